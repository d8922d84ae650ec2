"""A working speaks in the question's symbols: V_k of sweeps, no π and no a where nothing is chosen, labels as asked."""

import re

import pytest

from rldrill.exercise import Exercise, draw, read
from rldrill.problems.catalogue import chosen
from rldrill.render.unicode import unicode_text

ROWS = [["new", "worn", 1, 0], ["worn", "worn", "1/2", 2], ["worn", "broken", "1/2", 6]]
CHOICE = [["new", "run", "worn", 1, 2], ["new", "wait", "new", 1, 0], ["worn", "run", "broken", 1, 4]]


def problem(family: str, rows: list[list[object]], **more: object) -> Exercise:
    mdp = {"transitions": rows, "terminal": ["broken"]}
    return read({"family": family, "given": {"mdp": mdp, "gamma": "1/2", **more}})


def working(exercise: Exercise) -> list[str]:
    return [line.strip() for block in exercise.working() for line in unicode_text(block).splitlines()]


def key(exercise: Exercise) -> list[str]:
    return [unicode_text(exercise.answer(part)) for part in exercise.parts]


def test_the_values_of_a_reward_process_need_no_action() -> None:
    lines = working(problem("policy-value", ROWS))
    assert lines[0] == "V(s) = Σₛ′ Pₛₛ′(Rₛₛ′ + γV(s′))"
    assert "V(new) = 1·(0 + 1/2·V(worn))" in lines
    assert not [line for line in lines if "π" in line]


def test_its_residuals_need_none_either() -> None:
    lines = working(problem("bellman-residual", ROWS, values={"new": 1, "worn": 4}))
    assert lines[1] == "δ(s) = Σₛ′ Pₛₛ′(Rₛₛ′ + γV(s′)) − V(s)"
    assert "δ(new) = 1·(0 + 1/2·4) − 1 = 2 − 1 = 1" in lines


@pytest.mark.parametrize("family", ["policy-evaluation", "value-iteration"])
def test_synchronous_sweeps_go_from_one_table_to_the_next(family: str) -> None:
    lines = working(problem(family, CHOICE, sweeps=1))
    (general,) = (line for line in lines if line.startswith("Vₖ₊₁(s) = "))
    assert general.endswith("Σₛ′ Pₛₛ′ᵃ(Rₛₛ′ᵃ + γVₖ(s′))")
    assert [line for line in working(problem(family, CHOICE, sweeps=1, in_place=True)) if line.startswith("V(s) ← ")]


@pytest.mark.parametrize("family", ["policy-evaluation", "value-iteration"])
def test_what_a_sweep_gives_stays_the_same(family: str) -> None:
    # By hand: new earns 2 or 0, on average 1 and at best 2; worn earns 4.
    found = {"policy-evaluation": "V₁(new) = 1  V₁(worn) = 4", "value-iteration": "V₁(new) = 2  V₁(worn) = 4"}
    assert key(problem(family, CHOICE, sweeps=1))[0].strip() == found[family]


@pytest.mark.parametrize("level", [1, 2, 3])
def test_the_arm_that_is_pulled_next_stands_by_itself(level: int) -> None:
    for seed in range(6):
        assert not [line for line in key(draw("bandit", level, seed)) if "next" in line]


@pytest.mark.parametrize("name", chosen(("bellman", "dynamic-programming", "control")))
def test_what_a_key_calls_its_entries_is_in_the_question(name: str) -> None:
    for level in (1, 2, 3):
        exercise = draw(name, level, 4)
        asked = " ".join((str(exercise.question()), *(part.ask for part in exercise.parts))).replace("'", "′")
        for part in exercise.parts:
            of = getattr(part.kind, "of", "")
            head = of.partition("·")[0].replace("'", "′").rstrip("(")
            assert re.search(re.escape(head), asked), (exercise.id, part.label, of)


def test_the_same_policy_is_not_written_twice() -> None:
    # Both transitions lead to warm, where fast stays the best action: one policy of three lines.
    run = {"states": ["cool", "warm", "warm"], "actions": ["fast", "slow"], "rewards": [1, 1]}
    values = {"cool": {"slow": 0, "fast": 1}, "warm": {"slow": 2, "fast": 8}}
    given = {"trajectory": run, "values": values, "alpha": "1/4", "gamma": "1/2", "epsilon": "1/2"}
    lines = working(read({"family": "expected-sarsa", "given": given}))
    assert [line for line in lines if line.startswith(("t = 0: π", "t = 1: π"))] == [
        "t = 0: π(slow|warm) = (1/2)/2 = 1/4",
        "t = 0: π(fast|warm) = 1 − 1/2 + (1/2)/2 = 3/4",
    ]


def told(family: str, **given: object) -> str:
    return str(read({"family": family, "given": given}).question())


