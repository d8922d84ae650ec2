"""Which state, action or option is meant by a typed name."""

import re
import unicodedata
from collections.abc import Iterable, Iterator, Sequence
from functools import lru_cache
from typing import TypeVar, cast

from rldrill.problems.expressions import GREEK
from rldrill.problems.spelling import Source, quoted, spelled

Key = TypeVar("Key", bound=str | tuple[str, str])

MARKS = "\u0300-\u036f"  # the hat, bar or tilde on a letter
# V(cool), V^(π₀)(cool), ln p(cool), (cool, fast)
_RAISED = r"[\^_]\s*\{(?:[^{}]|\{[^{}]*\})*\}|[\^_]\([^()]*\)"
_OF = re.compile(rf"(?:[^\W\d_](?:{_RAISED}|[\w '^*⊤{MARKS}])*)?[(\[](.*)[)\]]")
_BELOW = re.compile(rf"[^\W\d_][{MARKS}]?_(?:\{{(.*)\}}|(.*))")  # V_cool
_NUMBERED = re.compile(r"(?:[^\W\d_]{1,9}\s?|#)_?(\d+)")  # Q1, s1, arm 2, #2, where the name is a number
_LETTER = re.compile(r"[^\W\d_]['′]*(?:_?\d+)?")  # s, s', s_0
_INDEX = re.compile(r"(?<=\w)\((\d+)\)|_\{([^{}]*)\}")  # pi(1), s_{1}
_SPELLED_OUT = str.maketrans({glyph: name for name, glyph in GREEK.items()} | {"π": "pi", "∂": "d"})
#: A variance, which is called Σ, too; σ2 is σ² as it is copied, and what is asked for in step 2.
_SQUARE = re.compile(r"(?:σ|sigma)(?:(.*?)\s*(?:\^\s*\{?2\}?|²)|_?[2₂])")
_DEVIATION = re.compile(r"σ|sigma")
_COUNTED = re.compile(r"(?<=.)\^?\{?\([0-9⁰¹²³⁴⁵⁶⁷⁸⁹]+\)\}?$")
_LISTED = 60
_LONGEST = 120  # longer names are none
_WAYS = {
    "up": "↑ ⬆ ⇧ ▲ ^ up north n u upwards hoch oben",
    "down": "↓ ⬇ ⇩ ▼ v down south s d downwards runter unten",
    "left": "← ⬅ ⇦ ◀ < <- left west w l links",
    "right": "→ ➡ ⇨ ▶ > -> right east e r rechts",
}
_WAY = {sign: way for way, signs in _WAYS.items() for sign in signs.split()}
#: What is typed for a tie of all actions; of two, where there are only two.
_OF_ALL, _OF_TWO = ("any", "all"), ("both", "either")
_ALTERNATIVES = re.compile(r"\s+(?:or|and|oder|und)\s+|\s*(?:[/|&,;]|\bor\b|∨)\s*")


def shown(key: str | tuple[str, str]) -> str:
    """A key as sentences name it."""
    return key if isinstance(key, str) else f"({', '.join(key)})"


def listed(names: Iterable[str]) -> str:
    """Some names, not too many of them."""
    text = ", ".join(names)
    return text if len(text) <= _LISTED else text[: _LISTED - 1] + "…"


def the_key(name: str, keys: Sequence[Key], ends: Sequence[str], whole: Source) -> Key | None:
    """The key that a name means; None for a terminal state, which is none.

    Raises:
        Unreadable: it means none, or may mean several.
    """
    hits: list[Key | str] = list(keys_named(name, keys))
    if not hits and is_end(name, keys, ends):
        return None
    begun = [] if hits else _by_initials(name, ends)
    hits = hits or [*_by_initials(name, keys), *begun]
    if len(hits) == 1:
        return None if begun else cast("Key", hits[0])
    fault = f"may be any of {listed(map(shown, hits))}" if hits else "is not a key here"
    raise whole.unreadable(f"{quoted(name)} {fault}; the keys are {listed(map(shown, keys))}.")


def keys_named(name: str, keys: Sequence[Key]) -> list[Key]:
    """The keys that a name may mean: ``cool``, ``V(cool)``, ``V_cool``, ``p(cool|wet)``; ``Q(cool, fast)``."""
    spellings = _spellings(tuple(keys))
    for candidate in _candidates(name):
        spread = candidate if _single(keys) else _spread(candidate)
        if hits := matches(spread, spellings):
            return hits
    inner = _candidates(name)[1:]
    for candidate in inner:  # Pr(new|new, worn): the pair stands behind the bar; ln p(D|shared, θ): the first name does
        before, bar, behind = candidate.partition("|")
        if bar and not _single(keys) and (hits := matches(_spread(behind), spellings)):
            return hits
        if bar and _single(keys) and not matches(before, spellings):
            return matches(behind.partition(",")[0], spellings)
    return list(dict.fromkeys(hit for candidate in inner for hit in _beside(candidate, spellings, keys)))


