"""The problems as a dataset of reasoning-gym, for training and evaluating language models.

``reasoning_gym.create_dataset("rldrill", …)`` finds it once this module has been imported.
"""

import re
from collections.abc import Collection, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

from reasoning_gym.factory import ProceduralDataset, register_dataset

from rldrill.exercise import Exercise, draw, load
from rldrill.generation.lots import Split, lots
from rldrill.problems.errors import UsageError
from rldrill.problems.parts import Part
from rldrill.solutions.answers.kinds import answer_kind

_ANSWERS = "Answer every part on a line of its own, such as (a) 3/4, exactly or with three significant digits."
_BLANK = r"[^\S\n]"
#: "(a)" or "Part a:", perhaps in a list, a table, a heading or bold, behind "the answer is", or in the tags that models
#: put around an answer; "a." and "A)" are perhaps one, for lists begin so as well, and "A." is none.
_LABEL = re.compile(
    rf"(?:{_BLANK}|[>#|*`•-])*+(?:\d+[.)](?:{_BLANK}|\*)*+)?+(?:<(?i:answer)>{_BLANK}*+)?+"
    rf"(?i:(?:the{_BLANK}++)?+(?:final{_BLANK}++)?+answer(?:{_BLANK}++is)?+{_BLANK}*+:?+(?:\*\*)?+{_BLANK}*+)?+"
    rf"(?:(?:(?i:part){_BLANK}++)?+\((?P<sure>[a-zA-Z])\)|(?i:part){_BLANK}++(?P<part>[a-zA-Z])(?=[:.)*|]|{_BLANK}*+$)"
    rf"|(?P<perhaps>[a-z](?=[:.)]|{_BLANK}*+\|)|[A-Z](?=\))))[:.)]*+(?:\*\*)?+:?+"
)
_NEXT = re.compile(rf"(?:[,;]{_BLANK}*+(?:and{_BLANK}++)?+|(?<!\s){_BLANK}++and{_BLANK}++)(?=(?:\*\*)?\([a-zA-Z]\))")
#: What is set around an answer.
_AROUND = re.compile(r"\A(?:\*\*|[`|\s])++|(?<![\s`|*])(?:\*\*|[`|\s]|</answer>)++\.?\Z")
_BOXED = re.compile(r"\\boxed\s*\{((?:[^{}]|\{[^{}]*\})*)\}")


@dataclass
class Config:
    """What the dataset draws.

    Args:
        names: topics and families; all, if there are none.
        level: 1 to 3, or None for all.
        split: ``train`` or ``held-out``; no problem is in both, and quizzes draw none of either.
        seed: what the problems depend on.
        size: how many there are.
    """

    names: Sequence[str] = ()
    level: int | None = None
    split: str = "train"
    seed: int | None = None
    size: int = 500

    def validate(self) -> None:
        """Refuse names and levels that do not exist.

        Raises:
            AssertionError: they do not; reasoning-gym expects this class.
        """
        assert self.split in [split.value for split in Split], f"split: {self.split!r} is neither train nor held-out"
        self.names = (self.names,) if isinstance(self.names, str) else self.names
        try:
            lots(self.names, self.level, 1, 0)
        except UsageError as error:
            raise AssertionError(str(error)) from None


class Dataset(ProceduralDataset):  # type: ignore[misc, unused-ignore]
    """Problems with their exact answers; an answer earns its share of the points, as in the quiz."""

    def __init__(self, config: Config) -> None:
        super().__init__(config=config, seed=config.seed, size=config.size)
        self._lots = lots(config.names, config.level, config.size, self.seed, Split(config.split))

    def __getitem__(self, idx: int) -> dict[str, Any]:
        """The problem with that index: families and levels take turns.

        Raises:
            IndexError: there are fewer.
        """
        if not 0 <= idx < self.size:
            raise IndexError(idx)
        turn, place = divmod(idx, len(self._lots))
        lot = self._lots[place]
        exercise = draw(lot.family, lot.level, lot.first + turn)
        data = exercise.data(mistakes=8)
        return {
            "question": _question(data),
            "answer": "\n".join(f"({part.label}) {_text(exercise, part)}" for part in exercise.parts),
            "metadata": {
                "source_dataset": "rldrill",
                "source_index": idx,
                "id": exercise.id,
                "family": lot.family,
                "level": lot.level,
                "answers": {part["part"]: part["answer"]["exact"] for part in data["parts"]},
                "mistakes": {part["part"]: part["mistakes"] for part in data["parts"]},
                "difficulty": {"level": lot.level},
            },
        }

    def score_answer(self, answer: str | None, entry: dict[str, Any]) -> float:
        """The share of the points that a text earns, from 0 to 1.

        Args:
            answer: what was answered, a line for every part; of one part the answer alone will do.
            entry: the problem, as the dataset gave it.
        """
        if not answer:
            return 0.0
        answer = _BOXED.sub(lambda boxed: boxed[1], answer)
        exercise = load(entry["metadata"]["id"])
        known = {part.label for part in exercise.parts}
        texts = _answers(answer, known)
        if not texts and len(known) == 1:
            texts = dict.fromkeys(known, answer)
        graded = exercise.grade(texts)
        return float(graded.points / graded.of)


def _answers(text: str, known: Collection[str]) -> dict[str, str]:
    """What is answered to each part; what is surely meant as an answer goes before what may be a remark."""
    sure: dict[str, str] = {}
    perhaps: dict[str, str] = {}
    lines = [piece for line in text.splitlines() if line.strip() for piece in _pieces(line)]
    for line, following in pairwise((*lines, "")):
        if label := _LABEL.match(line):
            beside = _AROUND.sub("", line[label.end() :])
            below = "" if _LABEL.match(following) else _AROUND.sub("", following)
            found = perhaps if label["perhaps"] or not beside else sure
            found[(label["sure"] or label["part"] or label["perhaps"]).lower()] = beside or below
    return {label: answer for label, answer in (perhaps | sure).items() if answer and label in known}


def _pieces(line: str) -> list[str]:
    """A line, or the answers to several parts that stand on it."""
    return _NEXT.split(line) if _LABEL.match(line) else [line]


def _question(data: dict[str, Any]) -> str:
    asked = []
    for part in data["parts"]:
        asked.append(f"({part['part']}) {part['ask']}")
        asked += [f"    {letter}: {text}" for letter, text in part.get("options", {}).items()]
    return "\n\n".join((*data["question"], *asked, _ANSWERS))


def _text(exercise: Exercise, part: Part) -> str:
    return answer_kind(part.kind).write(exercise.solution.answers[part.label])


register_dataset("rldrill", Dataset, Config)
