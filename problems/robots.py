"""Robots with their published dynamics, from ``robots.toml``, and dynamics as problems give them."""

import cmath
import tomllib
from collections.abc import Iterable, Iterator, Mapping, Set
from functools import cache
from itertools import zip_longest
from pathlib import Path
from typing import Annotated, Any, ClassVar, Literal, Self, TypeVar

from msgspec import Struct, field
from pydantic import AfterValidator, Field, WithJsonSchema, model_validator

from rldrill.problems import mathematics as maths
from rldrill.problems.angles import Angle, AngleField, degrees, read_angle, turned
from rldrill.problems.angles import text as angle_text
from rldrill.problems.document import Beside, Block, Equation, Paragraph
from rldrill.problems.draws import Draws
from rldrill.problems.exact import Exact, read_fraction
from rldrill.problems.exact import shown as exact_shown
from rldrill.problems.expressions import (
    Expression,
    has_powers,
    letter,
    letters,
    turning,
    worked_out,
    written,
    written_letter,
)
from rldrill.problems.family import Givens
from rldrill.problems.fractions import Fraction, fraction_of
from rldrill.problems.mathematics import Math, mathematics, row, variable
from rldrill.problems.names import once
from rldrill.problems.parts import Number, Numbers, Part
from rldrill.problems.pictures import Arm, Pendulum, Picture

Entry = TypeVar("Entry")
Letter = Annotated[
    str, AfterValidator(letter), WithJsonSchema({"type": "string", "title": "a letter such as θ or x_1"})
]
#: A table with an entry for every letter.
Lettered = Annotated[dict[Letter, Entry], once(letter)]


def _positive(step: Fraction) -> Fraction:
    if step <= 0:
        raise ValueError(f"{step} is not above 0; give one that is")
    return step


Look = Literal["pendulum", "cart-pole", "arm"]
#: The letters whose values a picture shows.
_SEEN: dict[Look, tuple[str, ...]] = {
    "pendulum": ("θ",),
    "cart-pole": ("θ",),
    "arm": ("l_1", "l_2", "θ_1", "θ_2"),
}


def _in_numbers(value: Any, constants: Mapping[str, Any]) -> Any:
    """What an expression in constants is worth; anything else as it is, and powers, whose numbers have no bound."""
    try:
        if not isinstance(value, str) or not letters(value) or has_powers(value):
            return value
        numbers = {letter(name): read_fraction(number) for name, number in constants.items()}
        return str(worked_out(value, numbers, {}, lambda number: number)) if {*letters(value)} <= {*numbers} else value
    except (ValueError, ZeroDivisionError, KeyError):
        return value  # read as it stands, it is refused in a sentence of its own


