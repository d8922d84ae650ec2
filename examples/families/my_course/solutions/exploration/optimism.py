"""The largest reward for ever, discounted from when it begins."""

from sympy import Pow, evaluate

from my_course.problems.exploration.optimism import Given
from rldrill.problems.mathematics import Script, variable, word
from rldrill.solutions.exact import exact
from rldrill.solutions.formula.formula import Formula, Misconception, Place
from rldrill.solutions.formula.notation import gamma, letter, n
from rldrill.solutions.oracle import Answers, at
from rldrill.solutions.work import Work

V_max = letter("V_max", Script(variable("V"), word("max")))
R_max = letter("R_max", Script(variable("R"), word("max")))

with evaluate(False):
    BEGINS_AT_ONCE = Misconception("begins-at-once", "The rewards that come later are discounted by the steps before.")
    ONE_STEP_LATE = Misconception(
        "one-step-late", "The first reward comes after n steps: its factor is γ^n, not γ^(n+1)."
    )
    BOUND = Formula(
        "optimistic-bound",
        V_max,
        gamma**n * R_max * Pow(1 - gamma, -1),
        title="Largest value",
        source="Brafman & Tennenholtz 2002, section 2",
        hint="The largest reward for ever is a geometric series; what comes later is discounted as a whole.",
        place=Place.BEYOND,
        misread={
            BEGINS_AT_ONCE: R_max * Pow(1 - gamma, -1),
            ONE_STEP_LATE: gamma ** (n + 1) * R_max * Pow(1 - gamma, -1),
        },
    )

MISCONCEPTIONS = (BEGINS_AT_ONCE, ONE_STEP_LATE)


def solve(given: Given, work: Work) -> None:
    """The formula."""
    work.answer(work.step(BOUND, R_max=exact(given.reward), n=given.time, gamma=exact(given.gamma)))


def oracle(given: Given) -> Answers:
    """The series, added up until nothing is left of it."""
    discount = at(given.gamma)
    return ([sum(at(given.reward) * discount**time for time in range(given.time, 2000))],)
