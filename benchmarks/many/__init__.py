"""Many designs: the fast path against MuJoCo's batched rollout, and against solve_ivp in a process pool."""
