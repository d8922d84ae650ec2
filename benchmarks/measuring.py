"""What one process measures for one of the tables: ``python benchmarks/measuring.py TABLE`` prints it as JSON."""

import json
import random
import resource
import subprocess
import sys
import time
from collections.abc import Callable
from fractions import Fraction
from math import nan
from statistics import median
from tempfile import NamedTemporaryFile
from typing import Any

from rldrill.problems.catalogue import families, family

#: So often something is done before it is measured: the first problems of a family load formulas and compile them.
_BEFORE = 12
_HELLO = "import typer\napp = typer.Typer()\n@app.command()\ndef main(): print('hello')\napp()"
_NEEDED = "import typer, rich, pydantic, sympy, flint"
#: Pydantic imports what models are made of when they are first asked for.
_MODELS = f"{_NEEDED}\nfrom pydantic import BaseModel, Field, TypeAdapter"


def _rate(work: Callable[[int], object], seconds: float, least: int) -> float:
    """How often something is done in a second of the processor, after what is made but once was made."""
    for number in range(_BEFORE):
        work(number)
    start, number = time.process_time(), _BEFORE
    while time.process_time() - start < seconds or number < _BEFORE + least:
        work(number)
        number += 1
    return (number - _BEFORE) / (time.process_time() - start)


def drawing() -> dict[str, float]:
    """Problems a second, for the median family and for every one."""
    from rldrill.solutions.drawing import draw

    found = {}
    for name in families():
        level = min(family(name).levels, key=lambda level: abs(level - 2))
        found[name] = _rate(lambda seed, name=name, level=level: draw(name, level, seed).mistakes, 0.3, 10)
    return {"the median family": median(found.values())} | found


def latex() -> dict[str, float]:
    """Records with working as LaTeX a second, for every eighth family, and together."""
    from rldrill.generation.records import Extra, record

    names = [name for name in families()[::8] if 2 in family(name).levels]
    extras = (Extra.ANSWERS, Extra.WORKING, Extra.LATEX)
    found = {name: _rate(lambda seed, name=name: record(name, 2, seed, extras), 0.2, 8) for name in names}
    return {"the same number of each": len(found) / sum(1 / rate for rate in found.values())} | found


def judging() -> dict[str, float]:
    """Answers a second: a number as a fraction and as a decimal, a table of two, an expression."""
    from rldrill.solutions.answers.judging import judge
    from rldrill.solutions.drawing import by_id

    cases = {
        "a number": ("n-step-return/2/1", lambda i: f"{i + 1}/7" if i % 2 else f"{i}.25"),
        "a table of three": ("bayes-predict/2/1", lambda i: f"1/4, {i}/4, 1/2"),
        "an expression": ("bellman-backup/3/1", lambda i: f"({i} + 1/(2 + x))/3 + gamma + p*q"),
    }
    found = {}
    for name, (problem, text) in cases.items():
        solution = by_id(problem)
        found[name] = _rate(lambda i, solution=solution, text=text: judge(solution, "a", text(i)), 0.5, 50)
    return found


