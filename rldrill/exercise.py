"""The library: a problem with its solution, drawn or of your own, that can be shown, solved, checked and graded."""

import reprlib
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from fractions import Fraction
from functools import cached_property, lru_cache
from numbers import Integral
from pathlib import Path
from typing import TYPE_CHECKING, Any

from msgspec import Struct
from msgspec.structs import replace

from rldrill.files import DATA_SUFFIXES, MODEL_SUFFIXES
from rldrill.graded import Graded, grade
from rldrill.problem_file import FORMAT, read_problem
from rldrill.problems.catalogue import family as family_of
from rldrill.problems.document import Block, Equation, Heading, Paragraph
from rldrill.problems.errors import FileError, UsageError
from rldrill.problems.family import Problem
from rldrill.problems.identity import looks_like_id
from rldrill.problems.notations import Writing, in_use
from rldrill.problems.parts import Choice, Kind, Part, Policy, YesNo
from rldrill.render.markdown import markdown, markdown_text
from rldrill.render.mathematics.unicode import inline, unicode
from rldrill.render.page import Page
from rldrill.render.sentences import in_letters
from rldrill.render.unicode import unicode_text
from rldrill.solutions import drawing
from rldrill.solutions.abridging import abridged
from rldrill.solutions.answers.judging import Outcome, Verdict, judge
from rldrill.solutions.answers.key import answer_block
from rldrill.solutions.answers.kinds import answer_kind
from rldrill.solutions.effort import points, seconds_of
from rldrill.solutions.exact import NoSolution, NotSolved, TooLong
from rldrill.solutions.formula.formula import Formula
from rldrill.solutions.formula.typesetting import typeset
from rldrill.solutions.matrices import is_matrix, matrix
from rldrill.solutions.solution import Solution
from rldrill.solutions.solution import solve as solve_problem
from rldrill.solutions.work import Drawn, Elimination, Equality, Line, Note, Recalled, Result, Step
from rldrill.typed import typed

if TYPE_CHECKING:
    from rldrill.diagnosis import Diagnosing, Diagnosis, Followed


#: Lines in which an equation is solved further.
_SOLVED_FURTHER = (Result, Elimination, Equality)


