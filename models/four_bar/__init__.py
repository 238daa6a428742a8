"""The four-bar linkage: crank, coupler and rocker between two fixed hinges, open or crossed."""
