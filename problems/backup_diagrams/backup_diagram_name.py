"""Which equation or method a backup diagram shows."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.backups import BACKUPS, TITLES, Backup, backup_diagram, legend
from rldrill.problems.document import Beside, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Choice, Part

TITLE = "Name of a backup diagram"
SOURCE = "Sutton & Barto 2018, sections 3.5, 3.6, 6.1 to 6.6 and 7.1"
REVISION = 3
#: One chooses among the options; and the name must not depend on how many branches or steps are drawn.
DISTRACTORS = ("diagrams.*.options.*", "diagrams.*.branches", "diagrams.*.steps")


class Shown(Givens):
    """One diagram, what may be chosen, and how many branches and steps are drawn where there are several."""

    shows: Backup = Field(description="The equation or method that is drawn.")
    options: tuple[Backup, ...] = Field(
        min_length=2, max_length=10, description="What may be chosen; it holds what is shown."
    )
    branches: int = Field(default=2, ge=2, le=3, description="How many branches are drawn where there are several.")
    steps: int = Field(default=2, ge=2, le=4, description="How many steps are drawn where there are several.")

    @model_validator(mode="after")
    def _fits(self) -> Self:
        if self.shows not in self.options:
            raise ValueError(f"options: {self.shows!r}, which is shown, must be among them")
        if len(set(self.options)) < len(self.options):
            raise ValueError("options: one is given twice; give each once")
        return self

    @property
    def letters(self) -> dict[Backup, str]:
        """The letter of every option."""
        return dict(zip(self.options, "ABCDEFGHIJ", strict=False))


class Given(Givens):
    """The diagrams, each of which is a part."""

    diagrams: tuple[Shown, ...] = Field(
        min_length=1, max_length=6, description="The diagrams, each of which is a part of the problem."
    )


#: For every diagram those that look most like it, the most similar first.
_NEIGHBOURS: dict[Backup, tuple[Backup, ...]] = {
    "bellman-v": ("bellman-optimality-v", "bellman-q", "td-zero", "bellman-optimality-q"),
    "bellman-q": ("bellman-optimality-q", "expected-sarsa", "bellman-v", "sarsa"),
    "bellman-optimality-v": ("bellman-v", "bellman-optimality-q", "q-learning", "bellman-q"),
    "bellman-optimality-q": ("bellman-q", "q-learning", "bellman-optimality-v", "expected-sarsa"),
    "td-zero": ("n-step-td", "sarsa", "monte-carlo", "bellman-v"),
    "n-step-td": ("td-zero", "monte-carlo", "sarsa", "bellman-v"),
    "monte-carlo": ("n-step-td", "td-zero", "sarsa", "bellman-v"),
    "sarsa": ("expected-sarsa", "td-zero", "q-learning", "bellman-q"),
    "expected-sarsa": ("q-learning", "sarsa", "bellman-q", "bellman-v"),
    "q-learning": ("expected-sarsa", "bellman-optimality-q", "sarsa", "bellman-optimality-v"),
}


def draw(level: int, rng: Draws) -> Given:
    """One diagram among five; then two among their neighbours; then three among all ten names."""
    shown = rng.sample(BACKUPS, level)
    return Given(diagrams=tuple(_drawn(level, backup, rng) for backup in rng.shuffled(shown)))


def _drawn(level: int, backup: Backup, rng: Draws) -> Shown:
    near = _NEIGHBOURS[backup]
    strangers = [other for other in BACKUPS if other != backup and other not in near[:2]]
    others = {1: rng.sample(strangers, 4), 2: near, 3: [other for other in BACKUPS if other != backup]}[level]
    return Shown(
        shows=backup,
        options=rng.shuffled((backup, *others)),
        branches=2 + rng.below(2),
        steps=2 + rng.below(2),
    )


def question(given: Given) -> Question:
    """The diagrams side by side; each is a part."""
    count = len(given.diagrams)
    drawn = tuple(
        backup_diagram(item.shows, item.branches, item.steps, title=f"Diagram {index}" if count > 1 else "")
        for index, item in enumerate(given.diagrams, 1)
    )
    parts = tuple(
        Part(
            f"Which equation or method does {f'diagram {index + 1}' if count > 1 else 'the diagram'} show?",
            Choice({letter: TITLES[option] for option, letter in item.letters.items()}),
        )
        for index, item in enumerate(given.diagrams)
    )
    ends = any(item.shows == "monte-carlo" for item in given.diagrams)
    return Question((Paragraph(legend(arcs=True, ends=ends)), Beside(drawn)), parts)
