"""Where a mistake is said not to be possible, making it changes nothing, or cannot be done at all."""

import pytest

from rldrill.problems.catalogue import families, family
from rldrill.solutions.drawing import draw
from rldrill.solutions.solution import solver

#: Mistakes that change something where they are ruled out, and why they cannot be told there.
OTHER_QUESTION = {
    "synchronous": "the order is given",
    "in-place": "the order is given",
    "ilqr-for-ddp": "the method is named",
    "ddp-for-ilqr": "the method is named",
    "max-for-mean": "unknowns are not compared",
    "mean-for-max": "a policy averages rightly",
    "forgot-policy": "there is no policy",
    "discounted-at-one-level-only": "with one level: forgot-gamma",
    "traces-kept": "only Watkins cuts them",
    "on-and-off-policy-swapped": "another word is asked",
    "both-alike": "another word is asked",
    "neither": "another word is asked",
    "normalised-without-exp": "the given odds contradict; with a letter it would take too long to judge",
    "block-of-the-wrong-action": "w's own block is told; of two actions the other one tells nothing",
    "weights-interleaved": "w's own block is told",
    "weights-interleaved-beside-the-open-one": "where no weight is open it is the one above",
    "width-forgotten": "b is asked or used before",
    "outer-step-from-adapted": "each of several tasks has an adapted parameter of its own",
    "divided-by-their-sum": "beside features that are known those asked for are not all",
    "other-action-subtracted": "of three actions no one is the other",
    "lengths-exchanged": "of more than two links several could be exchanged",
    "value-kept-at-the-end": "where a value is missing, its equation comes first",
    "absolute-rates": "of more than two links it is not worked out",
    "absolute-angles-differentiated": "the angle of the last link is a row, too",
    "parameters-exchanged": "of three models several could be; on the border both ways have the same n",
    "update-for-target": "the step size is not stated where no target needs it, or is asked for",
}


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
                        told_apart = made is not None and solution.tells_apart(made)
                    except Exception:  # what its givens have not, nobody can go by
                        continue
                    assert not told_apart, (solution.problem.identity, mistake)
