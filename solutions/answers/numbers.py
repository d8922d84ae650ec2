"""Typed numbers worked out exactly, and shown back as they were read."""

import re
from collections.abc import Mapping, Sequence

import sympy
from flint import fmpq
from msgspec import Struct

from rldrill.problems.exact import PARAMETERS
from rldrill.problems.grammar import RAISED, read
from rldrill.problems.notation import (
    ATOM,
    FUNCTIONS,
    POWER,
    PRODUCT,
    SUM,
    Name,
    Node,
    Numeral,
    Operation,
    folded,
    nodes,
    rank,
)
from rldrill.problems.spelling import VULGAR, Source, Unreadable, quoted
from rldrill.solutions.answers.arithmetic import Arithmetic
from rldrill.solutions.answers.rule import equivalent, within
from rldrill.solutions.answers.source import bare
from rldrill.solutions.exact import Value
from rldrill.solutions.exact import parameters as parameters_of

_ECHO = 60
_CONSTANTS = {"e": sympy.E, "pi": sympy.pi}
#: How strongly the parts of an operation must bind to need no brackets.
_LEAST = {"+": (SUM, PRODUCT), "-": (SUM, PRODUCT), "*": (PRODUCT, POWER), "/": (PRODUCT, POWER), "^": (ATOM, ATOM),
          "%": (ATOM,)}  # fmt: skip
_QUOTED = re.compile(r"""\((['"])([^'"()]*)\1\)""")  # Decimal('0.25')
#: The letter x between numbers, in Latin or Cyrillic; 0x10 is something else.
_TIMES = re.compile(rf"(?<![0-9A-Za-z_])((?!0[xX])[0-9.]*[0-9.]|(?<=[0-9])[%{VULGAR}])\s*[xXхХ]\s*([0-9.√{VULGAR}])")
_EQUAL = re.compile(r"==|≈|(?<=[^=~≈])~|≡|,?\s(?:or|i\.\s?e\.,?)\s")
_AGAIN = re.compile(r"(?:i\.\s?e\.,?|or\b|[=≈~]|approx(?:imately)?\b\.?|about\b|ca\b\.?)*\s*", re.IGNORECASE)
#: A decimal with the digits behind its point, and its power of ten: 8.1e-9, 8.1*10^(-9), 8.1*10⁻⁹.
_DECIMAL = re.compile(
    r"[-+]?\s*(?:[0-9]+(?:\.(?P<behind>[0-9]*))?|\.(?P<alone>[0-9]+))"
    r"(?:e(?P<e>[-+]?[0-9]+)|\s*\*\s*10\s*(?:\^\s*[({]?\s*(?P<caret>[-+]?\s*[0-9]+)\s*[)}]?|(?P<raised>[⁺⁻]?[⁰¹²³⁴-⁹]+)))?"
    r"\s*(?P<percent>%)?",
    re.IGNORECASE,
)
_PLAIN = re.compile(r"(-?[0-9]{1,15})(?:\.([0-9]{1,15})|/([1-9][0-9]{0,14}))?")
_MOST_FORMS = 8
#: What may be said behind a number of how exact it is, and that its last digits repeat.
_ABOUT_BEHIND = re.compile(r"\s*\(?\s*\b(?:approx(?:imately)?|rounded|exact(?:ly)?)\b\.?\s*\)?$", re.IGNORECASE)
_REPEATING = re.compile(r"(?<=\.)([0-9]+)\s*\(?(?:repeating|recurring|periodic)\b\)?", re.IGNORECASE)
_WORD = re.compile(r"(?<![A-Za-z0-9_\\'\"])[A-Za-z]{2,}(?![A-Za-z0-9_.(\[])")
#: What parameters are called for short.
_SHORT = {"lam": "lambda", "eps": "epsilon"}
_ENDLESS = frozenset({"nan", "inf", "infinity", "∞"})


class Reading(Struct, frozen=True):
    """A number that was typed.

    Attributes:
        value: the exact value.
        echo: how it was read, short enough to be shown back.
        decimal: whether it holds a decimal point, an exponent or a percent, and so may be rounded.
    """

    value: Value
    echo: str
    decimal: bool


