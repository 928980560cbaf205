"""What the plots share: reading the program's CSV files, the look of a picture."""

import csv

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt


def read_columns(path):
    """Columns by name as lists of numbers; lines that begin with # are comments."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
    if not rows:
        raise SystemExit(f"{path} has no rows")
    return {name: [float(row[name]) for row in rows] for name in rows[0]}


def new_picture(height=4.0):
    return plt.subplots(figsize=(6.0, height), constrained_layout=True)


def save_picture(figure, axes, x_label, y_label, path):
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.grid(alpha=0.3)
    axes.legend(frameon=False)
    figure.savefig(path, dpi=160)
    print(path)
