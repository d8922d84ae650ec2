"""Time zones that this process is in for a while."""

import os
import time
from collections.abc import Iterator
from contextlib import contextmanager
from unittest.mock import patch

import pytest


@contextmanager
def zone(name: str) -> Iterator[None]:
    """Be in the zone of that name.

    Windows has one zone for all processes and no ``tzset``: only there the test is passed over, and the others, of
    ``.ci/run`` among them, run it.
    """
    if not hasattr(time, "tzset"):
        pytest.skip("the zone of a process cannot be set here")
    try:
        with patch.dict(os.environ, TZ=name):
            time.tzset()
            yield
    finally:
        time.tzset()