RUN = {"states": ["cool", "warm"], "actions": ["fast", "slow"], "rewards": [1]}


@pytest.mark.parametrize(("slow", "tie"), [(2, False), (8, True)])
def test_ties_are_settled_only_where_there_is_one(slow: int, *, tie: bool) -> None:
    values = {"cool": {"slow": 0, "fast": 1}, "warm": {"slow": slow, "fast": 8}}
    known = {"trajectory": RUN, "values": values, "alpha": "1/4", "gamma": "1/2"}
    assert ("tied best actions" in told("expected-sarsa", epsilon="1/2", **known)) == tie
    second = {"cool": {"slow": 1, "fast": 0}, "warm": {"slow": 3, "fast": 5}}
    assert ("equally good actions" in told("double-q-learning", second=second, updates=[1], **known)) == tie


def test_a_tie_that_an_update_makes_is_settled_too() -> None:
    # Q(warm, slow) ← 4 + 1/2·(6 + 1/2·4 − 4) = 6, as much as fast: the second transition enters warm again.
    run = {"states": ["warm", "warm", "warm"], "actions": ["slow", "fast"], "rewards": [5, 1]}
    known = {"trajectory": run, "alpha": "1/2", "gamma": "1/2", "epsilon": 0}
    assert "tied best actions" in told("expected-sarsa", values={"warm": {"slow": 4, "fast": 6}}, **known)
    assert "tied best actions" not in told("expected-sarsa", values={"warm": {"slow": 2, "fast": 6}}, **known)


@pytest.mark.parametrize(("pays", "tie"), [(1, False), (2, True)])
def test_policy_iteration_keeps_the_old_action_only_on_a_tie(pays: int, *, tie: bool) -> None:
    # Both actions end the episode: run earns 2, wait as much or less.
    rows = [["new", "run", "broken", 1, 2], ["new", "wait", "broken", 1, pays]]
    mdp = {"transitions": rows, "terminal": ["broken"]}
    asked = told("policy-iteration", mdp=mdp, start={"new": "wait"}, gamma="1/2", rounds=1)
    assert ("on a tie the old action is kept" in asked) == tie


def test_first_visits_are_told_only_where_there_is_a_second_one() -> None:
    known = {"alpha": "1/2", "gamma": "1/2", "visits": "first", "values": {"a": 1, "b": 2}}

    def question(*states: str) -> str:
        run = {"states": [*states, "end"], "rewards": [1] * len(states), "terminal": ["end"]}
        return told("monte-carlo", trajectory=run, **known)

    assert "visit to a state" not in question("a", "b")
    assert "only the first visit to a state counts" in question("a", "b", "a")


@pytest.mark.parametrize("name", ["sarsa", "q-learning", "expected-sarsa", "sarsa-lambda", "epsilon-greedy"])
def test_what_is_asked_for_is_not_left_open(name: str) -> None:
    for seed in range(12):
        exercise = draw(name, 3, seed)
        asks_back = not exercise.problem.parameters
        asked = " ".join(str(exercise.question()).split())
        assert ("is not known" in asked) == asks_back, exercise.id


def test_a_visit_without_a_time_has_no_t() -> None:
    given = {"values": {"a": 4}, "counts": {"a": 4}, "visits": [["a", 9]]}
    lines = working(read({"family": "sample-average", "given": given}))
    assert lines == ["n(s) ← n(s) + 1", "n(a) ← 4 + 1 = 5", "V(s) ← V(s) + (R − V(s))/n(s)",
                     "V(a) ← 4 + (9 − 4)/5 = 4 + 5/5 = 5"]  # fmt: skip


@pytest.mark.parametrize("typed", ["blue", "next: blue", "a_7 = blue", "a7 = blue", "arm: blue"])
def test_a_single_choice_may_be_called_anything(typed: str) -> None:
    pulls = [["blue", 4], ["red", 1]]
    exercise = read({"family": "bandit", "given": {"pulls": pulls}})
    assert exercise.check(typed, "b").says == "Right."
    assert not exercise.check(typed.replace("blue", "red"), "b").accepted


@pytest.mark.parametrize("family", ["bayes-rule", "bayes-predict", "bayes-filter", "semi-gradient-td", "reinforce"])
def test_the_same_sign_never_has_two_values_in_one_working(family: str) -> None:
    for level in (1, 2):
        for seed in range(8):
            values: dict[str, set[str]] = {}
            for block in draw(family, level, seed).working():
                if found := re.match(r" *((?:t = \d+: )?[^=]+?) = .*?([^=]+)$", unicode_text(block)):
                    values.setdefault(found[1], set()).add(found[2].strip())
            assert not {head: results for head, results in values.items() if len(results) > 1}
