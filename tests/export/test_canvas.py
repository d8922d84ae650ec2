"""What Canvas makes of our quizzes: the rules of its importer (QTIMigrationTool, then ``qti_exporter`` of canvas-lms).

Packages of all families were gone through with that tool, and are valid by the DTD of QTI 1.2.1; neither is ours to
hand on.
"""

import io
import re
import zipfile
from decimal import Decimal
from functools import cache
from pathlib import PurePosixPath
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import pytest

import rldrill
from rldrill.exam.exam import Exam, Head, Version
from rldrill.export.canvas import canvas_exam

QTI = "{http://www.imsglobal.org/xsd/ims_qtiasiv1p2}"
PACKAGE = "{http://www.imsglobal.org/xsd/imsccv1p1/imscp_v1p1}"
META = "{http://canvas.instructure.com/xsd/cccv1p0}"
#: Numbers, words to choose from, a picture, an open parameter, yes or no.
PROBLEMS = (
    "td-zero/2/234",
    "value-iteration/2/1",
    "policy-value/3/1",
    "principle-of-optimality/1/2",
    "markov-property/2/1",
)


@cache
def package(*, practice: bool = False) -> dict[str, bytes]:
    exercises = tuple(map(rldrill.load, PROBLEMS))
    places = tuple(range(len(PROBLEMS)))
    versions = (Version("A", exercises, places), Version("B", exercises[:2], places[:2]))
    exam = Exam(Head(title="Costs $5 & <b>6</b>", duration=90), 1, versions)
    content = canvas_exam(exam, practice=practice)
    assert content == canvas_exam(exam, practice=practice), "the same exam is the same file"
    with zipfile.ZipFile(io.BytesIO(content)) as files:
        return {name: files.read(name) for name in files.namelist()}


def quizzes(*, practice: bool = False) -> list[Element]:
    files = package(practice=practice)
    trees = (ElementTree.fromstring(text) for name, text in files.items() if name.endswith(".xml"))
    return [tree for tree in trees if tree.tag == f"{QTI}questestinterop"]


def items(*, practice: bool = False) -> list[Element]:
    return list(quizzes(practice=practice)[0].iter(f"{QTI}item"))


def kind(item: Element) -> str:
    return about(item)["question_type"]


def about(item: Element) -> dict[str, str]:
    fields = item.iter(f"{QTI}qtimetadatafield")
    return {str(each.findtext(f"{QTI}fieldlabel")): str(each.findtext(f"{QTI}fieldentry")) for each in fields}


def shown(item: Element) -> str:
    return item.findtext(f"{QTI}presentation/{QTI}material/{QTI}mattext") or ""


def test_the_manifest_names_every_file_and_canvas_finds_the_settings_beside_each_quiz() -> None:
    files = package()
    manifest = ElementTree.fromstring(files["imsmanifest.xml"])
    named = [str(each.get("href")) for each in manifest.iter(f"{PACKAGE}file")]
    assert sorted(named) == sorted(set(files) - {"imsmanifest.xml"})
    for quiz in quizzes():
        name = str(quiz[0].get("ident"))
        settings = ElementTree.fromstring(files[f"{name}/assessment_meta.xml"])  # it looks nowhere else
        assert settings.findtext(f"{META}time_limit") == "90"
        assert settings.findtext(f"{META}show_correct_answers") == "false"
        assert settings.findtext(f"{META}title") == quiz[0].get("title")


def test_a_picture_is_a_file_of_its_quiz_and_no_resource_of_its_own() -> None:
    """What is a resource of its own is not kept with the quiz, and the text refers to a whole path."""
    files = package()
    manifest = ElementTree.fromstring(files["imsmanifest.xml"])
    own = {each.get("href") for each in manifest.iter(f"{PACKAGE}resource")}
    sources = [source for item in items() for source in re.findall(r'<img src="([^"]*)"', shown(item))]
    assert sources
    assert set(sources) <= set(files) - own
    assert {str(PurePosixPath(source).parent) for source in sources} == {quizzes()[0][0].get("ident")}


@pytest.mark.parametrize("practice", [True, False])
def test_no_picture_is_in_the_package_that_no_text_shows(*, practice: bool) -> None:
    """The bars of a belief that is asked for are the answer, even where only the package has them."""
    exam = Exam(Head(), 1, (Version("A", (rldrill.load("bayes-filter/2/3"),), (0,)),))
    with zipfile.ZipFile(io.BytesIO(canvas_exam(exam, practice=practice))) as files:
        pictures = {name for name in files.namelist() if name.endswith(".svg")}
        told = "".join(files.read(name).decode() for name in files.namelist() if name.endswith(".xml"))
    shown = set(re.findall(r'&lt;img src="([^"]*)"', told))
    assert pictures == shown


