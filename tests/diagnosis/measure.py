"""Measures the diagnosis over all families and levels: run it as ``python tests/diagnosis/measure.py [family ...]``.

It prints for every family and every kind of error what share of the answers is diagnosed rightly (the kind and the
place), by the place or the kind alone, wrongly, or not at all; how many numbers from nowhere are accused of something;
and the time. ``--seeds N`` takes several problems of each level, ``--sample N`` so many errors of each, ``--show``
prints what is missed.
"""

import argparse
import random
import sys
import time
from collections import Counter, defaultdict
from collections.abc import Iterable, Sequence
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parent))

from error_model import Erroneous, erroneous, numeric, random_wrong

from rldrill.diagnosis import AT_THE_PROMPT
from rldrill.problems.catalogue import selection
from rldrill.solutions.answers.judging import part_of, read_answer
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.text import Unreadable
from rldrill.solutions.diagnosis.causes import Cause
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.explaining import MOST, explained
from rldrill.solutions.diagnosis.outcomes import Outcomes
from rldrill.solutions.diagnosis.search import Search
from rldrill.solutions.diagnosis.typed import Typed
from rldrill.solutions.drawing import draw
from rldrill.solutions.solution import Solution

#: What may be said of an error, by the names of the program's causes.
ACCEPTED_NAMES = {
    "term_lost": "another-line bracket-left-out case choice confused elsewhere factor-left-out index kept lost-term "
    "range summand-left-out term-left-out twin",
    "factor_lost": "another-line bracket-left-out doubled elsewhere factor-left-out halved index inverse "
    "only-factor-left-out power sign tenfold term-left-out",
    "sign_turned": "all-signs difference minus-lost sign summand-sign term-sign twice",
    "bracket_lost": "bracket factor-for-one",
    "bracket_widened": "bracket factor-for-all",
    "minus_lost": "difference minus-lost sign summand-sign term-sign twice",
    "power_off": "factor-left-out index power squared squared-value",
    "power_as_product": "power-as-product",
    "square_forgotten": "factor-left-out index power squared squared-value",
    "factor_twice": "doubled halved index power squared squared-value",
    "smallest_taken": "choice another-line elsewhere min-for-max other-taken smallest",
    "mean_taken": "mean-for-max",
    "all_added": "sum-for-max",
    "first_taken": "case choice another-line elsewhere min-for-max other-taken",
    "complement_taken": "complement complement-of-value",
    "complement_forgotten": "complement complement-of-value confused exchanged",
    "inverse_forgotten": "divided factor-left-out inverse upside-down",
    "upside_down": "inverse upside-down",
    "transposition_forgotten": "answer-transposed order-of-factors transposed",
    "matrices_exchanged": "order-of-factors transposed",
    "added_for_multiplied": "added",
    "point_shifted": "tenfold term-tenfold",
    "fractions_added_crosswise": "crosswise",
    "numbers_exchanged": "all-signs difference exchanged sign summand-sign",
    "value_sign": "all-signs difference minus-lost sign",
    "value_tenfold": "tenfold",
    "value_one_off": "numerator one-off",
    "value_digits_swapped": "digits",
    "value_numerator_off": "numerator one-off",
    "value_denominator_off": "denominator one-off",
    "value_halved": "doubled factor-left-out halved twice",
    "update_left_out": "factor-left-out kept term-left-out",
    "change_doubled": "change-doubled factor-left-out repeated twice",
    "entries_exchanged": "another-line elsewhere exchanged-cells rows-exchanged",
    "one_sign_lost": "difference minus-lost sign",
    "answer_sign": "all-signs difference minus-lost sign",
    "answer_upside_down": "inverse upside-down",
    "another_quantity": "another-quantity as-given",
    "answer_transposed": "answer-transposed transposed",
}  # fmt: skip
ACCEPTED = {kind: frozenset(names.split()) for kind, names in ACCEPTED_NAMES.items()}
RANDOM_ANSWERS = 3
FIRST_SEED = 100


