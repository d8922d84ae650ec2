"""Problems: Inverse reinforcement learning."""
