"""The mass-material system: a mass on a sample on a shaker, as a function of arrays."""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import ArrayLike, NDArray

from .case import Case
from .native import extension, place_of, toml_of
from .tables import table_of
from .toml_text import toml_piece

if TYPE_CHECKING:
    import _pfdm
    import pandas

standard_gravity = 9.80665  # [m/s^2]


class MassMaterial:
    """m z'' + c(z') + k(z) + v = -m y'': z is the mass's displacement relative to the base, y'' the base's acceleration.

    The terms are those of the report AFRL-RW-EG-TR-2016-088 (eqs. A1-A5): k a polynomial, c a damping that may depend
    on the velocity's power, v a hereditary force with a Prony series. Arguments are the keys of [model] of a case of
    kind "mass_material" (./pfdm help model); quantities are texts with units, quantities of pint, or numbers in SI units:

        MassMaterial(structure="2", mass="1.12 kg", stiffness=["54 kN/m", "-1.1e6 N/m^2"], damping=19.7)

    Args:
        sample: {"length": ..., "area": ...}, needed where `young_modulus` is given in place of `stiffness`.
        **model: structure, mass, stiffness, damping, kernel ...

    Raises:
        InputError: what is wrong and what is allowed; also of a model that does not hold the mass at rest.
        Error: there is no compiled extension.
    """

    def __init__(self, *, sample: Mapping[str, Any] | None = None, **model: Any) -> None:
        self._model: _pfdm.MassMaterial = extension().MassMaterial.from_text(toml_of({"model": model, "sample": sample}))

    @classmethod
    def of(cls, case: Case) -> MassMaterial:
        """The model of a case of kind "mass_material". Raises InputError with file, line and key."""
        made = cls.__new__(cls)
        made._model = extension().MassMaterial.from_case(*place_of(case))
        return made

    @property
    def structure(self) -> str:
        """Name of the terms that it has: a row of ./pfdm list --laws."""
        return self._model.structure

    @property
    def mass(self) -> float:
        """m [kg]."""
        return self._model.mass

    @property
    def stiffness(self) -> NDArray[numpy.float64]:
        """k_1 ... k_N [N/m, N/m^2 ...], shape (N,)."""
        return self._model.stiffness

    @property
    def damping(self) -> float:
        """c [N s/m]."""
        return self._model.damping

    @property
    def static_stiffness(self) -> float:
        """k_1 and what the kernel adds at rest [N/m]."""
        return self._model.static_stiffness

    def settling_point(self, gravity: float = standard_gravity) -> float | None:
        """Where the mass settles under `gravity` [m/s^2], in z [m], negative; None if the sample does not carry it."""
        return self._model.settling_point(gravity)

    def stiffness_force(self, displacement: ArrayLike) -> NDArray[numpy.float64]:
        """k(z) [N] at displacements z [m], of any shape."""
        return self._model.stiffness_force(displacement)

    def damping_force(self, velocity: ArrayLike) -> NDArray[numpy.float64]:
        """c(z') [N] at velocities z' [m/s], of any shape."""
        return self._model.damping_force(velocity)

    def kernel(self, time: ArrayLike) -> NDArray[numpy.float64]:
        """g(t) of the hereditary force at times t >= 0 [s], of any shape; unit by what drives it."""
        return self._model.kernel(time)

    def complex_stiffness(self, frequency: ArrayLike, velocity: float = 0.0) -> NDArray[numpy.complex128]:
        """Force over displacement of a small sine [N/m] at frequencies [Hz] of any shape.

        Nonlinear damping counts by its first harmonic at the velocity's amplitude `velocity` [m/s].
        """
        return self._model.complex_stiffness(frequency, velocity)

    def respond(self, base: ArrayLike | Mapping[str, Any], rate: float, *, base_rate: float | None = None,
                band: tuple[float, float] | None = None, folder: str | Path = ".",
                tolerance: float = 1e-10) -> pandas.DataFrame:
        """The motion of the mass from rest, as `pfdm run` computes it: Runge-Kutta-Fehlberg 7(8), each step controlled.

        Args:
            base: acceleration of the base y'' [m/s^2], shape (n,), at least two samples; between them it is the
                band-limited signal. Or the table [test.excitation] of a case as a dict, as
                {"type": "swept_sine", "level": "2 g0", "from": "8 Hz", "to": "68 Hz", "duration": "60 s"}.
            rate: samples per second of the motion [Hz].
            base_rate: samples per second of `base` [Hz]; None: `rate`.
            band: lowest and highest frequency of `base` [Hz], by which errors are measured; None: from one period in
                the record to 0.23 of its rate, up to which the signal between samples is known to 1e-9. Of a record of
                less than a period it is from half of that.
            folder: where paths of an excitation of type "measured" start.
            tolerance: relative error of a step.

        Returns:
            A row for each sample: time_s, base_acceleration_m_per_s2, relative_displacement_m,
            relative_velocity_m_per_s, relative_acceleration_m_per_s2; attrs["units"] has the units.

        Raises:
            InputError: an array, a rate or a key that is wrong.
            ComputationError: the mass runs away.
            KeyboardInterrupt: after Ctrl-C.
        """
        if isinstance(base, Mapping):
            test = toml_piece([{"name": "of_the_script", "excitation": base}])
            columns = self._model.respond_to(f"test = {test}", Path(folder), rate, tolerance)
        else:
            samples = numpy.asarray(base, dtype=float)
            given = rate if base_rate is None else base_rate
            high = 0.23 * min(given, rate)
            low, high = band if band is not None else (min(given / max(samples.size, 1), high / 2), high)
            columns = self._model.respond(samples, given, low, high, rate, tolerance)
        units = {"base_acceleration": "m_per_s2", "relative_displacement": "m", "relative_velocity": "m_per_s",
                 "relative_acceleration": "m_per_s2"}
        n = len(columns["base_acceleration"])
        return table_of({"time_s": numpy.linspace(0.0, n - 1.0, n) / rate,
                         **{f"{name}_{units[name]}": values for name, values in columns.items()}})

    def __repr__(self) -> str:
        return f"<pfdm.MassMaterial of structure {self.structure}: {self.mass:g} kg, k1 = {self.stiffness[0]:g} N/m>"

    def text(self) -> str:
        """[model] of a case.toml, every number with all its digits."""
        return self._model.text()
