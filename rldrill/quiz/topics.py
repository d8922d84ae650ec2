"""The map of topics: what there is, and how much of it was asked."""

from collections.abc import Sequence
from datetime import datetime

from rich.console import Group, RenderableType

from rldrill.history.attempts import Attempt
from rldrill.history.progress import progress
from rldrill.problems.catalogue import topics
from rldrill.quiz.planning import skills
from rldrill.render.terminal import table, words

_BAR = 10


def topic_map(attempts: Sequence[Attempt], now: datetime) -> RenderableType:
    """Every topic with how much of it was asked, and how much of it would be right today."""
    groups = {name.replace("_", "-"): skills(families) for name, families in topics().items()}
    shares = progress(attempts, groups, now).shares
    rows = [
        (share.name, "█" * round(_BAR * share.mastery) + "─" * (_BAR - round(_BAR * share.mastery)),
         f"{round(100 * share.mastery)} %", f"{share.seen} of {share.of} seen")
        for share in shares
    ]  # fmt: skip
    drilled = words(("  One topic alone: rldrill quiz ", "dim"), (f"{shares[0].name}", "dim"))
    return Group(table(("topic", "right today", "", ""), rows, right=("",)), drilled)
