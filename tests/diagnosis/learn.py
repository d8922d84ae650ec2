"""Learns how much counts what is looked at: run it as ``python tests/diagnosis/learn.py [--seeds N]``.

For wrong answers of the error model and for numbers from nowhere it takes down what speaks for each cause and for
chance (``rldrill.solutions.diagnosis.weighing``), and fits a small logistic model: the right cause, or chance, has the
greatest share. The way errors were chosen is not to be learnt by heart, so how often a kind of cause is right counts
little: a penalty keeps the kinds where the weights put them. The counts are written to
``solutions/diagnosis/learnt.py``; what they achieve is printed for problems that they were not fitted to, with the
threshold at which so many random numbers are accused.
"""

import argparse
import json
import random
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import product
from math import inf
from pathlib import Path

import numpy as np
from error_model import erroneous, numeric, random_wrong
from measure import RANDOM_ANSWERS, Measured

import rldrill.solutions.diagnosis.learnt as learnt
from rldrill.problems.catalogue import selection
from rldrill.problems.errors import BrokenFamily
from rldrill.solutions.diagnosis.clock import Clock
from rldrill.solutions.diagnosis.explaining import distinct, giving, likeliest
from rldrill.solutions.diagnosis.weighing import Weighing
from rldrill.solutions.drawing import draw

#: Problems that are learnt from, that the threshold is chosen on; ``measure.py`` takes others.
FIRST_LEARNT, FIRST_CHOSEN = 1000, 1020
#: How strongly every count is drawn to 0 (the weight's to 1), and those of kinds and scopes.
_PENALTY, _PENALTY_OF_KINDS = 1.0, 20.0
_ERRORS = 8
#: Slips of arithmetic that stand for all the others, which nobody could list; so each is less likely than it is here.
_ONE_OF_MANY = {"value_numerator_off", "value_denominator_off", "value_one_off", "value_digits_swapped", "value_halved"}
_OF_MANY = 0.3
#: One number from nowhere among right ones counts less: most who get all others right make a slip in it.
_ALONE = 0.25
#: So many numbers from nowhere may be accused.
_ACCUSED = 0.045


@dataclass(frozen=True)
class Case:
    """A wrong answer: how much it counts, what speaks for chance and for each cause, which are right, or the same."""

    invented: bool
    counts: float
    chance: dict[str, float]
    causes: list[dict[str, float]]
    verdicts: list[str]
    groups: list[list[int]]


def cases(seeds: Sequence[int]) -> Iterator[Case]:
    """Wrong answers to a problem of every family, level and seed, and numbers from nowhere."""
    for family in selection(()):
        for level in family.levels:
            for seed in seeds:
                try:
                    measured = Measured(draw(family.name, level, seed), None)
                except BrokenFamily:
                    continue
                yield from _of(measured, seed)


def _of(measured: Measured, seed: int) -> Iterator[Case]:
    solution = measured.solution
    errors = erroneous(solution, seed)
    for error in random.Random(seed).sample(errors, min(_ERRORS, len(errors))):
        if (case := _case(measured, error.part, error.text)) is not None:
            verdicts = [measured.verdict(error, [cause]) for cause in case[2]]
            counts = _OF_MANY if error.kind in _ONE_OF_MANY else 1.0
            yield Case(False, counts, case[0], case[1], verdicts, distinct(case[2]))
    for part in solution.problem.parts:
        if numeric(solution, part.label):
            for number, alone in product(range(RANDOM_ANSWERS), (False, True)):
                text = random_wrong(solution, part.label, number, alone=alone)
                if text is not None and (case := _case(measured, part.label, text)) is not None:
                    yield Case(True, _ALONE if alone else 1.0, case[0], case[1], [""] * len(case[2]), distinct(case[2]))


def _case(measured: Measured, label: str, text: str):
    typed = measured.typed(label, text)
    if typed is None:
        return None
    outcomes = measured.outcomes_of(typed)
    found, _ = giving(outcomes, typed, Clock(), {})
    if not found:
        return {}, [], []
    weighing = Weighing(outcomes, typed, found)
    return dict(weighing.chance), [dict(each) for each in weighing.causes], [each.cause for each in found]


