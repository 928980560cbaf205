"""A case directory, with other values than its file has."""

from __future__ import annotations

import copy
import tomllib
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from .errors import InputError
from .fit_results import Fit
from .program import Step, call
from .results import Results
from .toml_text import leaves_of, set_at, toml_piece, value_at


@dataclass(frozen=True)
class Check:
    """What `pfdm check` says of a case that can be run; print() shows all of it.

    Attributes:
        text: all it says, a line each.
        warnings: what it doubts, each with the key to change.
    """

    text: list[str]
    warnings: list[str] = field(default_factory=list)

    def __str__(self) -> str:
        return "\n".join(self.text)


class Case:
    """A case directory with values that replace those of its file; the file itself stays as it is.

    A value has its place as in case.toml: "materials.glass.poisson_ratio", "boundary[1].displacement[2]". Quantities
    with a dimension are texts with their unit ("300 J/m^2") or quantities of pint; numbers of NumPy, lists and dicts
    become the TOML that they stand for. Whether a value is allowed is told by check(), run() and fit().

    Args:
        where: the case directory, or a .toml file in it.
        values: values to begin with, by key.

    Raises:
        InputError: there is no such case, or its file is no TOML.
    """

    def __init__(self, where: str | Path, values: Mapping[str, Any] | None = None) -> None:
        path = Path(where)
        self.file: Path = path / "case.toml" if path.is_dir() else path
        try:
            self._table = tomllib.loads(self.file.read_text(encoding="utf-8-sig"))
        except OSError as error:
            raise InputError(f"{self.file}: there is no such case: {error.strerror}") from None
        except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
            raise InputError(f"{self.file}: {error}") from None
        self._where = path
        self.values: dict[str, Any] = dict(values or {})

    @property
    def folder(self) -> Path:
        """The case directory."""
        return self.file.parent

    @property
    def own_results(self) -> Path:
        """Where results go that are given no other directory: CASE/results; of a fitted case in results/ a directory
        beside it by its name; of a case that a run has kept that run's (kept_case.h of the program)."""
        is_usual = self.file.name == "case.toml"
        if is_usual and (self.folder / "run.log").exists() and self.file.read_text().startswith("# Kept by pfdm "):
            return self.folder
        if not is_usual and self.folder.resolve().name == "results":
            return self.folder / self.file.stem.removeprefix("case.")
        return self.folder / "results"

    @property
    def kind(self) -> str:
        """Kind of the case, as "fracture" or "mass_material"."""
        return str(self._table.get("kind", ""))

    @property
    def title(self) -> str:
        return str(self._table.get("title", ""))

    @property
    def table(self) -> dict[str, Any]:
        """A copy of all that the case says, as dicts and lists, with the values set here; new_case() makes a case of it.

        Raises KeyError for a value whose place the file does not have.
        """
        table = copy.deepcopy(self._table)
        for key, value in self.values.items():
            set_at(table, key, copy.deepcopy(value))
        return table

    def __getitem__(self, key: str) -> Any:
        """The value of a key: as it was set here, else as it is in the file. Raises KeyError if neither has it."""
        return self.values[key] if key in self.values else value_at(self._table, key)

    def __setitem__(self, key: str, value: Any) -> None:
        toml_piece(value)  # raises TypeError
        self.values[key] = value

    def __delitem__(self, key: str) -> None:
        """The key has the value of the file again."""
        del self.values[key]

    def __contains__(self, key: object) -> bool:
        try:
            self[str(key)]
        except KeyError:
            return False
        return True

    def __iter__(self) -> Iterator[str]:
        return iter({**leaves_of(self._table), **self.values})

    def _ipython_key_completions_(self) -> list[str]:
        """Keys that IPython and Jupyter complete after case["."""
        return list(self)

    def __repr__(self) -> str:
        changed = f" with {len(self.values)} other values" if self.values else ""
        return f"<pfdm.Case {self.file}: {self.title}{changed}>"

    def with_values(self, values: Mapping[str, Any]) -> Case:
        """A copy of this case with further values."""
        return Case(self._where, {**self.values, **values})

    def words(self, job: str, output: str | Path | None = None, threads: int | None = None) -> list[str]:
        """The words after `pfdm` that do a job on this case, as for a cluster's script."""
        words = [job, str(self._where)]
        for key, value in self.values.items():
            words += ["--set", f"{key}={toml_piece(value)}"]
        if output is not None:
            words += ["--output", str(output)]
        return words + (["--threads", str(threads)] if threads is not None else [])

    def check(self) -> Check:
        """What would be run: cells, unknowns, memory, steps, and what is doubtful. Solves nothing, writes nothing.

        Raises:
            InputError: what is wrong, with file, line and key.
        """
        lines = call(self.words("check")).splitlines()
        warnings = [line.removeprefix("warning: ") for line in lines if line.startswith("warning: ")]
        return Check(text=lines, warnings=warnings)

    def run(self, output: str | Path | None = None, *, threads: int | None = None, restart: bool = False,
            max_steps: int | None = None, on_step: Callable[[Step], object] | None = None) -> Results:
        """Runs the case; earlier results in the same directory are replaced once the new run has something.

        Args:
            output: directory of the results; None: own_results.
            threads: number of threads; None: all cores.
            restart: goes on from the last complete step of an earlier run.
            max_steps: ends after so many load steps of this run.
            on_step: called after each load step of a case of kind "fracture" with a dict of the columns of
                force_displacement.csv ("step", "load", "displacement_m" [m], "force_x_N" [N], ...); the run is no more
                than a step ahead. If it returns
                False the run ends there, with what it has; what it raises ends the run too and is raised here.

        Raises:
            InputError, ComputationError: as for the command line. After Ctrl-C the run has ended in order, and
            restart=True goes on.
        """
        words = self.words("run", output, threads)
        words += ["--restart"] if restart else []
        words += ["--max-steps", str(max_steps)] if max_steps is not None else []
        call(words, on_step)
        return self.results(output)

    def fit(self, output: str | Path | None = None, *, threads: int | None = None) -> Fit:
        """Estimates the values that the case names in [fit]; a fit that was interrupted goes on.

        Raises InputError and ComputationError. A fit that is not sound raises nothing: see Fit.verdict.
        """
        call(self.words("fit", output, threads))
        return self.results(output).fit

    def sensitivity(self, output: str | Path | None = None, *, parameters: str | Sequence[str] = (),
                    step: float | None = None, method: str | None = None, threads: int | None = None) -> Results:
        """Which parameter of a fracture case moves which part of its curve: elasticities d ln F/d ln p.

        Args:
            output: where the results go (None: own_results).
            parameters: a key of the case, or several; keys joined by "+" keep their ratio. None named: those of [fit], or all
                positive constants of materials, regions, interfaces and the phase field.
            step: of the differences, relative (None: 0.01).
            method: "differences" of whole runs, or "direct" derivatives of each step of one run.
            threads: number of threads.

        Returns the results: Results.sensitivity over the displacement, Results.sensitivities with the events. Raises
        InputError and ComputationError.
        """
        words = self.words("sensitivity", output, threads)
        if parameters:
            words += ["--parameters", parameters if isinstance(parameters, str) else ",".join(parameters)]
        words += ["--step", repr(step)] if step is not None else []
        words += ["--method", method] if method is not None else []
        call(words)
        return self.results(output)

    def reduce(self, output: str | Path | None = None) -> Results:
        """Data reduction of the records of a fracture test, as the standards of its specimen have it; no run is needed.

        Returns the results: Results.reduction with G at initiation and in propagation [J/m^2] by each method,
        Results.table("reduction.csv") by point. Raises InputError without [experiment.reduction], and for a record that
        cannot be reduced.
        """
        call(self.words("reduce", output))
        return self.results(output)

    def report(self, output: str | Path | None = None) -> Path:
        """Draws the page of the results and returns the path of report/index.html."""
        call(self.words("report", output))
        return self.results(output).folder / "report" / "index.html"

    def results(self, output: str | Path | None = None) -> Results:
        """What is in the results directory (None: own_results)."""
        return Results(self.own_results if output is None else output)


def specimen(directory: str | Path, name: str, *, data: str | Path | Sequence[str | Path] = (), **values: Any) -> Case:
    """A new case of a standard specimen, as of `pfdm init DIR --specimen NAME`.

    Args:
        directory: a new or empty directory.
        name: "double_cantilever_beam", "end_notched_flexure".
        data: a CSV file of the testing machine, or several.
        values: dimensions and properties in place of defaults, width="20 mm"; `pfdm init --specimen` lists them.

    Raises InputError for what is wrong, before anything is written.
    """
    words = ["init", str(directory), "--specimen", name]
    for file in [data] if isinstance(data, (str, Path)) else data:
        words += ["--data", str(file)]
    for key, value in values.items():
        words += ["--set", f"{key}={value}"]
    call(words)
    return Case(directory)
