"""How a mechanism moves: a generic, table-driven engine in the part of Python that compiles without Python objects.

`run.engine_for` is the way in. What each folder holds, from the ground up; each knows only those before it:

    compiler      the part of Python that the engine is written in, and how it is compiled
    block         an instance's memory: what stands where in it, and views of it by subject
    profiles      curves, and where two cam profiles are nearest to each other
    constraints   Phi, Phi_q, nu, gamma: the rows of joints, drivers and contacts
    dynamics      from forces and rows to accelerations: eq (3), the minimum-norm solve, friction
    contacts      gaps and their guards, impacts by eq (7), who pushes, and what happens at an event
    stepping      a Runge-Kutta step, the first event within it, and communication steps
    starting      assembly of the start position

`library.py` is the engine as a C library; `status.py` says how a call has ended.
"""
