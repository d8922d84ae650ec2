"""Files that hold a model: tables (CSV, TSV, Markdown), arrays (.npz), JSON in some forms, pomdp-solve's format."""

import zipfile
import zlib
from pathlib import Path
from typing import Any

from rldrill.files import MODEL_SUFFIXES, brief, kind_of, parse, read_bytes, read_text, shown
from rldrill.problems.errors import FileError
from rldrill.problems.habits import ALSO
from rldrill.problems.pomdp_format import read_pomdp
from rldrill.problems.transition_tables import read_markdown_table, read_records, read_transition_table

_LARGEST = 10 * 10**6  # bytes of unpacked arrays


def read_model(path: str | Path) -> dict[str, Any]:
    """A model as problem files have it; ``discount`` stands beside it where the format has one.

    Raises:
        FileError: the file cannot be read, or says what a model cannot.
    """
    suffix = Path(path).suffix.lower()
    try:
        if suffix == ".npz":
            return _arrays(path)
        text = read_text(path, MODEL_SUFFIXES)
        if suffix in (".csv", ".tsv"):
            return read_transition_table(text)
        if suffix == ".md":
            return read_markdown_table(text)
        return read_pomdp(text) if suffix in (".pomdp", ".mdp") else _data(parse(text, path))
    except ValueError as error:
        raise FileError(f"{shown(path)}: {error}.") from None


def _data(data: object) -> dict[str, Any]:
    """JSON: a model as problem files have it, a list of transitions, or Gymnasium's table P for itself."""
    if isinstance(data, list):
        if data and all(isinstance(row, dict) for row in data):
            return read_records(data)
        return {"transitions": data}
    if not isinstance(data, dict):
        raise ValueError(f"a model is a table or a list of transitions, not {kind_of(data)}")
    if "family" in data:
        raise ValueError("this is a problem file; name a file that holds a model alone, or solve this one")
    return {"P": data} if data and all(isinstance(row, dict) for row in data.values()) else data


def _arrays(path: str | Path) -> dict[str, Any]:
    """The arrays P and R of a file of numpy's, as lists."""
    import io

    import numpy as np

    content = io.BytesIO(read_bytes(path, MODEL_SUFFIXES))
    try:
        with zipfile.ZipFile(content) as packed:
            if sum(member.file_size for member in packed.infolist()) > _LARGEST:
                raise ValueError(f"the arrays are larger than {_LARGEST // 10**6} MB; write a smaller model")
        with np.load(content, allow_pickle=False) as arrays:
            return {name: _listed(arrays[name]) for name in arrays.files}
    except (zipfile.BadZipFile, zlib.error, RuntimeError, MemoryError, EOFError, KeyError, OSError):
        raise ValueError("this is no file of numpy's; write it with np.savez(path, P=P, R=R)") from None
    except ValueError as error:
        if "pickle" in str(error):
            raise ValueError(
                "it holds Python objects, which are not read; write arrays with np.savez(path, P=np.stack(P), R=R)"
            ) from None
        raise


def _listed(array: object) -> Any:
    import numpy as np

    if not isinstance(array, np.ndarray):  # numpy hands over what else is packed as it is
        raise KeyError
    return array.tolist()


def with_files(given: object, folder: Path) -> object:
    """Givens with the models that they name: ``{file = "model.csv"}``, seen from the folder of the problem file.

    What stands beside ``file`` goes before what it holds. A discount that it has is the problem's, unless that has one.

    Raises:
        FileError: such a file cannot be read, or says what a model cannot.
    """
    if not isinstance(given, dict):
        return given
    read: dict[str, Any] = {}
    for key, value in given.items():
        if key == "mdp" and isinstance(value, str) and value.lower().endswith(tuple(MODEL_SUFFIXES)):
            value = {"file": value}
        if not (isinstance(value, dict) and "file" in value):
            read[key] = value
            continue
        if not isinstance(value["file"], str):
            raise FileError(f"given.{key}.file: must be the name of a file, not {brief(value['file'])}.")
        model = read_model(folder / value["file"])
        if "discount" in model and "gamma" not in {ALSO.get(str(name), name) for name in given}:
            read["gamma"] = model["discount"]
        beside = {name: field for name, field in value.items() if name != "file"}
        read[key] = {name: field for name, field in model.items() if name != "discount"} | beside
    return read
