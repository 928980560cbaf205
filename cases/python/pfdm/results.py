"""Results of runs, fits and sweeps, as tables and arrays."""

from __future__ import annotations

import json
import re
import xml.etree.ElementTree as xml
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy

from .errors import MissingResult
from .vtkhdf import read_frame, steps_in
from .vtu import Grid, read_vtu

if TYPE_CHECKING:
    import pandas

    from .case import Case

_units = {"m": "m", "N": "N", "J": "J", "Pa": "Pa", "m2": "m^2", "m3": "m^3", "deg": "degree", "s": "s", "Hz": "Hz",
          "K": "K", "per_m": "1/m", "N_per_m": "N/m", "J_per_m2": "J/m^2", "J_per_m3": "J/m^3", "Pa_per_m": "Pa/m",
          "m_per_s": "m/s", "m_per_s2": "m/s^2"}


def unit_in(name: str) -> str:
    """Unit at the end of a name, as "N" of "force_x_N" and "J/m^2" of "toughness_J_per_m2"; "" if there is none."""
    for at in (m.end() for m in re.finditer("_", name)):
        if name[at:] in _units:
            return _units[name[at:]]
    return ""


def read_table(path: Path) -> pandas.DataFrame:
    """A CSV file of pfdm as a table; attrs["units"] has the unit of each column whose name ends with one."""
    import pandas

    return _with_units(pandas.read_csv(path, comment="#", float_precision="round_trip"))


def table_of(columns: Mapping[str, numpy.ndarray]) -> pandas.DataFrame:
    """Columns as a table, with units like those of read_table()."""
    import pandas

    return _with_units(pandas.DataFrame(columns))


def _with_units(table: pandas.DataFrame) -> pandas.DataFrame:
    from .named_columns import NamedColumns

    table = NamedColumns(table)
    table.attrs["units"] = {str(name): unit_in(str(name)) for name in table.columns if unit_in(str(name))}
    return table


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


class Fit:
    """What a fit has found.

    Attributes:
        content: fit.json as it is.
        folder: where it is.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.content: dict[str, Any] = _json(folder / "fit.json", "pfdm fit")

    @property
    def verdict(self) -> str:
        """ "sound", "questionable" or "failed".

        "sound with correlated residuals" and "sound within the error of mesh and steps" have intervals too.
        """
        return str(self.content["verdict"])

    @property
    def reasons(self) -> list[str]:
        """Why it is not sound; empty if it is."""
        return list(self.content["reasons"])

    @cached_property
    def estimates(self) -> pandas.DataFrame:
        """A row for each parameter: estimate, standard_error, lower, upper (95 %), first_guess, at_bound, unit; values
        in that unit. What the data do not determine has no interval: NaN."""
        import pandas

        table = pandas.DataFrame(self.content["parameters"]).set_index("name")
        table.attrs["units"] = table["unit"].to_dict()
        return table

    @cached_property
    def correlation(self) -> pandas.DataFrame:
        """Correlations of the estimates, by names of parameters."""
        import pandas

        names = list(self.estimates.index)
        return pandas.DataFrame(self.content["correlation"], index=names, columns=names)

    @cached_property
    def posterior(self) -> pandas.DataFrame | None:
        """Samples of the posterior (`intervals = "posterior"` or `"discrepancy"` in [fit]): a row each, a column for
        each parameter that the last stage estimates, in the units of `estimates`; None of a fit without it."""
        if "posterior" not in self.content:
            return None
        table = read_table(self.folder / self.content["posterior"]["file"])
        units = self.estimates.attrs["units"]
        table.attrs["units"] = {name: units[name] for name in table.columns}
        return table

    @cached_property
    def discrepancy(self) -> pandas.DataFrame | None:
        """What the model lacks over displacement (`intervals = "discrepancy"` in [fit]): columns displacement_m,
        median_force_N, lower_force_N, upper_force_N (measured less computed, 95 %); None of a fit without it."""
        found = self.content.get("posterior", {}).get("discrepancy")
        return None if found is None else read_table(self.folder / found["file"])

    @cached_property
    def laws(self) -> list[pandas.DataFrame]:
        """Of a fit with a posterior, traction over separation of each cohesive interface whose law is the same
        everywhere: columns separation_m, traction_Pa (of the estimates), median_traction_Pa, lower_traction_Pa,
        upper_traction_Pa (95 %)."""
        return [read_table(self.folder / file) for file in self.content.get("posterior", {}).get("law_files", [])]

    @cached_property
    def fields(self) -> dict[str, pandas.DataFrame]:
        """Of a fit with [[experiment.fields]], by the name of each field: a row for each place of each frame, columns
        frame (from 1), displacement_m of the curve, x_m and y_m of the measurement, measured_x_m, model_x_m (with the
        rigid motion of the measured ones), residual_x_m (model less measured) and likewise y, z; empty without fields."""
        return {field["name"]: read_table(self.folder / field["file"]) for field in self.content.get("fields", [])}

    @property
    def case(self) -> Case:
        """The case with the estimates in place of the first guesses."""
        from .case import Case

        return Case(self.folder / "case.fitted.toml")

    def __repr__(self) -> str:
        values = ", ".join(f"{name} = {row.estimate:.4g} {row.unit}" for name, row in self.estimates.iterrows())
        return f"<pfdm.Fit, {self.verdict}: {values}>"


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
        return _json(self.folder / "summary.json", "pfdm run")

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
        return _json(self.folder / "cohesive.json", "pfdm cohesive")

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
        return _json(self.folder / "sensitivity.json", "pfdm sensitivity")

    @cached_property
    def reduction(self) -> dict[str, Any]:
        """reduction.json: of each test the methods of data reduction with G at initiation and in propagation."""
        return _json(self.folder / "reduction.json", "pfdm reduce")

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


def _json(path: Path, command: str) -> dict[str, Any]:
    if not path.exists():
        raise MissingResult(f"{path} is not there: {command} writes it")
    return json.loads(path.read_text(errors="replace"))


def open(where: str | Path) -> Results:  # noqa: A001
    """The results in a case directory, or in a directory of results.

    Raises MissingResult if there is no such directory.
    """
    if not Path(where).is_dir():
        raise MissingResult(f"{where} is no directory")
    return Results(where)
