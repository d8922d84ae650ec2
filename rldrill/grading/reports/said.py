"""What is said of one part, as far as a report tells it."""

from rldrill.grading.report import FEEDBACK, MarkedPart
from rldrill.spreadsheet import JOINERS


def sentence(part: MarkedPart, feedback: str) -> str:
    """The verdict, the reason and the key, or what of them is told."""
    amount, judged = FEEDBACK.index(feedback), part.judged
    said = [judged.verdict] if amount >= FEEDBACK.index("verdict") else []
    if amount >= FEEDBACK.index("reason") and judged.verdict != "right":
        said.append(judged.reason)
    if amount >= FEEDBACK.index("key"):
        said.append(f"Key: {judged.key}")
    return ": ".join(said[:2]) + (f" {said[2]}" if len(said) > 2 else "")


def located(part: MarkedPart, feedback: str) -> str:
    """The same, and where the answer stands if it is not right."""
    said = sentence(part, feedback)
    return f"{said} ({part.place})" if said and part.place and not part.judged.accepted else said


def one_line(text: str) -> str:
    """A text that can be shown anywhere: what controls a terminal, and line ends, are written out."""
    return "".join(sign if sign.isprintable() or sign in JOINERS else repr(sign)[1:-1] for sign in text)
