"""Exams: which problems they ask, in how many versions, for how many points and minutes, and their manifest."""
