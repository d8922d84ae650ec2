"""Solvers: Temporal difference learning."""
