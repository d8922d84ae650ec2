"""The quiz: ``session`` is what happens, ``screen`` is how it looks, ``prompt`` is how it is typed."""
