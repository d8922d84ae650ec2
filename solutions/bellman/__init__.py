"""Solvers: Bellman equations."""
