"""Problems: Dynamic programming."""
