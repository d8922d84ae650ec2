"""The dataset for reasoning-gym, with the real package."""

import pytest

reasoning_gym = pytest.importorskip("reasoning_gym", reason="an extra; CI has it")
import rldrill.generation.reasoning_gym  # noqa: E402, F401
from promptness import at_once  # noqa: E402


def test_the_answers_of_the_dataset_earn_everything_and_others_their_share() -> None:
    dataset = reasoning_gym.create_dataset("rldrill", names=("bellman", "td-zero"), seed=3, size=8)
    for entry in dataset:
        assert dataset.score_answer(entry["answer"], entry) == 1
        assert dataset.score_answer("I do not know.", entry) == 0
        assert dataset.score_answer(None, entry) == 0


def test_a_part_earns_its_share_and_mistakes_are_wrong() -> None:
    # return/1: (a) and (b) are worth a point each.
    dataset = reasoning_gym.create_dataset("rldrill", names=("return",), level=1, seed=3, size=5)
    for entry in dataset:
        first, _ = entry["answer"].splitlines()
        assert dataset.score_answer(first, entry) == 0.5
        for wrong in entry["metadata"]["mistakes"]["a"]:
            assert dataset.score_answer(f"(a) {wrong['answer']}", entry) == 0


def test_an_index_is_the_same_problem_again_and_the_splits_differ() -> None:
    train, again, held_out = (
        reasoning_gym.create_dataset("rldrill", names=("return",), seed=3, size=9, split=split)
        for split in ("train", "train", "held-out")
    )
    assert train[7] == again[7]
    assert {entry["metadata"]["id"] for entry in train}.isdisjoint(entry["metadata"]["id"] for entry in held_out)
    with pytest.raises(IndexError):
        train[9]


def test_one_name_needs_no_brackets() -> None:
    one, listed = (
        reasoning_gym.create_dataset("rldrill", names=names, seed=3, size=2) for names in ("return", ["return"])
    )
    assert [entry["question"] for entry in one] == [entry["question"] for entry in listed]


def test_what_does_not_exist_is_refused() -> None:
    with pytest.raises(AssertionError, match="There is no topic or family 'no-such'"):
        reasoning_gym.create_dataset("rldrill", names=("no-such",))
    with pytest.raises(AssertionError, match="neither train nor held-out"):
        reasoning_gym.create_dataset("rldrill", split="tests")


def test_answers_may_be_set_as_models_set_them() -> None:
    dataset = reasoning_gym.create_dataset("rldrill", names=("return",), level=1, seed=3, size=1)
    first, second = (line.partition(" ")[2] for line in dataset[0]["answer"].splitlines())
    for form in (
        "**({}) {}**", "- ({}) {}", "Part ({}): {}", "**({})** {}", "({}) $\\boxed{{{}}}$", "{}. {}", "({}) **{}**",
        "### ({}) {}", "> ({}) {}", "1. ({}) {}", "| ({}) | {} |", "|{}|{}|", "({})\n{}", "## Part {}\n\n{}",
        "({}): **{}**.", "({}) `{}`", "**Part {}**: {}",
    ):  # fmt: skip
        text = "\n".join(form.format(label, value) for label, value in (("a", first), ("b", second)))
        assert dataset.score_answer(text, dataset[0]) == 1, text
    assert dataset.score_answer(f"<answer>{dataset[0]['answer']}</answer>", dataset[0]) == 1
    for said in ("The answer is: ", "Answer: ", "**Final answer:** ", "the final answer is "):
        assert dataset.score_answer(said + dataset[0]["answer"], dataset[0]) == 1, said
    assert dataset.score_answer(f"\\boxed{{{dataset[0]['answer']}}}", dataset[0]) == 1
    for between in (", ", "; ", " and ", ", and "):
        assert dataset.score_answer(f"(a) {first}{between}(b) {second}", dataset[0]) == 1, between
    assert dataset.score_answer(f"(A) {first}\n(B) {second}", dataset[0]) == 1
    assert dataset.score_answer(f"A) {first}\nB) {second}", dataset[0]) == 1
    # "A." may begin a list of what was done, and is no part.
    assert dataset.score_answer(f"{dataset[0]['answer']}\nA. First I added the rewards.", dataset[0]) == 1
    # So may "a.", and a remark takes the place of no answer.
    assert dataset.score_answer(f"{dataset[0]['answer']}\n\na. note that this is exact", dataset[0]) == 1
    # A part without its answer takes none from the next one.
    assert dataset.score_answer(f"(a)\n(b) {second}", dataset[0]) == 0.5


def test_blanks_without_end_take_no_time() -> None:
    dataset = reasoning_gym.create_dataset("rldrill", names=("return",), level=1, seed=3, size=1)
    entry = dataset[0]
    blank = " " * 20_000
    with at_once():
        assert dataset.score_answer(f"(a){blank}x{blank}y\n{blank}\n{blank}z", entry) == 0
        assert dataset.score_answer(f"the{blank}final{blank}answer{blank}is{blank}:{blank}x", entry) == 0
        assert dataset.score_answer("\\boxed{" * 3000, entry) == 0
