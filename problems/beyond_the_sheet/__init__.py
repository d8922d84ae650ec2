"""What the lecture's introduction names without a formula: kinematics and meta-learning."""
