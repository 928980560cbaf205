#!/usr/bin/env python3
"""Twin data of cases/plate_fit: what a run of cases/plate_ambient computes, every second row, with noise.

    make_synthetic.py ../../plate_ambient/results     # writes synthetic_H1.csv and synthetic_rise.csv here
"""
import csv
import math
import pathlib
import random
import sys

HEAD = "# synthetic: computed by plate_ambient, with noise of {}; not measured\n"


def rows_of(file):
    lines = [line for line in file.read_text().splitlines() if not line.startswith("#")]
    return list(csv.DictReader(lines))


def main():
    results, here = pathlib.Path(sys.argv[1]), pathlib.Path(__file__).parent
    noise = random.Random(1)
    with open(here / "synthetic_H1.csv", "w") as file:
        file.write(HEAD.format("2 % (magnitude) and 0.02 (phase)") + "frequency_Hz,magnitude,phase_rad\n")
        for row in rows_of(results / "response.csv")[::2]:
            magnitude = float(row["centre_H1_magnitude"]) * math.exp(noise.gauss(0.0, 0.02))
            phase = float(row["centre_H1_phase_rad"]) + noise.gauss(0.0, 0.02)
            file.write(f"{float(row['frequency_Hz']):.4f},{magnitude:.5f},{phase:.5f}\n")
    with open(here / "synthetic_rise.csv", "w") as file:
        file.write(HEAD.format("0.02 K") + "time_s,rise_K\n")
        for row in rows_of(results / "temperature.csv")[::4]:
            rise = float(row["surface_mean_rise_K"]) + noise.gauss(0.0, 0.02)
            file.write(f"{float(row['time_s']):.0f},{rise:.4f}\n")


if __name__ == "__main__":
    main()
