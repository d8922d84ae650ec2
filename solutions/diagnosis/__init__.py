"""Why an answer is wrong: the formulas edited, one thing at a time, until what was typed comes out."""
