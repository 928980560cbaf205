"""Results of runs and sweeps, as tables and arrays."""

from __future__ import annotations

import re
import xml.etree.ElementTree as xml
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy

from .errors import MissingResult
from .fit_results import Fit
from .tables import read_json, read_table
from .vtkhdf import read_frame, steps_in
from .vtu import Grid, read_vtu

if TYPE_CHECKING:
    import pandas


class Frame:
    """The fields of one step, views of what was read. Arrays are attributes, of a fracture run frame.damage (n_cells,),
    frame.displacement (n_cells, 3) [m], frame.stress [Pa] and frame.strain (n_cells, 6) with the components XX, YY, ZZ,
    XY, YZ, XZ; names() has all, frame.grid.units their units. Of a name that cells and points share (displacement) it is
    the cells'; the other is in frame.grid.point_data, (n_points, 3).

    Attributes:
        step: number of the load step.
        time: what ParaView shows as time: the displacement of the curve [m], or the load parameter.
        path: the .vtu file, or the .vtkhdf file with all frames.
    """

    def __init__(self, step: int, time: float, path: Path, number: int | None = None) -> None:
        """`number`: of the frame in a .vtkhdf file."""
        self.step, self.time, self.path, self._number = step, time, path, number

    @cached_property
    def grid(self) -> Grid:
        """Points, cells and data; read when it is first asked for."""
        return read_vtu(self.path) if self._number is None else read_frame(self.path, self._number)

    def names(self) -> list[str]:
        """Names of the arrays."""
        return list(dict.fromkeys([*self.grid.cell_data, *self.grid.point_data]))

    def __getattr__(self, name: str) -> numpy.ndarray:
        if name.startswith("_"):
            raise AttributeError(name)
        for data in (self.grid.cell_data, self.grid.point_data):
            if name in data:
                return data[name]
        raise AttributeError(f"{self.path} has no array \"{name}\" (there are: {', '.join(self.names())})")

    def __repr__(self) -> str:
        return f"<pfdm.Frame of step {self.step}: {self.path}>"


class Results:
    """A results directory. What is not there raises MissingResult, which names the command that makes it.

    Args:
        where: the directory; a case directory stands for the results in it.
    """

    def __init__(self, where: str | Path) -> None:
        path = Path(where)
        inner = path / "results"
        is_case = not (path / "summary.json").exists() and (path / "case.toml").exists() and inner.is_dir()
        self.folder: Path = inner if is_case else path

    @cached_property
    def summary(self) -> dict[str, Any]:
        """summary.json: status, cells, iterations, seconds, and the figures of the run with their units in their
        names ("peak_force_N")."""
        return read_json(self.folder / "summary.json", "pfdm run")

    @property
    def status(self) -> str:
        """ "complete", or why the run ended before. """
        return str(self.summary["status"])

    @cached_property
    def curve(self) -> pandas.DataFrame:
        """force_displacement.csv: a row for each load step, attrs["units"] with the units."""
        return self.table("force_displacement.csv")

    @cached_property
    def law(self) -> pandas.DataFrame:
        """cohesive_law.csv: mean traction [Pa] over separation [m] of the interfaces and planes that [cohesive] names."""
        return self.table("cohesive_law.csv")

    @cached_property
    def cohesive(self) -> dict[str, Any]:
        """cohesive.json: strength, energy, stiffness and the law that fits best, of each set of columns."""
        return read_json(self.folder / "cohesive.json", "pfdm cohesive")

    @cached_property
    def sweep(self) -> pandas.DataFrame:
        """sweep.csv: a row for each run of a sweep. Where it changed words, as "AT1" and "AT2", columns have these."""
        table = self.table("sweep.csv")
        words: dict[str, dict[int, str]] = {}
        for line in (self.folder / "sweep.csv").read_text(encoding="utf-8").split("\n"):
            if not line.startswith("#"):
                break
            if told := re.match(r"# (.+?), (\d+):(.*)", line):
                words.setdefault(told[1], {})[int(told[2])] = told[3].strip()
        for name in words.keys() & set(table.columns):
            table[name] = table[name].astype(int).map(words[name])
        return table

    @cached_property
    def sensitivity(self) -> pandas.DataFrame:
        """sensitivity.csv: displacement, force, and by each parameter elasticity, error and derivative; nan where there
        is none."""
        return self.table("sensitivity.csv")

    @cached_property
    def sensitivities(self) -> dict[str, Any]:
        """sensitivity.json: the parameters, and the elasticities of each event of the curve."""
        return read_json(self.folder / "sensitivity.json", "pfdm sensitivity")

    @cached_property
    def reduction(self) -> dict[str, Any]:
        """reduction.json: of each test the methods of data reduction with G at initiation and in propagation."""
        return read_json(self.folder / "reduction.json", "pfdm reduce")

    @property
    def fit(self) -> Fit:
        return Fit(self.folder)

    @property
    def tables(self) -> list[str]:
        """Names of the CSV files that table() reads."""
        return sorted(str(path.relative_to(self.folder)) for path in self.folder.rglob("*.csv")
                      if not any(part.startswith(".") for part in path.parts))

    def table(self, name: str) -> pandas.DataFrame:
        """The CSV file `name` of the results, attrs["units"] with the units of its columns."""
        path = self.folder / name
        if not path.exists():
            raise MissingResult(f"{path} is not there (there are: {', '.join(self.tables) or 'no tables'})")
        return read_table(path)

    @cached_property
    def frames(self) -> list[Frame]:
        """The fields that were written, in the order of the steps; each is read when it is looked at."""
        path, one = self.folder / "fields.pvd", self.folder / "fields.vtkhdf"
        if not path.exists() and one.exists():
            return [Frame(step, time, one, k) for k, (step, time) in enumerate(steps_in(one))]
        if not path.exists():
            raise MissingResult(f"{path} is not there: pfdm run writes it")
        sets = xml.parse(path).getroot().iter("DataSet")
        files = [(float(one.get("timestep", "nan")), self.folder / one.get("file", "")) for one in sets]
        return [Frame(int((re.findall(r"\d+", file.stem) or ["0"])[-1]), time, file) for time, file in files]

    @cached_property
    def mesh(self) -> Grid:
        """mesh.vtu: the mesh with material (number of the region), volume [m^3] and figures of quality."""
        path = self.folder / "mesh.vtu"
        if not path.exists():
            raise MissingResult(f"{path} is not there: pfdm run and pfdm mesh write it")
        return read_vtu(path)

    @property
    def log(self) -> str:
        """Everything that the run has said."""
        path = self.folder / "run.log"
        if not path.exists():
            raise MissingResult(f"{path} is not there: pfdm run writes it")
        return path.read_text(errors="replace")

    @property
    def warnings(self) -> list[str]:
        """What the run doubts, each once, with the key to change."""
        lines = (line.split("warning: ", 1)[1] for line in self.log.splitlines() if "warning: " in line)
        return list(dict.fromkeys(lines))

    def __repr__(self) -> str:
        status = self.status if (self.folder / "summary.json").exists() else "no summary"
        return f"<pfdm.Results {self.folder}: {status}>"


def open(where: str | Path) -> Results:  # noqa: A001
    """The results in a case directory, or in a directory of results.

    Raises MissingResult if there is no such directory.
    """
    if not Path(where).is_dir():
        raise MissingResult(f"{where} is no directory")
    return Results(where)
