"""Questions the other way round: what comes out is given, and the one letter left open is asked for."""

from typing import Self

from pydantic import Field, model_validator

from rldrill.problems.document import joined
from rldrill.problems.exact import Exact, Parameter, shown
from rldrill.problems.family import Givens
from rldrill.problems.parts import Number, Part
from rldrill.problems.phrases import not_known


class Reversible(Givens):
    """Givens in which a letter may be left open; where ``known`` says what comes out, its value is asked for."""

    known: Exact | None = Field(
        default=None,
        description="What comes out (of several things the first), where the parameter left open is asked for instead.",
    )

    @model_validator(mode="after")
    def _one_sought(self) -> Self:
        if self.known is not None and len(self.letters) != 1:
            here = joined(list(self.letters)) if self.letters else "none"
            raise ValueError(f"known: leave exactly one parameter open, which is asked for then; here it is {here}")
        return self

    @property
    def letters(self) -> tuple[str, ...]:
        """The letters left open, whether answers are expressions in them or they are asked for."""
        return self.left_open

    @property
    def letter(self) -> str:
        """The letter that is asked for."""
        return self.letters[0]

    def parameters(self) -> tuple[str, ...]:
        """The letters that an answer may contain: not the one that is asked for."""
        return self.letters if self.known is None else ()


def letter_asked(given: Reversible) -> Part:
    """The part that asks for the value of the letter."""
    return Part(f"What is ${shown(Parameter(given.letter))}$?", Number(), zero=True)


def unknown(given: Reversible, text: str) -> str:
    """A sentence about the letter left open, as it is told where its value is asked for."""
    return text if given.known is None else not_known(text)