def is_end(name: str, keys: Sequence[Key], ends: Sequence[str]) -> bool:
    """Whether a name means a terminal state, or an action in one."""
    spellings = [(end, end) for end in ends]
    for candidate in _candidates(name):
        if matches(candidate, spellings):
            return True
        words = [] if _single(keys) else _spread(candidate).split()
        if any(matches(" ".join(words[:count]), spellings) for count in range(1, len(words))):
            return True
    return False


def is_known(name: str, keys: Sequence[Key], ends: Sequence[str]) -> bool:
    """Whether a name means one key, or a terminal state; its first letter is enough."""
    hits = keys_named(name, keys)
    if len(hits) == 1 or is_end(name, keys, ends):
        return True
    return not hits and len(_by_initials(name, keys)) + len(_by_initials(name, ends)) == 1


def _single(keys: Sequence[Key]) -> bool:
    return not keys or isinstance(keys[0], str)


def _candidates(name: str) -> list[str]:
    """A name, and what stands in it where it is a function of that."""
    if len(name) > _LONGEST:
        return [""]
    found = [match for pattern in (_OF, _BELOW, _NUMBERED) if (match := pattern.fullmatch(name))]
    return [name, *(next(filter(None, match.groups()), "") for match in found)]


@lru_cache(maxsize=4096)
def _spread(name: str) -> str:
    return re.sub(r"[\s,/|;()]+", " ", name).strip()


@lru_cache(maxsize=16)
def _spellings(keys: tuple[Key, ...]) -> Sequence[tuple[str, Key]]:
    """How each key is typed; of pairs that have one half in common, or one for each state, the other half is enough."""
    spellings = [(key if isinstance(key, str) else _spread(" ".join(key)), key) for key in keys]
    pairs = [key for key in keys if not isinstance(key, str)]
    for half in (0, 1):
        if len({key[1 - half] for key in pairs}) == 1 or (
            half == 0 and len({state for state, _ in pairs}) == len(pairs)
        ):
            spellings += [(_spread(key[half]), key) for key in pairs]
    return tuple(spellings)


def _beside(inner: str, spellings: Sequence[tuple[str, Key]], keys: Sequence[Key]) -> Iterator[Key]:
    """The keys that stand beside something else: ``cool|wet``, ``D|cool``, ``s, fast``.

    Behind or before a bar that may be anything where keys are single names; else it is a letter.
    """
    free = "|" in inner and _single(keys)
    pieces = [piece.strip() for piece in re.split(r"[|]" if free else r"[|,]", inner)]
    found = {piece: matches(piece, spellings) for piece in pieces}
    if len(pieces) > 1 and all(hits or free or _LETTER.fullmatch(piece) for piece, hits in found.items()):
        for hits in found.values():
            yield from hits


def _by_initials(name: str, keys: Sequence[Key]) -> list[Key]:
    """The keys whose names begin with the one letter that is typed for each."""
    for candidate in _candidates(name):
        words = [candidate.strip()] if _single(keys) else _spread(candidate).split()
        if hits := [key for key in keys if _all_begin(words, (key,) if isinstance(key, str) else key)]:
            return hits
    return []


def _all_begin(words: Sequence[str], names: Sequence[str]) -> bool:
    if len(words) != len(names):
        return False
    same = [bool(matches(word, [(name, name)])) for word, name in zip(words, names, strict=True)]
    return all(is_it or _begins(word, name) for is_it, word, name in zip(same, words, names, strict=True))


def _begins(letter: str, name: str) -> bool:
    typed = spelled(unquoted(letter)).casefold()
    return len(typed) == 1 and typed.isalpha() and spelled(name).casefold().startswith(typed)


def options_named(word: str, allowed: Sequence[str]) -> list[str]:
    """The actions that a word may mean: its name, an arrow or a point of the compass, or its first letter."""
    spellings = [(option, option) for option in allowed]
    numbered = _NUMBERED.fullmatch(word)
    alike = (word, word.rstrip("."), *(numbered.groups() if numbered else ()))
    if hits := next(filter(None, (matches(each, spellings) for each in alike)), []):
        return hits
    typed = unquoted(word).casefold().replace("\ufe0f", "").rstrip(".")
    way = _WAY.get(typed, "")
    return [option for option in allowed if (way and _WAY.get(option.casefold()) == way) or _begins(typed, option)]


def _alternatives(text: str, allowed: Sequence[str]) -> list[str]:
    """What stands between commas, strokes and "or"; a name with a comma in it, such as ``(0,1)``, stays whole."""
    names = [r"\s*".join(map(re.escape, "".join(name.split()))) for name in allowed if _ALTERNATIVES.search(name)]
    pieces = re.split(f"({'|'.join(names)})", text) if names else [text]
    each = ([piece] if at % 2 else _ALTERNATIVES.split(piece) for at, piece in enumerate(pieces))
    return [piece for split in each for piece in split if piece.strip()]


