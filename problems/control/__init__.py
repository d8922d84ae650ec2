"""Problems: TD control."""