class System(Givens):
    """Dynamics in letters, their constants, and an operating point.

    Every state's expression in ``dynamics`` is its rate of change; with a ``step`` Δt the system is
    discretised, s + Δt f(s, a), or by a zero-order hold once it is linearised. ``where`` names parts of the
    expressions, each in terms of those before it. ``picture`` draws it at the operating point: a pendulum by its
    angle θ from hanging down, an arm by the angles θ_1 and θ_2 of its links and their lengths l_1 and l_2.
    """

    OWN: ClassVar[str] = "A"  # the matrix

    dynamics: Lettered[Expression] = Field(
        min_length=1, max_length=6, description="For every letter of the state its rate of change."
    )
    where: Lettered[Expression] = Field(
        default_factory=dict,
        max_length=8,
        description="Parts of these expressions by their letters, each in terms of those before it.",
        examples=[{"D": "m_c + m_p sin(θ)^2"}],
    )
    constants: Lettered[Exact] = Field(max_length=20, default_factory=dict, description="The value of every constant.")
    state: Lettered[AngleField] = Field(
        max_length=6, description="The value of every letter of the state at the operating point."
    )
    action: Lettered[AngleField] = Field(
        min_length=1, max_length=4, description="The value of every letter of the action at the operating point."
    )
    step: Annotated[Exact, AfterValidator(_positive)] | None = Field(
        default=None,
        description="The time step in seconds, above 0; without it the system stays continuous.",
        examples=["1/10"],
    )
    discretisation: Literal["euler", "zero-order hold"] = Field(
        default="euler",
        exclude_if=lambda discretisation: discretisation == "euler",
        description="How a step is made: s + Δt f(s, a), or exactly by the linearised rates while the action is held.",
    )
    story: str = Field(default="", max_length=500, pattern=r"^[^\\]*$", description="A sentence that is printed first.")
    picture: Look | None = Field(default=None, description="What is drawn at the operating point.")

    @model_validator(mode="before")
    @classmethod
    def _in_constants(cls, given: Any) -> Any:
        """The operating point in numbers, where it is written with the constants: ``m g/2``."""
        constants = given.get("constants") if isinstance(given, dict) else None
        if not isinstance(constants, dict):
            return given
        points = {name: given[name] for name in ("state", "action") if isinstance(given.get(name), dict)}
        return given | {
            name: {key: _in_numbers(value, constants) for key, value in point.items()} for name, point in points.items()
        }

    @model_validator(mode="after")
    def _closed(self) -> Self:
        if missing := set(self.dynamics) ^ set(self.state):
            raise ValueError(f"state and dynamics must have the same letters; {min(missing)!r} is in one only")
        groups = (self.state, self.action, self.constants, self.where)
        names = [name for group in groups for name in group]
        if doubled := [name for name in names if names.count(name) > 1]:
            raise ValueError(f"the letter {doubled[0]!r} stands for two things; rename one")
        known = {*self.state, *self.action, *self.constants}
        for name, text in (*self.where.items(), *self.dynamics.items()):
            if unknown := [used for used in letters(text) if used not in known]:
                raise ValueError(f"the expression of {name!r} holds {unknown[0]!r}, which has no value; give it one")
            if name in self.where:
                known.add(name)
        angles = {name for text in (*self.where.values(), *self.dynamics.values()) for name in turning(text)}
        for name, value in self.state.items():
            if name in angles:
                turned(value, f"state: of {name}, ")
        if self.held and self.step is None:
            raise ValueError("step is missing: for how long the zero-order hold keeps the action; add it")
        if self.story.count("$") % 2:
            raise ValueError("story: a $ is missing; add it")
        if self.picture and (missing := {*_SEEN[self.picture]} - {*self.state, *self.constants}):
            raise ValueError(f"picture: there is no {min(missing)}, which the picture of {self.picture!r} shows")
        return self

    def own_letters(self) -> Set[str]:
        """The letters that it has for states, actions, constants and parts, besides those left open."""
        named = (*self.state, *self.action, *self.constants, *self.where)
        return super().own_letters() | {name[0] for name in named}

    @property
    def held(self) -> bool:
        """Whether a step is made by a zero-order hold."""
        return self.discretisation != "euler"

    @property
    def states(self) -> tuple[str, ...]:
        """The letters of the state, in the order of the dynamics."""
        return tuple(self.dynamics)


class Robot(Struct, frozen=True):
    """A robot of ``robots.toml``: its dynamics, the values that are drawn, and where it comes from."""

    name: str
    source: str
    story: str
    levels: Mapping[str, tuple[int, ...]]
    dynamics: Mapping[str, str]
    where: Mapping[str, str]
    constants: Mapping[str, tuple[Fraction, ...]]
    state: Mapping[str, tuple[Angle, ...]]
    action: Mapping[str, tuple[Angle, ...]]
    varying: Mapping[str, tuple[tuple[int, int], ...]] = field(default_factory=dict)
    reward: str = ""
    wanted: Mapping[str, str] = field(default_factory=dict)
    picture: Look | None = None


@cache
def robots() -> tuple[Robot, ...]:
    """All robots."""
    with (Path(__file__).parent / "robots.toml").open("rb") as file:
        rows = tomllib.load(file)["robot"]
    return tuple(map(_robot, rows))


