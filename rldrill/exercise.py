"""The library: a problem with its solution, drawn or brought, that can be shown, solved and checked."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from rldrill.problem_file import FORMAT, read_problem
from rldrill.problems.catalogue import family as family_of
from rldrill.problems.document import Block, Document, Equation, Heading, Paragraph
from rldrill.problems.errors import FileError, UsageError
from rldrill.problems.family import Problem
from rldrill.problems.identity import looks_like_id
from rldrill.problems.parts import Choice, Part
from rldrill.render.mathematics.unicode import unicode
from rldrill.render.unicode import unicode_text
from rldrill.solutions import drawing
from rldrill.solutions.answers.judging import Verdict, judge
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.exact import NoSolution
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.solution import Solution
from rldrill.solutions.solution import solve as solve_problem
from rldrill.solutions.work import Drawn, Note, Recalled, Result, Step


@dataclass(frozen=True)
class Exercise:
    """A problem together with its solution."""

    solution: Solution

    @property
    def problem(self) -> Problem:
        """The problem: its family and what is given."""
        return self.solution.problem

    @property
    def id(self) -> str | None:
        """The problem's ID; None for a problem from outside."""
        return None if self.problem.identity is None else str(self.problem.identity)

    @property
    def parts(self) -> tuple[Part, ...]:
        """What is asked."""
        return self.problem.parts

    def solve(self) -> Mapping[str, Any]:
        """The exact answer of every part: sympy and flint numbers, in tuples and dictionaries."""
        return self.solution.answers

    def check(self, text: str, part: str = "a", earlier: Mapping[str, Any] | None = None) -> Verdict:
        """Judge a typed answer.

        Args:
            text: what was typed, such as ``3/4`` or ``cool: 7/2, warm: 2.5``.
            part: the part that it answers.
            earlier: ``Verdict.value`` of the answers to earlier parts, for follow-through.

        Raises:
            UsageError: the problem has no such part.
        """
        if part not in {known.label for known in self.parts}:
            labels = ", ".join(known.label for known in self.parts)
            raise UsageError(f"There is no part {part[:20]!r}; this problem has {labels}.")
        return judge(self.solution, part, text, earlier)

    def question(self) -> Document:
        """What is printed before the parts."""
        return self.problem.question.blocks

    def working(self, part: str | None = None) -> Document:
        """The working as a page, whole or of one part."""
        if part is None and len(self.parts) > 1:
            return tuple(
                block for each in self.parts for block in (Heading(f"({each.label})"), *self.working(each.label))
            )
        blocks: list[Block] = []
        for line in self.solution.lines if part is None else self.solution.lines_of(part):
            if isinstance(line, Step | Recalled):
                blocks.append(line.equation())
            elif isinstance(line, Note):
                blocks.append(Paragraph(line.text))
            elif isinstance(line, Drawn):
                blocks.append(line.picture)
            elif isinstance(line, Result):
                blocks.extend(line.equations())
        return tuple(blocks)

    def answer(self, part: Part) -> Equation | Paragraph:
        """The exact answer of a part, typeset, as a block; a table has a line for each of its keys."""
        return answer_kind(part.kind).block(self.solution.answers[part.label])

    def formulas(self, part: str | None = None) -> tuple[Formula, ...]:
        """The formulas of the sheet that the working uses; their equations and hints are the hint."""
        return self.solution.formulas(part)

    def hint(self, part: str | None = None) -> Document:
        """The formulas that are needed, and a sentence on each; two sentences where none is."""
        formulas = self.formulas(part)
        if not formulas:
            return (
                Paragraph("No formula is needed here: go by what is given."),
                Paragraph("Rule out one answer after the other."),
            )
        return tuple(block for formula in formulas for block in (formula.equation(), Paragraph(formula.hint)))

    def data(self, *, answers: bool = True) -> dict[str, Any]:
        """The problem as JSON has it; with ``answers`` also the exact answers and the steps."""
        result: dict[str, Any] = {"format": FORMAT, "id": self.id, **self.problem.data()}
        result["level"] = self.problem.level
        result["question"] = [unicode_text(block) for block in self.question()]
        result["parts"] = []
        for part in self.parts:
            entry: dict[str, Any] = {"part": part.label, "ask": unicode_text(Paragraph(part.ask))}
            entry |= {"kind": part.kind.name, "points": part.points}
            if isinstance(part.kind, Choice):
                entry["options"] = {letter: unicode_text(Paragraph(text)) for letter, text in part.kind.options.items()}
            if answers:
                kind, value = answer_kind(part.kind), self.solution.answers[part.label]
                entry["answer"] = {"exact": kind.data(value), "decimal": kind.decimals(value)}
            result["parts"].append(entry)
        if answers:
            result["steps"] = [
                {
                    "formula": line.formula.key,
                    "quantity": unicode(line.equation().left),
                    "put_in": unicode(line.equation().rights[0]),
                    "value": unicode(line.equation().rights[-1]),
                }
                for line in self.solution.lines
                if isinstance(line, Step)
            ]
        return result


def draw(family: str, level: int = 1, seed: int = 0) -> Exercise:
    """Draw a problem; the same arguments give the same problem, to the letter, everywhere.

    Raises:
        UsageError: there is no such family or level.
    """
    return Exercise(drawing.draw(family, level, seed))


def load(id_or_path: str | Path) -> Exercise:
    """The problem with that ID, or in that problem file (TOML or JSON).

    Raises:
        UsageError: it is neither an ID nor a file.
        FileError: the file is unreadable or inconsistent.
    """
    text = str(id_or_path)
    if looks_like_id(text):
        return Exercise(drawing.by_id(text))
    if Path(text).suffix.lower() not in (".toml", ".json"):
        raise UsageError(
            f"{text[:60]!r} is neither a problem ID (such as value-iteration/2/7) nor a problem file (.toml or .json)."
        )
    return read(read_problem(Path(id_or_path)), where=text)


def read(data: object, where: str = "the problem") -> Exercise:
    """A problem from data in the form of a problem file.

    Raises:
        FileError: the data does not fit, or the problem has no answer.
    """
    if not isinstance(data, dict) or not isinstance(data.get("family"), str) or "given" not in data:
        raise FileError(f"{where}: a problem file needs 'family' and '[given]'; 'rldrill show ID --json' writes one.")
    family = family_of(data["family"])
    try:
        problem = Problem(family, family.read(data["given"]))
        return Exercise(solve_problem(problem))
    except FileError as error:
        raise FileError(f"{where}: {error}") from None
    except NoSolution as error:
        raise FileError(f"{where}: this problem has no answer: {error}.") from None
