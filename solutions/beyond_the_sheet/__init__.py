"""Kinematics and meta-learning, solved."""
