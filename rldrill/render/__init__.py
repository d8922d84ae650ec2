"""Documents and mathematics as text for the terminal, Typst, LaTeX and Markdown."""
