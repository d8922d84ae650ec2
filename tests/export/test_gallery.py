"""The catalogue as a site."""

import re
from pathlib import Path

from typer.testing import CliRunner

from rldrill.cli import app
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


def test_a_file_is_no_folder_for_the_gallery(tmp_path: Path) -> None:
    (tmp_path / "site").write_text("")
    assert CliRunner().invoke(app, ["gallery", "return", "-o", str(tmp_path / "site")]).exit_code != 0
