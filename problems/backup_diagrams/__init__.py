"""Problems: backup diagrams."""
