"""``python -m rldrill``."""

from rldrill.cli import main

main()
