#!/usr/bin/env python3
"""Makes the synthetic experiments of this case with SciPy, by tests/statistics/endochronic_coverage.py, whose law and tests
they are, and adds normal noise of 0.5 % of the rms of what each measured.

    cases/endochronic_creep/data/make_synthetic.py
"""

import pathlib
import sys

import numpy as np

HERE = pathlib.Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[2] / "tests/statistics"))

from endochronic_coverage import curves  # noqa: E402

if __name__ == "__main__":
    draw = np.random.default_rng(1)
    for test in curves("rates"):
        print(test.write(HERE, 0.005, draw))
