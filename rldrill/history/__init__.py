"""The history: every answer of every quiz, in a log that only grows; what is computed from it lies beside it."""
