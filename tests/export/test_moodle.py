"""What Moodle makes of our questions: the rules of its importers of XML and of cloze questions (type ``multianswer``).

1. A box is ``{weight:KIND:answers}``; answers are parted by ``~``, an answer and its feedback by ``#``.
2. ``~``, ``#`` and ``}`` end what they stand in, but not behind a backslash, and ``#`` not behind ``&``.
3. Entities are undone once, then the backslashes before ``}`` and ``#``, and no others; what is left is HTML.
4. A number is digits with a point and perhaps a power of ten, its tolerance the same behind a colon.
5. Every box has an answer of 100 %, a list to choose from has two or more, and none of them is empty.
6. A name has at most 255 signs and no mathematics; an ID at most 100, once in a category.
7. A file of a text is beside that text, and is called by ``@@PLUGINFILE@@``.
"""

import re
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from html import unescape
from html.parser import HTMLParser
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import pytest

import rldrill
from rldrill.exam.exam import Exam, Head, Version
from rldrill.exercise import Exercise
from rldrill.export.asked import cells
from rldrill.export.moodle import _escaped, moodle_exam

PROBLEMS = (
    "td-zero/2/234", "value-iteration/2/1", "principle-of-optimality/1/2", "markov-property/2/1", "softmax-policy/2/1",
    "td-lambda-backward/2/1", "optimal-policy-from-q/2/1",
)  # fmt: skip
NUMBER = r"-?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?"


@dataclass(frozen=True)
class Answer:
    share: int
    text: str
    feedback: str


@cache
def questions() -> tuple[Element, ...]:
    exercises = tuple(map(rldrill.load, PROBLEMS))
    exam = Exam(Head(title="Costs $5 & <6>/7"), 1, (Version("A", exercises, tuple(range(len(exercises)))),))
    return tuple(ElementTree.fromstring(moodle_exam(exam, practice=True)))


def boxes(text: str) -> Iterator[tuple[int, str, list[Answer]]]:
    """The boxes of a text as Moodle reads them: weight, kind, answers."""
    for found in re.finditer(r"\{(\d*):([A-Z]+):(.*?)(?<!\\)\}", text, re.DOTALL):
        alternatives = re.split(r"(?<!\\)~", found[3])
        yield int(found[1] or 1), found[2], [read(each) for each in alternatives]


def read(alternative: str) -> Answer:
    share, rest = re.fullmatch(r"(=|%-?\d+%)?(.*)", alternative, re.DOTALL).groups()  # type: ignore[union-attr]
    text, _, feedback = re.sub(r"(?<![\\&])#", "\0", rest, count=1).partition("\0")
    percent = 100 if share == "=" else int((share or "%0%").strip("%"))
    return Answer(percent, undone(text), undone(feedback))


def undone(text: str) -> str:
    return unescape(text).replace(r"\}", "}").replace(r"\#", "#")


def cloze() -> list[tuple[int, str, list[Answer]]]:
    return [
        box
        for question in questions()
        if question.get("type") == "cloze"
        for box in boxes(question.findtext("questiontext/text") or "")
    ]


def test_every_box_can_be_answered_rightly() -> None:
    kinds = set()
    for weight, kind, answers in cloze():
        kinds.add(kind)
        assert weight >= 1
        assert any(answer.share == 100 for answer in answers)
        assert all(answer.text.strip() for answer in answers)
        if kind == "MULTICHOICE":
            assert len(answers) >= 2
        else:
            assert all(re.fullmatch(f"{NUMBER}:{NUMBER}", answer.text) for answer in answers)
    assert kinds == {"NUMERICAL", "MULTICHOICE"}


def test_every_cell_has_its_box() -> None:
    for question, name in zip(questions()[1:], PROBLEMS, strict=True):
        exercise = rldrill.load(name)
        asked = sum(len(cells(exercise, part)) for part in exercise.parts)
        assert len(list(boxes(question.findtext("questiontext/text") or ""))) == asked


class Plain(HTMLParser):
    """The text that a page shows, and whether anything in it was taken for an element."""

    def __init__(self) -> None:
        super().__init__()
        self.text, self.elements = "", 0

    def handle_data(self, data: str) -> None:
        self.text += data

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:  # noqa: ARG002
        self.elements += 1


def seen(html: str) -> Plain:
    page = Plain()
    page.feed(html)
    page.close()
    return page


