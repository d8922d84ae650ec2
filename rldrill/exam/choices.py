"""What can be chosen of an exam and its pages: the words that blueprints, manifests and the command line share."""

from typing import Literal, TypeAlias

Language: TypeAlias = Literal["en", "de"]
DecimalMark: TypeAlias = Literal[".", ","]
Paper: TypeAlias = Literal["a4", "letter"]
#: How much room there is for working.
Space: TypeAlias = Literal["none", "tight", "normal", "wide"]
#: Whether there are keys, and whether beside the exam or in it.
Solutions: TypeAlias = Literal["none", "inline", "separate"]
#: Whether a table counts as a whole, or each of its entries.
Partial: TypeAlias = Literal["all", "entries"]
