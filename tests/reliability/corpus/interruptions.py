#!/usr/bin/env python3
"""Kills the program at random moments and makes its system calls fail, and compares what comes with an unbroken run.

interruptions.py PROGRAM [--kills N] [--calls N] [--only NAME]: N kills in sum; of each system call of each job about N
calls, evenly over the job (0: all of them). After each the same command is given again and has to end with the unbroken
run's files. Needs strace. Exit status 1 if anything differs.
"""

import argparse
import json
import os
import random
import re
import shutil
import subprocess
import sys
import tempfile
import time
from collections import Counter
from pathlib import Path

import judge

REPOSITORY = Path(__file__).resolve().parents[3]
CALLS = {"write": "ENOSPC", "pwrite64": "ENOSPC", "fsync": "EIO", "rename": "ENOSPC", "openat": "ENOSPC",
         "mkdir": "ENOSPC",
         "unlink": "EIO", "unlinkat": "EIO", "ftruncate": "EIO"}
# What a run that goes on may count otherwise: times, memory, iterations and what was found already.
COUNTED = re.compile(r"seconds|memory|iterations|threads|runs|computed|found|started|version|date")
# Files that hold times, or what was said on the way: that they are there is all that is compared.
TIMED = re.compile(r"\.log$|index\.html$|\.pdf$|report\.png$|chain\.json$|^case\.|\.pfdm$")


def shipped(case, replacements):
    """The text of a shipped case with others in place of these parts."""
    text = (REPOSITORY / f"cases/{case}/case.toml").read_text()
    for old, new in {"#:schema ../case.schema.json\n": "", **replacements}.items():
        assert old in text, old
        text = text.replace(old, new)
    return text


def small_bar():
    return shipped("bar_at2", {"cells = 201": "cells = 41", "initial_increment = 0.01": "initial_increment = 0.05",
                               "maximum_increment = 0.01": "maximum_increment = 0.05"})


def with_outputs(text):
    planes = '\n[[cohesive.planes]]\nname = "middle"\npoint = ["50 mm", "0 mm", "0 mm"]\nnormal = [1, 0, 0]\n'
    planes += 'half_width = "20 mm"\n'
    return text.replace('[output]\n', '[output]\nframes_every = 2\n') + planes


def short_fit():
    """cases/bar_fit in 2 CPU seconds: 49 runs on fewer cells in longer steps."""
    return shipped("bar_fit", {"cells = 161": "cells = 21", "energy_release = 0.02 ": "energy_release = 0.1 ",
                               "finest_increment = 1e-3": "finest_increment = 1e-2"})


def make_jobs(folder):
    """(name, folder, command, command to go on) of small jobs."""
    (folder / "run").mkdir()
    (folder / "run/case.toml").write_text(with_outputs(small_bar()))
    yield "run", folder / "run", ["run"], ["run", "--restart"]
    (folder / "sweep").mkdir()
    sweep = '\n[sweep]\nmethod = "list"\n[[sweep.parameters]]\nkey = "materials.concrete.toughness"\n'
    sweep += 'values = ["90 J/m^2", "100 J/m^2", "110 J/m^2"]\n'
    (folder / "sweep/case.toml").write_text(small_bar() + sweep)
    yield "sweep", folder / "sweep", ["sweep"], ["sweep"]
    shutil.copytree(REPOSITORY / "cases/bar_fit", folder / "fit", ignore=shutil.ignore_patterns("results*"))
    (folder / "fit/case.toml").write_text(short_fit())
    yield "fit", folder / "fit", ["fit"], ["fit"]
    (folder / "chain/one").mkdir(parents=True)
    (folder / "chain/two").mkdir()
    (folder / "chain/one/case.toml").write_text(small_bar())
    (folder / "chain/two/case.toml").write_text(small_bar().replace("end = 1.0", "end = 0.3"))
    steps = '[[step]]\ncase = "one"\n[[step]]\ncase = "two"\n'
    (folder / "chain/case.toml").write_text('kind = "chain"\ntitle = "two bars"\n' + steps)
    yield "chain", folder / "chain", ["run"], ["run"]
    (folder / "report").mkdir()
    (folder / "report/case.toml").write_text(with_outputs(small_bar()))
    yield "report", folder / "report", ["report"], ["report"]


def leaves(value, path=""):
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, f"{path}.{key}")
    elif isinstance(value, list):
        for i, inner in enumerate(value):
            yield from leaves(inner, f"{path}[{i}]")
    else:
        yield path, value


def results_of(folder):
    """What a job leaves: bytes of its files, of JSON the leaves that are no counts."""
    found = {}
    for name, content in judge.content_of(folder).items():
        if TIMED.search(name):
            found[name] = b"is there"
        elif name.endswith(".json"):
            found[name] = sorted((k, repr(v)) for k, v in leaves(json.loads(content)) if not COUNTED.search(k))
        else:
            found[name] = content
    return found


