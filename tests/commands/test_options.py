"""What commands do without options, and how much may be asked of them: what courses' scripts rely on."""

import inspect
from pathlib import Path
from types import ModuleType
from typing import Any, get_type_hints

import pytest

from rldrill.commands import (
    audit,
    fields,
    gallery,
    generate,
    list_,
    quiz,
    sheet,
    show,
    solve,
    stats,
    verify,
    worksheet,
)  # fmt: skip
from rldrill.commands.arguments import complete_families, complete_ids, complete_names

#: For every option its default, and the least and most that it takes.
OPTIONS: dict[ModuleType, dict[str, tuple[Any, int | None, int | None]]] = {
    quiz: {
        "number": (None, 1, 1000), "level": (None, 1, 3), "seed": (None, 0, None), "exam_date": (None, None, None),
        "minutes": (None, 1, 600), "exam": (None, None, None), "version": (None, None, None),
        "plain": (False, None, None), "mistake": (None, None, None), "answers": (None, None, None),
        "notation": (None, None, None),
    },
    worksheet: {
        "count": (None, 1, 100), "minutes": (None, 1, 600), "level": (None, 1, 3), "exclude": (None, None, None),
        "seed": (None, 0, None), "versions": (None, 1, 999), "roster": (None, None, None),
        "secret_file": (None, None, None),
        "paper": (None, None, None), "space": (None, None, None), "solutions": (None, None, None),
        "ids": (None, None, None), "duplex": (None, None, None), "title": (None, None, None),
        "output": (None, None, None), "format_": (None, None, None), "force": (False, None, None),
        "init": (None, None, None),
        "source": (None, None, None), "key": (False, None, None), "as_json": (False, None, None),
        "notation": (None, None, None),
    },
    verify: {
        "exam": (None, None, None), "version": (None, None, None), "roster": (None, None, None),
        "reports": (None, None, None), "enough": (None, None, None), "feedback": (None, None, None),
        "show_key": (False, None, None), "hand_ins": (None, None, None), "absent": (True, None, None),
        "allow_files": (False, None, None),
        "strict": (False, None, None), "seconds": (30, 0.1, 3600), "schema": (False, None, None),
        "json": (False, None, None),
    },
    solve: {"json": (False, None, None), "schema": (None, None, None)},
    show: {"json": (False, None, None), "notation": (None, None, None)},
    sheet: {
        "output": (None, None, None), "paper": ("a4", None, None), "latex": (False, None, None),
        "workings": (False, None, None), "notation": (None, None, None),
    },
    list_: {"json": (False, None, None)},
    fields: {"json": (False, None, None)},
    generate: {
        "number": (10, 1, 10**8), "level": (None, 1, 3), "seed": (None, 0, None), "answers": (False, None, None),
        "more": ("", None, None), "output": (None, None, None), "form": ("jsonl", None, None),
        "jobs": (1, 1, 256), "shard": ("", None, None), "dask": (None, None, None),
        "split": ("train", None, None),
    },
    stats: {"json": (False, None, None), "output": (None, None, None)},
    gallery: {"output": (Path("site"), None, None), "notation": (None, None, None)},
    audit: {"number": (200, 1, 10**5), "seed": (0, 0, None), "exam": (None, None, None), "json": (False, None, None)},
}  # fmt: skip
_ARGUMENTS = {"names", "files", "problem", "family"}


@pytest.mark.parametrize("module", OPTIONS, ids=[module.NAME for module in OPTIONS])
def test_the_defaults_and_bounds_of_every_option(module: ModuleType) -> None:
    told = {name: hint.__metadata__[0] for name, hint in get_type_hints(module.command, include_extras=True).items()
            if name != "return"}  # fmt: skip
    parameters = inspect.signature(module.command).parameters
    assert {
        name: (parameters[name].default, told[name].min, told[name].max)
        for name in parameters
        if name not in _ARGUMENTS
    } == OPTIONS[module]


def test_names_are_completed() -> None:
    assert complete_names("td-z") == ["td-zero"]
    assert complete_names("temporal-d") == ["temporal-difference"]
    assert complete_families("temporal-d") == []
    assert complete_ids("td-z") == ["td-zero/"]
    assert complete_ids("td-zero/") == ["td-zero/1/", "td-zero/2/", "td-zero/3/"]
    assert complete_ids("td-zero/2") == ["td-zero/2/"]
    assert complete_ids("no-family/") == []
