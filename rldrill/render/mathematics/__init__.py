"""Mathematics in one notation each: one line of Unicode, several lines, LaTeX, Typst."""
