"""Problems: Temporal difference learning."""
