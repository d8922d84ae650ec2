"""Problems: Policy gradient methods."""
