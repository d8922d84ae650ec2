"""The inner and the outer step of MAML on quadratic losses."""

from typing import NamedTuple, Self

from pydantic import Field, model_validator

from rldrill.problems.document import Paragraph, Table
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, Parameter, StepSize, shown
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Number, Numbers, Part
from rldrill.problems.phrases import in_open, step_size

TITLE = "MAML step"
SOURCE = "Finn, Abbeel & Levine 2017, section 2.2"
REVISION = 2


class Task(NamedTuple):
    """A task by its loss ½ c (θ − m)²: the curvature c, and the best parameter m."""

    curvature: Exact
    optimum: Exact


class Given(Givens):
    """The shared parameter θ, the tasks, and the step sizes α of the adaptation and β of the outer step."""

    theta: Exact = Field(description="The shared parameter.")
    tasks: tuple[Task, ...] = Field(
        min_length=1, max_length=12, description="The tasks, each by the curvature and the optimum of its loss."
    )
    alpha: StepSize = Field(description="The step size of the adaptation to a task.")
    beta: Exact = Field(description="The step size of the outer step, above 0.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.beta <= 0:
            raise ValueError(f"beta is {self.beta}; it must be above 0")
        if any(task.curvature <= 0 for task in self.tasks):
            raise ValueError("tasks: a curvature is not above 0")
        return self


def draw(level: int, rng: Draws) -> Given:
    """One task; then two; then two with the step size of the adaptation left open."""
    count = 1 if level == 1 else 2
    theta, *optima = rng.distinct(count + 1, -4, 6)
    tasks = tuple(Task(rng.choice((rng.whole(1, 3), rng.whole(1, 4))), optimum) for optimum in optima)
    fine = ("1/4", "1/10", "1/5") if level > 1 else ("1/4",)
    alpha = Parameter("alpha") if level == 3 else rng.fraction("1/2", *fine)
    return Given(theta=theta, tasks=tasks, alpha=alpha, beta=rng.fraction("1/2", *fine))


def question(given: Given) -> Question:
    """The losses; the adapted parameters, then the new shared one."""
    count = len(given.tasks)
    rows = tuple(
        (f"${index}$", f"${shown(task.curvature)}$", f"${shown(task.optimum)}$")
        for index, task in enumerate(given.tasks, 1)
    )
    adapted = tuple(f"θ′_{index}" for index in range(1, count + 1))
    open_ = in_open(given)
    inner = step_size(given.alpha).replace("step size", "step size of the adaptation")
    return Question(
        (
            Paragraph(
                "A robot meets tasks that differ a little, and adapts its one parameter $θ$ to each. Task $i$ has the "
                "loss $L_i(θ) = 1/2 · c_i (θ − m_i)^2$, in the adaptation as well as after it:"
            ),
            Table(("task $i$", "$c_i$", "$m_i$"), rows),
            Paragraph(
                f"The parameter is $θ = {shown(given.theta)}$. MAML adapts it to every task by one step of gradient "
                "descent on the task's loss. Then it changes $θ$ by one step of gradient descent on the sum of the "
                "losses after adaptation, with the full gradient through the adaptation. "
                f"{inner} That of the outer step is $β = {shown(given.beta)}$."
            ),
        ),
        (
            Part(
                f"What {'is the adapted parameter' if count == 1 else 'are the adapted parameters'} "
                f"${', '.join(adapted)}${open_}?",
                Numbers(adapted) if count > 1 else Number(),
                zero=True,
            ),
            Part(f"What is $θ$ after the outer step{open_}?", Number(), zero=True),
        ),
    )