def _robot(row_: Mapping[str, Any]) -> Robot:
    return Robot(
        name=row_["name"],
        source=row_["source"],
        story=row_["story"],
        levels={use: tuple(levels) for use, levels in row_["levels"].items()},
        dynamics=row_["dynamics"],
        where=row_.get("where", {}),
        constants={name: tuple(map(fraction_of, texts)) for name, texts in row_["constants"].items()},
        state={name: tuple(map(read_angle, texts)) for name, texts in row_["state"].items()},
        action={name: tuple(map(read_angle, texts)) for name, texts in row_["action"].items()},
        varying={name: tuple(map(tuple, places)) for name, places in row_.get("varying", {}).items()},
        reward=row_.get("reward", ""),
        wanted=row_.get("wanted", {}),
        picture=row_.get("picture"),
    )


@cache
def _fit(use: str, level: int) -> tuple[Robot, ...]:
    return tuple(robot for robot in robots() if level in robot.levels.get(use, ()))


def drawn_robot(rng: Draws, use: str, level: int) -> Robot:
    """A robot for that use and level."""
    return rng.choice(_fit(use, level))


def values_of(rng: Draws, robot: Robot) -> dict[str, Any]:
    """A robot with values for its letters; constants that differ in their index alone, as c₁ and c₂, are not equal."""
    constants = {name: rng.choice(values) for name, values in robot.constants.items()}
    if len({(name.partition("_")[0], value) for name, value in constants.items()}) < len(constants):
        return values_of(rng, robot)
    return {
        **({"reward": robot.reward} if robot.reward else {}),
        "story": robot.story,
        **({"picture": robot.picture} if robot.picture else {}),
        "dynamics": robot.dynamics,
        "where": robot.where,
        "constants": constants,
        **{
            field: {name: rng.choice(values) for name, values in getattr(robot, field).items()}
            for field in ("state", "action")
        },
    }


_FUNCTIONS = {"sin": cmath.sin, "cos": cmath.cos, "tan": cmath.tan, "sqrt": cmath.sqrt, "exp": cmath.exp}


def radians(angle: Angle) -> complex:
    """An angle in floating point."""
    return complex(angle.number) * (cmath.pi if angle.of_pi else 1)


def letter_values(system: Mapping[str, Any]) -> dict[str, complex]:
    """The values of all letters at the operating point, in floating point."""
    angles: dict[str, Angle] = {**system["state"], **system["action"]}
    return {name: complex(value) for name, value in system["constants"].items()} | {
        name: radians(angle) for name, angle in angles.items()
    }


def worth(expression: str, values: Mapping[str, complex]) -> complex:
    """What an expression is worth, in floating point."""
    return complex(worked_out(expression, values, _FUNCTIONS, complex))


def slope(expression: str, name: str, system: Mapping[str, Any]) -> float:
    """The derivative of an expression by one of its letters at the operating point: a step in imaginary direction."""
    values, tiny = letter_values(system), 1e-30
    return worth(expression, values | {name: values[name] + 1j * tiny}).imag / tiny


class Entries(Givens):
    """Which entries of A and of B are asked for, each as its row and column, counted from 1."""

    A: tuple[tuple[int, int], ...] = Field(
        default=(), max_length=36, description="The entries of A.", examples=[[[2, 1]]]
    )
    B: tuple[tuple[int, int], ...] = Field(
        default=(), max_length=36, description="The entries of B.", examples=[[[2, 1]]]
    )

    def check(self, rows: int, columns: int) -> None:
        """Demand that there are some, and that matrices of these sizes have them.

        Raises:
            ValueError: they have not.
        """
        if not self.A and not self.B:
            raise ValueError("entries: name one entry of A or B at least")
        for name, places, width in (("A", self.A, rows), ("B", self.B, columns)):
            if any(not (1 <= row <= rows and 1 <= column <= width) for row, column in places):
                raise ValueError(f"entries: {name} has {rows} rows and {width} columns; name entries that it has")
            if len({*places}) < len(places):
                raise ValueError(f"entries: one of {name} is named twice; name each once")

    def part(self, which: str, head: str) -> list[Part]:
        """The part that asks for those of one matrix; none, if there are none."""
        places = getattr(self, which)
        names = tuple(f"{head}_{{{row} {column}}}" for row, column in places)
        if not names:
            return []
        if len(names) == 1:
            return [Part(f"What is the entry ${names[0]}$, in row ${places[0][0]}$ and column ${places[0][1]}$ of "
                         f"${head}$?", Number())]  # fmt: skip
        return [
            Part(f"What are the entries ${', '.join(names)}$ of ${head}$ (row, column)?", Numbers(names), zero=True)
        ]