class Model:
    """The logistic model: its names, and the cases as arrays."""

    def __init__(self, every: Sequence[Case]) -> None:
        self.cases = [case for case in every if case.causes]
        self.names = sorted({name for case in self.cases for one in (case.chance, *case.causes) for name in one})
        number = {name: place for place, name in enumerate(self.names)}
        self.rows = np.array([len(case.causes) + 1 for case in self.cases])
        self.start = np.concatenate([[0], np.cumsum(self.rows)[:-1]])
        self.matrix = np.zeros((self.rows.sum(), len(self.names)))
        self.target = np.zeros(len(self.matrix), bool)
        for case, start in zip(self.cases, self.start, strict=True):
            for row, features in enumerate((case.chance, *case.causes)):
                for name, value in features.items():
                    self.matrix[start + row, number[name]] = value
            right = [verdict == "right" for verdict in case.verdicts]
            self.target[start : start + len(right) + 1] = [not any(right), *right]
        self.counted = np.array([case.counts for case in self.cases])
        self.rest = np.array([float(name == "weight") for name in self.names])
        self.penalty = np.array(
            [_PENALTY_OF_KINDS if name.startswith(("kind ", "scope ")) else _PENALTY for name in self.names]
        )

    def loss(self, counts: np.ndarray) -> tuple[float, np.ndarray]:
        """How badly the counts do, and in which direction they do worse."""
        scores = self.matrix @ counts
        shares = self._shares(scores)
        of_target = np.add.reduceat(shares * self.target, self.start)
        away = counts - self.rest
        of_target = np.maximum(of_target, 1e-300)
        loss = -(self.counted * np.log(of_target)).sum() + 0.5 * (self.penalty * away**2).sum()
        wanted = shares * self.target / np.repeat(of_target, self.rows)
        slope = self.matrix.T @ ((shares - wanted) * np.repeat(self.counted, self.rows))
        return float(loss), slope + self.penalty * away

    def _shares(self, scores: np.ndarray) -> np.ndarray:
        highest = np.repeat(np.maximum.reduceat(scores, self.start), self.rows)
        powers = np.exp(scores - highest)
        return powers / np.repeat(np.add.reduceat(powers, self.start), self.rows)

    def shares_in(self, counts: dict[str, float]) -> list[list[float]]:
        """The shares of the causes in every case."""
        shares = self._shares(self.matrix @ np.array([counts.get(name, 0.0) for name in self.names]))
        return [list(each[1:]) for each in np.split(shares, self.start[1:])]


def minimum(loss: Callable[[np.ndarray], tuple[float, np.ndarray]], start: np.ndarray, steps: int = 300) -> np.ndarray:
    """Where a smooth function is smallest, by the method of Broyden, Fletcher, Goldfarb and Shanno."""
    at, inverse = start, np.eye(len(start)) / 100
    height, slope = loss(at)
    for _ in range(steps):
        way, length = -inverse @ slope, 1.0
        while True:
            next_height, next_slope = loss(at + length * way)
            if next_height <= height + 1e-4 * length * (way @ slope) or length < 1e-8:
                break
            length /= 2
        step, change = length * way, next_slope - slope
        at, done = at + step, height - next_height < 1e-7 * abs(height)
        height, slope = next_height, next_slope
        if done:
            break
        if (along := step @ change) > 1e-12:
            turn = np.eye(len(start)) - np.outer(step, change) / along
            inverse = turn @ inverse @ turn.T + np.outer(step, step) / along
    return at


def threshold(model: Model, counts: dict[str, float], every: Sequence[Case]) -> None:
    """Print what is achieved at a few shares of random numbers accused."""
    told = []
    for case, shares in zip(model.cases, model.shares_in(counts), strict=True):
        said = likeliest(shares, case.groups)
        verdicts = [case.verdicts[number] for _, number in said]
        best = next((each for each in ("right", "place", "kind", "wrong") if each in verdicts), "")
        told.append((sum(share for share, _ in said), case.invented, best))
    told.sort(reverse=True)
    errors = sum(not case.invented for case in every)
    invented = len(every) - errors
    print(f"{errors} errors, {invented} numbers from nowhere")
    for accused in (0.02, 0.03, 0.035, 0.04, _ACCUSED, 0.05, 0.06, inf):
        counted, so_many, last = {"right": 0, "place": 0, "kind": 0, "wrong": 0}, 0, 1.0
        for share, is_invented, verdict in told:
            so_many += is_invented
            if so_many > accused * invented:
                break
            last = share
            if not is_invented:
                counted[verdict] += 1
        shares = ", ".join(f"{name} {100 * number / errors:.1f}" for name, number in counted.items())
        print(f"  {100 * accused:.1f} % accused from {last:.3f} on: {shares}")


def written(counts: dict[str, float]) -> str:
    """The module that holds the counts."""
    lines = [f"    {json.dumps(name)}: {value:.2f}," for name, value in sorted(counts.items()) if abs(value) >= 0.005]
    head = '"""How much each thing counts that is looked at, as logarithms; written by ``tests/diagnosis/learn.py``."""'
    return "\n".join([head, "", "COUNTS: dict[str, float] = {", *lines, "}", ""])


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--seeds", type=int, default=4, help="problems of every family and level that are learnt from")
    seeds = parser.parse_args().seeds
    model = Model([*cases(range(FIRST_LEARNT, FIRST_LEARNT + seeds))])
    found = minimum(lambda counts: model.loss(counts), model.rest)
    counts = dict(zip(model.names, map(float, found), strict=True))
    Path(learnt.__file__).write_text(written(counts), encoding="utf-8")
    chosen = [*cases(range(FIRST_CHOSEN, FIRST_CHOSEN + max(1, seeds // 3)))]
    threshold(Model(chosen), counts, chosen)


if __name__ == "__main__":
    main()
