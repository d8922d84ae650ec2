"""Solutions: How unknown actions come to be tried."""
