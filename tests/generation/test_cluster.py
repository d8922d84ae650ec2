"""Problems in bulk on a cluster: a worker that is killed changes nothing."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).parents[2] / "benchmarks" / "cluster.py"


def test_a_killed_worker_changes_nothing() -> None:
    pytest.importorskip("distributed", reason="an extra; CI has it")
    done = subprocess.run([sys.executable, str(SCRIPT), "200"], capture_output=True, text=True, timeout=120)
    assert done.returncode == 0, done.stderr
    assert "killed worker" in done.stdout
    assert done.stdout.endswith("the same lines\n")
