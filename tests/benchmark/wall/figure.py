"""The figure of the wall: CPU seconds over the error, a panel a problem."""

import math

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt

LOOKS = {("pfdm", ""): ("C0", "o", "pfdm"), ("dolfinx", ""): ("C3", "s", "dolfinx, linear"),
         ("dolfinx", "corrected"): ("C4", "^", "dolfinx, linear, toughness corrected"),
         ("dolfinx", "bilinear"): ("C1", "D", "dolfinx, bilinear"), ("dolfinx", "relaxed"): ("C2", "v", "dolfinx, over-relaxed")}


def largest_errors(rows, problem, key):
    """(error, CPU seconds) of each mesh, at the case's steps and tolerance: the largest of the problem's measures."""
    meshes = {}
    for row in rows:
        plain = row["steps"] == "1" and row["tolerance"] == "1"
        if row["problem"] == problem and (row["code"], row["variant"]) == key and plain and row["error"] != "":
            error, _ = meshes.get(row["mesh"], (0.0, 0.0))
            meshes[row["mesh"]] = max(error, abs(float(row["error"]))), float(row["cpu_s"])
    return [meshes[m] for m in sorted(meshes, key=float)]


def draw(rows, path):
    names = list(dict.fromkeys(row["problem"] for row in rows))
    if not names:
        return
    across = min(3, len(names))
    down = math.ceil(len(names) / across)
    picture, panels = plt.subplots(down, across, figsize=(3.4 * across, 3.0 * down), squeeze=False, constrained_layout=True)
    for panel, name in zip(panels.flat, names):
        for key, (colour, marker, label) in LOOKS.items():
            points = largest_errors(rows, name, key)
            if points:
                panel.loglog([100 * e for e, _ in points], [s for _, s in points], color=colour, marker=marker, label=label)
        doubt = max(float(row["doubt"]) for row in rows if row["problem"] == name)
        panel.axvline(100 * doubt, color="0.5", linestyle=":", label="half the difference of the limits")
        panel.set_title(name, fontsize=9)
        panel.set_xlabel("largest error [%]")
        panel.grid(alpha=0.3, which="both")
    for row in panels:
        row[0].set_ylabel("CPU seconds")
    for panel in panels.flat[len(names):]:
        panel.axis("off")
    shown = {label: line for panel in panels.flat for line, label in zip(*panel.get_legend_handles_labels())}
    picture.legend(shown.values(), shown.keys(), loc="upper center", bbox_to_anchor=(0.5, 0.0), ncol=3, frameon=False, fontsize=9)
    picture.savefig(path, dpi=130, bbox_inches="tight")
    print(path)
