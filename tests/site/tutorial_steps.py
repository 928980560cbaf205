"""What is done with the blocks of each tutorial, in their order; check_tutorials.py does it."""

import csv
import re
import shutil

from tutorial_blocks import Command, Do, Merge, Python, Replace, Said, Shown, Skip, Skipped, Write


def own_record(folder):
    """The file of a testing machine that "With your curve" is about: the shipped record in other words and units."""
    (given,) = (folder / "my_fit/data").glob("*.csv")
    lines = [line for line in given.read_text().splitlines() if not line.startswith("#")]
    rows = list(csv.DictReader(lines))
    millimetres, newtons = 1e-3, 1.0
    length, force = (next(name for name in rows[0] if name.startswith(word)) for word in ("displacement_um", "force_N"))
    with open(folder / "my_fit/data/bead_1.csv", "w", newline="") as file:
        out = csv.writer(file, delimiter=";")
        out.writerows([["Extension", "Load"], ["mm", "N"]])
        out.writerows([millimetres * float(row[length]), newtons * float(row[force])] for row in rows)


def own_records(folder):
    """"Copied to my_sample/data/ they stand for yours"."""
    for name in ("sweep_2g0.csv", "sweep_1g0.csv"):
        (folder / "my_sample/data").mkdir(exist_ok=True)
        shutil.copy(folder / "my_sample/results" / name, folder / "my_sample/data")


def with_models(folder):
    """"Name some, under [fit]"."""
    page = (folder / "record.md").read_text()
    case = folder / "my_sample/case.toml"
    case.write_text(re.sub(r"^\[fit\]$", "[fit]\n" + re.search(r"`(models = [^`]*)`", page)[1], case.read_text(), flags=re.M))


def with_matlab_record(folder):
    """A copy of the case whose first record is the same one as a MATLAB file with absolute accelerations in g0."""
    try:
        import numpy
        import scipy.io
    except ImportError as error:
        raise Skipped(str(error)) from None
    lines = (folder / "my_sample/data/sweep_2g0.csv").read_text().splitlines()
    head = next(i for i, line in enumerate(lines) if line.startswith("time"))
    numbers = numpy.loadtxt([line for line in lines[head + 1:] if line[:1].isdigit()], delimiter=",")
    names = lines[head].split(",")
    base, relative = (numbers[:, next(i for i, n in enumerate(names) if n.startswith(w))] for w in ("base", "relative"))
    rate = (len(numbers) - 1) / (numbers[-1, 0] - numbers[0, 0])
    shutil.copytree(folder / "my_sample", folder / "my_matlab", ignore=shutil.ignore_patterns("results"))
    scipy.io.savemat(folder / "my_matlab/run7.mat", {"ch": numpy.column_stack([base, base + relative]) / 9.80665})
    return {"5 kHz": f"{rate:.12g} Hz"}


two_fibres = [Write("two_fibres/fibres.geo"), Command(), Write("two_fibres/case.toml"),
              Command(says=("fibre                         692 cells", "matrix                       1918 cells"))]
tutorials = {
    "bead": [Command(slow=True), Command(slow=True, says=("report/index.html",)), Command(), Merge("my_bead/case.toml"),
             Command(slow=True, quick="check"), Command(slow=True),
             Command(slow=True, says=("first debonding displacement", "twice the layers")), Command(slow=True),
             Write("study.py"), Command(slow=True, says=("200 J/m^2",))],
    "mesh": two_fibres,
    "curve": [Command(slow=True), Command(), Do(own_record), Replace("my_fit/case.toml", "[[experiment.specimens]]"),
              Shown("my_fit/case.toml"), Command(slow=True, quick="check"), Command(slow=True)],
    "dcb_test": [Command(), Said(), Command(), Command(slow=True, says=("verdict",)), Command(slow=True)],
    "composite": [Command(), Replace("my_composite/case.toml", "[mesh]"),
                  Command(says=("cells 4756", "between strain_zz = 0.04 and 0.042", "3.745 MPa at strain_zz = 0.08")),
                  Do(lambda folder: shutil.copytree(folder / "my_composite", folder / "my_finer",
                                                    ignore=shutil.ignore_patterns("results"))),
                  Command(slow=True), Command(slow=True)],
    "record": [Command(), Do(own_records), Replace("my_sample/case.toml", "[[test]]"),
               Do(with_matlab_record), Replace("my_matlab/case.toml", "record", first_only=True,
                                               then="./pfdm check my_matlab && ./pfdm analyse my_matlab",
                                               says=("largest response 12.79 times the base at 36 Hz",)),
               Command(says=("largest response 12.79 times the base at 36 Hz",
                             "largest response 12.59 times the base at 35.45 Hz")), Do(with_models),
               Command(says=("k1_N_per_m 54.1598 kN/m, 95 % between 54.15924 and 54.16049", "verdict: sound"))],
    "study": [Write("study.py"), Command(), Write("two_fibres/case.toml", append=True), Command(),
              Skip("a cluster is needed")],
    "law": [Python(), Python(before="import numpy, pfdm\n", after="assert abs(Gent().respond(numpy.eye(3)).energy) < 1e-9\n"),
            Skip("tests/installation builds these programs")],
}
before = {"study": ("mesh",)}  # tutorials whose folder another one goes on with
