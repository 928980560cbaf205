#!/usr/bin/env python3
"""Verdicts of pfdm fit on vibration records: wrong records, wrong models, and right ones.

    vibration_corpus.py build/release/cases/program/pfdm records            24 wrong records, swept and random
    vibration_corpus.py build/release/cases/program/pfdm models             12 wrong models, some in random motion too
    vibration_corpus.py build/release/cases/program/pfdm right --number 40  right ones, at 40 and at 60 dB

None of the wrong ones may be "sound"; each has to be named by its reason, or refused. Records are made by
vibration_simulator.py, which shares nothing with the program."""

import argparse
import functools
import pathlib
import re
import sys
import tempfile

import numpy as np
from scipy.signal import butter, sosfilt

from fits_over_seeds import judged
from vibration_simulator import (DAMPING, MASS, OMEGA, RATE, SCALE, STIFFNESS, VELOCITY, Random, Sample, Sweep,
                                 integrated, linear, noisy, polynomial)

G0 = 9.80665
QUINTIC = [-0.05, -0.04, 0.008, 0.008]  # of model 2, relative to k1
DOUBT = r"moves with|leaves .* of the response|misfit is|no passive|not passive|no bounded"


# ---- Wrong records: base, relative -> the same with one fault; and the reason that is expected

class Test:
    """A clean record and what else faults need."""

    def __init__(self, swept):
        self.swept, self.base, self.rate = swept, Sweep() if swept else Random(duration=12.0), RATE
        self.structure = "2" if swept else "1"
        self.sample = Sample(polynomial(QUINTIC)) if swept else Sample()

    def record(self, sample=None):
        if sample is None:
            return self.clean()
        if not self.swept and not sample.force:
            return linear(sample, self.base)
        y, z = integrated([sample], self.base)
        return y, z[0]

    @functools.cache
    def clean(self):
        return self.record(self.sample)

    def time(self, x):
        return np.arange(len(x)) / self.rate


@functools.cache
def clean_test(swept):
    return Test(swept)


def rms(x):
    return np.sqrt(np.mean(np.asarray(x)**2))


def delayed(x, samples):
    """By a fraction of a sample too."""
    frequency = np.fft.rfftfreq(2 * len(x))
    spectrum = np.fft.rfft(x, 2 * len(x))
    return np.fft.irfft(spectrum * np.exp(-2j * np.pi * frequency * samples))[:len(x)]


