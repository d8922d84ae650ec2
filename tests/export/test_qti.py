"""Items of QTI 2.1, answered: their response processing is gone through as a reader of QTI goes through it."""

import io
import zipfile
from collections.abc import Mapping
from decimal import Decimal
from fractions import Fraction
from typing import Any
from xml.etree import ElementTree
from xml.etree.ElementTree import Element

import pytest

import rldrill
from rldrill.exam.exam import Exam, Head, Version
from rldrill.export.qti import qti_exam

QTI = "{http://www.imsglobal.org/xsd/imsqti_v2p1}"


def items(*problems: str, own: tuple[Mapping[str, str], ...] = (), **exam: Any) -> list[Element]:
    exercises = tuple(map(rldrill.load, problems))
    version = Version("A", exercises, tuple(range(len(exercises))), partial=own)
    content = qti_exam(Exam(Head(), 1, (version,), **exam), practice=False)
    with zipfile.ZipFile(io.BytesIO(content)) as package:
        return [ElementTree.fromstring(package.read(f"item-A-{number}.xml")) for number in range(1, 1 + len(problems))]


def holds(test: Element, answers: Mapping[str, str]) -> bool:
    match test.tag.removeprefix(QTI):
        case "and":
            return all(holds(each, answers) for each in test)
        case "or":
            return any(holds(each, answers) for each in test)
    named, value = test
    typed = answers.get(str(named.get("identifier")))
    if typed is None:
        return False
    if test.tag == f"{QTI}match":
        return typed == value.text
    return abs(Decimal(typed) - Decimal(str(value.text))) <= Decimal(str(test.get("tolerance")).split()[0])


def score(item: Element, answers: Mapping[str, str]) -> Decimal:
    """What is earned: of every condition the first branch that holds."""
    earned = Decimal(0)
    for condition in item.iter(f"{QTI}responseCondition"):
        branch = next((each for each in condition if holds(each[0], answers)), None)
        if branch is not None and branch[1].get("identifier") == "SCORE":
            earned += Decimal(str(branch[1].findtext(f"{QTI}sum/{QTI}baseValue")))
    return earned


def notes(item: Element) -> list[str]:
    return [str(each.text) for each in item.iter(f"{QTI}em")]


def test_a_part_with_an_open_letter_is_marked_by_hand_as_a_whole() -> None:
    """V(rim) has p in it, and V(slope) is 3/4, which is typed as the note says: 3/4 is no float."""
    open_, closed = items("policy-value/3/1", "td-zero/2/234")
    kinds = [each.get("baseType") for each in open_.iter(f"{QTI}responseDeclaration")]
    keys = [each.findtext(f"{QTI}correctResponse/{QTI}value") for each in open_.iter(f"{QTI}responseDeclaration")]
    assert kinds == ["string", "string"]
    assert keys[1] == "3/4"
    assert not list(open_.iter(f"{QTI}responseCondition"))
    assert notes(open_) == ["Answer in words and formulas; it is marked by hand."]
    assert ["fractions are not read here" in note for note in notes(closed)] == [True]


#: A = [0, 1; −10·cos(π/6), 0] with 9 for its third entry, of Q^π 12 for 7, of π′ fast for hot; all else right.
SLIPS = (
    {"R_a_1": "0", "R_a_2": "1", "R_a_3": "9", "R_a_4": "0", "R_b_1": "0", "R_b_2": "0.5"},
    {
        **{f"R_a_{number}": value for number, value in enumerate(("16", "12", "18", "14", "12", "10"), 1)},
        "R_b_1": "o1", "R_b_2": "o1", "R_b_3": "o1", "R_c_1": "o2",
    },
)  # fmt: skip


@pytest.mark.parametrize(
    ("rules", "earned"),
    [
        ({}, (1, 1)),  # (b), and (c)
        ({"partial": "entries"}, (Fraction(3, 4) + 1, 3 * Fraction(5, 6) + Fraction(2, 3) + 1)),
        ({"own": ({"a": "entries"}, {"b": "entries"})}, (Fraction(3, 4) + 1, Fraction(2, 3) + 1)),
    ],
)
def test_a_wrong_entry_costs_what_the_exam_says(rules: dict[str, Any], earned: tuple[Fraction, Fraction]) -> None:
    """Of 1 + 1 points and of 3 + 1 + 1."""
    asked = items("linearise/1/26", "policy-improvement/2/1", **rules)
    for item, typed, worth in zip(asked, SLIPS, earned, strict=True):
        assert float(score(item, typed)) == pytest.approx(float(worth), abs=1e-4)
    right = {**SLIPS[0], "R_a_3": "-8.66"}
    assert float(score(asked[0], right)) == pytest.approx(2, abs=1e-4)


def test_a_part_of_which_a_box_is_empty_earns_nothing_where_a_wrong_entry_costs_all() -> None:
    (item,) = items("linearise/1/26")
    assert score(item, {"R_b_1": "0"}) == 0
    assert score(item, {"R_b_1": "0", "R_b_2": "0.5"}) == 1
