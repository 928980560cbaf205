"""One fit over many seeds of the noise: verdicts, and how often the 95 % intervals hold the truth."""

import json
import pathlib
import resource
import subprocess
import sys
import tempfile

import numpy as np


def judged(pfdm, folder):
    """Verdict ("refused" where the data are not read), reasons, CPU seconds."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    done = subprocess.run([pfdm, "fit", folder, "--quiet", "--threads", "1"], capture_output=True, text=True)
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    seconds = after.ru_utime - before.ru_utime
    if done.returncode == 2:
        return "refused", [done.stderr.strip()], seconds
    if done.returncode not in (0, 1):
        raise RuntimeError(f"{folder}: status {done.returncode}: {done.stderr}")
    if not (folder / "results/fit.json").exists():
        return "failed", [done.stderr.strip()], seconds
    fit = json.loads((folder / "results/fit.json").read_text(encoding="utf-8"))
    return fit["verdict"], fit["reasons"], seconds


def options_of(parser, number):
    """Adds what every study of coverage asks for, and parses."""
    parser.add_argument("--number", type=int, default=number, help="of fits")
    parser.add_argument("--first-seed", type=int, default=1, help="of the noise")
    parser.add_argument("--keep", type=pathlib.Path,
                        help="file of the fits' results, a line each: seeds that are in it are not fitted again")
    options = parser.parse_args()
    options.pfdm = options.pfdm.resolve()
    return options


class Tally:
    """`truth`: values by the names that fit.json has. `errors`: further figures, relative, of found and true values."""

    def __init__(self, truth, errors=None):
        self.truth, self.errors, self.seconds = truth, errors, 0.0
        self.verdicts, self.estimates, self.deviations, self.held, self.worst = {}, [], [], [], {}

    def add(self, verdict, parameters, seconds):
        found = {p["name"]: p["estimate"] for p in parameters}
        self.seconds += seconds
        same = found.keys() == self.truth.keys()
        self.verdicts[verdict, same] = self.verdicts.get((verdict, same), 0) + 1
        if not same:
            return
        self.estimates.append([found[name] for name in self.truth])
        by_name = {p["name"]: p for p in parameters}
        if verdict.startswith("sound"):  # others have no intervals
            self.held.append([by_name[n]["lower"] <= t <= by_name[n]["upper"] for n, t in self.truth.items()])
            self.deviations.append([by_name[n]["standard_error"] for n in self.truth])
        for name, error in (self.errors(found, self.truth) if self.errors else {}).items():
            self.worst[name] = max(self.worst.get(name, 0.0), abs(error))

    def say(self, number):
        print(f"{number} fits, {self.seconds / number:.1f} CPU s each: " + ", ".join(
            f"{n} {verdict} with {'the terms of the truth' if same else 'OTHER TERMS'}"
            for (verdict, same), n in self.verdicts.items()))
        if self.worst:
            print("largest error: " + ", ".join(f"{name} {100 * e:.3g} %" for name, e in self.worst.items()))
        if len(self.held) < 2:
            return
        estimates, stated = np.array(self.estimates), np.sqrt(np.mean(np.square(self.deviations), axis=0))
        for i, (name, true) in enumerate(self.truth.items()):
            scatter = estimates[:, i].std(ddof=1)
            print(f"{name:>32} held in {np.sum(self.held, axis=0)[i]} of {len(self.held)}; mean error "
                  f"{(estimates[:, i].mean() - true) / scatter:+.2f} and stated standard error {stated[i] / scatter:.2f} "
                  f"of the scatter, which is {100 * scatter / abs(true):.3g} %")
        sys.stdout.flush()


def study_of(options):
    """What tells the fits of one study from those of another."""
    own = {"number", "first_seed", "keep", "pfdm"}
    return {name: value if isinstance(value, (int, float)) else str(value)
            for name, value in vars(options).items() if name not in own}


def kept_fits(file, study):
    """By their seed. Fits of another study, or of one that is not known, are refused."""
    if not file or not file.exists():
        return {}
    lines = [json.loads(line) for line in file.read_text(encoding="utf-8").splitlines()]
    for line in lines:
        if line.get("study") != study:
            sys.exit(f"{file}: seed {line['seed']} was fitted with {line.get('study', 'options that were not kept')}, "
                     f"not with {study}: keep these fits in another file")
    return {line["seed"]: line for line in lines}


def fitted(options, folder, write_case, seed):
    write_case(folder, seed)
    verdict, reasons, seconds = judged(options.pfdm, folder)
    file = folder / "results/fit.json"
    fit = json.loads(file.read_text(encoding="utf-8")) if file.exists() else {"parameters": []}
    file.unlink(missing_ok=True)
    return {"seed": seed, "verdict": verdict, "reasons": reasons, "parameters": fit["parameters"], "seconds": seconds}


def repeat(options, tally, write_case, every=20):
    """write_case(folder, seed) makes the case; the tally is printed after every so many fits."""
    study = study_of(options)
    kept = kept_fits(options.keep, study)
    with tempfile.TemporaryDirectory() as temporary:
        for number in range(1, options.number + 1):
            seed = options.first_seed + number - 1
            fit = kept.get(seed)
            if not fit:
                fit = fitted(options, pathlib.Path(temporary), write_case, seed)
                if options.keep:
                    with options.keep.open("a", encoding="utf-8") as file:
                        file.write(json.dumps({"study": study, **fit}) + "\n")
            if not fit["verdict"].startswith("sound"):
                print(f"seed {seed}: {fit['verdict']}: {'; '.join(fit['reasons'])}")
            tally.add(fit["verdict"], fit["parameters"], fit["seconds"])
            if number % every == 0 or number == options.number:
                tally.say(number)
