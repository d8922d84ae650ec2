"""Problem files: the family and the givens, as TOML or JSON."""

from pathlib import Path
from typing import Any

from rldrill.files import brief, kind_of, read_data, shown
from rldrill.problems.catalogue import family
from rldrill.problems.complaints import nearest
from rldrill.problems.errors import FileError

#: The version of the JSON that ``Exercise.data`` gives and that problem files have.
FORMAT = 1
_IGNORED = frozenset({"format", "id", "level", "question", "parts", "steps"})


def schema_of(name: str) -> dict[str, Any]:
    """The JSON Schema of the problem files of a family, for editors and other programs.

    It is that of a file that holds its model itself, and names no other file (``{ file = "model.csv" }``). It has the
    fields' own names; other names that are read as well (``discount`` for ``gamma``) are not in it.

    Raises:
        UsageError: there is no such family.
    """
    wanted = family(name)
    given = wanted.written_schema()
    hoisted = {"$defs": given.pop("$defs")} if "$defs" in given else {}
    return {
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": f"A problem file of {wanted.name}",
        "description": wanted.summary,
        "type": "object",
        "properties": {"format": {"const": FORMAT}, "family": {"const": wanted.name}, "given": given}
        | {key: {} for key in sorted(_IGNORED - {"format"})},
        "required": ["family", "given"],
        "additionalProperties": False,
    } | hoisted


def read_problem(path: str | Path) -> dict[str, Any]:
    """The family and the givens that a problem file (TOML or JSON) holds.

    What ``rldrill show ID --json`` writes beside them is passed over. A model may lie in a file of its own, named
    from the folder of the problem file.

    Raises:
        FileError: the file cannot be read, or is not a problem file.
    """
    data = read_data(path)
    where = shown(path)
    if not isinstance(data, dict):
        raise FileError(f"{where}: a problem file is a table with 'family' and 'given', not {kind_of(data)}.")
    version = data.get("format", FORMAT)
    if type(version) is not int or version != FORMAT:
        raise FileError(
            f"{where}: its format is {brief(version)}, and this release reads format {FORMAT}; "
            "write the file again with this release's 'rldrill show ID --json'."
        )
    unknown = [key for key in data if key not in _IGNORED | {"family", "given"}]
    if unknown:
        near = nearest(unknown[0], ("family", "given"))
        raise FileError(
            f"{where}: {brief(unknown[0])} is not a field of a problem file{near}; givens stand under 'given'."
        )
    problem = {key: data[key] for key in ("family", "given") if key in data}
    if "given" in problem:
        from rldrill.model_file import with_files

        try:
            problem["given"] = with_files(problem["given"], Path(path).parent)
        except FileError as error:
            raise FileError(f"{where}: {error}") from None
    return problem