def plain(text: str) -> Reading | None:
    """A number that needs no grammar, read at once: 3, -0.75, 3/4; None, if it is anything else."""
    match = _PLAIN.fullmatch(text)
    if match is None:
        return None
    whole, decimals, below = match.groups()
    value = fmpq(int(whole + (decimals or "")), int(below or 10 ** len(decimals or "")))
    return Reading(value, text, decimals is not None)


def number(source: Source, parameters: Sequence[str], arithmetic: Arithmetic) -> Reading:
    """Read one number, or one number in several forms: ``1/4 = 0.25``, ``0.25 (25%)``, ``1/3 ≈ 0.333``.

    Args:
        source: all that was typed of it.
        parameters: the open parameters it may contain.
        arithmetic: what it is worked out with; one for the whole answer.

    Raises:
        Unreadable: it is not a number, or not one of moderate size, or may be read as two.
    """
    source = bare(source).replaced(_QUOTED, lambda match: f"({match[2]})").replaced(_ABOUT_BEHIND, lambda _: "")
    source = source.replaced(_REPEATING, _with_bars)
    if "x" not in parameters:
        source = source.replaced(_TIMES, lambda match: f"{match[1]}*{match[2]}")
    if source.text[-2:] in (").", "%.", "}.", "]."):  # the end of a sentence
        source = source.part(0, len(source.text) - 1)
    _refuse_two_signs(source)
    forms = _forms(source)
    if len(forms) == 1:
        return _in_brackets(source, parameters, arithmetic) or _single(source, parameters, arithmetic).reading
    readings = [_single(form, parameters, arithmetic) for form in forms]
    for form in readings[1:]:
        if not _agree(readings[0], form):
            first, other = readings[0].reading.echo, form.reading.echo
            raise form.source.unreadable(
                f"It says {quoted(first)} and {quoted(other)}, which differ; write one number."
            )
    return _together(readings)


class _Form(Struct, frozen=True):
    """A number in one form, with the text and the tree of it."""

    source: Source
    tree: Node
    reading: Reading


def _single(source: Source, parameters: Sequence[str], arithmetic: Arithmetic) -> _Form:
    """A number in one form."""
    try:
        tree = read(source)
    except Unreadable:
        _refuse_words(source, parameters)
        raise
    units = _behind_numbers(tree)
    names = {node.text: _meant(node, parameters, node in units) for node in nodes(tree) if isinstance(node, Name)}

    def worth(node: Node, parts: list[Value]) -> Value:
        try:
            return _worth(node, parts, names, arithmetic)
        except Unreadable as complaint:  # of the arithmetic, which knows no columns
            raise Unreadable(complaint.message, node.at) from None

    value = arithmetic.finish(folded(tree, worth))
    echo = folded(tree, lambda node, parts: _echo(node, parts, names))
    return _Form(source, tree, Reading(value, _cut(echo), any(map(_is_decimal, nodes(tree)))))


def _with_bars(match: re.Match[str]) -> str:
    """The digits behind the point with bars over those that repeat, if one sees which: 0.3 repeating."""
    digits = match[1]
    return "".join(f"{digit}\u0305" for digit in digits) if len({*digits}) == 1 else f"{digits}..."


def _refuse_words(source: Source, parameters: Sequence[str]) -> None:
    """Complain about the first word that has no place in a number: it is why nothing can be made of the rest.

    Raises:
        Unreadable: there is one.
    """
    for word in _WORD.finditer(source.text):
        if word[0].lower() not in FUNCTIONS:
            behind = source.text[: word.start()].rstrip()[-1:].isdigit()
            _meant(Name(word[0], source.column(word.start())), parameters, behind)


def _cut(echo: str) -> str:
    return echo if len(echo) <= _ECHO else f"{echo[: _ECHO - 1]}…"


def _sign(node: Node) -> str:
    """The sign of an operation, with a name of its own for that of a negative."""
    if not isinstance(node, Operation):
        return ""
    return "negative" if node.sign == "-" and len(node.parts) == 1 else node.sign