def differences(a, b):
    return sorted(name for name in a.keys() | b.keys() if a.get(name) != b.get(name))


class Job:
    def __init__(self, program, name, folder, command, again):
        self.name, self.folder = name, folder
        self.command = [program, command[0], str(folder), *command[1:]]
        self.again = [program, again[0], str(folder), *again[1:]]
        if name == "report":
            subprocess.run([program, "run", folder], check=True, capture_output=True)
        self.kept = folder.with_name(folder.name + "_kept")
        shutil.copytree(folder, self.kept)
        begin = time.monotonic()
        subprocess.run(self.command, check=True, capture_output=True)
        self.seconds = time.monotonic() - begin
        self.unbroken = results_of(folder)
        self.renew()
        subprocess.run(self.command, check=True, capture_output=True)
        if unsteady := differences(self.unbroken, results_of(folder)):
            raise SystemExit(f"{name}: not the same in two unbroken runs: {unsteady}")

    def renew(self):
        shutil.rmtree(self.folder)
        shutil.copytree(self.kept, self.folder)

    def finish(self, what):
        """The same command again; returns what is at fault."""
        status, errors, late, _ = judge.run(self.again)
        if status != 0 or late:
            return [f"{what}: the command given again: exit status {status}: {errors.decode()[:300]}"]
        return [f"{what}: {file} differs" for file in differences(self.unbroken, results_of(self.folder))]


def kill(job, chance):
    job.renew()
    process = subprocess.Popen(job.command, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    moment = chance.uniform(0.0, 1.05 * job.seconds)
    time.sleep(moment)
    process.kill()
    process.wait()
    return job.finish(f"{job.name}: killed after {moment:.3f} s of {job.seconds:.3f} s")


def writing_calls(job):
    """{call: how often the first thread makes it, or at which of them it writes}"""
    job.renew()
    with tempfile.NamedTemporaryFile("r") as log:
        trace = ["strace", "-f", "-o", log.name, "-e", "trace=" + ",".join(CALLS)]
        subprocess.run([*trace, *job.command], check=True, capture_output=True)
        first, count, places = None, Counter(), {call: [] for call in CALLS}
        for line in log:
            pid, _, rest = line.partition(" ")
            call = rest.strip().partition("(")[0]
            first = first or pid
            if pid != first or call not in CALLS:
                continue
            count[call] += 1
            reads = call == "openat" and not re.search("O_WRONLY|O_RDWR|O_CREAT", rest)
            if not reads and not re.search(r"^\s*write\([12],", rest):
                places[call].append(count[call])
    return places


def fail(job, call, place):
    job.renew()
    inject = ["strace", "-f", "-qq", "-o", "/dev/null", "-e", f"trace={call}"]
    inject += ["-e", f"inject={call}:error={CALLS[call]}:when={place}"]
    status, errors, late, _ = judge.run([*inject, *job.command])
    what = f"{job.name}: {call} number {place} fails"
    lines = errors.decode("utf-8", "replace").splitlines()
    found = []
    if late or status not in (0, 1):
        found.append(f"{what}: exit status {status}: {' / '.join(lines)[:300]}")
    elif status == 1 and (len(lines) != 1 or len(lines[0].replace(str(job.folder), "")) > judge.LONGEST):
        found.append(f"{what}: {len(lines)} lines: {' / '.join(lines)[:300]}")
    elif status == 0:
        now = results_of(job.folder)
        found += [f"{what}: exit status 0, and {file} differs" for file in differences(job.unbroken, now)]
    return found + job.finish(what)


def some(places, most):
    return places if most == 0 or len(places) <= most else [places[i * len(places) // most] for i in range(most)]


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--kills", type=int, default=200)
    parser.add_argument("--calls", type=int, default=0)
    parser.add_argument("--only", default="")
    arguments = parser.parse_args()
    chance, faults, done = random.Random(1), [], Counter()
    with tempfile.TemporaryDirectory(prefix="pfdm_broken_") as scratch:
        jobs = [Job(arguments.program, *job) for job in make_jobs(Path(scratch)) if arguments.only in job[0]]
        for job in jobs:
            found = []
            for _ in range(arguments.kills // len(jobs)):
                found += kill(job, chance)
                done[f"{job.name}: kills"] += 1
            print(f"{job.name}: {done[f'{job.name}: kills']} kills, {len(found)} at fault", flush=True)
            for call, places in writing_calls(job).items() if shutil.which("strace") else ():
                for place in some(places, arguments.calls):
                    found += fail(job, call, place)
                    done[f"{job.name}: {call}"] += 1
            print("\n".join(found), flush=True)
            faults += found
    print(", ".join(f"{what} {n}" for what, n in done.items()), f"; {len(faults)} at fault")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