class Exercise(Struct, frozen=True, eq=False, dict=True):
    """A problem together with its solution.

    What is a page (``question``, ``hint``, ``working``) is readable text as ``str``, and Markdown in a notebook.
    ``notes`` say what was read otherwise than it is written in the file, such as 0.3333333333333333 as 1/3.
    ``worth`` has the points of every part where an exam sets them; else they follow the minutes.
    """

    solution: Solution
    notes: tuple[str, ...] = ()
    worth: Mapping[str, int] | None = None

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
        """What is asked, with its points."""
        spared = self.problem.keeps_letters
        if spared not in self._parts:
            worth = self.worth or points(self.solution)
            self._parts[spared] = tuple(replace(part, points=worth[part.label]) for part in self.problem.parts)
        return self._parts[spared]

    @cached_property
    def _parts(self) -> dict[bool, tuple[Part, ...]]:
        """The parts as the notation in use writes them, and as they are kept from it."""
        return {}

    def __eq__(self, other: object) -> bool:
        """Whether the problem is the same, and what its parts are worth; its solution follows from it."""
        if not isinstance(other, Exercise):
            return NotImplemented
        return (self.problem, self.notes, self.worth) == (other.problem, other.notes, other.worth)

    def __ne__(self, other: object) -> bool:  # a Struct has one of its own, which knows nothing of ours
        return not self == other

    def __hash__(self) -> int:
        return hash((self.id, self.problem.family.name, tuple(part.label for part in self.problem.parts)))

    def __reduce__(self) -> tuple[Any, ...]:
        """In another process the problem is solved again."""
        return _again, (self.id, None if self.id else self.problem.data(), self.notes, self.worth)

    def __repr__(self) -> str:
        name = self.id or f"of the family {self.problem.family.name}"
        return f"<Exercise {name}: {', '.join(f'({part.label})' for part in self.parts)}>"

    def _repr_markdown_(self) -> str:
        asked = [Paragraph(text) for part in self.parts for text in _asked(part)]
        return markdown((Heading(self.problem.family.title), *self.question(), *asked))

    def solve(self) -> Mapping[str, Any]:
        """The exact answer of every part, to calculate with: flint and sympy numbers, in tuples and dictionaries.

        With an open letter it is a rational function of rldrill's, which ``sympy.sympify`` takes. ``check`` and
        ``grade`` take all of them as they are.
        """
        return {label: _copied(answer) for label, answer in self.solution.answers.items()}

    def answers(self) -> dict[str, Any]:
        """The exact answer of every part, to read: fractions, and text where a number is not rational.

        A table is a dictionary, a vector a tuple, a matrix a tuple of its rows; a policy holds the best action of
        every state, or a tuple of those that are equally good. ``check`` and ``grade`` take them as they are.
        """
        return {part.label: _readable(part.kind, self.solution.answers[part.label]) for part in self.parts}

    def check(self, answer: object, part: str = "a") -> Verdict:
        """Judge an answer to one part, for itself.

        Args:
            answer: what was typed, such as ``3/4`` or ``cool: 7/2, warm: 2.5``; or a number, a list or a table.
            part: the part that it answers.

        Raises:
            UsageError: the problem has no such part, or the answer is nothing that could be typed.
        """
        label = self._part(part).label
        if answer is None:
            raise UsageError("The answer is missing; give a text or a number.")
        text = typed(answer, "The answer")
        return self.diagnosing.unmasked(label, text, self._said(judge(self.solution, label, text)))

    def grade(self, answers: Mapping[str, object]) -> Graded:
        """Judge a whole submission; a later part is also judged with the person's own answers to earlier parts.

        Args:
            answers: for the labels of parts what was typed, or numbers, lists and tables; blank is missing.

        Raises:
            UsageError: the problem has no such part, or an answer is nothing that could be typed.
        """
        if not isinstance(answers, Mapping):
            raise _refused("answers", "a dictionary such as {'a': '3/4'}", answers)
        texts = {
            self._part(label).label: typed(answer, f"The answer to ({label})") for label, answer in answers.items()
        }
        graded = grade(self.solution, texts, self.worth)
        verdicts = {part.part: part.verdict and self._said(part.verdict) for part in graded.parts}
        return Graded(
            tuple(
                part if part.verdict is None else replace(part, verdict=self.unmasked(part.part, part.typed, verdicts))
                for part in graded.parts
            )
        )

    def _said(self, verdict: Verdict) -> Verdict:
        """A verdict; what is said of a typical mistake names quantities as the notation in use writes them."""
        if not verdict.told:
            return verdict
        return replace(verdict, says=self.problem.written(lambda: in_letters(verdict.says)))

    def unmasked(self, label: str, text: str, verdicts: Mapping[str, Verdict | None]) -> Verdict:
        """The verdict on a part, among those on others: what is close to the key by accident is wrong.

        Raises:
            KeyError: it was not judged.
        """
        verdict = verdicts[label]
        if verdict is None:
            raise KeyError(label)
        return self.diagnosing.unmasked(label, text, verdict, self._settled(label, verdicts))

    @cached_property
    def diagnosing(self) -> "Diagnosing":
        """What diagnoses the wrong answers; it keeps what it finds out."""
        from rldrill.diagnosis import Diagnosing

        return Diagnosing(self.solution)

    def diagnose(
        self,
        answer: object,
        part: str = "a",
        earlier: Mapping[str, object] | None = None,
        seconds: float | None = None,
    ) -> "Diagnosis":
        """What a wrong answer comes from: a typical mistake, or one thing changed in the working.

        Args:
            answer: what was typed.
            part: the part that it answers.
            earlier: what was answered to earlier parts, for somebody who went on from there.
            seconds: the time to search; without end if None.

        Raises:
            UsageError: the problem has no such part, or an answer is nothing that could be typed.
        """
        label = self._part(part).label
        if not isinstance(earlier, Mapping | None):
            raise _refused("earlier", "a dictionary such as {'a': '3/4'}", earlier)
        verdicts = {each.part: each.verdict for each in self.grade({**(earlier or {}), label: answer}).parts}
        if (verdict := verdicts[label]) is None:
            raise UsageError("The answer is missing; give a text or a number.")
        return self.diagnosed(label, typed(answer, "The answer"), verdict, verdicts, seconds)

    def diagnosed(
        self,
        label: str,
        text: str,
        verdict: Verdict,
        verdicts: Mapping[str, Verdict | None],
        seconds: float | None = None,
    ) -> "Diagnosis":
        """What a wrong answer comes from that was judged already, as the earlier ones were."""
        before = {
            other: judged.value
            for other, judged in verdicts.items()
            if judged is not None and judged.value is not None and other < label and not judged.accepted
        }
        return self.diagnosing.diagnose(label, text, verdict, before, seconds, self._settled(label, verdicts))

    def _settled(self, label: str, verdicts: Mapping[str, Verdict | None]) -> dict[str, Any]:
        """The right answers to the parts before, as far as they were given."""
        return {
            other: self.solution.answers[other]
            for other, judged in verdicts.items()
            if judged is not None and judged.outcome is Outcome.RIGHT and other < label
        }

    def follow(self, lines: Iterable[str] | str) -> "Followed":
        """Somebody's own working held against the right one: where it departs, and what follows from there.

        Args:
            lines: as a person writes them, such as ``V1 = 8 + 1/2*4 = 10`` or a bare number; steps may be left out.
        """
        from rldrill.diagnosis import followed

        if not isinstance(lines, Iterable):
            raise UsageError("The working is no text and no list of lines; give one of these.")
        texts = lines.splitlines() if isinstance(lines, str) else [str(line) for line in lines]
        told = self.problem.written(lambda: followed(self.diagnosing.search({}), texts))
        typed = filter(None, map(str.strip, texts))  # the notation is that of what is said, not of what was typed
        return replace(told, lines=tuple(map(lambda line, text: replace(line, text=text), told.lines, typed)))

    def _part(self, label: str) -> Part:
        for part in self.parts:
            if part.label == label:
                return part
        known = ", ".join(part.label for part in self.parts)
        raise UsageError(f"There is no part {str(label)[:20]!r}; this problem has {known}.")

    def question(self) -> Page:
        """What is printed before the parts."""
        return Page(self.problem.question.blocks)

    def working(self, part: str | None = None) -> Page:
        """The working, whole or of one part.

        Raises:
            UsageError: the problem has no such part.
        """
        if part is None and len(self.parts) > 1:
            return Page(
                block for each in self.parts for block in (Heading(f"({each.label})"), *self.working(each.label))
            )
        lines = self.solution.lines if part is None else self.solution.lines_of(self._part(part).label)
        return Page(self._made(_written(abridged(lines), set())))

    def _made(self, blocks: Iterable[Block]) -> tuple[Block, ...]:
        """Blocks that are made now, in the notation that the problem is written in."""
        return self.problem.written(lambda: tuple(blocks))

    def scheme(self, part: str) -> tuple[tuple[tuple[Block, ...], int], ...]:
        """The working of a part in pieces, each with the points that are earned when it is reached.

        The points follow the time that the steps take; an equation that is solved earns them with its last line.

        Raises:
            UsageError: the problem has no such part.
        """
        worth = self._part(part).points
        lines = abridged(self.solution.lines_of(part))
        times = [_seconds(lines, index) for index in range(len(lines))]
        whole, spent, earned = sum(times), Fraction(0), 0
        stated: set[Formula] = set()
        result: list[tuple[tuple[Block, ...], int]] = []
        waiting: tuple[Block, ...] = ()
        for index, time in enumerate(times):
            waiting += self._made(_written([lines[index]], stated))
            spent += time
            reached = int(worth * spent / whole) if whole else 0
            if reached > earned and not isinstance(next(iter(lines[index + 1 :]), None), _SOLVED_FURTHER):
                result.append((waiting, reached - earned))
                earned, waiting = reached, ()
        if result and earned == worth and all(isinstance(block, Paragraph) for block in waiting):
            blocks, points = result.pop()
            return (*result, (blocks + waiting, points))  # the conclusion from the last step earns its points
        return (*result, (waiting, worth - earned)) if waiting else tuple(result)

    def answer(self, part: Part) -> Equation:
        """The answer of a part, exact and as a decimal, as a block; a table has a line for each of its keys."""
        return answer_block(part, self.solution.answers[part.label])

    def formulas(self, part: str | None = None) -> tuple[Formula, ...]:
        """The formulas of the sheet that the working uses; their equations and hints are the hint.

        Raises:
            UsageError: the problem has no such part.
        """
        return self.solution.formulas(None if part is None else self._part(part).label)

    def hint(self, part: str | None = None) -> Page:
        """The formulas that are needed, and a sentence on each; two sentences where none is.

        Raises:
            UsageError: the problem has no such part.
        """
        formulas = self.formulas(part)
        if not formulas:
            return Page(
                (
                    Paragraph("No formula is needed here: go by what is given."),
                    Paragraph("Rule out one answer after the other."),
                )
            )
        said = ((formula.equation(), Paragraph(in_letters(formula.hint))) for formula in formulas)
        return Page(self._made(block for blocks in said for block in blocks))

    def data(self, *, answers: bool = True, mistakes: int = 0, latex: bool = False) -> dict[str, Any]:
        """The problem as JSON has it.

        Args:
            answers: with the exact answers and the steps.
            mistakes: with so many wrong answers to every part, each with what it comes from.
            latex: the question, and what is asked, as Markdown with LaTeX.
        """
        if _whole("mistakes", mistakes) < 0:
            raise _refused("mistakes", "0 or more", mistakes)
        result: dict[str, Any] = {"format": FORMAT, "id": self.id, **self.problem.data()}
        result["level"] = self.problem.level
        result["question"] = markdown(self.question()) if latex else [unicode_text(block) for block in self.question()]
        result["parts"] = []
        for part in self.parts:
            entry: dict[str, Any] = {"part": part.label, "ask": (markdown_text if latex else inline)(part.ask)}
            entry |= {"kind": part.kind.name, "points": part.points}
            if isinstance(part.kind, Choice):
                entry["options"] = {letter: inline(text) for letter, text in part.kind.options.items()}
            if answers:
                kind, value = answer_kind(part.kind), self.solution.answers[part.label]
                entry["answer"] = {"exact": kind.data(value), "decimal": kind.decimals(value)}
            if mistakes:
                wrong = self.diagnosing.wrong_answers(part.label, mistakes)
                entry["mistakes"] = [
                    {"answer": each.answer, "kind": each.kind, "sentence": each.sentence} for each in wrong
                ]
            result["parts"].append(entry)
        if answers:
            steps = [line for line in abridged(self.solution.lines) if isinstance(line, Step)]
            result["steps"] = self.problem.written(lambda: [_step(step) for step in steps])
        return result


