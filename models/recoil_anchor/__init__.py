"""The recoil anchor escapement: a pendulum's anchor pushes the wheel back after each tick."""
