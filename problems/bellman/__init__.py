"""Problems: Bellman equations."""
