"""Constraint equations of joints: one file each, with Phi, Phi_q, nu and gamma (ME451, after Haug).

Every function writes the rows of one joint: residual Phi, its rate Phi' = Phi_q qd - nu, gamma (so that
Phi_q qdd = gamma) and the Jacobian Phi_q, whose columns 3i, 3i+1, 3i+2 belong to body i.
"""
