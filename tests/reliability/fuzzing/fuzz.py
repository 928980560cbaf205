#!/usr/bin/env python3
"""Fuzzes the readers of users' files: builds the targets with clang and sanitizers, runs each for some minutes, and
prints executions, covered edges and findings. Inputs that break a target stay in the folder of the build."""

import argparse
import collections
import io
import os
import re
import shutil
import subprocess
import sys
import tarfile
import tempfile
from pathlib import Path

from seeds import ROOT, SEEDS

HERE = Path(__file__).resolve().parent
# Their libraries run in a process of their own, where a crash is a message (physics/system/separate_process).
BY_FOREIGN_LIBRARY = {"wav", "mat", "hdf5", "vtk"}
LONGEST = {"quantity": 200, "expression": 400, "frames": 2000, "message": 6000, "hdf5": 16_000, "case": 8000}
SECONDS, MEGABYTES = 20, 2048  # of one input
KEPT = 20_000  # bytes of a corpus in the repository


def build(folder, names, jobs):
    subprocess.run(["cmake", "--preset", "fuzz", "-B", folder], cwd=ROOT, check=True, stdout=subprocess.DEVNULL)
    targets = [f"fuzz_{name}" for name in names]
    subprocess.run(["cmake", "--build", folder, "--parallel", str(jobs), "--target", *targets], check=True,
                   stdout=subprocess.DEVNULL)
    return {name: folder / "tests/reliability/fuzzing" / f"fuzz_{name}" for name in names}


def kept_corpus(name):
    return HERE / "corpus" / f"{name}.tar.xz"


def put_seeds(name, corpus):
    corpus.mkdir(parents=True, exist_ok=True)
    for i, content in enumerate(SEEDS[name]()):
        (corpus / f"seed_{i:03}").write_bytes(content)
    if kept_corpus(name).exists():
        with tarfile.open(kept_corpus(name)) as archive:
            for entry in archive:
                (corpus / Path(entry.name).name).write_bytes(archive.extractfile(entry).read())


def environment():
    options = f"detect_leaks=0:allocator_may_return_null=1:max_allocation_size_mb={MEGABYTES // 2}:handle_abort=2"
    symbolizer = shutil.which("llvm-symbolizer-16") or shutil.which("llvm-symbolizer") or ""
    return os.environ | {"ASAN_OPTIONS": options, "UBSAN_OPTIONS": "print_stacktrace=1",
                         "ASAN_SYMBOLIZER_PATH": symbolizer, "UBSAN_SYMBOLIZER_PATH": symbolizer}


def limits(name):
    return [f"-timeout={SECONDS}", f"-rss_limit_mb={MEGABYTES}", f"-max_len={LONGEST.get(name, 16_000)}"]


def fuzz(program, name, folder, minutes):
    """(executions, covered edges): the fuzzer goes on after a fault, and saves what led to it."""
    crashes = folder / "crashes"
    shutil.rmtree(crashes, ignore_errors=True)
    crashes.mkdir(parents=True)
    command = [program, folder / "corpus", f"-max_total_time={round(60 * minutes)}", "-fork=1", "-ignore_crashes=1",
               "-ignore_timeouts=1", "-ignore_ooms=1", f"-artifact_prefix={crashes}/", *limits(name)]
    with open(folder / "log.txt", "w") as log:
        subprocess.run(command, stdout=log, stderr=log, env=environment(), check=False)
    text = (folder / "log.txt").read_text(errors="replace")
    rows = re.findall(r"^#(\d+): cov: (\d+)", text, re.M)
    return (int(rows[-1][0]), int(rows[-1][1])) if rows else (0, 0)


