"""Runge-Kutta steps, the first event within one, and the communication steps that are made of them."""
