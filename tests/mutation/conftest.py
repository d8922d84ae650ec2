"""The modules of this folder belong to a script; its test finds them here."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parent))
