"""Exams and the catalogue in the formats that other programs read."""
