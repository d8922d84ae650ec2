"""What commands print for programs."""

import json
import sys
from typing import Any

import typer

from rldrill.render.encodable import shows_all


def print_json(data: Any) -> None:
    """Print data as JSON; where the output is not in UTF-8, all that is not ASCII is escaped."""
    typer.echo(json.dumps(data, ensure_ascii=not shows_all(sys.stdout.encoding), indent=2))
