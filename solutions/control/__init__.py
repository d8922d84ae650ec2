"""Solvers: TD control."""
