"""Problems: Function approximation."""