def _copied(answer: Any) -> Any:
    """An answer that may be changed: a table or a matrix of its own."""
    if isinstance(answer, dict):
        return dict(answer)
    return matrix(answer.tolist()) if is_matrix(answer) else answer


def _seconds(lines: Sequence[Line], index: int) -> Fraction:
    """The time that a line takes, which for the solution of equations depends on those before."""
    if isinstance(lines[index], _SOLVED_FURTHER):
        return seconds_of(lines[: index + 1]) - seconds_of(lines[:index])
    return seconds_of([lines[index]])


def _written(lines: Iterable[Line], stated: set[Formula]) -> Iterator[Block]:
    """A working as blocks; each formula that is not stated yet stands there as it is before its first step."""
    for line in lines:
        if isinstance(line, Step) and line.formula not in stated:
            stated.add(line.formula)
            general, here = line.general(), line.equation()
            # Where nothing is put in, the step says it; where both sides are the same, the formula says nothing.
            if general.rights[0] not in (*here.rights, general.left):
                yield general
            yield here
        elif isinstance(line, Step | Equality):
            yield line.equation()
        elif isinstance(line, Recalled):
            stated.add(line.formula)
            yield line.equation()
        elif isinstance(line, Note):
            yield Paragraph(line.text)
        elif isinstance(line, Drawn):
            yield from line.pictures()
        elif isinstance(line, Result):
            yield from line.equations()
        elif isinstance(line, Elimination):
            yield from _written(line.lines(), set())


