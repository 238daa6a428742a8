"""Deflection of elastic members under the inertia of the rigid motion: quasi-static, by the flexibility approach."""
