"""Blueprints: what may stand in them, and what is said of what may not, with the line."""

from pathlib import Path

import pytest

from rldrill.exam.blueprint import Blueprint, Entry, is_blueprint, read_blueprint, template
from rldrill.exam.planning import plan
from rldrill.problems.catalogue import family
from rldrill.problems.errors import FileError, UsageError

#: A problem, by its whole ID.
RBF = f"rbf/1/2@{family('rbf').revision}"
#: Two problems, the first of them this one; the name of the other follows.
TWICE = "[[problems]]\nid = 'rbf/1/2'\n[[problems]]\nid = "


def written(folder: Path, text: str) -> Path:
    path = folder / "exam.toml"
    path.write_text(text, encoding="utf-8")
    return path


def test_the_blueprint_with_comments_is_one(tmp_path: Path) -> None:
    blueprint = read_blueprint(written(tmp_path, template()))
    assert (blueprint.duration, blueprint.date, blueprint.points) == (90, "2027-02-11", 60)
    exam = plan(blueprint)
    assert len(exam.versions) == 2
    assert exam.versions[0].points == 60
    fields = set(Blueprint.model_fields)
    assert not [name for name in fields if name not in template()]


def test_a_file_is_named_from_the_folder_of_the_blueprint(tmp_path: Path) -> None:
    (tmp_path / "mine.toml").write_text('family = "return"\n[given]\ngamma = "1/2"\nrewards = [1, 4]\ntime = 0\n')
    exam = plan(read_blueprint(written(tmp_path, '[[problems]]\nfile = "mine.toml"\n')))
    assert exam.versions[0].exercises[0].problem.family.name == "return"


def test_a_problem_file_is_no_blueprint() -> None:
    assert is_blueprint({"title": "x"})
    assert not is_blueprint({"family": "return", "given": {}})


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ('titel = "x"', "line 1: 'titel' is not a field of a blueprint (did you mean title?)."),
        ('\n\nlanguage = "fr"', "line 3: language: 'fr' is not possible here; write 'en' or 'de'."),
        ("title = {a = 1}", "line 1: title: must be a text; put it in quotes."),
        ("problems = 3", "line 1: problems: must be a list; a single entry, too, stands in brackets: [3]."),
        ('notation = "ms"', "line 1: notation: there is no notation 'ms'; there are lecture, sutton-barto, control."),
        ("versions = true", "line 1: versions: true is not a whole number; write one, such as 3."),
        ("[[problems]]\nfamily = 'return'\nlevle = 2", "line 3: 'levle' is not a field of [[problems]] (did you mean"),
        ("[[problems]]\nfamily = 'return'\nlevel = 7", "line 3: level: 7 is too large; it must be at most 3."),
        ("\n[[problems]]\nfamily = 'retrun'", "line 2: There is no family 'retrun' (did you mean 'return'?)"),
        ("[[problems]]\nfamily = 'return'\n[[problems]]\nfamily = 'rbf'\nlevel = 3", None),
        ("[[problems]]\nfamily = 'return'\nid = 'return/1/2166'", "line 1: a problem is named by family, topic, id or"),
        ("[[problems]]\nlevel = 1", "this one names none."),
        ("[[problems]]\nid = 'return/1/2166'\ncount = 2", "line 1: id names one problem; leave level and count out."),
        ("[[problems]]\nid = 'return/1/2166@1'", "line 1: return/1/2166@1 is of revision 1"),
        ("[[problems]]\nfile = 'no.toml'", "there is no such file"),
        ("points = 9\n[[problems]]\nfamily = 'return'\npoints = 5", "line 1: the problems' points add up to 5, not to"),
        (
            "[[problems]]\nfamily = 'return'\nlevel = 1\npoints = [1, 2, 3]",
            "line 1: points are given for 3 parts, and no problem",
        ),
        ("problems = [{id = 'return/1/7', count = 2}]", "exam.toml: id names one problem; leave level and count out."),
        (
            "problems = ['return', 'rbf']",
            "line 1: a problem is not its name alone; write a line [[problems]], and below",
        ),
        ("points = '30'\n[[problems]]\nfamily = 'rbf'", "line 1: points: '30' is a text; write 30, without quotes."),
        ("problems = []", "there are no problems in it"),
        ("[problems]\nfamily = 'return'", "line 1: every problem begins with a line [[problems]], in two brackets."),
        ("[[problems]]\nfamily = 'return'\npoints = -3", "line 3: points: -3 is too small; it must be at least 1."),
        (
            "[[problems]]\nfamily = 'return'\npoints = [1, -2]",
            "line 3: points: -2 is too small; it must be at least 1.",
        ),
        (
            "exclude = ['x', 'return']\n[[problems]]\nfamily = 'rbf'",
            "line 1: There is no topic or family 'x'; 'rldrill list'",
        ),
        ("exclude = 'fundamentals'\n[[problems]]\nfamily = 'return'", "line 2: return is left out by exclude;"),
        *(
            (f"{TWICE}'{same}'", f"line 3: the problem {RBF} is there already;")
            for same in ("rbf/1/2", RBF, "rbf/1/002")
        ),
        ("title = ", "the syntax is broken"),
        ("", "there are no problems in it; begin one with a line [[problems]]"),
    ],
)
def test_what_is_wrong_is_said_with_the_line(text: str, sentence: str | None, tmp_path: Path) -> None:
    path = written(tmp_path, text)
    if sentence is None:
        plan(read_blueprint(path))
        return
    with pytest.raises(FileError) as caught:
        plan(read_blueprint(path))
    assert str(caught.value).startswith(str(path))
    assert sentence in str(caught.value)
    assert caught.value.exit_code == 3


def test_of_a_problem_that_is_named_twice_the_command_line_is_told_too(tmp_path: Path) -> None:
    with pytest.raises(UsageError, match=f"The problem {RBF} is there already"):
        plan(Blueprint(problems=(Entry(id="rbf/1/2"), Entry(id=RBF))))
    own = tmp_path / "own.toml"
    own.write_text('family = "return"\n[given]\ngamma = "1/2"\nrewards = [1, 4]\ntime = 0\n')
    with pytest.raises(UsageError, match="This problem is there already"):
        plan(Blueprint(problems=(Entry(file=str(own)), Entry(file=str(own)))))
