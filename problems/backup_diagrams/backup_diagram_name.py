"""Which equation or method a backup diagram shows, as it is drawn or with something changed in it."""

from collections.abc import Sequence
from typing import Annotated, Self

from pydantic import Discriminator, Field, Tag, model_validator

from rldrill.problems.backups import (
    BACKUPS,
    CHANGED,
    CHANGES,
    DONE,
    TITLES,
    Backup,
    Change,
    backup_diagram,
    legend,
)
from rldrill.problems.document import Beside, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.family import Givens, Question
from rldrill.problems.parts import Choice, Part

TITLE = "Name of a backup diagram"
SOURCE = "Sutton & Barto 2018, sections 3.5, 3.6, 6.1 to 6.6 and 7.1"
REVISION = 5
#: One chooses among the options; and the name must not depend on how many branches or steps are drawn.
DISTRACTORS = (
    "diagrams.*.options.*", "diagrams.*.branches", "diagrams.*.steps", "options.*", "changes.*", "branches", "steps",
)  # fmt: skip
_LETTERS = "ABCDEFGHIJ"


class Drawn(Givens):
    """One diagram, what may be chosen, and how many branches and steps are drawn where there are several."""

    shows: Backup = Field(description="The equation or method that is drawn.")
    options: tuple[Backup, ...] = Field(
        min_length=2, max_length=10, description="What may be chosen; it holds the right one."
    )
    branches: int = Field(default=2, ge=2, le=3, description="How many branches are drawn where there are several.")
    steps: int = Field(default=2, ge=2, le=4, description="How many steps are drawn where there are several.")

    @property
    def named(self) -> Backup:
        """The equation or method that is asked for."""
        return self.shows

    @model_validator(mode="after")
    def _offered(self) -> Self:
        if self.named not in self.options:
            raise ValueError(f"options: {self.named!r}, which is {self._called}, must be among them")
        if len(set(self.options)) < len(self.options):
            raise ValueError("options: one is given twice; give each once")
        return self

    @property
    def _called(self) -> str:
        return "shown"

    @property
    def letters(self) -> dict[Backup, str]:
        """The letter of every option."""
        return dict(zip(self.options, _LETTERS, strict=False))


class Shown(Drawn):
    """One of several diagrams, as it is drawn."""


class Several(Givens):
    """The diagrams, each of which is a part."""

    diagrams: tuple[Shown, ...] = Field(
        min_length=1, max_length=6, description="The diagrams, each of which is a part of the problem."
    )


class Changed(Drawn):
    """A diagram in which something is changed, and what further change makes it the diagram of something else."""

    change: Change = Field(description="What is changed first; what the diagram then shows is asked for.")
    target: Backup = Field(description="The equation or method whose diagram a further change makes of it.")
    changes: tuple[Change, ...] = Field(
        min_length=2, max_length=10, description="The further changes that may be chosen; one of them is right."
    )

    @property
    def named(self) -> Backup:
        """What the diagram shows after the first change."""
        return CHANGED[self.shows][self.change]

    @property
    def _called(self) -> str:
        return "shown after the change"

    @model_validator(mode="before")
    @classmethod
    def _named(cls, given: object) -> object:
        if isinstance(given, dict):
            shows, change = given.get("shows"), given.get("change")
            told = isinstance(shows, str) and isinstance(change, str)
            if told and shows in CHANGED and change in CHANGES and change not in CHANGED[shows]:
                possible = " or ".join(map(repr, CHANGED[shows]))
                raise ValueError(f"change: {change!r} makes no diagram that has a name of {shows!r}; take {possible}")
        return given

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        if len(set(self.changes)) < len(self.changes):
            raise ValueError("changes: one is given twice; give each once")
        if len(self.right_changes) != 1:
            raise ValueError(f"changes: one of them, and no more, must make {self.target!r} of {self.named!r}")
        return self

    @property
    def right_changes(self) -> tuple[Change, ...]:
        """The further changes that lead to the target, of which there is one."""
        further = CHANGED[self.named]
        return tuple(change for change in self.changes if further.get(change) == self.target)

    @property
    def letters_of_changes(self) -> dict[Change, str]:
        """The letter of every further change."""
        return dict(zip(self.changes, _LETTERS, strict=False))


