"""Solvers: Inverse reinforcement learning."""
