"""Measures the diagnosis over all families: ``python tests/diagnosis/measure.py [--seeds N] [family ...]``."""

import random
import sys
import time
from collections import Counter, defaultdict
from pathlib import Path
from statistics import median

sys.path.insert(0, str(Path(__file__).parent))

from error_model import Erroneous, erroneous, numeric, random_wrong

from rldrill.problems.catalogue import selection
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.answers.text import Unreadable
from rldrill.solutions.diagnosis.explaining import explained
from rldrill.solutions.diagnosis.search import Clock, Search, Typed
from rldrill.solutions.drawing import draw

#: What may be said of an error, by the names of the program's causes.
TERM = {"term-left-out", "factor-left-out", "case"}
ACCEPTED = {
    "term_lost": {
        "summand-left-out",
        "kept",
        "bracket-left-out",
        "term-left-out",
        "factor-left-out",
        "index",
        "range",
        "twin",
        "case",
        "choice",
        "elsewhere",
        "confused",
    },
    "factor_lost": {
        "bracket-left-out",
        "factor-left-out",
        "term-left-out",
        "doubled",
        "halved",
        "tenfold",
        "power",
        "inverse",
        "elsewhere",
        "index",
        "sign",
    },
    "sign_turned": {"summand-sign", "all-signs", "sign", "minus-lost", "difference", "twice"},
    "bracket_lost": {"bracket"},
    "bracket_widened": {"bracket"},
    "minus_lost": {"summand-sign", "sign", "minus-lost", "difference", "twice"},
    "power_off": {"power", "squared", "squared-value", "factor-left-out", "index"},
    "power_as_product": {"power-as-product"},
    "square_forgotten": {"power", "squared", "squared-value", "factor-left-out", "index"},
    "factor_twice": {"squared-value", "squared", "power", "doubled", "halved", "index"},
    "smallest_taken": {"min-for-max", "choice", "elsewhere", "smallest", "other-taken"},
    "mean_taken": {"mean-for-max"},
    "all_added": {"sum-for-max"},
    "first_taken": {"other-taken", "choice", "min-for-max", "elsewhere", "case"},
    "complement_taken": {"complement", "complement-of-value"},
    "complement_forgotten": {"complement-of-value", "complement", "confused", "exchanged"},
    "inverse_forgotten": {"inverse", "upside-down", "divided", "factor-left-out"},
    "upside_down": {"inverse", "upside-down"},
    "transposition_forgotten": {"transposed", "order-of-factors", "answer-transposed"},
    "matrices_exchanged": {"order-of-factors", "transposed"},
    "added_for_multiplied": {"added"},
    "point_shifted": {"tenfold"},
    "fractions_added_crosswise": {"crosswise"},
    "numbers_exchanged": {"summand-sign", "all-signs", "difference", "sign", "exchanged"},
    "value_sign": {"sign", "difference", "all-signs", "minus-lost"},
    "value_tenfold": {"tenfold"},
    "value_one_off": {"one-off", "numerator"},
    "value_digits_swapped": {"digits"},
    "value_numerator_off": {"numerator", "one-off"},
    "value_denominator_off": {"denominator", "one-off"},
    "value_halved": {"doubled", "halved", "factor-left-out", "twice"},
    "update_left_out": {"kept", "term-left-out", "factor-left-out"},
    "change_doubled": {"twice", "repeated", "factor-left-out", "change-doubled"},
    "entries_exchanged": {"exchanged-cells", "rows-exchanged", "elsewhere"},
    "one_sign_lost": {"sign", "minus-lost", "difference"},
    "answer_sign": {"all-signs", "sign", "minus-lost", "difference"},
    "answer_upside_down": {"inverse", "upside-down"},
    "another_quantity": {"another-quantity"},
    "answer_transposed": {"answer-transposed", "transposed"},
}


def right(error: Erroneous, causes, solution, steps) -> str:
    """right, place (only), kind (only) or wrong."""
    best = "wrong"
    for cause in causes:
        if cause.mistake is not None:
            # A listed mistake is right where the error is one of that formula, all along.
            read = [f.key for f in solution.work.read if cause.mistake in f.misread]
            if error.formula in read or cause.mistake.is_slip:
                return "listed"
            continue
        if error.twofold:
            at = None if error.place is None else steps[error.place]
            places = {c.application.number for c in (cause, cause.then) if c and c.application}
            if at in places or cause.then is not None:
                return "right"
            continue
        kinds = ACCEPTED[error.kind]
        kind = cause.kind in kinds or (cause.kind in {"elsewhere"} and error.kind == "first_taken")
        numbers = {c.application.number for c in (cause,) if c.application}
        if error.formula is None:
            place = True
        elif error.everywhere:
            place = cause.application is None and cause.formula is not None and cause.formula.key == error.formula
            place = place or (
                cause.application is not None and cause.formula is not None and cause.formula.key == error.formula
            )
        else:
            place = steps[error.place] in numbers or (
                cause.application is None and (cause.formula is None or cause.formula.key == error.formula)
            )
        if kind and place:
            return "right"
        if place and best == "wrong":
            best = "place"
        elif kind and best == "wrong":
            best = "kind"
    return best


