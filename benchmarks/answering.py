"""How long it takes from Enter to the verdict, and from Enter to the next problem, where somebody reads and types.

python benchmarks/answering.py [PROBLEMS]
"""

import sys
import time
from collections.abc import Iterator
from io import StringIO
from itertools import cycle, islice
from statistics import median, quantiles

from rich.console import Console

from rldrill.exercise import Exercise, draw, load
from rldrill.problems.catalogue import families
from rldrill.quiz.screen import Screen
from rldrill.quiz.session import Session
from rldrill.solutions.answers.kinds import answer_kind

#: So long, in seconds, somebody reads a verdict, and types an answer.
_READS, _TYPES = 1.0, 2.0


class Person:
    """Answers every part wrong once and then rightly, taking the time for it, and measures how long each line takes."""

    def __init__(self, exercises: Iterator[Exercise]) -> None:
        self._exercises = exercises
        self._exercise: Exercise | None = None
        self._since: tuple[str, float] | None = None
        self._wrong = False
        self._part = 0
        self._next: Exercise | None = None
        self.times: dict[str, list[float]] = {}

    def drawn(self) -> Iterator[Exercise]:
        """The exercises as the quiz asks for them."""
        for exercise in self._exercises:
            self._next = exercise
            yield exercise

    def __call__(self, prompt: str, _keys: str = "") -> str:
        now = time.perf_counter()
        if self._since is not None:
            self.times.setdefault(self._since[0], []).append(now - self._since[1])
        if prompt.startswith("f five more"):
            raise EOFError
        if prompt.startswith("Enter next"):
            return self._types("next problem", "", _READS)
        if self._exercise is not self._next:
            self._exercise, self._part, self._wrong = self._next, 0, False
        part = self._exercise.parts[self._part]
        if not self._wrong and part.kind.name not in ("yes-no", "choice"):
            self._wrong = True
            found = load(str(self._exercise.id)).diagnosing.wrong_answers(part.label, 1)
            if found:
                return self._types("verdict on a wrong answer", found[0].answer, _TYPES)
        self._wrong = False
        self._part += 1
        right = answer_kind(part.kind).write(self._exercise.solution.answers[part.label])
        return self._types("verdict on a right answer", right, _TYPES)

    def _types(self, what: str, text: str, seconds: float) -> str:
        time.sleep(seconds)
        self._since = (what, time.perf_counter())
        return text


def main() -> None:
    """Print the medians and the 90 % quantiles."""
    number = int(sys.argv[1]) if sys.argv[1:] else 12
    names = cycle(families()[:: max(1, len(families()) // number)])
    person = Person(draw(name, 1 + count % 3, count) for count, name in enumerate(islice(names, number)))
    console = Console(file=StringIO(), width=80, height=24, color_system=None, highlight=False)
    Screen(console, person).run(person.drawn(), Session(number))
    for what, times in person.times.items():
        rest = quantiles(times, n=10)[-1] if len(times) > 1 else times[0]
        print(f"{what}: median {1000 * median(times):.0f} ms, 90 % within {1000 * rest:.0f} ms ({len(times)} times)")


if __name__ == "__main__":
    main()
