"""The map of topics: a bar of ten for what would be right today, and how many were seen."""

import io

from rich.console import Console

from rldrill.history.attempts import Attempt
from rldrill.problems.catalogue import topics
from rldrill.quiz.planning import skills
from rldrill.quiz.recording import utc_now
from rldrill.quiz.topics import topic_map

NOW = utc_now()


def shown(asked: dict[str, int]) -> dict[str, str]:
    """The lines by their topics, where so many skills of each were answered rightly just now."""
    every = [skill for topic, number in asked.items() for skill in skills(topics()[topic])[:number]]
    log = [
        Attempt(str(n), NOW, str(n), skill.family, skill.level, 7, 1, "a", 1, "", "right", (), 0, 0, 60.0, 1.0)
        for n, skill in enumerate(every)
    ]
    console = Console(file=io.StringIO(), width=80, color_system=None)
    with console.capture() as captured:
        console.print(topic_map(log, NOW))
    head, *rows, below = captured.get().splitlines()
    assert head.split() == ["topic", "right", "today"]
    assert below == "  One topic alone: rldrill quiz fundamentals"
    return {row.split()[0]: " ".join(row.split()[1:]) for row in rows}


def test_every_topic_has_its_share() -> None:
    lines = shown({"bellman": 12, "bayes": 21, "dynamic_programming": 6})
    assert list(lines) == [topic.replace("_", "-") for topic in topics()]
    assert lines["bellman"] == "█████───── 50 % 12 of 24 seen"
    assert lines["bayes"] == "██████████ 100 % 21 of 21 seen"
    assert lines["dynamic-programming"] == "██──────── 25 % 6 of 24 seen"  # 2.5, to the even number
    assert lines["fundamentals"] == "────────── 0 % 0 of 12 seen"
