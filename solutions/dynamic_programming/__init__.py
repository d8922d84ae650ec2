"""Solvers: Dynamic programming."""