def formulas() -> dict[str, float]:
    """Values a second: compiled from the sheet, and as somebody writes the same over flint's rationals."""
    from flint import fmpq

    from rldrill.solutions.formula.compiling import value_of
    from rldrill.solutions.sheet.bayes import BAYES
    from rldrill.solutions.sheet.bellman import BELLMAN_OPTIMALITY_V, BELLMAN_V
    from rldrill.solutions.sheet.control import EXPECTED_SARSA, Q_LEARNING, SARSA
    from rldrill.solutions.sheet.temporal_difference import N_STEP_RETURN, TD_ZERO

    half, ends, act = fmpq(1, 2), ("a", "b", "c"), ("left", "right")
    known: dict[str, Any] = {
        "S": {0: "a", 1: "b", 2: "c"}, "A": {0: "left", 1: "right"}, "r": {1: fmpq(3), 2: fmpq(-1, 3)},
        "alpha": half, "gamma": fmpq(9, 10), "t": 0, "n": 2, "s": "a", "h": "a", "z": "low",
        "V": {state: fmpq(index, 3) for index, state in enumerate(ends)},
        "Q": {(state, action): fmpq(index, 5) for index, state in enumerate(ends) for action in act},
        "pi": {(action, state): half for state in ends for action in act}, "actions": dict.fromkeys(ends, act),
        "P": {(s, a, e): fmpq(1, 3) for s in ends for a in act for e in ends},
        "R": {(s, a, e): fmpq(2, 7) for s in ends for a in act for e in ends},
        "successors": {(s, a): ends for s in ends for a in act}, "hypotheses": ends,
        "likelihood": {("low", state): fmpq(index + 1, 6) for index, state in enumerate(ends)},
        "p": {state: fmpq(1, 3) for state in ends},
    }  # fmt: skip
    k = known

    def moved(target: fmpq) -> fmpq:
        old = k["Q"][k["S"][0], k["A"][0]]
        return old + k["alpha"] * (target - old)

    def ahead(state: str, action: str) -> fmpq:
        return sum(
            (k["P"][state, action, e] * (k["R"][state, action, e] + k["gamma"] * k["V"][e])
             for e in k["successors"][state, action]), fmpq(0),
        )  # fmt: skip

    def td_zero() -> fmpq:
        V, S, t = k["V"], k["S"], k["t"]
        return V[S[t]] + k["alpha"] * (k["r"][t + 1] + k["gamma"] * V[S[t + 1]] - V[S[t]])

    by_hand: dict[Any, Callable[[], fmpq]] = {
        TD_ZERO: td_zero,
        SARSA: lambda: moved(k["r"][1] + k["gamma"] * k["Q"][k["S"][1], k["A"][1]]),
        Q_LEARNING: lambda: moved(k["r"][1] + k["gamma"] * max(k["Q"][k["S"][1], a] for a in k["actions"][k["S"][1]])),
        EXPECTED_SARSA: lambda: moved(
            k["r"][1] + k["gamma"] * sum((k["pi"][a, k["S"][1]] * k["Q"][k["S"][1], a] for a in act), fmpq(0))
        ),
        BELLMAN_V: lambda: sum((k["pi"][a, k["s"]] * ahead(k["s"], a) for a in act), fmpq(0)),
        BELLMAN_OPTIMALITY_V: lambda: max(ahead(k["s"], a) for a in act),
        BAYES: lambda: (
            k["likelihood"][k["z"], k["h"]]
            * k["p"][k["h"]]
            / sum((k["likelihood"][k["z"], h] * k["p"][h] for h in k["hypotheses"]), fmpq(0))
        ),
        N_STEP_RETURN: lambda: (
            sum((k["gamma"] ** i * k["r"][k["t"] + 1 + i] for i in range(k["n"])), fmpq(0))
            + k["gamma"] ** k["n"] * k["V"][k["S"][k["t"] + k["n"]]]
        ),
    }
    found = {}
    for formula, function in by_hand.items():
        assert value_of(formula.right, known) == function(), formula
        compiled = _rate(lambda _, right=formula.right: value_of(right, known), 0.2, 100)
        hand = _rate(lambda _, function=function: function(), 0.2, 100)
        found |= {f"{formula.key}, compiled": compiled, f"{formula.key}, by hand": hand}
        found[f"{formula.key}, times"] = hand / compiled
    return found


def _random_model(states: int) -> list[list[Any]]:
    """The transitions of a sparse model: every action leads to three states, the end perhaps among them."""
    choose, rows = random.Random(states), []
    for state in range(states):
        for action in range(4):
            weights = [choose.randint(1, 5) for _ in range(3)]
            for after, weight in zip(choose.sample(range(states + 1), 3), weights, strict=True):
                name = "end" if after == states else f"s{after}"
                rows.append([f"s{state}", f"a{action}", name, f"{weight}/{sum(weights)}", choose.randint(-9, 9)])
    return rows