def _behind_numbers(tree: Node) -> list[Name]:
    """The names that follow a number without a sign: parameters, or units."""
    return [
        right
        for node in nodes(tree)
        if isinstance(node, Operation) and node.sign == "*" and node.at == node.parts[1].at
        for left, right in [node.parts]
        if isinstance(left, Numeral) and isinstance(right, Name)
    ]


def _refuse_two_signs(source: Source) -> None:
    """Complain about two signs before a number: a plus or minus, or a dash typed as two signs."""
    if signs := re.match(r"(\+-|-\+|--)\s*([0-9.][0-9./]*)", source.text):
        readings = {"+-": ("-{}", "±{}"), "-+": ("-{}", "∓{}"), "--": ("{}", "-{}")}[signs[1]]
        shown = " or ".join(quoted(reading.format(signs[2])) for reading in readings)
        raise source.unreadable(f"{quoted(signs[0])} may be {shown}; write one sign at most.")


def _forms(source: Source) -> list[Source]:
    """The pieces between signs of equality; before the first there may be nothing."""
    forms = source.replaced(_EQUAL, lambda _: "=").split("=")
    if len(forms) > _MOST_FORMS:
        raise source.unreadable("The number is given too often; write it once.")
    if len(forms) > 1 and not forms[-1].text:
        raise source.unreadable("A number is missing after the last sign; write one.", len(source.text) - 1)
    return forms if forms[0].text or len(forms) == 1 else forms[1:]


def _in_brackets(source: Source, parameters: Sequence[str], arithmetic: Arithmetic) -> Reading | None:
    """A number and the same again in brackets, ``0.25 (1/4)``; None if it is something else, such as a product."""
    ends = [index for index, character in source.outside() if character in "()"][-2:]
    if len(ends) < 2 or ends[1] != len(source.text) - 1:
        return None
    outside, inside = source.part(0, ends[0]), source.part(ends[0] + 1, ends[1])
    said = _AGAIN.match(inside.text)
    again = bool(said and said.end())
    inside = inside.part(said.end() if said else 0, len(inside.text))
    last, spaced = outside.text[-1:], source.text[ends[0] - 1].isspace()
    if not (last.isalnum() or last in (".", "%", "°", ")", "}", "]", "…") or last in VULGAR):
        return None
    try:
        plain_inside = again or _is_plain(read(inside))
        first, second = (_single(form, parameters, arithmetic) for form in (outside, inside))
    except Unreadable:
        return None
    agree = _agree(first, second)
    if not plain_inside and not (spaced and (agree or _agree(second, first))):  # 0.707 (√2/2)
        return None
    if again:
        if agree:
            return _together([first, second])
        raise source.unreadable(f"It says {_both(first, second)}, which differ; write one number.")
    if not agree and not (spaced and _is_plain(first.tree) and last != ")"):
        return None
    try:
        product = _single(source, parameters, arithmetic)
    except Unreadable:  # it is not one for sure
        return _together([first, second]) if agree and spaced else None
    same_text = outside.text == inside.text
    if product.reading.value == first.reading.value or (same_text and not spaced):
        return product.reading
    if agree and not same_text and spaced and last != ")" and not _may_be_product(first, second):
        return _together([first, second])
    readings = f"{quoted(product.reading.echo)} or say {_both(first, second)}"
    raise source.unreadable(f"{quoted(source.text)} may be {readings}; write one number.")


def _is_plain(tree: Node) -> bool:
    """Whether a number stands there as it is written, and no sum or product."""
    return all(isinstance(node, Numeral) or _sign(node) in ("/", "%", "negative") for node in nodes(tree))


def _may_be_product(first: _Form, second: _Form) -> bool:
    """Whether what stands in brackets may be a factor of a sum's last term, in spite of being worth the sum."""
    return any(_sign(node) in ("+", "-") for node in nodes(first.tree)) and second.source.text.isdigit()


def _both(first: _Form, second: _Form) -> str:
    return f"{quoted(first.reading.echo)} and {quoted(second.reading.echo)}"


