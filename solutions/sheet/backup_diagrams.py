"""Section 8 of the sheet: backup diagrams, which are pictures only."""

from rldrill.problems.backups import backup_diagram
from rldrill.solutions.sheet import Gallery

GALLERY = Gallery(
    (
        backup_diagram("bellman-v", title="$V^π$"),
        backup_diagram("bellman-q", title="$Q^π$"),
        backup_diagram("bellman-optimality-v", title="$V^*$"),
        backup_diagram("bellman-optimality-q", title="$Q^*$"),
        backup_diagram("q-learning", title="Q-learning"),
    ),
    "Open circles are states, filled dots are actions, an arc across branches is a maximum.",
)