def the_options(word: Source, place: str, allowed: Sequence[str]) -> tuple[str, ...]:
    """The action that is typed for a state, or the actions: ``E or S``.

    Raises:
        Unreadable: one is not allowed, or may be several.
    """
    inside = word.unwrapped() or word
    hits = options_named(word.text, allowed) or options_named(inside.text, allowed)
    if len(hits) == 1:
        return (hits[0],)
    several = _alternatives(inside.text, allowed)
    each = [options_named(piece, allowed) for piece in several]
    if (len(several) > 1 or inside is not word) and each and all(len(found) == 1 for found in each):
        chosen = {found[0] for found in each}
        return tuple(option for option in allowed if option in chosen)
    if not hits and inside.text.strip().casefold() in (*_OF_ALL, *(_OF_TWO if len(allowed) == 2 else ())):
        return tuple(allowed)
    fault = "may be any of" if hits else "is not one of"
    raise word.unreadable(f"{quoted(word.text)} {fault} {listed(hits or allowed)}; type one of them.").within(place)


def matches(typed: str, spellings: Iterable[tuple[str, Key]]) -> list[Key]:
    """What is spelled so; else if capitals do not count; else if ``_`` and spaces do not; else its name."""
    pairs = list(spellings)
    for form in (unquoted, _small, _bare, _plain):
        wanted = form(typed)
        if hits := [meant for spelling, meant in pairs if form(spelling) == wanted]:
            return hits
    wanted = _plain(typed)
    return [meant for spelling, meant in pairs if _unmarked(spelling) == wanted]


@lru_cache(maxsize=4096)
def unquoted(text: str) -> str:
    """A name in the one spelling, without quotes around it."""
    text = unicodedata.normalize("NFC", spelled(text))
    return text[1:-1].strip() if len(text) > 2 and text[0] == text[-1] and text[0] in "'\"`" else text


@lru_cache(maxsize=4096)
def _small(text: str) -> str:
    return unquoted(text).casefold()


@lru_cache(maxsize=4096)
def _bare(text: str) -> str:
    """A name without ``_``, spaces, and braces around an index or all of it."""
    text = _INDEX.sub(lambda match: match[1] or match[2] or "", _small(text))
    text = text[1:-1] if text[:1] == "{" and text[-1:] == "}" else text
    return re.sub(r"[_\s]", "", text)


@lru_cache(maxsize=4096)
def _plain(text: str) -> str:
    """The name in Latin letters: ``pi1`` for π₁ and ``pi(1)``."""
    return unicodedata.normalize("NFD", _bare(text)).translate(_SPELLED_OUT)


@lru_cache(maxsize=4096)
def _unmarked(text: str) -> str:
    """The same without what stands above or below letters, which may be left out where a name has it."""
    return "".join(sign for sign in _plain(text) if not unicodedata.combining(sign))


def entry_named(label: str, names: Sequence[str], called: Sequence[str] = ()) -> int | None:
    """Which entry a label means; its index may be left out where no other entry has the same letter.

    Args:
        label: what was typed before an entry.
        names: what the entries are, in mathematics.
        called: what they are called, in words; the beginning of one is enough.
    """
    label = label.strip()
    if is_deviation(label, names):
        return None
    if (squared := _SQUARE.fullmatch(label)) and not any(name.startswith("σ") for name in names):
        label = f"Σ{squared[1] or ''}"
    for form in (_plain, _unmarked, _loose, lambda name: _loose(name).rstrip("0123456789")):
        hits = [index for index, name in enumerate(names) if form(name) in (_plain(label), _loose(label))]
        if len(hits) == 1:
            return hits[0]
    begun = [index for index, word in enumerate(called) if word.startswith(label.casefold())]
    if not begun and (bare := _COUNTED.sub("", label)) != label:
        return entry_named(bare, names, called)  # R_0^(3), where three steps go to the end and it is R_0
    return begun[0] if len(begun) == 1 else None


def is_deviation(label: str, names: Sequence[str]) -> bool:
    """Whether a label is that of a standard deviation, where variances are asked for."""
    label = label.strip()
    named = _DEVIATION.match(label) and not _SQUARE.fullmatch(label)
    return (
        bool(named) and not any(name.startswith("σ") for name in names) and any(name.startswith("Σ") for name in names)
    )


def _loose(name: str) -> str:
    """The same with what is raised on the line, and without quotes: ``R01`` for ``R₀⁽¹⁾``, ``wtmua`` for ``wᵀμ(A)``."""
    spelled = unicodedata.normalize("NFKC", _unmarked(name)).replace("⊤", "T")
    return re.sub(r"[\^(){}\"]", "", spelled).casefold()
