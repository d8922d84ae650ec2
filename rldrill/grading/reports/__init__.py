"""Reports for programs and people, a module for every form: each takes a ``Report`` and gives the text of a file."""
