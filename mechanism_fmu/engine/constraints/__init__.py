"""The constraint rows Phi, Phi_q, nu, gamma of joints, drivers and contacts, at the instant that is looked at."""
