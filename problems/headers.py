"""What a family's file says of it at its head, read without importing it: its models take longer than a list may."""

import ast
from pathlib import Path
from typing import Any

from msgspec import Struct

from rldrill.problems.errors import BrokenFamily
from rldrill.problems.identity import LEVELS


class Header(Struct, frozen=True):
    """The name, the topic, and what the head of the file says."""

    name: str
    topic: str
    summary: str
    title: str
    source: str
    revision: int
    levels: tuple[int, ...]


def header(topic: str, name: str, tree: Path) -> Header:
    """Read the head of a family's file, down to its first class or function; ``tree`` is the folder of the topics.

    Raises:
        BrokenFamily: the head lacks something that a family must have.
    """
    path = tree / topic / f"{name.replace('-', '_')}.py"
    head = path.read_text(encoding="utf-8")
    for end in ("\nclass ", "\ndef ", "\n@"):
        head = head.partition(end)[0]
    module = ast.parse(head)
    says: dict[str, Any] = {"LEVELS": LEVELS}
    for line in module.body:
        match line:
            case ast.Assign(targets=[ast.Name(id="TITLE" | "SOURCE" | "REVISION" | "LEVELS" as word)], value=value):
                says[word] = ast.literal_eval(value)
    for word in ("TITLE", "SOURCE", "REVISION"):
        if word not in says:
            raise BrokenFamily(f"{path}: a family must have {word}, above its first class; add it.")
    summary = (ast.get_docstring(module) or "").partition("\n")[0]
    return Header(name, topic, summary, says["TITLE"], says["SOURCE"], says["REVISION"], says["LEVELS"])
