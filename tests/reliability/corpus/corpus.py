#!/usr/bin/env python3
"""Runs the program on bad inputs made by program and judges what it does; exit status 1 if anything is at fault.

corpus.py PROGRAM [--every N] [--only WORD] [--keep DIR]: each N-th input alone; those whose name holds WORD; the inputs
at fault go to DIR.
"""

import argparse
import os
import shutil
import sys
import tempfile
import time
from pathlib import Path

import bad_cases
import bad_files
import judge

REPOSITORY = Path(__file__).resolve().parents[3]
GOOD = ("bar_at2", "endochronic_uniaxial", "endochronic_calibration", "prony_calibration", "plate_ambient", "plate_fit",
        "htpb_soft_sweep", "bar_fit", "cohesive_dcb", "chain", "composite_stiffness", "glass_bead_quick", "nine_dcb",
        "surfing_crack", "hot_spot", "fatigue_crack", "bar_jump_fit", "tear_rates")
EARLIER = ("summary.json", "force_displacement.csv", "checkpoint.bin", "fit.json", ".pfdm")


class Corpus:
    def __init__(self, arguments):
        self.arguments = arguments
        self.n = self.judged = 0
        self.at_fault = []

    def is_due(self, name):
        self.n += 1
        wanted = self.arguments.only
        return wanted in name if wanted else self.n % self.arguments.every == 0

    def judge(self, name, command, folder, places, surely, untouched):
        self.judged += 1
        before = judge.content_of(untouched)
        outcome = judge.run([self.arguments.program, command[0], str(folder), *command[1:]])
        found = judge.faults(outcome, folder, places, surely)
        if outcome[0] != 0 and judge.content_of(untouched) != before:
            found.append("earlier results touched")
        if not found:
            return
        print(f"{name}: {'; '.join(found)}\n    {outcome[1][:400]!r}", flush=True)
        self.at_fault.append(name)
        if self.arguments.keep:
            shutil.copytree(folder, Path(self.arguments.keep) / f"{len(self.at_fault):04}", dirs_exist_ok=True)


def words_of(path):
    return [part for part in path.split(": ")[0].split(".") if not part.isdigit()]


def bad_keys(corpus, scratch):
    shutil.copytree(REPOSITORY / "cases", scratch / "cases", ignore=shutil.ignore_patterns("program", "results*"))
    schema = bad_cases.read_schema(corpus.arguments.program)
    for name in GOOD:
        folder = scratch / "cases" / name
        results = folder / "results"
        results.mkdir()
        for file in EARLIER:
            (results / file).write_text("earlier\n" if file != ".pfdm" else "")
        case = bad_cases.read_case(folder / "case.toml")
        for i, (what, make, surely) in enumerate(bad_cases.bad_versions(case, schema)):
            if not corpus.is_due(f"{name}: {what}"):
                continue
            (folder / "case.toml").write_bytes(make())
            command = ["run" if surely and i % 4 == 0 else "check"]
            places = ["case.toml", *words_of(what)]
            corpus.judge(f"{name}: {what}: {command[0]}", command, folder, places, surely, results)


def damaged_files(corpus, scratch):
    folder = scratch / "files"
    folder.mkdir()
    made = [*bad_files.make_records(folder, REPOSITORY / "tests/postproc/data"),
            *bad_files.make_meshes(folder, REPOSITORY, corpus.arguments.program),
            *bad_files.make_tables(folder, REPOSITORY)]
    for file, case, command in made:
        damage(corpus, folder, file, case, command)
    again = scratch / "again"
    again.mkdir()
    for file, _, command in [*bad_files.short_run(again, REPOSITORY, corpus.arguments.program)]:
        damage(corpus, again, file, None, command)


def damage(corpus, folder, file, case, command):
    kept = scratch_copy(folder)
    for what, content in bad_files.damages((folder / file).read_bytes(), file):
        if not corpus.is_due(f"{file}: {what}"):
            continue
        shutil.rmtree(folder)
        shutil.copytree(kept, folder)
        if case:
            (folder / "case.toml").write_text(case)
        (folder / file).write_bytes(content)
        # All that is in a case may hold the damaged number; a run that goes on writes.
        corpus.judge(f"{file}: {what}", command, folder, [Path(file).name, "case.toml"], False, folder)
    shutil.rmtree(folder)
    shutil.copytree(kept, folder)
    shutil.rmtree(kept)


def scratch_copy(folder):
    kept = folder.with_name(folder.name + "_kept")
    shutil.copytree(folder, kept)
    return kept


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("program", type=os.path.abspath)
    parser.add_argument("--every", type=int, default=1)
    parser.add_argument("--only", default="")
    parser.add_argument("--keep", default="")
    corpus = Corpus(parser.parse_args())
    begin = time.monotonic()
    with tempfile.TemporaryDirectory(prefix="pfdm_corpus_") as scratch:
        bad_keys(corpus, Path(scratch))
        damaged_files(corpus, Path(scratch))
    print(f"{corpus.judged} of {corpus.n} inputs, {len(corpus.at_fault)} at fault, {time.monotonic() - begin:.0f} s")
    return 1 if corpus.at_fault or corpus.judged == 0 else 0


if __name__ == "__main__":
    sys.exit(main())
