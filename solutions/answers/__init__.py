"""Reading and judging answers: text to exact value, exact value to verdict."""
