"""How a machine takes a step: one algorithm a file, behind `base.Algorithm`."""

__all__ = ["adaptive", "base", "event_aware", "gauss_seidel", "jacobi"]
