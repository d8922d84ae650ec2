"""One self-contained page: no request leaves it, and nothing that it says is taken for markup."""

import json
from functools import cache
from html import escape
from importlib.resources import files
from typing import Any


@cache
def beside(name: str) -> str:
    """A file that lies beside this module."""
    return (files("rldrill.export") / name).read_text(encoding="utf-8")


def page(title: str, body: str, *, language: str = "en", more: str = "") -> str:
    """A page of HTML.

    Args:
        title: the title, plain text.
        body: what stands in it.
        language: of the page.
        more: what comes at the end, such as scripts.
    """
    return (
        f'<!doctype html>\n<html lang="{language}">\n<head>\n<meta charset="utf-8">\n'
        '<meta name="viewport" content="width=device-width, initial-scale=1">\n'
        f"<title>{escape(title)}</title>\n<style>\n{beside('page.css')}</style>\n</head>\n"
        f"<body>\n<main>\n{body}</main>\n{more}</body>\n</html>\n"
    )


def embedded(data: Any) -> str:
    """Data as it may stand within a script element."""
    return json.dumps(data, ensure_ascii=False, separators=(",", ":")).replace("<", "\\u003c")
