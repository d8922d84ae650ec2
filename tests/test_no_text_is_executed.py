"""Whatever a person types, in answers or in problem files, is read and never executed."""

from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest
import sympy
from sympy import SympifyError

import rldrill
from rldrill.problems.errors import FileError
from rldrill.solutions.formula.compiling import compiled
from rldrill.solutions.formula.notation import Blocks, Cases, SumOver

PENDULUM: dict[str, Any] = {
    "dynamics": {"θ": "ω", "ω": "u - g*sin(θ)"},
    "constants": {"g": 10},
    "state": {"θ": "pi", "ω": 0},
    "action": {"u": 0},
}


@pytest.fixture
def mark(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """A file that is there only if a text was executed; and no text may be handed to sympy on the way."""
    original = sympy.sympify

    def watched(value: Any, *arguments: Any, **options: Any) -> Any:
        assert not isinstance(value, str), f"sympify was given the text {value!r}"
        return original(value, *arguments, **options)

    monkeypatch.setattr(sympy, "sympify", watched)
    return tmp_path / "executed"


def hostile(mark: Path) -> str:
    return f"__import__('pathlib').Path({str(mark)!r}).touch()"


PROBLEMS = [
    "td-zero/1/1", "softmax-policy/1/1", "rbf/3/1", "lqr-gain/2/1", "bayes-rule/1/1", "bic/2/1",
    "backup-diagram-name/1/1", "value-iteration/2/1", "jacobian/2/1",
]  # fmt: skip


@pytest.mark.parametrize("problem", PROBLEMS)
def test_answers(problem: str, mark: Path) -> None:
    exercise = rldrill.load(problem)
    text = hostile(mark)
    for part in exercise.parts:
        for typed in (text, f"[{text}]", f"cool: {text}", f"{text}: 1", f"1 + {text}", f"exp({text})", f"sqrt({text})"):
            assert exercise.check(typed, part.label).outcome.value == "unreadable"
    assert not mark.exists()


PLACES: list[Callable[[str], dict[str, Any]]] = [
    lambda text: PENDULUM | {"dynamics": {"θ": "ω", "ω": text}},
    lambda text: PENDULUM | {"dynamics": {"θ": "ω", "ω": "u", text: "1"}, "state": {"θ": 0, "ω": 0, text: 1}},
    lambda text: PENDULUM | {"where": {text: "1"}},
    lambda text: PENDULUM | {"where": {"D": text}},
    lambda text: PENDULUM | {"constants": {text: 10}},
    lambda text: PENDULUM | {"constants": {"g": text}},
    lambda text: PENDULUM | {"state": {"θ": text, "ω": 0}},
    lambda text: PENDULUM | {"step": text},
    lambda text: PENDULUM | {"picture": text},
]


@pytest.mark.parametrize("place", PLACES)
def test_dynamics(place: Callable[[str], dict[str, Any]], mark: Path) -> None:
    with pytest.raises(FileError):
        rldrill.read({"family": "linearise", "given": place(hostile(mark))})
    assert not mark.exists()


@pytest.mark.parametrize("name", ["_", "__class__", "a.b", "x:0", "x=1", "0", "θ\n", "x if u else y", "import", "None"])
def test_letters_that_would_be_code(name: str) -> None:
    given = PENDULUM | {"dynamics": {"θ": "ω", "ω": "u", name: "1"}, "state": {"θ": 0, "ω": 0, name: 1}}
    with pytest.raises(FileError):
        rldrill.read({"family": "linearise", "given": given})


def test_a_word_of_pythons_own_is_a_letter_where_it_is_one_in_mathematics() -> None:
    given = PENDULUM | {"dynamics": {"θ": "ω", "ω": "2*lambda", "lambda": "u"}, "state": {"θ": 0, "ω": 0, "lambda": 1}}
    answers = rldrill.read({"family": "linearise", "given": given}).solve()
    assert answers["a"].tolist() == [[0, 1, 0], [0, 0, 2], [0, 0, 0]]


def test_names_of_states_and_numbers(mark: Path) -> None:
    text = hostile(mark)
    runs: list[dict[str, Any]] = [
        {"states": [text, "end"], "rewards": [1], "terminal": ["end"]},
        {"states": ["s", "end"], "rewards": [text], "terminal": ["end"]},
    ]
    for run in runs:
        with pytest.raises(FileError):
            rldrill.read({"family": "return", "given": {"rewards": run["rewards"], "gamma": text}})
        with pytest.raises(FileError):
            rldrill.read(
                {"family": "td-zero", "given": {"trajectory": run, "values": {"s": 1}, "alpha": 1, "gamma": 1}}
            )
    assert not mark.exists()


def test_the_compiler_takes_names_alone_and_knows_no_functions_of_pythons(mark: Path) -> None:
    with pytest.raises(ValueError, match="is not the name of a letter"):
        compiled(sympy.Symbol(hostile(mark)))
    assert compiled(sympy.Symbol("x") + 1).__globals__["__builtins__"] == {}
    assert not mark.exists()


@pytest.mark.parametrize(
    "built",
    [
        lambda: SumOver("1 + 1", sympy.Symbol("s"), sympy.Symbol("S")),  # type: ignore[arg-type]
        lambda: Cases(sympy.Symbol("c"), "1 + 1", sympy.S.One),  # type: ignore[arg-type]
        lambda: Blocks(1, "1 + 1"),
    ],
)
def test_a_text_is_no_part_of_a_formula(built: Callable[[], object]) -> None:
    with pytest.raises(SympifyError):
        built()
