"""The catalogue as a site."""

import json
import re
from pathlib import Path

import pytest
from py_mini_racer import MiniRacer
from typer.testing import CliRunner

from rldrill.cli import app
from rldrill.export.page import beside
from rldrill.problems.catalogue import family, headers
from rldrill.solutions.solution import solver


def test_the_gallery_shows_every_level_the_formulas_and_the_mistakes(tmp_path: Path) -> None:
    names = ["return", "optimal-policy-from-q"]
    done = CliRunner().invoke(app, ["gallery", *names, "-o", str(tmp_path / "site")])
    assert done.exit_code == 0, done.output
    front = (tmp_path / "site" / "index.html").read_text("utf-8")
    for header in headers(names):
        assert f'<a href="{header.name}.html">' in front
        text = (tmp_path / "site" / f"{header.name}.html").read_text("utf-8")
        assert [int(level) for level in re.findall(r'id="level-(\d)"', text)] == list(header.levels)
        assert "<math" in text
        for mistake in solver(family(header.name)).misconceptions:
            assert mistake.says.split("$")[0].split("'")[0].split("’")[0][:20] in text
    links = re.findall(r'href="([^"]*)"', front)
    assert all((tmp_path / "site" / link).exists() for link in links)


def test_the_front_page_knows_letters_by_name_mistakes_and_other_words(tmp_path: Path) -> None:
    done = CliRunner().invoke(app, ["gallery", "td-zero", "-o", str(tmp_path / "site")])
    assert done.exit_code == 0, done.output
    found = re.search('data-text="([^"]*)"', (tmp_path / "site" / "index.html").read_text("utf-8"))
    assert found
    words = found[1].split()
    assert {"γ.", "gamma", "alpha", "discount", "learning", "rate", "temporal", "forgot-gamma", "barto"} <= set(words)
    assert "sigma" not in words  # of sums
    assert len(words) == len(set(words))


@pytest.mark.parametrize(
    ("typed", "found", "instead"),
    [
        ("", [True, True, True], []),
        ("gamma", [True, False, True], []),
        ("GAMMA step", [True, False, False], []),
        ("td zero", [True, False, False], []),
        ("q-learning", [False, True, False], []),
        ("poincare", [False, False, True], []),
        ("dicsount", [True, False, False], ["discount"]),  # two neighbours exchanged
        ("learnings", [False, True, False], ["learning"]),
        ("gmma", [True, False, True], ["gamma"]),
        ("gam", [True, False, True], []),
        ("xyz", [False, False, False], []),  # too short to guess
        ("policy", [False, False, False], []),
    ],
)
def test_a_search_finds_all_words_and_guesses_those_that_stand_nowhere(
    typed: str, found: list[bool], instead: list[str]
) -> None:
    machine = MiniRacer()
    machine.eval(beside("search.js").replace("const Search", "var Search"))
    texts = ["td-zero discount step γ gamma", "Q-learning, learning", "Poincaré, gamma"]
    result = json.loads(machine.eval(f"JSON.stringify(Search.index({json.dumps(texts)})({json.dumps(typed)}))"))
    assert (result["found"], result["instead"]) == (found, instead)


def test_a_file_is_no_folder_for_the_gallery(tmp_path: Path) -> None:
    (tmp_path / "site").write_text("")
    assert CliRunner().invoke(app, ["gallery", "return", "-o", str(tmp_path / "site")]).exit_code != 0