def _agree(first: _Form, second: _Form) -> bool:
    """Whether the second form says the same as the first, or is the first rounded to the digits it has."""
    exact, other = first.reading.value, second.reading.value
    if exact == other:
        return True
    if parameters_of(exact) or parameters_of(other) or not second.reading.decimal:
        return equivalent(other, exact)
    decimal = _DECIMAL.fullmatch(second.source.text)
    if decimal is None:
        return equivalent(other, exact)
    power = "".join((decimal["e"] or decimal["caret"] or decimal["raised"] or "0").translate(RAISED).split())
    places = len(decimal["behind"] or decimal["alone"] or "") - int(power) + 2 * bool(decimal["percent"])
    return within(other, exact, fmpq(10) ** -places / 2)


def _together(forms: Sequence[_Form]) -> Reading:
    """The reading of a number that stands there in several forms: the first, with all of them shown."""
    first = forms[0].reading
    echo = first.echo
    for form in forms[1:]:
        echo += f" {'=' if form.reading.value == first.value else '≈'} {form.reading.echo}"
    return Reading(first.value, _cut(echo), first.decimal)


def _meant(name: Name, parameters: Sequence[str], behind_number: bool) -> str:
    """The parameter or constant that is meant by a name."""
    typed = name.text if name.text in parameters else name.text.lower()
    typed = _SHORT.get(typed, typed)
    if typed == "e" and "epsilon" in parameters:
        raise Unreadable("'e' may be ε or the number e; write epsilon, or exp(1).", name.at)
    for parameter in parameters:
        if typed in (parameter, PARAMETERS.get(parameter)):
            return parameter
    constant = "pi" if typed == "π" else typed
    if constant in _CONSTANTS:
        return constant
    if typed in _ENDLESS:
        message = f"{quoted(name.text)} is not a number; write a finite one."
    else:
        instead = "write the number alone, without a unit" if behind_number else "write a number such as 3/4"
        instead = f"it may contain {', '.join(parameters)}" if parameters else instead
        message = f"{quoted(name.text)} is not something this answer may contain; {instead}."
    raise Unreadable(message, name.at)


def _worth(node: Node, parts: list[Value], names: Mapping[str, str], arithmetic: Arithmetic) -> Value:
    """What a node is worth, by what its parts are worth."""
    if isinstance(node, Numeral):
        return fmpq(node.value.numerator, node.value.denominator)
    if isinstance(node, Name):
        name = names[node.text]
        return _CONSTANTS[name] if name in _CONSTANTS else arithmetic.parameter(name)
    if node.sign == "-":
        negative = arithmetic.negate(parts[-1])
        return arithmetic.add(parts[0], negative) if len(parts) == 2 else negative
    if node.sign == "%":
        return arithmetic.divide(parts[0], fmpq(100))
    work = {"+": arithmetic.add, "*": arithmetic.multiply, "/": arithmetic.divide, "^": arithmetic.power}
    return work[node.sign](*parts) if node.sign in work else arithmetic.call(node.sign, parts)


def _echo(node: Node, parts: list[str], names: Mapping[str, str]) -> str:
    """How a node is shown back, by how its parts are."""
    if isinstance(node, Numeral):
        return (f"0{node.text}" if node.text.startswith(".") else node.text).removesuffix(".").lower()
    if isinstance(node, Name):
        return names[node.text]

    single = len(parts) == 1
    least = (PRODUCT,) if node.sign == "-" and single else _LEAST.get(node.sign, (SUM,) * len(parts))
    shown = [
        text if rank(part) >= needed else f"({text})"
        for part, text, needed in zip(node.parts, parts, least, strict=True)
    ]
    if node.sign in ("/", "^") and shown[1].endswith("%"):
        shown[1] = f"({shown[1]})"
    if node.sign == "/" and shown[0].endswith("^1"):  # 2^1/3 could be 2^(1/3)
        shown[0] = f"({shown[0]})"
    match node.sign:
        case "+" | "-":
            return f"-{shown[0]}" if single else f" {node.sign} ".join(shown)
        case "*" | "/" | "^":
            return node.sign.join(shown)
        case "%":
            return f"{shown[0]}%"
    return f"{node.sign}({', '.join(shown)})"


def _is_decimal(node: Node) -> bool:
    if isinstance(node, Numeral):
        return not node.text.replace("/", "").isdigit()
    return not isinstance(node, Name) and node.sign == "%"
