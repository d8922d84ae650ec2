"""Solvers: backup diagrams."""
