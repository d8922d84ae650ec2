"""``rldrill list``."""

from rldrill.commands.arguments import Json, Names

NAME = "list"


def command(
    names: Names = None,
    json: Json = False,
) -> None:
    """List the topics and their families of problems, with the minutes that each level takes by hand.

    Examples: rldrill list · rldrill list bellman · rldrill list --json
    """

    from rldrill.commands.output import print_json
    from rldrill.exam.expected import minutes
    from rldrill.problems.catalogue import headers

    families = headers(names or ())
    if json:
        rows = [
            {"topic": family.topic, "family": family.name, "title": family.title, "levels": list(family.levels),
             "minutes": minutes().get(family.name), "revision": family.revision, "source": family.source}
            for family in families
        ]  # fmt: skip
        print_json(rows)
        return
    from itertools import pairwise

    from rldrill.render.terminal import console, table

    topics = ["", *(family.topic.replace("_", "-") for family in families)]
    lines = [
        ("" if topic == before else topic, (family.name, "bold"), family.summary, _joined(minutes().get(family.name)))
        for family, (before, topic) in zip(families, pairwise(topics), strict=True)
    ]
    console().print(table(("Topic", "Family", "Asks", "Minutes"), lines, whole=("Family", "Minutes")))


def _joined(minutes: list[int] | None) -> str:
    return " · ".join(map(str, minutes or ()))