def test_every_question_is_of_a_kind_that_canvas_knows() -> None:
    kinds = [kind(item) for item in items()]
    assert set(kinds) == {
        "text_only_question", "numerical_question", "multiple_dropdowns_question", "essay_question",
        "multiple_choice_question",
    }  # fmt: skip
    assert kinds[:6] == ["text_only_question", *["numerical_question"] * 5]  # δ₀, δ₁, δ₂; V of two states


def test_a_number_is_right_by_our_tolerance() -> None:
    """Canvas takes the equal number, and the upper bound less it as the margin; ``vargt`` would mean digits."""
    numbers = [item for item in items() if kind(item) == "numerical_question"]
    for item in numbers:
        condition = item.find(f".//{QTI}conditionvar/{QTI}or")
        assert condition is not None
        told = [each.tag.removeprefix(QTI) for each in condition.iter()]
        assert told == ["or", "varequal", "and", "vargte", "varlte"]
    value, low, high = (Decimal(numbers[0].findtext(f".//{QTI}or//{QTI}{tag}") or 0) for tag in told[1:2] + told[3:])
    # δ₀ = 8 + 1/2·(−4) − (−4) = 10, and 10.0 allows 0.05
    assert (value, low, high) == (10, Decimal("9.95"), Decimal("10.05"))


def test_what_is_marked_by_hand_says_so_itself() -> None:
    """A number beside it is typed as the description of the quiz says."""
    by_hand = [kind(item) for item in items() if "marked by hand" in shown(item)]
    assert by_hand == ["essay_question"]


def test_what_is_to_choose_has_numbers_for_names_and_a_right_one_in_every_place() -> None:
    for item in items():
        if kind(item) not in ("multiple_dropdowns_question", "multiple_choice_question"):
            continue
        places = [str(each.get("ident")) for each in item.iter(f"{QTI}response_lid")]
        keys = [str(each.get("ident")) for each in item.iter(f"{QTI}response_label")]
        assert all(key.isdecimal() for key in keys)
        assert len(keys) == len(set(keys))
        right = [
            str(each.find(f".//{QTI}varequal[@respident]").get("respident"))  # type: ignore[union-attr]
            for each in item.iter(f"{QTI}respcondition")
            if each.find(f"{QTI}setvar") is not None
        ]
        assert sorted(set(right)) == sorted(places)
        blanks = [each.findtext(f"{QTI}material/{QTI}mattext") for each in item.iter(f"{QTI}response_lid")]
        if kind(item) == "multiple_dropdowns_question":
            assert blanks == [place.removeprefix("response_") for place in places]
            assert all(f"[{blank}]" in shown(item) for blank in blanks)
        else:
            assert blanks == [None]


@pytest.mark.parametrize("practice", [False, True])
def test_what_is_told_is_there_and_only_practice_tells_the_working(*, practice: bool) -> None:
    told = 0
    for item in items(practice=practice):
        wanted = [str(each.get("linkrefid")) for each in item.iter(f"{QTI}displayfeedback")]
        there = [str(each.get("ident")) for each in item.iter(f"{QTI}itemfeedback")]
        assert wanted == there
        assert all(re.fullmatch(r"general_fb|general_incorrect_fb|\d+_fb", key) for key in there)
        assert ("general_fb" in there) == (practice and kind(item) != "text_only_question")
        told += "general_incorrect_fb" in there
    assert told
    mistakes = items()[1].findtext(f"{QTI}itemfeedback[@ident='general_incorrect_fb']//{QTI}mattext") or ""
    assert "<p>2: It looks as if rₜ₊₁ is missing" in mistakes  # 1/2·(−4) − (−4) without the 8
    assert not re.search(r"<p>10\D", mistakes)


def test_the_points_are_those_of_the_parts() -> None:
    points = sum(float(about(item)["points_possible"]) for item in items())
    assert points == pytest.approx(sum(part.points for name in PROBLEMS for part in rldrill.load(name).parts), rel=1e-5)
    assert {about(item)["points_possible"] for item in items() if kind(item) == "text_only_question"} == {"0"}


def test_names_are_used_once_in_a_package() -> None:
    names = [str(item.get("ident")) for quiz in quizzes() for item in quiz.iter(f"{QTI}item")]
    assert len(names) == len(set(names))
