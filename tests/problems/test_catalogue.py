"""Which packages have families, and whose a family is."""

from importlib.metadata import EntryPoint
from pathlib import Path

import pytest

from rldrill.problems import catalogue
from rldrill.problems.errors import BrokenFamily


def declared(monkeypatch: pytest.MonkeyPatch, folder: Path, *values: str) -> dict[str, Path]:
    """The trees where installed packages declare these values, and the folder is one of those that Python looks in."""
    points = [EntryPoint(f"from-{value}", value, "rldrill.families") for value in values]
    monkeypatch.setattr("importlib.metadata.entry_points", lambda group: points if group == "rldrill.families" else [])
    monkeypatch.syspath_prepend(folder)
    return catalogue.trees.__wrapped__()


def test_packages_with_problems_follow_our_own_in_the_order_of_their_names(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    for name in ("course_b", "course_a"):
        (tmp_path / name / "problems").mkdir(parents=True)
    found = declared(monkeypatch, tmp_path, "course_b", "course_a")
    assert list(found) == ["rldrill", "course_a", "course_b"]
    assert found["course_a"] == tmp_path / "course_a" / "problems"
    assert (found["rldrill"] / "temporal_difference" / "td_zero.py").is_file()


@pytest.mark.parametrize("value", ["no_such_course", "course_c", "course_c.problems", "course c"])
def test_a_package_without_problems_is_told(monkeypatch: pytest.MonkeyPatch, tmp_path: Path, value: str) -> None:
    (tmp_path / "course_c").mkdir()
    (tmp_path / "course_c" / "problems").write_text("a file, no folder")
    with pytest.raises(BrokenFamily, match=f"'from-{value}' of rldrill.families names '{value}', which is no package"):
        declared(monkeypatch, tmp_path, value)


def test_a_family_is_of_one_package(monkeypatch: pytest.MonkeyPatch, tmp_path: Path) -> None:
    (tmp_path / "control").mkdir()
    (tmp_path / "drafts").mkdir()  # no topic
    (tmp_path / "drafts" / "q_learning.py").write_text("")
    (tmp_path / "control" / "__init__.py").write_text("")
    (tmp_path / "control" / "new_family.py").write_text("")
    trees = {**catalogue.trees(), "course": tmp_path}
    monkeypatch.setattr(catalogue, "trees", lambda: trees)
    found = catalogue.packages.__wrapped__()
    assert (found["new-family"], found["td-zero"]) == ("course", "rldrill")
    (tmp_path / "control" / "td_zero.py").write_text("")
    with pytest.raises(BrokenFamily, match="course: there is a family 'td-zero' in rldrill; call this one otherwise"):
        catalogue.packages.__wrapped__()