def dead_half(y, z, test):
    z = z.copy()
    z[len(z) // 2:] = 0.0
    return y, z


def hum(y, z, test):
    t = test.time(z)
    line = sum(np.sin(2 * np.pi * 50.0 * h * t + h) / h for h in (1, 3, 5, 7))
    return y + 0.03 * rms(y) * line, z + 0.03 * rms(z) * line


def drift(y, z, test):
    t = test.time(z)
    return y, z + 1.0 * rms(z) * (np.exp(-t / 2.0) - 0.3)


def dropouts(y, z, test):
    z = z.copy()
    for at in np.random.default_rng(5).integers(0, len(z) - 60, 25):
        z[at:at + 40] = z[at]
    return y, z


def missing(z, at=0.4, n=14):
    i = int(at * len(z))
    return np.concatenate([z[:i], z[i + n:]])


def missing_in_one(y, z, test):
    z = missing(z)
    return y[:len(z)], z


def missing_in_both(y, z, test):
    return missing(y), missing(z)


def rattle(y, z, test):
    """A short ring at 900 Hz whenever the response passes most of its range."""
    above = z > 0.7 * np.max(z[len(z) // 10:-len(z) // 10])
    starts = np.flatnonzero(above[1:] & ~above[:-1])
    t = np.arange(60) / test.rate
    ring = 0.5 * rms(z) * np.exp(-t / 2e-3) * np.sin(2 * np.pi * 900.0 * t)
    z = z.copy()
    for i in starts[starts < len(z) - 60]:
        z[i:i + 60] += ring
    return y, z


def saturated(y, z, test):
    limit = 1.5 * np.max(np.abs(z)) if test.swept else 3.0 * rms(z)
    return y, limit * np.tanh(z / limit)


def quantised(y, z, test):
    step = 2 * np.max(np.abs(z)) / 2**6
    return y, step * np.round(z / step)


def aliased(y, z, test):
    """A strong tone of a switched power supply at 5.78 kHz, sampled without a filter."""
    tone = np.sin(2 * np.pi * 5780.0 * test.time(z) + 1.0)
    return y + 0.05 * rms(y) * tone, z + 0.05 * rms(z) * tone


def low_excitation(y, z, test):
    return noisy(y, z, 6.0, 17)


def changed_unit(y, z, which):
    return (y / G0, z) if which == "base" else (y, z / G0)


RECORDS = {
    "sign_base": (lambda y, z, test: (-y, z), "sign"),
    "sign_relative": (lambda y, z, test: (y, -z), "sign"),
    "absolute": (lambda y, z, test: (y, z + y), "absolute"),
    "skew": (lambda y, z, test: (y, delayed(z, 1.0)), "behind"),
    "skew_of_half_a_sample": (lambda y, z, test: (y, delayed(z, 0.5)), "behind"),
    "dead_half": (dead_half, "dead"),
    "clipped": (lambda y, z, test: (y, np.clip(z, -0.6 * np.max(z), 0.6 * np.max(z))), "clipped"),
    "unit_of_relative": (lambda y, z, test: changed_unit(y, z, "relative"), "unit"),
    "unit_of_base": (lambda y, z, test: changed_unit(y, z, "base"), "unit"),
    "wrong_rate": (None, "sampling rate|band"),
    "swapped": (lambda y, z, test: (z, y), "swapped|exchanged"),
    "hum": (hum, "hum|tone"),
    "drift": (drift, "drift"),
    "dropouts": (dropouts, "dropout|constant"),
    "saturation": (saturated, "saturat|compress|" + DOUBT),
    "missing_in_one": (missing_in_one, "missing|behind"),
    "missing_in_both": (missing_in_both, "missing|jump|at [0-9.]+ s"),
    "low_excitation": (low_excitation, "of the response"),
    "another_mass": (None, "mass|changed"),
    "two_resonances": (None, DOUBT),
    "rattle": (rattle, "rattle|burst|" + DOUBT),
    "heating": (None, "changes|" + DOUBT),
    "quantised": (quantised, "quanti|steps"),
    "aliasing": (aliased, "alias|tone"),
}


def two_masses(stiff=0.15, frequency=330.0):
    """Internal states x, v of a mass on the first one."""
    m2 = stiff * STIFFNESS / (2 * np.pi * frequency)**2
    k2, c2 = stiff * STIFFNESS, 2 * 0.02 * m2 * 2 * np.pi * frequency

    def force(t, z, v, w, base):
        own = k2 * (w[0] - z) + c2 * (w[1] - v)
        return -own, [w[1], -base(t) - own / m2]
    return force


def wrong_record(name, test):
    """[(base, relative)], rates, and text of the record that deviates."""
    change, _ = RECORDS[name]
    if name == "low_excitation":
        return [change(*test.record(), test)], {}
    if name == "another_mass":
        other = Sample(test.sample.k, mass=1.4)
        pairs = [test.record(), test.record(other)]
    elif name == "two_resonances":
        drive = test.base.spline() if not test.swept else test.base
        own = two_masses()
        sample = Sample(test.sample.k, force=lambda t, z, v, w: own(t, z, v, w, drive), internal=2)
        pairs = [test.record(sample)]
    elif name == "heating":
        duration = test.base.duration
        soft = lambda t, z, v, w: (-0.06 * STIFFNESS * t / duration * z, np.zeros((0, 1)))
        pairs = [test.record(Sample(test.sample.k, force=soft))]
    else:
        pairs = [test.record()]
    pairs = [noisy(y, z, 40.0, 3 + i) for i, (y, z) in enumerate(pairs)]
    if change:
        pairs = [change(y, z, test) for y, z in pairs]
    return pairs, {"rate": 5000.0} if name == "wrong_rate" else {}


# ---- Wrong models: samples that the structure fitted does not have

def bouc_wen():
    yielding = 1e-4

    def force(t, z, v, w):
        return 0.15 * STIFFNESS * yielding * w[0], [(v - 0.5 * np.abs(v) * w[0] - 0.5 * v * np.abs(w[0])) / yielding]
    return Sample([0.85 * STIFFNESS], 0.5 * DAMPING, force=force, internal=1)


def coulomb():
    return Sample([STIFFNESS], 0.7 * DAMPING, force=lambda t, z, v, w: (12.0 * np.tanh(v / 2e-3), np.zeros((0, 1))))


def fractional():
    """A springpot of order 0.4 by 16 Maxwell elements, over five decades."""
    alpha = np.logspace(0.5, 5.5, 16)
    beta = np.sin(0.4 * np.pi) / np.pi * alpha**0.4 * np.log(alpha[1] / alpha[0])
    return Sample([0.7 * STIFFNESS], 0.0, alpha=list(alpha), beta=list(0.3 * STIFFNESS / OMEGA**0.4 * beta))


def backlash():
    gap = 1.5e-5
    return Sample([0.2 * STIFFNESS], DAMPING,
                  force=lambda t, z, v, w: (0.8 * STIFFNESS * (z - np.clip(z, -gap, gap)), np.zeros((0, 1))))


def bilinear():
    return Sample([0.85 * STIFFNESS], DAMPING,
                  force=lambda t, z, v, w: (0.3 * STIFFNESS * np.maximum(z, 0.0), np.zeros((0, 1))))


def mullins():
    """Softer after the largest displacement so far."""
    def force(t, z, v, w):
        largest = w[0]
        return -0.15 * STIFFNESS * z * (1 - np.exp(-largest / SCALE)), [np.where(np.abs(z) > largest, np.abs(v), 0.0)]
    return Sample([STIFFNESS], DAMPING, force=force, internal=1)


def pair():
    omega = 2 * np.pi * 220.0
    return Sample([STIFFNESS], 0.5 * DAMPING, alpha=[0.15 * omega + 1j * omega], beta=[(0.1 + 0.0045j) * STIFFNESS])


def two_terms():
    return Sample([0.75 * STIFFNESS], 0.5 * DAMPING, alpha=[400.0, 3000.0], beta=[0.12 * STIFFNESS, 0.25 * STIFFNESS])


def double_mass(base):
    own = two_masses(0.08, 180.0)
    drive = base.spline() if hasattr(base, "spline") else base
    return Sample(force=lambda t, z, v, w: own(t, z, v, w, drive), internal=2)


MODELS = {  # sample, structure fitted in sweeps, in random motion
    "bouc_wen": (bouc_wen, "2", "1"),
    "coulomb_friction": (coulomb, "2", "1"),
    "fractional": (fractional, "2", "1"),
    "two_masses": (double_mass, "2", "1"),
    "backlash": (backlash, "2", "1"),
    "bilinear": (bilinear, "2", "1"),
    "mullins": (mullins, "2", None),
    "pair_by_a_real_term": (pair, "4b", "linear_4b"),
    "kernel_by_none": (two_terms, "2", "1"),
    "quintic_by_linear": (lambda: Sample(polynomial(QUINTIC)), "1", "1"),
    "nonlinear_damping_by_linear": (lambda: Sample(polynomial(QUINTIC), DAMPING / 0.72, 1.8), "2", None),
    "quadratic_damping_by_linear": (lambda: Sample(c=DAMPING, exponent=1.0), "2", "1"),
}


def wrong_model(name, swept):
    make, in_sweeps, in_random = MODELS[name]
    structure = in_sweeps if swept else in_random
    if structure is None:
        return None
    base = Sweep() if swept else Random(duration=12.0)
    sample = make(base) if make is double_mass else make()
    if not sample.force and not sample.exponent and len(sample.k) == 1:
        y, z = linear(sample, base)
    else:
        y, rows = integrated([sample], base)
        z = rows[0]
    return noisy(y, z, 40.0, 4), structure


# ---- Right ones

def right_samples(kind, number, draw):
    """Parameters vary by a tenth to a fifth."""
    some = lambda width: 1 + width * (2 * draw.random() - 1)
    for _ in range(number):
        first, c = STIFFNESS * some(0.2), DAMPING * some(0.2)
        if kind == "1":
            yield Sample([first], c)
        if kind == "2":
            yield Sample(polynomial([r * some(0.2) for r in QUINTIC], first), c)
        if kind == "3":
            yield Sample(polynomial([r * some(0.2) for r in QUINTIC], first), c / 0.72, 1.8 * some(0.1))
        if kind == "4b":
            yield Sample(polynomial([r * some(0.2) for r in QUINTIC], 0.8 * first), 0.5 * c, alpha=[900.0 * some(0.2)],
                         beta=[0.25 * first])


def right_records(number):
    """name, structure, swept, clean record: as many swept of models 1, 2, 3 and 4b, and random of model 1 and 4b."""
    kinds = [("1", False), ("2", True), ("3", True), ("4b", True), ("linear_4b", False)]
    draw = np.random.default_rng(1)
    for i, (kind, swept) in enumerate(kinds):
        share = number // len(kinds) + (i < number % len(kinds))
        if swept:
            y, rows = integrated(list(right_samples(kind, share, draw)), Sweep())
            records = [(y, z) for z in rows]
        elif kind == "1":
            records = [linear(s, Random(seed=10 + j)) for j, s in enumerate(right_samples("1", share, draw))]
        else:
            records = [linear(two_terms(), Random(seed=30 + j)) for j in range(share)]
        for j, record in enumerate(records):
            yield f"model_{kind}_{'sweep' if swept else 'random'}_{j + 1}", kind, swept, record


# ---- Cases and fits

def write_case(folder, structure, swept, pairs, rate=None, kernel_order=None, replicates=50):
    folder.mkdir(parents=True, exist_ok=True)
    base = Sweep if swept else Random
    text = f'kind = "mass_material"\ntitle = "corpus (synthetic)"\n[model]\nstructure = "{structure}"\n'
    text += f'mass = "{MASS} kg"\nreference_velocity = "{VELOCITY} m/s"\n[sampling]\nrate = "{RATE} Hz"\n'
    for i, (y, z) in enumerate(pairs):
        rows = np.column_stack([y, z])
        np.savetxt(folder / f"record_{i + 1}.csv", rows, "%.9g", ",", comments="",
                   header="# synthetic: simulated, not measured\nbase_acceleration,relative_acceleration\nm/s^2,m/s^2")
        text += f'[[test]]\nname = "test_{i + 1}"\nrecord = {{ file = "record_{i + 1}.csv", '
        text += f'rate = "{rate or RATE} Hz", from = "{base.low} Hz", to = "{base.high} Hz" }}\n'
    text += f"[fit]\nreplicates = {replicates}\n"
    if kernel_order is not None:
        text += f"kernel_order = {kernel_order}\n"
    (folder / "case.toml").write_text(text, encoding="utf-8")


class Tally:
    def __init__(self):
        self.lines, self.bad = [], 0

    def add(self, name, verdict, reasons, seconds, good):
        self.bad += not good
        print(f"{'' if good else 'NOT AS IT SHOULD BE '}{name}: {verdict}, {seconds:.1f} CPU s")
        for reason in reasons:
            print(f"    {reason}")
        sys.stdout.flush()


def run_wrong(options, folder, names, make, tally):
    for name in names:
        for swept in (True, False):
            label = f"{name}, {'sweep' if swept else 'random'}"
            if options.only and not re.search(options.only, label):
                continue
            place = folder / label.replace(", ", "_")
            reason = make(name, swept, place)
            if reason is None:
                continue
            verdict, reasons, seconds = judged(options.pfdm, place)
            named = verdict == "failed" or any(re.search(reason, r) for r in reasons)
            tally.add(label, verdict, reasons, seconds, verdict != "sound" and named)


def make_wrong_record(name, swept, place):
    if not (place / "case.toml").exists():
        test = clean_test(swept)
        pairs, settings = wrong_record(name, test)
        write_case(place, test.structure, swept, pairs, **settings)
    return RECORDS[name][1]


def make_wrong_model(name, swept, place):
    if MODELS[name][1 if swept else 2] is None:
        return None
    if not (place / "case.toml").exists():
        record, structure = wrong_model(name, swept)
        order = 1 if name == "pair_by_a_real_term" else None
        write_case(place, structure, swept, [record], kernel_order=order)
    return DOUBT


def run_right(options, folder, tally):
    counts = {}
    for name, structure, swept, (y, z) in right_records(options.number):
        for decibel in (40, 60):
            label = f"{name}_{decibel}dB"
            if options.only and not re.search(options.only, label):
                continue
            place = folder / label
            if not (place / "case.toml").exists():
                write_case(place, structure, swept, [noisy(y, z, decibel, sum(map(ord, label)) + 1000 * decibel)])
            verdict, reasons, seconds = judged(options.pfdm, place)
            tally.add(label, verdict, reasons, seconds, verdict == "sound")
            key = (name.rsplit("_", 1)[0], decibel, verdict)
            counts[key] = counts.get(key, 0) + 1
    for (kind, decibel, verdict), count in sorted(counts.items()):
        print(f"{kind}, {decibel} dB: {count} {verdict}")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("pfdm", type=pathlib.Path)
    parser.add_argument("what", choices=("records", "models", "right"))
    parser.add_argument("--number", type=int, default=40, help="of right records, at each level of noise")
    parser.add_argument("--only", help="regular expression of the names")
    parser.add_argument("--keep", type=pathlib.Path, help="folder of the cases, to use again; default: none")
    options = parser.parse_args()
    options.pfdm = options.pfdm.resolve()
    with tempfile.TemporaryDirectory() as temporary:
        folder, tally = (options.keep or pathlib.Path(temporary)) / options.what, Tally()
        if options.what == "records":
            run_wrong(options, folder, RECORDS, make_wrong_record, tally)
        elif options.what == "models":
            run_wrong(options, folder, MODELS, make_wrong_model, tally)
        else:
            run_right(options, folder, tally)
    print(f"{tally.bad} not as they should be")
    return 1 if tally.bad else 0


if __name__ == "__main__":
    sys.exit(main())
