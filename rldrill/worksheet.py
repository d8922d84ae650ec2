"""Worksheets: versions of the same length and difficulty that share no problem, their keys and their manifest."""

import json
import re
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from itertools import islice
from pathlib import Path
from typing import Any

from rldrill import __version__
from rldrill.exercise import Exercise, draw
from rldrill.paper import Paper, page_setup, pdf, write_bytes_atomically
from rldrill.problems import parts
from rldrill.problems.document import Document, Equation
from rldrill.problems.errors import UsageError
from rldrill.problems.family import Family
from rldrill.problems.mathematics import Fence, Glyph, Math, listed, mathematics, name, row, typeset_exponent
