"""Plain sentences that name quantities, "minus the baseline: Rₜ − b(sₜ)", in the notation in use."""

import re
from unicodedata import normalize

from rldrill.problems.mathematics import Math, mathematics
from rldrill.problems.notations import LECTURE, all_in_notation, in_use
from rldrill.render.mathematics.unicode import unicode

_LETTER = r"[A-Za-zα-ωΑ-Ωā]"
_BELOW, _ABOVE = "₀-₉₊₋ₐ-ₜᵢ", "⁰¹²³⁴-⁹⁺⁻ᵃ-ᵛⁱⁿᵀ"
_ONE = rf"{_LETTER}[\u0300-\u036f]*′*(?:\^[π*]|\*)?[{_BELOW}′]*[{_ABOVE}]*"
#: Letters with whatever stands at them; what has nothing at it and is no letter alone is a word of the sentence.
_NAMED = re.compile(rf"(?<![\w'′])(?:{_ONE})+(?![\w*])")
_EACH = re.compile(_ONE)
_BARE = re.compile(r"[A-Za-z]{2,}")
_PRODUCTS = ("BL", "Qs", "Ra")
#: A letter alone that may be an article; it is none between signs: (s, a), B a, a = 0.
_ARTICLE = re.compile(r"(?<![(|+=−·BA] )(?<![(|,])\b[aA]\b(?!′)(?=\s[A-Za-z]|\.?$)|\bI\b")


def in_letters(sentence: str) -> str:
    """A sentence with its quantities as the notation in use writes them; what stands between ``$`` signs stays."""
    if in_use().notation == LECTURE:
        return sentence
    pieces = sentence.split("$")
    return "$".join([piece if number % 2 else _in_letters(piece) for number, piece in enumerate(pieces)])


def _in_letters(sentence: str) -> str:
    articles = {match.start() for match in _ARTICLE.finditer(sentence)}
    found = [
        match
        for match in _NAMED.finditer(sentence)
        if match.start() not in articles and (not _BARE.fullmatch(match[0]) or match[0] in _PRODUCTS)
    ]
    named = [_mathematics(match[0]) for match in found]
    pieces, end = [], 0
    for match, before, after in zip(found, named, all_in_notation(named), strict=True):
        pieces += [sentence[end : match.start()], match[0] if after == before else normalize("NFC", unicode(after))]
        end = match.end()
    return "".join([*pieces, sentence[end:]])


def _mathematics(text: str) -> Math:
    """What is written with signs above and below letters, in the notation between ``$`` signs."""
    text = " ".join(_EACH.findall(text))
    text = re.sub(rf"[{_BELOW}]+(?:′[{_BELOW}]*)*", lambda match: f"_{{{_apart(normalize('NFKC', match[0]))}}}", text)
    text = re.sub(rf"[{_ABOVE}]+", lambda match: f"^{{{_raised(match[0])}}}", text)
    return mathematics(re.sub(r"(?<!\^)\*", "^*", text))


def _apart(letters: str) -> str:
    return re.sub(r"(?<=[a-z′])(?=[a-z])", " ", letters)


def _raised(signs: str) -> str:
    return normalize("NFKC", signs).replace("T", "⊤")
