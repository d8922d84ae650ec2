"""Solvers: Linear methods: LQR."""