def models() -> dict[str, float]:
    """Seconds for the optimal values: ours and exact, and what others take for the same models; NaN without them."""
    from rldrill.problems.models import Model
    from rldrill.solutions.optimality import optimum

    peers: tuple[tuple[str, int, Callable[[int, list[list[Any]], Any], object]], ...] = (
        ("Storm's exact engine", 300, _by_storm),
        ("sympy's linsolve, for the optimal policy alone", 100, _by_sympy),
        ("quantecon's policy iteration in floats", 1000, _by_quantecon),
        ("policy iteration in numpy's floats", 1000, _in_floats),
    )
    found = {}
    for states in (10, 10, 30, 100, 300, 1000):  # the first time all that is needed is imported and compiled
        rows = _random_model(states)
        model = Model.model_validate({"transitions": rows, "terminal": ["end"]})
        start = time.process_time()
        best = optimum(model, type(model.transitions[0].probability)("9/10")).policy
        found[f"{states} states, exact"] = time.process_time() - start
        for name, most, solve in peers:
            if states <= most:
                found[f"{states} states, {name}"] = _seconds(solve, states, rows, best)
    return found


def _seconds(solve: Callable[..., object], *model: object) -> float:
    """How long it takes; NaN where what it needs is not installed."""
    start = time.process_time()
    try:
        solve(*model)
    except ImportError:
        return nan
    return time.process_time() - start


def _pairs(rows: list[list[Any]]) -> dict[tuple[int, int], list[tuple[int, Fraction, int]]]:
    """By the numbers of state and action where it leads, with which probability and reward; the end is number −1."""
    found: dict[tuple[int, int], list[tuple[int, Fraction, int]]] = {}
    for state, action, after, chance, reward in rows:
        target = -1 if after == "end" else int(after[1:])
        found.setdefault((int(state[1:]), int(action[1:])), []).append((target, Fraction(chance), reward))
    return found


def _by_storm(states: int, rows: list[list[Any]], _: Any) -> None:
    """Storm knows no discount: with a probability of 1/10 every step leads to an end."""
    import stormpy

    lines = ["@type: MDP", "@value_type: rational", "@parameters", "", "@reward_models", "r"]
    lines += ["@nr_states", str(states + 1), "@nr_choices", str(4 * states + 1), "@model"]
    for (state, action), outcomes in _pairs(rows).items():
        if action == 0:
            lines.append(f"state {state} [0]{' init' if state == 0 else ''}")
        lines.append(f"\taction {action} [{sum(chance * reward for _, chance, reward in outcomes)}]")
        going = {target: chance * Fraction(9, 10) for target, chance, _ in outcomes if target >= 0}
        going[states] = 1 - sum(going.values())
        lines += [f"\t\t{target} : {going[target]}" for target in sorted(going)]
    lines += [f"state {states} [0] done", "\taction 0 [0]", f"\t\t{states} : 1", ""]
    with NamedTemporaryFile("w", suffix=".drn") as file:
        print("\n".join(lines), file=file, flush=True)
        model = stormpy.build_model_from_drn[stormpy.Rational](file.name)
    (wanted,) = stormpy.parse_properties('R{"r"}max=? [F "done"]')
    stormpy.model_checking(model, wanted)


def _by_quantecon(states: int, rows: list[list[Any]], _: Any) -> None:
    import numpy as np
    from quantecon.markov import DiscreteDP
    from scipy.sparse import csr_matrix

    pairs = _pairs(rows) | {(states, 0): [(-1, Fraction(1), 0)]}
    rewards = [float(sum(chance * reward for _, chance, reward in outcomes)) for outcomes in pairs.values()]
    places = [
        (float(chance), number, target % (states + 1))
        for number, outcomes in enumerate(pairs.values())
        for target, chance, _ in outcomes
    ]
    chances, numbers, targets = zip(*places, strict=True)
    moves = csr_matrix((chances, (numbers, targets)), shape=(len(pairs), states + 1))
    chosen = np.array(list(pairs))
    DiscreteDP(np.array(rewards), moves, 0.9, chosen[:, 0], chosen[:, 1]).solve(method="policy_iteration")