@lru_cache(maxsize=1024)
def _general(formula: Formula, _: Writing) -> str:
    """A formula as it is computed with, in the notation in use; the same ones are written again and again."""
    return unicode_text(formula.equation(formula.right))


def _step(step: Step) -> dict[str, str]:
    equation = step.equation()
    return {
        "formula": step.formula.key,
        "general": _general(step.formula, in_use()),
        "quantity": unicode(typeset(step.left)),
        "put_in": unicode(equation.rights[0]),
        "value": unicode(equation.rights[-1]),
    }


def _asked(part: Part) -> Iterator[str]:
    """The lines that ask for a part: the sentence, then what there is to choose from."""
    yield f"({part.label}) {part.ask}"
    if isinstance(part.kind, Choice):
        yield from (f"({letter}) {option}" for letter, option in part.kind.options.items())


def _readable(kind: Kind, value: Any) -> Any:
    data = answer_kind(kind).data(value)
    return _map(data, str if isinstance(kind, Policy | Choice | YesNo) else _number)


def _map(data: Any, write: Callable[[str], Any]) -> Any:
    if isinstance(data, dict):
        return {key: _map(item, write) for key, item in data.items()}
    return tuple(_map(item, write) for item in data) if isinstance(data, list) else write(data)


def _again(identity: str | None, data: object, notes: tuple[str, ...], worth: Mapping[str, int] | None) -> Exercise:
    """The exercise that was put away."""
    exercise = read(data) if identity is None else load(identity)
    return replace(exercise, notes=notes, worth=worth)


