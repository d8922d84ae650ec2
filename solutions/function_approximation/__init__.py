"""Solvers: Function approximation."""