def main() -> None:
    arguments = sys.argv[1:]
    seeds = 1
    if "--seeds" in arguments:
        at = arguments.index("--seeds")
        seeds = int(arguments[at + 1])
        del arguments[at : at + 2]
    budget = None
    if "--budget" in arguments:
        at = arguments.index("--budget")
        budget = float(arguments[at + 1])
        del arguments[at : at + 2]
    sample = 0
    if "--sample" in arguments:
        at = arguments.index("--sample")
        sample = int(arguments[at + 1])
        del arguments[at : at + 2]
    verbose = "-v" in arguments
    arguments = [a for a in arguments if a != "-v"]
    total, kinds, families, times = Counter(), defaultdict(Counter), defaultdict(Counter), defaultdict(list)
    accused, tried = Counter(), Counter()
    causes_of = Counter()
    wrongs = defaultdict(Counter)
    for family in selection(arguments):
        if family.name == "dyna-q":
            continue
        for level in family.levels:
            for seed in range(100, 100 + seeds):
                solution = draw(family.name, level, seed)
                search = Search(solution)
                steps = [each.number for each in search.applications if not each.equation]
                keys = {p.label: (p, answer_kind(p.kind)) for p in solution.problem.parts}

                def typed(label, text):
                    part, kind = keys[label]
                    cells = kind.read(text, solution.problem.parameters, solution.problem.given.terminal_states())
                    return Typed(part, cells, kind.cells(solution.answers[label]))

                begun = time.process_time()
                errors = erroneous(solution, seed)
                if sample:
                    errors = random.Random(seed).sample(errors, min(sample, len(errors)))
                for error in errors:
                    try:
                        t = typed(error.part, error.text)
                    except Unreadable:  # longer than anybody types
                        continue
                    if not t.wrong:
                        continue
                    begun = time.process_time()
                    result = explained(search, t, Clock(budget))
                    spent = (time.process_time() - begun) * 1000
                    times[family.name].append(spent)
                    verdict = (
                        "none"
                        if not result.causes or len(result.causes) > 2
                        else right(error, result.causes, solution, steps)
                    )
                    if verdict == "none" and len(result.causes) > 2:
                        verdict = "many"
                    if verbose:
                        ok = [c.kind for c in result.every if right(error, [c], solution, steps) in ("right", "listed")]
                        print(
                            "REC",
                            family.name,
                            verdict,
                            error.kind,
                            f"{result.chance:.4g} 0",
                            [(c.kind, round(c.weight, 3), c.kind in ok) for c in result.every],
                        )
                    total[verdict] += 1
                    kinds[error.kind if not error.twofold else "two slips"][verdict] += 1
                    families[family.name][verdict] += 1
                    causes_of[result.causes[0].kind if result.causes else "-"] += 1
                    if verdict in ("wrong", "place", "kind"):
                        wrongs[error.kind][verdict + " " + " / ".join(c.kind for c in result.causes)] += 1
                        if verbose:
                            print(
                                verdict,
                                solution.problem.identity,
                                error,
                                [
                                    (
                                        c.kind,
                                        c.weight,
                                        c.application and c.application.number,
                                        str((c.edit and c.edit.part) or (c.probe and c.probe.part)),
                                        c.what,
                                    )
                                    for c in result.causes
                                ],
                                result.confidence,
                            )
                    elif verbose and verdict in ("none", "many"):
                        print(verdict, solution.problem.identity, error)
                for part in solution.problem.parts:
                    if not numeric(solution, part.label):
                        continue
                    for n in range(3):
                        text = random_wrong(solution, part.label, n)
                        if text is None:
                            continue
                        t = typed(part.label, text)
                        if not t.wrong:
                            continue
                        result = explained(search, t, Clock(budget))
                        tried[family.name] += 1
                        if verbose:
                            print(
                                "REC",
                                family.name,
                                "RANDOM",
                                "-",
                                f"{result.chance:.4g} 0",
                                [(c.kind, round(c.weight, 3), False) for c in result.every],
                            )
                        if result.causes and len(result.causes) <= 2:
                            accused[family.name] += 1
                            if verbose:
                                print(
                                    "ACCUSED",
                                    solution.problem.identity,
                                    part.label,
                                    text,
                                    [(c.kind, c.weight, c.application and c.application.number) for c in result.causes],
                                    result.confidence,
                                )
    n = sum(total.values())
    for name, row in families.items():
        m = sum(row.values())
        spent = times[name]
        print(
            f"{name:30} n={m:4} right {100 * (row['right'] + row['listed']) / m:5.1f} many {100 * row['many'] / m:5.1f} none {100 * row['none'] / m:5.1f} "
            f"wrong {100 * (row['wrong']) / m:5.1f} place {100 * row['place'] / m:4.1f} kind {100 * row['kind'] / m:4.1f} accused {accused[name]}/{tried[name]} ms {median(spent):.1f} {max(spent):.0f}"
        )
    print()
    for name, row in sorted(kinds.items()):
        m = sum(row.values())
        print(
            f"{name:28} n={m:4} right {100 * (row['right'] + row['listed']) / m:5.1f} many {100 * row['many'] / m:5.1f} none {100 * row['none'] / m:5.1f} place {100 * row['place'] / m:4.1f} kind {100 * row['kind'] / m:4.1f} wrong {100 * row['wrong'] / m:5.1f} {wrongs[name].most_common(3)}"
        )
    every = [spent for row in times.values() for spent in row]
    print()
    print(
        "n",
        n,
        {k: f"{100 * v / n:.1f}" for k, v in total.items()},
        "random accused",
        sum(accused.values()),
        "of",
        sum(tried.values()),
        f"ms median {median(every):.1f} worst {max(every):.0f}",
    )


if __name__ == "__main__":
    main()
