"""How it is answered: the formula sheet, and the solver of every family of problems.

``sheet`` holds the formulas, ``formula`` what a formula is, ``answers`` how a typed answer is read and
judged; every other subfolder is a topic, and mirrors the folder of that name in ``problems``.
"""
