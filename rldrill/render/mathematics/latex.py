"""Mathematics as LaTeX, for Markdown, notebooks and flash cards."""

from collections.abc import Iterator
from functools import lru_cache

from rldrill.problems.document import pieces
from rldrill.problems.mathematics import (
    Accent,
    Big,
    Fence,
    Fraction,
    Glyph,
    Marked,
    Math,
    Root,
    Row,
    Script,
    Tabular,
    is_sign,
    with_joined_scripts,
)
from rldrill.render.mathematics.scripts import taken_apart
from rldrill.render.mathematics.spacing import is_tall, needs_space, parted
from rldrill.render.mathematics.unicode import ABOVE, BELOW, unmarked

_COMMANDS = {
    "α": r"\alpha", "β": r"\beta", "γ": r"\gamma", "δ": r"\delta", "ε": r"\varepsilon", "θ": r"\theta",
    "λ": r"\lambda", "μ": r"\mu", "π": r"\pi", "ρ": r"\rho", "σ": r"\sigma", "τ": r"\tau", "φ": r"\phi", "χ": r"\chi",
    "ξ": r"\xi", "∞": r"\infty", "∇": r"\nabla", "𝔼": r"\mathbb{E}", "·": r"\cdot", "×": r"\times", "±": r"\pm",
    "−": "-", "≤": r"\le", "≥": r"\ge", "≠": r"\ne", "≈": r"\approx", "←": r"\leftarrow", "→": r"\to",
    "∈": r"\in", "…": r"\dots", "|": r"\mid", ":": r"\colon", "‖": r"\Vert", "∀": r"\forall", "Σ": r"\sum",
    "Π": r"\prod", "∫": r"\int",
    "max": r"\max", "min": r"\min", "arg max": r"\mathop{\text{arg max}}", "ln": r"\ln", "exp": r"\exp",
    "log": r"\log", "sin": r"\sin", "cos": r"\cos", "tan": r"\tan", "∂": r"\partial", "Δ": r"\Delta", "ω": r"\omega",
    "*": "*", "{": r"\{", "}": r"\}", "%": r"\%", "_": r"\_", "#": r"\#", "&": r"\&",
}  # fmt: skip
_SPELLED = {
    "\\": r"\textbackslash{}", "~": r"\textasciitilde{}", "^": r"\textasciicircum{}", "#": r"\#", "$": r"\$",
    "%": r"\%", "&": r"\&", "_": r"\_", "{": r"\{", "}": r"\}", "–": "--", "—": "---", "“": "``", "”": "''", "’": "'",
    "…": r"\dots{}",
    "√": r"\ensuremath{\surd}", "Σ": r"\ensuremath{\Sigma}",
    "′": r"\ensuremath{'}", "\u200b": "", "\u0302": "", "\u0304": "", "\u0303": "",
}  # fmt: skip
_LOWERED = {small: _COMMANDS.get(sign, sign) for sign, small in BELOW.items()}
_RAISED = {small: _COMMANDS.get(sign, sign) for sign, small in ABOVE.items()}
_PLAIN_WORDS = {"max", "min", "ln", "exp", "log", "sin", "cos", "tan"}
_OPERATORS = {Glyph(word, "word") for word in _PLAIN_WORDS}


def latex_plain(text: str) -> str:
    """Text without mathematics: every sign of it stands for itself, also those that only mathematics has.

    No line ends behind the hyphen of Q-learning.
    """
    spelled = (("".join(map(_spelled, piece)), whole) for piece, whole in parted(text))
    return "".join(rf"\mbox{{{piece}}}" if whole else piece for piece, whole in spelled)


def latex_text(text: str) -> str:
    """Running text with its mathematics; every sign of it stands for itself."""
    return "".join(
        latex_plain(piece) if isinstance(piece, str) else f"${latex_typed(piece)}$" for piece in pieces(text)
    )


def latex_typed(math: Math) -> str:
    """Mathematics as LaTeX that every engine reads: signs that only Unicode has are spelled."""
    return typed(latex(math))


def typed(written: str) -> str:
    """LaTeX with the signs spelled that only Unicode has."""
    return "".join(sign if sign.isascii() else f"{{{_spelled(sign)}}}" for sign in written)


