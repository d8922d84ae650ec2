"""Solvers: Returns and the elements of a reinforcement learning problem."""
