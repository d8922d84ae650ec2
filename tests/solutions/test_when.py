"""Where a mistake is said not to be possible, making it changes nothing, or cannot be done at all."""

import pytest

from rldrill.problems.catalogue import families, family
from rldrill.solutions.drawing import distinguishable, draw
from rldrill.solutions.solution import solver

#: Mistakes that change something where they are ruled out: what is asked there is another question, in which they are
#: no mistake, or one that nobody makes.
OTHER_QUESTION = {
    "forgot-gamma-in-q", "own-value-for-next", "synchronous", "in-place", "max-for-mean", "traces-kept",
    "on-and-off-policy-swapped", "both-alike", "neither", "normalised-without-exp", "ilqr-for-ddp", "ddp-for-ilqr",
    "cost-to-go-given", "forgot-policy", "discounted-at-one-level-only", "mean-for-max", "prior-again",
    "block-of-the-wrong-action", "weights-interleaved", "width-forgotten", "half-forgotten", "sigma-not-squared",
    "norm-not-squared",
}  # fmt: skip


@pytest.mark.parametrize("name", families())
def test_a_mistake_that_is_ruled_out_changes_nothing(name: str) -> None:
    for level in family(name).levels:
        for seed in range(2):
            solution = draw(name, level, seed)
            read = {mistake for formula in solution.work.read for mistake in formula.misread}
            for mistake in solver(family(name)).misconceptions:
                if not (mistake.is_slip or mistake in read) or mistake.name in OTHER_QUESTION:
                    continue
                if not mistake.applies(solution.problem.given):
                    try:
                        made = solution.answers_with(mistake)
                        told_apart = made is not None and distinguishable(solution, made)
                    except Exception:  # what its givens have not, nobody can go by
                        continue
                    assert not told_apart, (solution.problem.identity, mistake)
