"""Solvers: Bayesian methods."""
