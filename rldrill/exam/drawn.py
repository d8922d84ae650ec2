"""An exam as it is printed from: its manifest and the figures of its versions, and no problem kept."""

from collections.abc import Callable, Sequence
from functools import partial

from msgspec import Struct

from rldrill.background import apart
from rldrill.exam.blueprint import Blueprint
from rldrill.exam.exam import Person
from rldrill.exam.fairness import Fairness, fairness
from rldrill.exam.manifest import manifest, written
from rldrill.exam.planning import plan
from rldrill.exam.sealing import Secret

#: With so many versions their problems take more memory than another process.
_MANY = 50


class Drawn(Struct, frozen=True):
    """An exam that is planned.

    Args:
        manifest: all that is printed, as the file holds it.
        fairness: how equal its versions are.
    """

    manifest: bytes
    fairness: Fairness


def drawn(
    blueprint: Blueprint,
    printed_with: str,
    *,
    roster: Sequence[Person] = (),
    secret: Secret | None = None,
    advance: Callable[[], None] = lambda: None,
) -> Drawn:
    """Plan an exam and write its manifest; of many versions in a process of its own.

    Args:
        blueprint: what the exam shall be.
        printed_with: the version of Typst.
        roster: the people, if each has a version.
        secret: what is mixed into every draw.
        advance: called as often as there are versions.

    Raises:
        FileError: as from ``plan``.
        UsageError: as from ``plan``.
    """
    work = partial(_drawn, blueprint, printed_with, tuple(roster), secret)
    many = max(len(roster), blueprint.versions) >= _MANY
    return apart(work, advance) if many else work(advance)


def _drawn(
    blueprint: Blueprint,
    printed_with: str,
    roster: Sequence[Person],
    secret: Secret | None,
    advance: Callable[[], None],
) -> Drawn:
    exam = plan(blueprint, roster=roster, secret=secret, advance=advance)
    return Drawn(written(manifest(exam, printed_with)), fairness(exam))
