"""The audit: every answer held against an independent solver, every draw against what an examiner demands of it."""