def _number(text: str) -> Fraction | str:
    try:
        return Fraction(text)
    except ValueError:
        return text


def draw(family: str, level: int = 1, seed: int = 0) -> Exercise:
    """Draw a problem; the same arguments give the same problem, to the letter, everywhere.

    Raises:
        UsageError: there is no such family or level, or the seed is no whole number in range.
    """
    if not isinstance(family, str):
        raise _refused("family", "the name of a family such as 'td-zero'", family)
    if looks_like_id(family):
        raise UsageError(f"{family!r} is the ID of a problem, no family; rldrill.load({family!r}) gives that problem.")
    return Exercise(drawing.draw(family, _whole("level", level), _whole("seed", seed)))


def load(id_or_path: str | Path) -> Exercise:
    """The problem with that ID, or in that problem file (TOML or JSON).

    Raises:
        UsageError: it is neither an ID nor a file.
        FileError: the file is unreadable or inconsistent.
    """
    if not isinstance(id_or_path, str | Path):
        raise _refused("id_or_path", "a problem ID such as 'td-zero/2/7' or the path of a problem file", id_or_path)
    text = str(id_or_path)
    if looks_like_id(text):
        return Exercise(drawing.by_id(text))
    if (suffix := Path(text).suffix.lower()) in set(MODEL_SUFFIXES) - set(DATA_SUFFIXES):
        raise UsageError(
            f"{text[:60]!r} is no problem file; if it holds a model, write one beside it, with "
            f'family = "optimal-value", given.gamma, and given.mdp.file = "{Path(text).name[:40]}".'
        )
    if suffix not in DATA_SUFFIXES:
        raise UsageError(
            f"{text[:60]!r} is neither a problem ID (such as value-iteration/2/7) nor a problem file (.toml or .json)."
        )
    return read(read_problem(Path(id_or_path)), where=text)


def read(data: object, where: str = "the problem") -> Exercise:
    """A problem from data in the form of a problem file.

    Raises:
        FileError: the data does not fit, or the problem has no answer.
    """
    missing = [name for name in ("family", "given") if not isinstance(data, dict) or name not in data]
    if missing or not isinstance(data, dict):
        raise FileError(
            f"{where}: {missing[0]!r} is missing; a problem needs 'family' and 'given', as 'rldrill show ID --json' "
            "and Exercise.data() write them."
        )
    if not isinstance(data["family"], str):
        raise FileError(f"{where}: 'family' must be the name of a family in quotes, such as 'td-zero'.")
    family = family_of(data["family"])
    notes: list[str] = []
    try:
        problem = Problem(family, family.read(data["given"], notes.append))
        return Exercise(solve_problem(problem), tuple(dict.fromkeys(notes)))
    except FileError as error:
        raise FileError(f"{where}: {error}") from None
    except (TooLong, NotSolved) as error:
        raise FileError(f"{where}: {error}.") from None
    except NoSolution as error:
        raise FileError(f"{where}: this problem has no answer: {error}.") from None


def _whole(name: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, Integral):
        raise _refused(name, "a whole number", value)
    return int(value)


def _refused(name: str, wanted: str, value: object) -> UsageError:
    return UsageError(f"{name} must be {wanted}, not {' '.join(reprlib.repr(value).split())}.")
