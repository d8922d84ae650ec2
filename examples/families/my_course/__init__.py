"""A course of one's own."""
