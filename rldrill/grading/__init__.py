"""Files of answers: how they are read and judged, and the report."""
