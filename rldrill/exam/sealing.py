"""Sealed exams: a secret decides what is drawn, so that whoever has rldrill cannot draw the exam again without it."""

import hmac
import os
import secrets
from hashlib import sha256
from pathlib import Path

from rldrill.files import shown
from rldrill.problems.draws import Draws
from rldrill.problems.errors import FileError, reason

#: A shorter secret could be found by trying all; a longer file is no secret but something else.
_LEAST, _MOST = 16, 4096
#: What the codes of versions are written with: capitals and digits that nobody takes for others, and no vowels.
_SIGNS = "CDFGHJKMNPQRTVWXY34679"
_LENGTH = 6


class Secret:
    """A secret that is mixed into every draw.

    Args:
        key: the bytes that nobody else knows.
    """

    def __init__(self, key: bytes) -> None:
        self._key = key

    def mixed(self, text: str) -> str:
        """The HMAC-SHA256 of the secret and a text, in hexadecimal."""
        return hmac.new(self._key, text.encode(), sha256).hexdigest()

    def draws(self, key: str) -> Draws:
        """The stream of choices that an exam without a secret draws by this key."""
        return Draws(self.mixed(key))

    def codes(self, seed: int, number: int) -> tuple[str, ...]:
        """Codes for so many versions, all different; they tell neither how many there are nor which comes first."""
        found: dict[str, None] = {}
        for index in range(number):
            draws = self.draws(f"code {seed} version {index}")
            while (code := "".join(draws.choice(_SIGNS) for _ in range(_LENGTH))) in found:
                pass
            found[code] = None
        return tuple(found)


def read_secret(path: Path) -> tuple[Secret, bool]:
    """The secret in a file, without the line end that editors put there; and whether it was made just now.

    A file that is not there is written, for its owner's eyes alone, with 256 random bits.

    Raises:
        FileError: the file cannot be read or written, or what it holds is no secret.
    """
    where = shown(path)
    try:
        with path.open("rb") as file:
            key = file.read(_MOST + 1).strip()
    except FileNotFoundError:
        return _fresh(path), True
    except OSError as error:
        raise FileError(f"{where}: the secret cannot be read ({reason(error)}); name another file.") from None
    if len(key) > _MOST:
        raise FileError(f"{where}: a secret has at most {_MOST} bytes; name a file that holds nothing else.")
    if len(key) < _LEAST:
        raise FileError(
            f"{where}: a secret of {len(key)} bytes is found by trying, and at least {_LEAST} are needed; "
            "name a file that is not there, and one is made."
        )
    return Secret(key), False


def _fresh(path: Path) -> Secret:
    key = secrets.token_hex(32)
    try:
        with os.fdopen(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o600), "w", encoding="ascii") as file:
            file.write(f"{key}\n")
    except OSError as error:
        raise FileError(f"{shown(path)}: a secret cannot be written there ({reason(error)}); name another.") from None
    return Secret(key.encode())
