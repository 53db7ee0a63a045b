"""Figures of a record: from the rows that `amb export --csv` writes."""

MEASURES = {}
