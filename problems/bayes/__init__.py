"""Problems: Bayesian methods."""
