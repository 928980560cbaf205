"""A bar is pulled step by step in this process until it breaks; then back to the state before.

    ./pfdm python cases/python/bar_steps.py

Each step tells the force; the fields are arrays of NumPy without copies.
"""

from pathlib import Path

import pfdm

case = pfdm.Case(Path(__file__).parents[1] / "bar_at2", {"mesh.x[0].cells": 51, "fracture.length": "10 mm"})
area = 1.0  # [mm^2]

with pfdm.FractureRun(case) as run:
    greatest, before = 0.0, run.state
    for row in run:
        if run.damage.max() > 0.9:
            break
        greatest, before = max(greatest, row["force_x_N"]), run.state
    broken = run.cell_centres[run.damage > 0.5, 0]
    print(f"breaks at {1e6 * row['displacement_m']:.1f} um, strength {greatest / area:.3f} N/mm2")
    print(f"damage above 0.5 from {1e3 * broken.min():.1f} to {1e3 * broken.max():.1f} mm")

    run.restore(before)
    print(f"before: step {run.state.step}, largest damage {run.damage.max():.2f}, "
          f"stress {1e-6 * run.stress[:, 0, 0].mean():.3f} N/mm2")
