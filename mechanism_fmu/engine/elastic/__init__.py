"""How far elastic members give way under the inertia of the rigid motion: quasi-static, by the flexibility approach."""
