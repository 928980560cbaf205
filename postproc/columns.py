"""Reads the program's CSV files, for the plots."""

import csv


def read_columns(path):
    """Columns by name as lists of numbers; lines that begin with # are comments."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    if not rows:
        raise SystemExit(f"{path} has no rows")
    return {name: [float(row[name]) for row in rows] for name in rows[0]}