def _spelled(sign: str) -> str:
    if sign in _SPELLED:
        return _SPELLED[sign]
    if sign in _LOWERED:
        return rf"\ensuremath{{_{_LOWERED[sign]}}}"
    if sign in _RAISED:
        return rf"\ensuremath{{^{_RAISED[sign]}}}"
    return sign if sign.isascii() or sign not in _COMMANDS else rf"\ensuremath{{{_COMMANDS[sign]}}}"


def latex(math: Math) -> str:
    """Mathematics as LaTeX, without the signs that open and close it."""
    match math:
        case Glyph(text, style):
            return _glyph(text, style)
        case Row(items):
            return " ".join(_spaced(items))
        case Fraction(numerator, denominator):
            return rf"\frac{{{latex(numerator)}}}{{{latex(denominator)}}}"
        case Script():
            return _script(with_joined_scripts(math))
        case Fence(body, left, right):
            if is_tall(body):
                return rf"\left{_fence(left)} {latex(body)} \right{_fence(right)}"
            room = " " if left in _COMMANDS else ""
            return f"{_bracket(left)}{room}{latex(body)}{room}{_bracket(right)}"
        case Big(sign, below, above):
            base = _COMMANDS.get(sign, rf"\mathop{{\text{{{sign}}}}}")  # GitHub has no \operatorname
            return base + _scripts(_optional(below), _optional(above))
        case Root(body):
            return rf"\sqrt{{{latex(body)}}}"
        case Accent(body, mark):
            return rf"\{mark}{{{latex(body)}}}"
        case Marked(body):  # MathJax takes the braces behind a colour for all that it colours, LaTeX does not
            around = "boxed" if is_sign(body) else "underline"  # a line below a plus would make another sign of it
            return rf"{{\color{{red}}{{\{around}{{{latex(body)}}}}}}}"
        case Tabular(rows, left, right):
            lines = r" \\ ".join(" & ".join(map(latex, line)) for line in rows)
            return rf"\left{_fence(left)} \begin{{matrix}} {lines} \end{{matrix}} \right{_fence(right)}"


def _script(script: Script) -> str:
    body, below, above = script.body, _optional(script.below), _optional(script.above)
    if isinstance(body, Glyph):
        return _glyph(body.text, body.style, below, above)
    return f"{{{latex(body)}}}{_scripts(below, above)}"


def _spaced(items: tuple[Math, ...]) -> Iterator[str]:
    """What stands side by side, with a space where a word needs one; an operator such as ln has its own."""
    bare = [unmarked(item) for item in items]
    for before, after, item in zip((None, *bare), bare, items, strict=False):
        if before is not None and needs_space(before, after) and not {before, after} & _OPERATORS:
            yield "\\"  # and the space behind it
        yield latex(item)


def _fence(sign: str) -> str:
    """A bracket that grows; none at all is a full stop to LaTeX."""
    return _bracket(sign) or "."


def _bracket(sign: str) -> str:
    """A bracket; a bar is no relation here."""
    return "|" if sign == "|" else _COMMANDS.get(sign, sign)


@lru_cache(maxsize=1024)  # the same letters stand everywhere
def _glyph(text: str, style: str, below: str = "", above: str = "") -> str:
    """A glyph with its scripts; of its own it has those of ``s₁′``."""
    if style not in ("variable", "word"):  # a comma within a number, and none behind which there is room
        sign = text.replace(",", "{,}") if style == "number" else _COMMANDS.get(text, text)
        return sign + _scripts(below, above)
    stem, digits, primes = taken_apart(text, style)
    return _named(stem, style) + "'" * primes + _scripts(" , ".join(filter(None, (digits, below))), above)


def _named(stem: str, style: str) -> str:
    if style == "word" and stem not in _PLAIN_WORDS:
        return rf"\text{{{''.join(_COMMANDS.get(sign, sign) if sign in '%_#&{}' else sign for sign in stem)}}}"
    if style == "variable" and stem == "Σ":  # a matrix of covariances, no sum
        return r"\Sigma"
    return _COMMANDS.get(stem, stem)


def _scripts(below: str, above: str) -> str:
    return (f"_{{{below}}}" if below else "") + (f"^{{{above}}}" if above else "")


def _optional(math: Math | None) -> str:
    return "" if math is None else latex(math)
