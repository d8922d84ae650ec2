"""What an examiner asks of a family and level as a whole: figures over many draws, and their limits."""

import json
import re
from collections import Counter
from collections.abc import Iterator
from statistics import median
from typing import Any

from msgspec import Struct, field

from rldrill.audit.givens import idle
from rldrill.audit.guessing import Guesses
from rldrill.problems.parts import Choice, Part, YesNo
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.effort import minutes, points
from rldrill.solutions.solution import Solution

#: Constant answers earn no more than this share of the points.
MOST_GUESSED = 0.35
#: A point takes no less and no more minutes than this.
MINUTES_A_POINT = (1.0, 2.0)
#: So many different structures, and problems of a hundred, are drawn at levels 2 and 3.
STRUCTURES, DIFFERENT = 4, 90
#: Yes, and every option beside its fair share, are right in at least and at most this share of the draws.
BALANCED = (0.4, 0.6)
#: No option is right in less than this part of its fair share.
LEAST_OPTION = 0.5
#: Half of the problems are found in so many attempts.
MOST_ATTEMPTS = 3

#: Of fewer answers no balance is judged: an answer that is right in half of the draws may stay below 40 % by chance.
_JUDGED = 200
_WHOLE = re.compile(r"\d+")


class Figures(Struct):
    """What many problems of one family and level are like together.

    Args:
        idle: the IDs of problems with the places of givens that no answer depends on.
        guesses: what constant answers earn.
        largest: the largest whole number in the answers of each problem.
        attempts: how many draws each problem took.
        rates: the minutes a point of each problem.
        problems: the different ones of the first hundred problems.
        structures: the different structures: shape of the givens, and what is asked.
        yes: for each part answered by yes or no how often the answer is yes, and how often it is asked.
        options: for each choice how often each option is right.
    """

    idle: list[str] = field(default_factory=list)
    guesses: Guesses = field(default_factory=Guesses)
    largest: list[int] = field(default_factory=list)
    attempts: list[int] = field(default_factory=list)
    rates: list[float] = field(default_factory=list)
    problems: set[str] = field(default_factory=set)
    structures: set[str] = field(default_factory=set)
    yes: dict[str, list[int]] = field(default_factory=dict)
    options: dict[str, Counter[str]] = field(default_factory=dict)

    def add(self, solution: Solution) -> None:
        """Look at one problem more."""
        problem = solution.problem
        if places := idle(solution):
            self.idle.append(f"{problem.identity}: {', '.join(places)}")
        self.guesses.add(solution)
        self.largest.append(largest(solution))
        self.attempts.append(solution.attempts)
        self.rates.append(float(minutes(solution) / sum(points(solution).values())))
        if self.drawn <= 100:
            self.problems.add(json.dumps(problem.data(), sort_keys=True))
        self.structures.add(structure(solution))
        for part in problem.parts:
            self._count(part, solution.answers[part.label])

    def _count(self, part: Part, answer: Any) -> None:
        if isinstance(part.kind, YesNo):
            counts = self.yes.setdefault(part.label, [0, 0])
            counts[0] += bool(answer)
            counts[1] += 1
        elif isinstance(part.kind, Choice):
            self.options.setdefault(part.label, Counter(dict.fromkeys(part.kind.options, 0)))[answer] += 1

    @property
    def drawn(self) -> int:
        """How many problems were looked at."""
        return len(self.attempts)

    def data(self) -> dict[str, Any]:
        """The figures as JSON has them."""
        return {
            "idle": self.idle, "guessed": round(self.guesses.share, 3), "guesses": self.guesses.best,
            "largest": median(self.largest), "largest_of_95": _percentile(self.largest, 95),
            "attempts": median(self.attempts),
            "minutes_a_point": [round(min(self.rates), 2), round(median(self.rates), 2), round(max(self.rates), 2)],
            "different": len(self.problems), "structures": len(self.structures),
            "yes": {label: round(yes / asked, 3) for label, (yes, asked) in self.yes.items()},
            "options": {label: dict(counts) for label, counts in self.options.items()},
        }  # fmt: skip

    def complaints(self, level: int) -> Iterator[str]:
        """What an examiner would object to, a sentence each; shares are only judged of many draws."""
        yield from (f"no answer depends on {place}" for place in self.idle)
        low, high = MINUTES_A_POINT
        if min(self.rates) < low or max(self.rates) > high:
            yield f"a point takes from {min(self.rates):.2f} to {max(self.rates):.2f} minutes"
        if median(self.attempts) > MOST_ATTEMPTS:
            yield f"half of the problems take more than {median(self.attempts):g} attempts"
        if self.drawn < 40:
            return
        if self.guesses.share > MOST_GUESSED:
            yield f"constant answers earn {self.guesses.share:.0%}: {self.guesses.best}"
        if level > 1 and len(self.structures) < STRUCTURES:
            yield f"there are only {len(self.structures)} structures"
        if level > 1 and len(self.problems) < DIFFERENT * min(self.drawn, 100) // 100:
            yield f"only {len(self.problems)} of {min(self.drawn, 100)} problems are different"
        for label, (yes, asked) in self.yes.items():
            if asked >= _JUDGED and not BALANCED[0] <= yes / asked <= BALANCED[1]:
                yield f"({label}) is yes in {yes / asked:.0%}"
        for label, counts in self.options.items():
            fair = LEAST_OPTION / len(counts)
            rare = [letter for letter, count in counts.items() if count < fair * counts.total()]
            if rare and counts.total() >= _JUDGED:
                yield f"({label}) is seldom {' or '.join(rare)}: {dict(counts)}"


def largest(solution: Solution) -> int:
    """The largest whole number in the answers, above or below a line or under a root."""
    data = [answer_kind(part.kind).data(solution.answers[part.label]) for part in solution.problem.parts]
    return max((int(digits) for digits in _WHOLE.findall(json.dumps(data, ensure_ascii=False))), default=0)


def structure(solution: Solution) -> str:
    """What is left of a problem without its numbers, and with names in the order in which they come."""
    names: dict[str, str] = {}

    def bare(data: Any) -> Any:
        if isinstance(data, dict):
            return {canonical(key): bare(inner) for key, inner in data.items()}
        if isinstance(data, list):
            return [bare(inner) for inner in data]
        return canonical(data) if isinstance(data, str) else "#" if type(data) is int else data

    def canonical(text: str) -> str:
        if re.fullmatch(r"-?\d+(/\d+)?", text):
            return "#"
        return text if text in fields else names.setdefault(text, f"name {len(names)}")

    fields = set(type(solution.problem.given).model_fields)
    given = bare(solution.problem.data()["given"])
    asked = [(part.kind.name, _without_names(part.ask, names)) for part in solution.problem.parts]
    return json.dumps([given, asked])


def _without_names(ask: str, names: dict[str, str]) -> str:
    for text, bare in sorted(names.items(), key=lambda item: -len(item[0])):
        ask = re.sub(rf"\b{re.escape(text)}\b", bare, ask)
    return re.sub(r"\d+", "#", ask)


def _percentile(numbers: list[int], share: int) -> int:
    return sorted(numbers)[min(len(numbers) * share // 100, len(numbers) - 1)]