@pytest.mark.parametrize(
    "text",
    [
        "a ~ b",
        "one # two",
        "{x}",
        "1/2",
        '"said"',
        "r < V and V > r",
        "a\\",
        "&lt; is not <b>",
        "≈ 3 % & more",
        "a\\}b~c",
    ],
)
def test_a_sentence_is_shown_as_it_was_written(text: str) -> None:
    """Whatever is in it: as the text of an option, and as what is said of one."""
    box = f"{{1:MULTICHOICE:=right~{_escaped(text)}#{_escaped(text)}}}"
    ((_, _, (right, other)),) = boxes(f"before {box} behind")
    assert (right.text, right.share, other.share) == ("right", 100, 0)
    for html in (other.text, other.feedback):
        page = seen(html)
        assert (page.text, page.elements) == (text, 0)


def test_sentences_have_no_backslashes() -> None:
    told = [answer.feedback for _, _, answers in cloze() for answer in answers]
    assert any("1/2" in text or "γ" in text for text in told)
    assert not any("\\" in text for text in told)


def test_names_are_text_and_ids_are_used_once() -> None:
    named = [question for question in questions() if question.get("type") != "category"]
    names = [question.findtext("name/text") or "" for question in named]
    assert all(0 < len(name) <= 255 and "$" not in name for name in names)
    ids = [question.findtext("idnumber") or "" for question in named]
    assert len(ids) == len(set(ids))
    assert all(0 < len(each) <= 100 for each in ids)
    assert questions()[0].findtext("category/text") == "$course$/top/Costs $5 & <6>//7"


def test_files_are_beside_the_text_that_calls_them() -> None:
    texts = [text for question in questions() for text in question if text.find("text") is not None]
    called = [re.findall(r"@@PLUGINFILE@@/([^\"]+)", text.findtext("text") or "") for text in texts]
    assert any(called)
    assert called == [[file.get("name") for file in text.findall("file")] for text in texts]


def test_points_are_shared_as_those_of_the_parts() -> None:
    (_, question, *_) = questions()
    weights = [weight for weight, _, _ in boxes(question.findtext("questiontext/text") or "")]
    first, second = rldrill.load("td-zero/2/234").parts
    assert Fraction(sum(weights[:3]), sum(weights)) == Fraction(first.points, first.points + second.points)


def test_a_wrong_word_beside_others_is_not_told_where_it_comes_from() -> None:
    """Whoever errs in one state may have erred for many reasons; of a choice there is only one word."""
    exercises = tuple(map(rldrill.load, ("policy-improvement/2/1", "backup-diagram-name/2/1")))
    exam = Exam(Head(title="Words"), 1, (Version("A", exercises, (0, 1)),))
    words, choice = ElementTree.fromstring(moodle_exam(exam, practice=False))[1:]
    said = [re.findall(r":MULTICHOICE:([^}]*)", each.findtext("questiontext/text") or "") for each in (words, choice)]
    assert said[0][:3] == ["=fast~slow#", "=fast~slow#", "fast#~=slow"]
    assert all("starts at" in box for box in said[1])


def test_a_part_that_shall_not_count_weighs_nothing() -> None:
    """Three boxes share 2 points, so all is counted threefold; Moodle takes a weight of 0 for what it is."""
    asked, open_ = (rldrill.load(name) for name in ("td-zero/2/234", "policy-value/3/1"))
    exercises = (Exercise(asked.solution, worth={"a": 2, "b": 0}), Exercise(open_.solution, worth={"a": 0}))
    exam = Exam(Head(title="Points"), 1, (Version("A", exercises, (0, 1)),))
    cloze, essay = ElementTree.fromstring(moodle_exam(exam, practice=False))[1:]
    weights = [weight for weight, _, _ in boxes(cloze.findtext("questiontext/text") or "")]
    assert weights == [2, 2, 2, 0, 0]
    assert essay.findtext("defaultgrade") == "0"


def test_problems_weigh_what_they_are_worth_in_the_exam() -> None:
    """A question weighs what its boxes weigh together, an essay what is said; policy-value/3/1 has an open letter."""
    exercises = tuple(map(rldrill.load, (*PROBLEMS, "policy-value/3/1")))
    exam = Exam(Head(title="Points"), 1, (Version("A", exercises, tuple(range(len(exercises)))),))
    shares, kinds = set(), set()
    for exercise, question in zip(exercises, ElementTree.fromstring(moodle_exam(exam, practice=True))[1:], strict=True):
        boxed = sum(weight for weight, _, _ in boxes(question.findtext("questiontext/text") or ""))
        weight = int(question.findtext("defaultgrade") or 0) if question.get("type") == "essay" else boxed
        shares.add(Fraction(weight, sum(part.points for part in exercise.parts)))
        kinds.add(question.get("type"))
    assert kinds == {"cloze", "essay"}
    assert len(shares) == 1
