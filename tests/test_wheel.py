"""The wheel: it claims one name, holds everything, and runs in an empty environment away from the checkout."""

import os
import subprocess
import sys
import sysconfig
import venv
import zipfile
from pathlib import Path

import pytest

from rldrill.problems.catalogue import topics

ROOT = Path(__file__).parent.parent


@pytest.fixture(scope="module")
def wheel(tmp_path_factory: pytest.TempPathFactory) -> Path:
    folder = tmp_path_factory.mktemp("wheel")
    # From a copy without links' targets resolved, as a fresh clone has it; the checkout stays as it is.
    source = folder / "source"
    files = subprocess.run(
        ["git", "ls-files", "-z", "--cached", "--others", "--exclude-standard"],
        cwd=ROOT,
        capture_output=True,
        check=True,
    ).stdout.decode()
    for name in filter(None, files.split("\0")):
        if not (ROOT / name).exists():
            continue
        target = source / name
        target.parent.mkdir(parents=True, exist_ok=True)
        if (ROOT / name).is_symlink():
            target.symlink_to((ROOT / name).readlink())
        else:
            target.write_bytes((ROOT / name).read_bytes())
    subprocess.run(
        [
            sys.executable,
            "-m",
            "pip",
            "wheel",
            "--quiet",
            "--no-deps",
            "--wheel-dir",
            str(folder),
            str(source),
        ],
        check=True,
    )
    (built,) = folder.glob("*.whl")
    return built


def test_it_claims_one_name_and_holds_every_module(wheel: Path) -> None:
    names = zipfile.ZipFile(wheel).namelist()
    assert {name.split("/")[0] for name in names} == {
        "rldrill",
        next(n for n in names if ".dist-info" in n).split("/")[0],
    }
    for room in ("problems", "solutions"):
        modules = {str(path.relative_to(ROOT)) for path in (ROOT / room).rglob("*.py")}
        assert {f"rldrill/{module}" for module in modules} <= set(names)
    typst = {str(path.relative_to(ROOT)) for path in (ROOT / "rldrill").rglob("*.typ")}
    assert typst
    assert {*typst, "rldrill/py.typed", "rldrill/exam/minutes.json"} <= set(names)


def test_it_runs_away_from_the_checkout(wheel: Path, tmp_path: Path) -> None:
    # The libraries are those that are here already: that the declared ones do is seen where CI installs the lowest.
    venv.create(tmp_path / "env", with_pip=False)
    binaries = tmp_path / "env" / "bin"
    (site,) = (tmp_path / "env" / "lib").glob("python*/site-packages")
    install = [sys.executable, "-m", "pip", "--python", str(binaries / "python"), "install", "--quiet", "--no-deps"]
    subprocess.run([*install, "--disable-pip-version-check", str(wheel)], check=True)
    (site / "libraries.pth").write_text(f"{sysconfig.get_path('purelib')}\n")
    environment = {name: value for name, value in os.environ.items() if name != "PYTHONPATH"} | {"COLUMNS": "140"}

    def run(*arguments: str) -> str:
        return subprocess.run(
            [binaries / "rldrill", *arguments],
            cwd=tmp_path,
            env=environment,
            capture_output=True,
            text=True,
            check=True,
        ).stdout

    listed = run("list")
    assert all(topic.replace("_", "-") in listed for topic in topics())
    assert "Working" in run("solve", "td-zero/1/7")
    (tmp_path / "problems").mkdir()  # a course's own folder of that name is not in the way
    (tmp_path / "problems" / "__init__.py").write_text("raise RuntimeError\n")
    assert run("show", "td-zero/1/7")
    run("worksheet", "td-zero", "-n", "1", "--seed", "1", "-o", "sheet.pdf")
    assert (tmp_path / "sheet.pdf").read_bytes().startswith(b"%PDF")