def _kind(given: object) -> str:
    return "changed" if isinstance(given, dict) and "change" in given else "several"


Given = Annotated[Annotated[Several, Tag("several")] | Annotated[Changed, Tag("changed")], Discriminator(_kind)]


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


def draw(level: int, rng: Draws) -> Several | Changed:
    """One diagram among five; then two among their neighbours; then one in which something is changed."""
    if level == 3:
        return _draw_changed(rng)
    shown = rng.sample(BACKUPS, level)
    return Several(diagrams=tuple(_drawn(level, backup, rng) for backup in rng.shuffled(shown)))


def _drawn(level: int, backup: Backup, rng: Draws) -> Shown:
    near = _NEIGHBOURS[backup]
    strangers = [other for other in BACKUPS if other != backup and other not in near[:2]]
    others = near if level == 2 else rng.sample(strangers, 4)
    return Shown(shows=backup, options=rng.shuffled((backup, *others)), **_sizes(rng))


def _sizes(rng: Draws) -> dict[str, int]:
    return {"branches": 2 + rng.below(2), "steps": 2 + rng.below(2)}


def _draw_changed(rng: Draws) -> Changed:
    """Two changes one after the other that lead to a third diagram."""
    shows = rng.choice(BACKUPS)
    change, further = rng.choice(_ways(shows))
    named = CHANGED[shows][change]
    target = CHANGED[named][further]
    near = [other for other in dict.fromkeys((*_NEIGHBOURS[named], *BACKUPS)) if other not in (named, shows, target)]
    return Changed(
        shows=shows,
        change=change,
        options=rng.shuffled((named, shows, *near[:3])),
        target=target,
        changes=rng.shuffled((further, *_wrong(named, target, rng, change))),
        **_sizes(rng),
    )


def _ways(shows: Backup) -> Sequence[tuple[Change, Change]]:
    return [
        (change, further)
        for change, named in _plain(shows).items()
        for further, target in _plain(named).items()
        if target != shows
    ]


def _plain(shows: Backup) -> dict[Change, Backup]:
    """The changes that are told in one way only: not that all is drawn where some of it is, nor what was sampled."""
    row = CHANGED[shows]
    if "no-arc" in row or "one-action" in row:  # no action was sampled at an arc, and only one at a mean
        return {change: named for change, named in row.items() if change not in ("sampled", "everything")}
    return row


def _wrong(named: Backup, target: Backup, rng: Draws, done: Change) -> tuple[Change, ...]:
    """Four changes that lead elsewhere, first those that lead to another diagram with a name; none that is done."""
    elsewhere = [change for change, then in CHANGED[named].items() if then != target and change != done][:2]
    others = [change for change in CHANGES if change not in CHANGED[named] and change != done]
    return (*elsewhere, *rng.sample(others, 4 - len(elsewhere)))


def question(given: Several | Changed) -> Question:
    """The diagrams side by side, each a part; or the one that is changed."""
    return _of_several(given) if isinstance(given, Several) else _of_changed(given)


def _of_changed(given: Changed) -> Question:
    drawn = backup_diagram(given.shows, given.branches, given.steps)
    return Question(
        (Paragraph(legend(arcs=True, ends=True)), drawn),
        (
            Part(
                f"Something is changed in the diagram: {DONE[given.change]}. Which equation or method does it show "
                "then?",
                Choice({letter: TITLES[option] for option, letter in given.letters.items()}),
            ),
            Part(
                f"Which further change makes it the diagram of {TITLES[given.target]}?",
                Choice({letter: DONE[change] for change, letter in given.letters_of_changes.items()}),
            ),
        ),
    )


def _of_several(given: Several) -> Question:
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
    return Question((Paragraph(legend(arcs=True, ends=True)), Beside(drawn)), parts)
