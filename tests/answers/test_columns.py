"""A complaint points to the very sign that is not understood, whatever stands around it and whoever wrote that."""

from collections.abc import Callable
from typing import Any

import pytest

from rldrill.solutions.answers.text import Unreadable, read_matrix, read_number, read_table, read_vector, read_words

STATES, ENDS = ["cool", "warm"], ["over"]
PAIRS = [("cool", "fast"), ("cool", "slow"), ("warm", "fast"), ("warm", "slow")]
ACTIONS = {"cool": ["slow", "fast"], "warm": ["slow", "fast"]}
READERS: dict[str, Callable[[str], Any]] = {
    "number": lambda text: read_number(text, ["gamma"]),
    "vector": lambda text: read_vector(text, 2, ["gamma"], ["x", "y"]),
    "matrix": lambda text: read_matrix(text, (2, 2), ["gamma"]),
    "table": lambda text: read_table(text, STATES, ["gamma"], ENDS),
    "pairs": lambda text: read_table(text, PAIRS, ["gamma"], ENDS),
    "policy": lambda text: read_words(text, STATES, ACTIONS, ENDS),
}
#: Texts with one sign, @, that nobody understands.
TEXTS = {
    "number": [
        "@", "  @", "1 + @", "½ + @", "1½ - @", "(1 + 2)(@)", "x = @", "V(s) = 1 + @", "≈ @", "'@'", "[@]", "2γ² - @",
        "exp(@)", "max(1, @)", "¹⁄₄ + @", "\t1 + @", "0.(3) + @", "1e-3 + @", "$@$", "3 % @", "√@", "- @", "2^(@)",
    ],
    "vector": [
        "1, @", "@, 1", "[1 @]", "(@; 1)", "1; @", "[1, @]", "(1, @)^T", "⟨@, 2⟩", "1\n@", "x = (1, @)", "[[1], [@]]",
        "[[1, @]]", "[ 1 , @ ]", "x: 1, y: @", "y = @, x = 1", "x = 1 y = @", "array([1., @])", "[1,\n @]",
        "tensor([1., @], device='cuda:0')", "[½, @]", "| 1 | @ |", "1\t@", "{1, @}",
    ],
    "matrix": [
        "[[1, 2], [3, @]]", "[1 2; @ 4]", "1 2\n3 @", "1, @\n3, 4", "K = [1 2\n@ 4]", "[1 2] [3 @]", "((1, @), (3, 4))",
        "[[1. 2.]\n [@ 4.]]", "array([[1., 2.],\n       [3., @]])", "1\t2\n3\t@", "| 1 | 2 |\n|---|---|\n| @ | 4 |",
        "[1, 2; ...\n 3, @]", "{{1, 2}, {@, 4}}", "[[1,3],[2,@]]^T",
    ],
    "table": [
        "cool: 3, warm: @", "warm = @; cool = 1", "cool: @\nwarm: 2", "V(cool) = 1, V(warm) = @",
        "V_cool = @, V_{warm} = 2",
        "1, @", "[@ 2]", "{cool: 1, warm: @}", "{'cool': @, \"warm\": 2}", "cool → 1, warm -> @", "V = (1, @)",
        "cool=1 warm=@", "cool\t1\nwarm\t@", "cool | @\nwarm | 2", "| cool | warm |\n|---|---|\n| 1 | @ |",
        "[('cool', 1), ('warm', @)]", "cool: 1, warm: @, over: 0", "c: 1, w: @", "{'cool': np.float64(1), 'warm': @}",
        "cool 1\nwarm @\ndtype: float64", "V(cool) ← 3 + 1\n        = 4\nV(warm) ← @",
    ],
    "pairs": [
        "(cool, fast): 1, (cool, slow): 2, (warm, fast): @, (warm, slow): 4", "[[1, 2], [3, @]]", "1 2\n@ 4",
        "1, 2, @, 4", "cool: [1, @], warm: [3, 4]", '{"cool": {"fast": 1, "slow": @}, "warm": {"fast": 3, "slow": 4}}',
        "| | fast | slow |\n| cool | 1 | 2 |\n| warm | @ | 4 |", "Q(c,f)=1 Q(c,s)=2 Q(w,f)=3 Q(w,s)=@",
        "cool fast: 1, cool slow: @, warm fast: 3, warm slow: 4",
    ],
    "policy": [
        "cool: fast, warm: @", "@, slow", "warm = @; cool = fast", "cool -> fast, warm → @", "(fast, @)", "@ slow",
        "{'cool': 'fast', 'warm': @}", "cool: fast\nwarm: @", "π(cool) = fast\nπ(warm) = @",
    ],
}  # fmt: skip
CASES = [(kind, text) for kind, texts in TEXTS.items() for text in texts]


@pytest.mark.parametrize(("kind", "text"), CASES)
def test_the_column_is_that_of_the_sign(kind: str, text: str) -> None:
    with pytest.raises(Unreadable) as refused:
        READERS[kind](text)
    assert refused.value.position == text.index("@"), refused.value.message
    assert "'@'" in refused.value.message


@pytest.mark.parametrize(
    ("text", "column"),
    [
        ("1/4 =", 4),
        ("x = 1/4 = ", 8),
        ("1 + ", 3),
        ("(1 + 2", 6),
        ("1 + 2)", 5),
        ("1 = 2", 4),
        ("2^1001", 1),
        ("1 2", 2),
    ],
)  # fmt: skip
def test_the_column_of_what_is_missing_or_too_much(text: str, column: int) -> None:
    with pytest.raises(Unreadable) as refused:
        read_number(text)
    assert refused.value.position == column
