"""Documents for a terminal, as plain text, as Markdown and as Typst, one writer a module; mathematics and pictures."""
