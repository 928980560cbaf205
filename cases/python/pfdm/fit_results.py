"""Results of fits."""

from __future__ import annotations

from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .tables import read_json, read_table

if TYPE_CHECKING:
    import pandas

    from .case import Case


class Fit:
    """What a fit has found.

    Attributes:
        content: fit.json as it is.
        folder: where it is.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        self.content: dict[str, Any] = read_json(folder / "fit.json", "pfdm fit")

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
