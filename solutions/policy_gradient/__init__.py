"""Solvers: Policy gradient methods."""
