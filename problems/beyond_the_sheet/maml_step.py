"""The inner and the outer step of MAML on quadratic losses; or the parameter or step size with a given outcome."""

from collections.abc import Iterator
from typing import ClassVar, NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Block, Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, StepSize, shown
from rldrill.problems.family import Givens, Question, flag
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.parts import Number, Numbers, Part
from rldrill.problems.phrases import in_open

TITLE = "MAML step"
SOURCE = "Finn, Abbeel & Levine 2017, section 2.2"
REVISION = 8


class Task(NamedTuple):
    """A task by its loss ½ c (θ − m)²: the curvature c, and the best parameter m."""

    curvature: Exact
    optimum: Exact


class Given(Givens):
    """The shared parameter θ, the tasks, and the step sizes α of the adaptation and β of the outer step.

    Without θ and β that θ is asked for which the outer step does not change; without β alone, that β with which the
    outer step leads to ``after``.
    """

    OWN: ClassVar[str] = "L"

    theta: Exact | None = Field(default=None, description="The shared parameter; without it, it is asked for.")
    tasks: tuple[Task, ...] = Field(
        min_length=1, max_length=12, description="The tasks, each by the curvature and the optimum of its loss."
    )
    alpha: StepSize = Field(description="The step size of the adaptation to a task.")
    beta: Exact | None = Field(default=None, description="The step size of the outer step, above 0.")
    after: Exact | None = Field(default=None, description="The shared parameter after the outer step; instead of beta.")
    first_order: bool = flag("Whether the outer step of first-order MAML is asked for, too.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.beta is not None and self.beta <= 0:
            raise ValueError(f"beta is {self.beta}; it must be above 0")
        if any(task.curvature <= 0 for task in self.tasks):
            raise ValueError("tasks: a curvature is not above 0; make it so")
        if self.theta is None and (self.beta is not None or self.after is not None):
            raise ValueError("theta: which one the outer step leaves alone is asked without beta and after")
        if self.theta is not None and (self.beta is None) == (self.after is None):
            raise ValueError("give either beta or what theta is after the outer step")
        if self.beta is None and isinstance(self.alpha, Parameter):
            raise ValueError("alpha: give a number where theta or beta is to be found")
        if self.first_order and self.beta is None:
            raise ValueError("first_order: give theta and beta, too")
        return self


def draw(level: int, rng: Draws) -> Given:
    """One task; then more, or first-order MAML, too; then α left open, or the θ that stays, or β from what follows.

    Not every curvature is 2: without it the gradient is that without the 2 of the power.
    """
    given = rng.choice((_open, _staying, _step_sought))(rng) if level == 3 else _stepped(level, rng)
    return given if any(task.curvature != 2 for task in given.tasks) else draw(level, rng)


def _stepped(level: int, rng: Draws) -> Given:
    count, first_order = (1, False) if level == 1 else rng.choice(((2, False), (2, True), (1, True), (3, False)))
    theta, tasks, alpha = _drawn_halved(rng) if level == 1 else _drawn(rng, count)
    beta = Fraction(1, 4) if alpha == Fraction(1, 2) else Fraction(1, 2)
    adapted = [theta - alpha * curve * (theta - optimum) for curve, optimum in tasks]
    outer = sum(curve * (own - optimum) for own, (curve, optimum) in zip(adapted, tasks, strict=True))
    if first_order and theta - beta * outer in adapted:
        return draw(level, rng)
    return Given(theta=theta, tasks=tasks, alpha=alpha, beta=beta, first_order=first_order)


def _drawn_halved(rng: Draws) -> tuple[Fraction, tuple[Task, ...], Fraction]:
    """One task whose optimum is half as far after the adaptation, at a whole number."""
    alpha, curvature = rng.choice(((Fraction(1, 2), 1), (Fraction(1, 2), 3), (Fraction(1, 4), 2)))
    optimum = rng.whole(-3, 5)
    theta = optimum + 2 * rng.nonzero(-3, 3)
    return theta, (Task(Fraction(curvature), optimum),), alpha


def _drawn(rng: Draws, count: int) -> tuple[Fraction, tuple[Task, ...], Fraction]:
    """Tasks that are not all of one curvature, none that is learnt in one step, so that it would not count.

    θ does not stay where it is.
    """
    theta, *optima = rng.distinct(count + 1, -3, 5)
    alpha = rng.fraction("1/2", "1/4" if count < 3 else "1/2")
    curvatures = [Fraction(curve) for curve in (1, 2, 3) if curve * alpha != 1]
    tasks = tuple(Task(rng.choice(curvatures), optimum) for optimum in optima)
    alike = count > 1 and len({task.curvature for task in tasks}) == 1
    return _drawn(rng, count) if alike or not _slope(theta, tasks, alpha) else (theta, tasks, alpha)


def _slope(theta: Fraction, tasks: tuple[Task, ...], alpha: Fraction) -> Fraction:
    """The gradient of the outer loss."""
    return sum(((1 - alpha * c) ** 2 * c * (theta - m) for c, m in tasks), Fraction(0))


def _open(rng: Draws) -> Given:
    theta, *optima = rng.distinct(3, -3, 5)
    tasks = tuple(map(Task, rng.shuffled(tuple(map(Fraction, (1, 2)))), optima))
    return Given(theta=theta, tasks=tasks, alpha=Parameter("alpha"), beta=rng.fraction("1/2", "1/4"))


def _staying(rng: Draws) -> Given:
    """Tasks of different curvature: with equal ones it is the mean of the optima."""
    _, tasks, alpha = _drawn(rng, rng.choice((2, 3)))
    return Given(tasks=tasks, alpha=alpha)


def _step_sought(rng: Draws) -> Given:
    """First β, which is not α, then what it leads to."""
    theta, tasks, alpha = _drawn(rng, 2)
    beta = rng.fraction(*(each for each in ("1/2", "1/4", "1/3", "1/5") if fraction_of(each) != alpha))
    changed = beta * _slope(theta, tasks, alpha)
    return Given(theta=theta, tasks=tasks, alpha=alpha, after=theta - changed)


def question(given: Given) -> Question:
    """The losses; the adapted parameters, then the new shared one; or what is to be found."""
    start = "" if given.theta is None else f"The parameter is $θ = {shown(given.theta)}$. "
    left_open = isinstance(given.alpha, Parameter)
    alpha = "$α$ of the adaptation is left open" if left_open else f"of the adaptation is $α = {shown(given.alpha)}$"
    inner = f"The step size {alpha}."
    tasks, adapted, total = _losses(given)
    return Question(
        (
            *tasks,
            Paragraph(
                f"{start}MAML {adapted}. In the outer step it changes $θ$ by one step of gradient descent on "
                f"$J = {total}$, with the full gradient through the adaptation. {inner}{_outer(given)}"
            ),
        ),
        tuple(_parts(given)),
    )


def _losses(given: Given) -> tuple[tuple[Block, ...], str, str]:
    """The tasks, what the adaptation does, and the outer loss."""
    if len(given.tasks) == 1:
        ((curvature, optimum),) = given.tasks
        told = (
            "A robot has a parameter $θ$ that is to be adapted to a single task, $i = 1$. The task has the loss "
            f"$L_1(θ) = 1/2 · c_1 (θ − m_1)^2$ with $c_1 = {shown(curvature)}$ and $m_1 = {shown(optimum)}$, before "
            "the adaptation as well as after it."
        )
        adapted = "adapts it by one step of gradient descent on this loss, from $θ$ to $θ′_1$"
        return (Paragraph(told),), adapted, "L_1(θ′_1)"
    rows = tuple(
        (f"${index}$", f"${shown(task.curvature)}$", f"${shown(task.optimum)}$")
        for index, task in enumerate(given.tasks, 1)
    )
    told = (
        "A robot has a parameter $θ$ that is to be adapted to one of several tasks. Task $i$ has the loss "
        "$L_i(θ) = 1/2 · c_i (θ − m_i)^2$, before the adaptation as well as after it:"
    )
    adapted = "adapts it to every task by one step of gradient descent on the task's loss, from $θ$ to $θ′_i$"
    return (Paragraph(told), Table(("task $i$", "$c_i$", "$m_i$"), rows)), adapted, "∑_i L_i(θ′_i)"


def _outer(given: Given) -> str:
    if given.beta is not None:
        return f" That of the outer step is $β = {shown(given.beta)}$."
    return "" if given.after is None else f" The outer step leads to $θ = {shown(given.after)}$."


def _parts(given: Given) -> Iterator[Part]:
    numbers, opened = range(1, len(given.tasks) + 1), in_open(given)
    if given.theta is None:
        slopes = tuple(f"dθ′_{index}/dθ" for index in numbers)
        yield Part(f"What are the derivatives ${', '.join(slopes)}$ of the adapted parameters?", Numbers(slopes))
        yield Part("Which $θ$ does the outer step leave unchanged?", Number(), zero=True)
        return
    adapted = tuple(f"θ′_{index}" for index in numbers)
    if len(adapted) == 1:
        yield Part(f"What is the adapted parameter ${adapted[0]}${opened}?", Number(), zero=True)
    else:
        yield Part(
            f"What are the adapted parameters ${', '.join(adapted)}${in_open(given)}?",
            Numbers(adapted),
            zero=True,
        )
    if given.beta is None:
        yield Part("What is the step size $β$ of the outer step?", Number())
        return
    yield Part(f"What is $θ$ after the outer step{opened}?", Number(), zero=True)
    if given.first_order:
        which = "i" if len(given.tasks) > 1 else "1"
        ask = f"What would $θ$ be after the outer step of first-order MAML, which takes $dθ′_{which}/dθ$ to be $1$"
        yield Part(f"{ask}{opened}?", Number(), zero=True)
