"""Verge and foliot, the oldest escapement of clocks: only the wheel's torque swings it."""