def _by_sympy(states: int, rows: list[list[Any]], policy: Any) -> None:
    from sympy import Rational, linsolve, symbols

    V = symbols(f"V:{states}")
    equations = list(V)
    for state, action, after, chance, reward in rows:
        if policy[state] == action:
            ahead = Rational(9, 10) * V[int(after[1:])] if after != "end" else 0
            equations[int(state[1:])] -= Rational(chance) * (reward + ahead)
    linsolve(equations, V)


def _in_floats(states: int, rows: list[list[Any]], _: Any) -> None:
    import numpy as np

    P, r = np.zeros((4, states, states)), np.zeros((4, states))
    for state, action, after, chance, reward in rows:
        r[int(action[1:]), int(state[1:])] += float(Fraction(chance)) * reward
        if after != "end":
            P[int(action[1:]), int(state[1:]), int(after[1:])] += float(Fraction(chance))
    chosen, every = r.argmax(axis=0), np.arange(states)
    while True:
        V = np.linalg.solve(np.eye(states) - 0.9 * P[chosen, every], r[chosen, every])
        better = (r + 0.9 * P @ V).argmax(axis=0)
        if (better == chosen).all():
            return
        chosen = better


def start() -> dict[str, float]:
    """Seconds of whole processes, and how they compare with what they cannot do without."""

    def seconds(*command: str) -> float:
        times = []
        for _ in range(5):
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            subprocess.run([sys.executable, *command], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            times.append(after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime)
        return sorted(times)[2]

    hello, needed, models = seconds("-c", _HELLO), seconds("-c", _NEEDED), seconds("-c", _MODELS)
    found = {"hello-world Typer": hello, "typer, rich, pydantic, sympy, flint": needed, "and pydantic's models": models}
    with NamedTemporaryFile("w", suffix=".toml") as answers:
        print('[answers."td-zero/2/1"]\na = "1, 2"', file=answers, flush=True)
        for name, command, base in (
            ("-h", ["-h"], hello),
            ("list", ["list"], hello),
            ("show", ["show", "td-zero/2/1"], needed),
            ("solve", ["solve", "td-zero/2/1"], needed),
            ("verify", ["verify", answers.name], needed),
        ):
            found[name] = seconds("-m", "rldrill", *command)
            found[f"{name}, times"] = found[name] / base
            if base is needed:
                found[f"{name}, times with pydantic's models"] = found[name] / models
    return found


def million() -> dict[str, float]:
    """Hours for a million problems with working, by what 600 cost more than 200, in one process and in two."""
    names = [name for name in families()[::8] if 2 in family(name).levels]

    def cost(number: int, jobs: int) -> tuple[float, float]:
        options = ["-n", str(number), "--seed", "1", "--level", "2", "--with", "answers,working", "--jobs", str(jobs)]
        began, before = time.perf_counter(), resource.getrusage(resource.RUSAGE_CHILDREN)
        command = [sys.executable, "-m", "rldrill", "generate", *names, *options]
        subprocess.run(command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL, check=True)
        after = resource.getrusage(resource.RUSAGE_CHILDREN)
        return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime, time.perf_counter() - began

    found = {}
    for jobs, told in ((1, "1 process"), (2, "2 processes")):
        few, many = cost(200, jobs), cost(600, jobs)
        for what, less, more in zip(("of the processor", "by the clock"), few, many, strict=True):
            found[f"{told}, hours {what}"] = (more - less) / 400 * 10**6 / 3600
    return found


if __name__ == "__main__":
    print(json.dumps(globals()[sys.argv[1]]()))