class Measured:
    """One problem, its errors and what is said of them."""

    def __init__(self, solution: Solution, seconds: float | None) -> None:
        self.solution = solution
        self.seconds = seconds
        self.search = Search(solution)
        self.outcomes: dict[str, Outcomes] = {}
        self.steps = [each.number for each in self.search.applications if not each.equation]

    def typed(self, label: str, text: str) -> Typed | None:
        """What was typed for a part; None where it is not wrong, or longer than anybody types."""
        part = part_of(self.solution, label)
        kind = answer_kind(part.kind)
        try:
            typed = Typed(part, read_answer(self.solution, part, text), kind.cells(self.solution.answers[label]))
        except Unreadable:
            return None
        return typed if typed.wrong else None

    def outcomes_of(self, typed: Typed) -> Outcomes:
        """What causes make of the part that was answered."""
        label = typed.part.label
        if label not in self.outcomes:
            self.outcomes[label] = Outcomes(self.search, typed.part, typed.key)
        return self.outcomes[label]

    def causes(self, label: str, text: str) -> tuple[tuple[Cause, ...], float] | None:
        """What is said of a wrong answer, and the milliseconds that it took; None where it is not wrong."""
        typed = self.typed(label, text)
        if typed is None:
            return None
        begun = time.process_time()
        found = explained(self.outcomes_of(typed), typed, Clock(self.seconds)).causes
        return found, 1000 * (time.process_time() - begun)

    def verdict(self, error: Erroneous, causes: Sequence[Cause]) -> str:
        """right, place (alone), kind (alone), wrong, many or none."""
        if not causes:
            return "none"
        if len(causes) > MOST:
            return "many"
        verdicts = [self._of_one(error, cause) for cause in causes]
        return next(verdict for verdict in ("right", "place", "kind", "wrong") if verdict in verdicts)

    def _of_one(self, error: Erroneous, cause: Cause) -> str:
        if cause.mistake is not None:
            read = [formula.key for formula in self.solution.work.read if cause.mistake in formula.misread]
            return "right" if error.formula in read or cause.mistake.is_slip else "wrong"
        place = self._at_its_place(error, cause)
        kind = error.twofold or cause.kind in ACCEPTED[error.kind]
        if place and kind:
            return "right"
        return "place" if place else "kind" if kind and not error.twofold else "wrong"

    def _at_its_place(self, error: Erroneous, cause: Cause) -> bool:
        if error.formula is None:
            return True
        same_formula = cause.formula is None or cause.formula.key == error.formula
        if error.everywhere or cause.application is None:
            return same_formula
        places = {each.application.number for each in (cause, cause.then) if each and each.application}
        return self.steps[error.place] in places


def report(name: str, row: Counter[str], more: str = "") -> None:
    number = sum(row.values())
    shares = " ".join(f"{kind} {100 * row[kind] / number:5.1f}" for kind in ("right", "place", "kind", "wrong", "none"))
    print(f"{name:30} n={number:5} {shares} many {100 * row['many'] / number:4.1f} {more}", flush=True)


def main(arguments: Iterable[str] | None = None) -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("families", nargs="*")
    parser.add_argument("--seeds", type=int, default=1)
    parser.add_argument("--sample", type=int, default=0)
    parser.add_argument("--show", action="store_true")
    parser.add_argument("--at-the-prompt", action="store_true", help="with the time that there is at a prompt")
    chosen = parser.parse_args(arguments)
    kinds: dict[str, Counter[str]] = defaultdict(Counter)
    accused: Counter[bool] = Counter()
    alone: Counter[bool] = Counter()
    every: list[float] = []
    for family in selection(chosen.families):
        row: Counter[str] = Counter()
        times: list[float] = []
        mine: Counter[bool] = Counter()
        for level in family.levels:
            for seed in range(FIRST_SEED, FIRST_SEED + chosen.seeds):
                solution = draw(family.name, level, seed)
                measured = Measured(solution, AT_THE_PROMPT if chosen.at_the_prompt else None)
                errors = erroneous(solution, seed)
                if chosen.sample:
                    errors = random.Random(seed).sample(errors, min(chosen.sample, len(errors)))
                for error in errors:
                    if (said := measured.causes(error.part, error.text)) is None:
                        continue
                    verdict = measured.verdict(error, said[0])
                    row[verdict] += 1
                    kinds["two slips" if error.twofold else error.kind][verdict] += 1
                    times.append(said[1])
                    if chosen.show and verdict != "right":
                        print(verdict, solution.problem.identity, error, [cause.kind for cause in said[0]])
                mine.update(random_verdicts(measured, chosen.show))
                alone.update(random_verdicts(measured, chosen.show, alone=True))
        if row:
            report(
                family.name, row, f"accused {mine[True]}/{mine.total()} ms {median(times):.1f} worst {max(times):.0f}"
            )
        accused.update(mine)
        every += times
    print()
    for kind, row in sorted(kinds.items()):
        report(kind, row)
    print()
    report("all", sum(kinds.values(), Counter()), f"ms {median(every):.1f} worst {max(every):.0f}")
    print(f"numbers from nowhere that are accused: {accused[True]} of {accused.total()}")
    print(f"one number from nowhere among right ones: {alone[True]} of {alone.total()}")


def random_verdicts(measured: Measured, show: bool, *, alone: bool = False) -> Iterable[bool]:
    """Whether numbers from nowhere are accused of something; ``alone`` for one such number among right ones."""
    for part in measured.solution.problem.parts:
        if not numeric(measured.solution, part.label):
            continue
        for number in range(RANDOM_ANSWERS):
            text = random_wrong(measured.solution, part.label, number, alone=alone)
            said = None if text is None else measured.causes(part.label, text)
            if said is None:
                continue
            accused = 0 < len(said[0]) <= MOST
            if show and accused:
                print("ACCUSED", measured.solution.problem.identity, part.label, text, [each.kind for each in said[0]])
            yield accused


if __name__ == "__main__":
    main()
