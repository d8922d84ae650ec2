"""What is kept of an answer, and how it is written as a line of JSON."""

import json
from collections.abc import Iterable, Iterator, Mapping
from datetime import UTC, datetime
from typing import Annotated, Any

from msgspec import Meta, Struct
from msgspec.structs import asdict, fields, replace

from rldrill.problems.errors import FileError
from rldrill.problems.identity import LEVELS

#: How a part may end without an answer.
SKIPPED, SHOWN = "skipped", "working shown"
#: What an answer may be; ``rldrill.solutions.answers.judging`` says what each means.
OUTCOMES = ("right", "follow-through", "close", "misconception", "wrong", SKIPPED, SHOWN)


class Attempt(Struct, frozen=True):
    """One answer to one part, or that it was given up.

    Args:
        id: its own name, so that a log that is read in twice counts once.
        time: when, with a time zone.
        sitting: the name that all attempts at one problem share, from its first showing to its end.
        family: what was asked.
        level: its level; None for a problem from outside, and so are ``seed`` and ``revision``.
        part: the letter of the part, and ``parts`` how many the problem has.
        typed: what was typed.
        outcome: what it is, one of ``OUTCOMES``.
        misconceptions: the names of the mistakes that give this answer, or the kind of cause that was found.
        hints: how many hints were read for the part before.
        retries: how many answers to the part counted before.
        seconds: since the part was asked, or since the attempt before.
        credit: the share of the part's points that it earns, 0 to 1.
    """

    id: str
    time: Annotated[datetime, Meta(tz=True)]
    sitting: str
    family: str
    level: int | None
    seed: int | None
    revision: int | None
    part: str
    parts: int
    typed: str
    outcome: str
    misconceptions: tuple[str, ...]
    hints: int
    retries: int
    seconds: float
    credit: float

    @property
    def right(self) -> bool:
        """Whether it ends the part well; what was seen before, and typed off, earns nothing."""
        return self.outcome in ("right", "follow-through") and self.credit > 0

    @property
    def first_time(self) -> bool:
        """Whether it is right at the first try and without a hint."""
        return self.right and not self.hints and not self.retries


_MOST = 10**15
NAMES = tuple(field.name for field in fields(Attempt))
#: From where to where numbers go. Those that may be missing are an ID's, of which a problem from outside has none.
_NUMBERS = {
    "level": (LEVELS[0], LEVELS[-1]),
    "seed": (0, _MOST),
    "revision": (0, _MOST),
    "parts": (1, _MOST),
    "hints": (0, _MOST),
    "retries": (0, _MOST),
    "seconds": (0, _MOST),
    "credit": (0, 1),
}
_MAY_BE_MISSING, _MAY_BE_BROKEN = ("level", "seed", "revision"), ("seconds", "credit")
#: Clocks may be wrong, but calendars end: what is due is worked out beyond the last answer.
_YEARS = range(1970, 2200)


def to_line(attempt: Attempt, *, ascii_only: bool = False) -> str:
    """The attempt as a line of JSON, without its end; where it must be in ASCII, all other signs are escaped."""
    data = asdict(attempt) | {"time": attempt.time.astimezone(UTC).isoformat()}
    return json.dumps(data, ensure_ascii=ascii_only)


def from_lines(lines: Iterable[str], where: str) -> Iterator[Attempt]:
    """The attempts of a file in JSON Lines; blank lines are passed over.

    Raises:
        FileError: a line is none; the sentence names it.
    """
    for number, line in enumerate(lines, 1):
        if line.strip():
            try:
                yield _attempt(json.loads(line))
            except (ValueError, TypeError, KeyError, ArithmeticError, RecursionError) as error:
                why = f"{error.args[0]!r} is missing" if isinstance(error, KeyError) else str(error).partition(":")[0]
                raise FileError(f"{where}, line {number}: this is no attempt of a history: {why}.") from None


def _attempt(data: Mapping[str, Any]) -> Attempt:
    if not isinstance(data, dict):
        raise TypeError("a line is an object")
    if unknown := set(data) - set(NAMES):
        raise ValueError(f"there is no {min(unknown)[:20]!r}")
    kept = Attempt(**{name: data[name] for name in NAMES})
    for name in ("id", "time", "sitting", "family", "part", "typed", "outcome"):
        if not (_is_text if name == "typed" else _is_name)(data[name]):
            raise TypeError(f"{name!r} is a text")
    for name, (least, most) in _NUMBERS.items():
        value, kind = data[name], int | float if name in _MAY_BE_BROKEN else int
        is_number = isinstance(value, kind) and not isinstance(value, bool) and least <= value <= most
        if not is_number and not (value is None and name in _MAY_BE_MISSING):
            whole = "" if name in _MAY_BE_BROKEN else "whole "
            raise TypeError(f"{name!r} is a {whole}number from {least} to {most}")
    if data["outcome"] not in OUTCOMES:
        raise ValueError(f"there is no outcome {data['outcome'][:20]!r}")
    if not isinstance(data["misconceptions"], list) or not all(map(_is_name, data["misconceptions"])):
        raise TypeError("'misconceptions' is a list of texts")
    time = datetime.fromisoformat(data["time"])
    if time.tzinfo is None:
        raise ValueError("'time' has no time zone")
    time = time.astimezone(UTC)
    if time.year not in _YEARS:
        raise ValueError(f"'time' is in a year from {_YEARS[0]} to {_YEARS[-1]}")
    return replace(kept, time=time, misconceptions=tuple(data["misconceptions"]))


def _is_text(value: object) -> bool:
    """Whether it is a text that a file can hold: half a pair of surrogates is none."""
    return isinstance(value, str) and value.encode("utf-8", "ignore").decode() == value


def _is_name(value: object) -> bool:
    """Whether it is a text that may be shown: control characters would reach the terminal."""
    return isinstance(value, str) and value.isprintable()