def cause_of(program, name, crasher):
    """("ours", "foreign" or "not again", what happened and where)"""
    for runs in (1, 200):  # what is in memory beyond the input may decide
        command = [program, f"-runs={runs}", crasher, *limits(name)]
        process = subprocess.run(command, capture_output=True, env=environment(), check=False)
        if process.returncode != 0:
            break
    else:
        return "not again", ""
    text = process.stderr.decode("utf-8", "replace")
    kind = re.search(r"runtime error: .*|ERROR: (?:AddressSanitizer|libFuzzer): [-\w ]+|uncaught exception.*", text)
    thrown = re.search(r"terminate called .*\n.*what\(\): .*", text)
    what = (thrown or kind).group(0).replace("\n", " ") if thrown or kind else "died"
    for frame in re.findall(r"^ *#\d+ 0x\w+ (.*)$", text, re.M):
        if "/input_file.h" in frame:  # where what is demanded of all targets is checked
            continue
        if f"{ROOT}/" in frame:
            place = frame[frame.index(f"{ROOT}/") + len(f"{ROOT}/"):]
            return "ours", f"{what} at {place}"
        library = re.search(r"\((?:/[^()]*/)(lib[^()]*?\.so[^()+]*)", frame)
        if library and not library.group(1).startswith(("libc.", "libstdc++", "libm.", "libgcc")):
            return "foreign" if name in BY_FOREIGN_LIBRARY else "ours", f"{what} in {library.group(1)}"
    return "ours", what


def findings(program, name, folder):
    found = collections.Counter()
    for crasher in sorted((folder / "crashes").iterdir()):
        found[cause_of(program, name, crasher)] += 1
    return found


def packed(files):
    """One file with the same bytes whenever it is made."""
    content = io.BytesIO()
    with tarfile.open(fileobj=content, mode="w:xz", preset=9) as archive:
        for path in files:
            entry = tarfile.TarInfo(path.name)
            entry.size = path.stat().st_size
            with path.open("rb") as file:
                archive.addfile(entry, file)
    return content.getvalue()


def keep_corpus(program, name, folder):
    """The smallest set of inputs that covers as much; of a set that is too large the longest are left out."""
    smallest = folder / "smallest"
    shutil.rmtree(smallest, ignore_errors=True)
    smallest.mkdir()
    subprocess.run([program, "-merge=1", f"-artifact_prefix={folder}/", smallest, folder / "corpus", *limits(name)],
                   env=environment(), check=False, capture_output=True)
    files = sorted(smallest.iterdir(), key=lambda path: (path.stat().st_size, path.name))
    while len(content := packed(files)) > KEPT:
        del files[-max(1, len(files) // 20):]
    kept_corpus(name).parent.mkdir(exist_ok=True)
    kept_corpus(name).write_bytes(content)


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("targets", nargs="*", metavar="TARGET", help=f"of {', '.join(SEEDS)}; all of them")
    parser.add_argument("--minutes", type=float, default=5, help="of each target (5)")
    parser.add_argument("--build", type=Path, default=ROOT / "build/fuzz", help="folder of the build (build/fuzz)")
    parser.add_argument("--jobs", type=int, default=os.cpu_count(), help="compilers side by side")
    parser.add_argument("--keep", action="store_true", help="keep the smallest corpus in the repository")
    options = parser.parse_args()
    names = options.targets or list(SEEDS)
    if unknown := [name for name in names if name not in SEEDS]:
        parser.error(f"there is no target {unknown[0]} (available: {', '.join(SEEDS)})")
    programs = build(options.build.resolve(), names, options.jobs)
    print(f"{'target':12}{'executions':>12}{'edges':>8}  findings", flush=True)
    n_findings = 0
    for name in names:
        folder = options.build.resolve() / "fuzzed" / name
        put_seeds(name, folder / "corpus")
        executions, edges = fuzz(programs[name], name, folder, options.minutes)
        found = findings(programs[name], name, folder)
        ours = {cause: n for (whose, cause), n in found.items() if whose == "ours"}
        beside = [f"{sum(n for (w, _), n in found.items() if w == whose)} {words}"
                  for whose, words in (("foreign", "inputs break a foreign library"), ("not again", "only once"))
                  if any(w == whose for w, _ in found)]
        print(f"{name:12}{executions:12}{edges:8}  {len(ours)}" + (f" ({', '.join(beside)})" if beside else ""),
              flush=True)
        for cause, n in ours.items():
            print(f"    {n} x {cause}", flush=True)
        n_findings += len(ours)
        if options.keep:
            keep_corpus(programs[name], name, folder)
    sys.exit(1 if n_findings else 0)


if __name__ == "__main__":
    # The inputs are files, thousands a second: in memory where there is such a folder.
    with tempfile.TemporaryDirectory(dir="/dev/shm" if Path("/dev/shm").is_dir() else None) as scratch:
        os.environ["TMPDIR"] = scratch
        main()
