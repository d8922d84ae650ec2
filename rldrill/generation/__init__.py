"""Problems in bulk: which are drawn, what is written of each, and by how many processes or machines."""