def situation(given: System, then: str) -> Iterator[Block]:
    """What the system does: its story, the rates of its state, the values of the letters; and what is said then."""
    yield from _story(given, f"The rates $f(s, a)$ {'and their parts' if given.where else 'of the state'} are:")
    yield from _in_pairs((_rate(name), written(text)) for name, text in given.dynamics.items())
    yield from _in_pairs((written_letter(name), written(text)) for name, text in given.where.items())
    yield Paragraph(f"{_values(given)} {then}")


def plan(given: System, reward: str, then: str) -> Iterator[Block]:
    """The same for a system of which the next state and the reward are given."""
    yield from _story(given, "The next state $f(s, a)$ and the reward $r(s, a)$ are:")
    names = ["f(s, a)"] if len(given.dynamics) == 1 else [f"f_{index}" for index in range(1, len(given.dynamics) + 1)]
    lefts, rights = (*names, "r(s, a)"), (*given.dynamics.values(), reward)
    yield from _in_pairs(zip(map(mathematics, lefts), map(written, rights), strict=True))
    yield Paragraph(f"{_values(given)} {then}")


def _in_pairs(equations: Iterable[tuple[Math, Math]]) -> Iterator[Block]:
    """Equations two and two side by side."""
    blocks = [Equation(left, (right,), ("=",)) for left, right in equations]
    for first, second in zip_longest(blocks[::2], blocks[1::2]):
        yield first if second is None else Beside((first, second))


def _story(given: System, then: str) -> Iterator[Block]:
    if given.story:
        yield Paragraph(given.story)
    yield from _drawn(given)
    states, actions = (column(map(_text, names)) for names in (given.states, tuple(given.action)))
    yield Paragraph(f"State and action are $s = {states}$ and $a = {actions}$. {then}")


def _values(given: System) -> str:
    """The values of the constants, and the operating point."""
    state = column(angle_text(given.state[name]) for name in given.states)
    point = f"he operating point is $s̄ = {state}$, $ā = {column(map(angle_text, given.action.values()))}$."
    if not given.constants:
        return f"T{point}"
    what = "constant is" if len(given.constants) == 1 else "constants are"
    return f"The {what} ${_assignments(given.constants)}$; t{point}"


def discretised(given: System) -> str:
    """The sentence that gives the Euler step, or the zero-order hold."""
    if given.held:
        return (
            "The rates are linearised at the operating point, $f(s, a) ≈ f(s̄, ā) + A (s − s̄) + B (a − ā)$, and time is "
            "discretised by a zero-order hold: the action stays $a_t$ for the time "
            f"$Δ t = {exact_shown(given.step or Fraction(0))}$, and $s_{{t+1}} = F(s_t, a_t)$ is where the linearised "
            "rates have then led from $s_t$."
        )
    return (
        "Time is discretised by an Euler step: $s_{t+1} = F(s_t, a_t) = s_t + Δ t f(s_t, a_t)$ with "
        f"$Δ t = {exact_shown(given.step or Fraction(0))}$."
    )


def _drawn(given: System) -> Iterator[Picture]:
    if given.picture == "arm":
        lengths = (float(given.constants["l_1"]), float(given.constants["l_2"]))
        yield Arm(lengths, (degrees(given.state["θ_1"]), degrees(given.state["θ_2"])))
    elif given.picture:
        yield Pendulum(degrees(given.state["θ"]), cart=given.picture == "cart-pole")


def column(entries: Iterable[str]) -> str:
    """A column of numbers or letters as mathematics, in a line; a single one stands alone."""
    each = tuple(entries)
    return f"({', '.join(each)})^⊤" if len(each) > 1 else each[0]


def _text(name: str) -> str:
    head, _, index = name.partition("_")
    return f"{head}_{index}" if index else head


def _rate(name: str) -> Math:
    return maths.Fraction(row(variable("d"), written_letter(name)), row(variable("d"), variable("t")))


def _assignments(values: Mapping[str, Fraction]) -> str:
    return ", ".join(f"{_text(name)} = {value}" for name, value in values.items())
