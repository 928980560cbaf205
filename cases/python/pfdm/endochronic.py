"""The endochronic law of a material point, as a function of arrays."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import ArrayLike, NDArray

from .case import Case
from .errors import InputError
from .native import extension, place_of, toml_of
from .tables import table_of

if TYPE_CHECKING:
    import _pfdm
    import pandas

components = ("xx", "yy", "zz", "yz", "xz", "xy")
_places = ((0, 0), (1, 1), (2, 2), (1, 2), (0, 2), (0, 1))


class Endochronic:
    """Endochronic plasticity without a yield surface: isotropic, small strain (Valanis 1971; Watanabe, Atluri,
    Int. J. Plasticity 2 (1986) 37).

    s = 2 int rho(z - z') (d eps_p/dz') dz', rho(z) = sum of C exp(-alpha z), dz = norm(d eps_p) / f. Arguments are the keys of
    [material] of a case of kind "endochronic" (./pfdm help material); quantities are texts with units, quantities of
    pint, or numbers in SI units:

        Endochronic(young_modulus="117 GPa", poisson_ratio=0.34, kernel=[{"C": "60 GPa", "alpha": 3000}],
                    hardening={"law": "saturating", "f_inf": 3.0, "b": 6.0})

    Raises:
        InputError: what is wrong and what is allowed.
        Error: there is no compiled extension.
    """

    def __init__(self, **material: Any) -> None:
        self._law: _pfdm.Endochronic = extension().Endochronic.from_text(toml_of({"material": material}))

    @classmethod
    def of(cls, case: Case) -> Endochronic:
        """The law of a case of kind "endochronic". Raises InputError with file, line and key."""
        made = cls.__new__(cls)
        made._law = extension().Endochronic.from_case(*place_of(case))
        return made

    @property
    def young_modulus(self) -> float:
        """E [Pa]."""
        return self._law.young_modulus

    @property
    def poisson_ratio(self) -> float:
        """nu [-]."""
        return self._law.poisson_ratio

    def respond(self, prescribed: Mapping[str, ArrayLike], time: ArrayLike | None = None, *,
                largest_strain_increment: float | None = None) -> pandas.DataFrame:
        """What the virgin material goes through, as `pfdm run` computes it.

        Args:
            prescribed: component to its values, shape (n,): "stress_xx" [Pa], "strain_xx" [-], and "gamma_xy", twice
                "strain_xy". A pair of indices that is not named is free of stress. Between the times values are linear;
                the first stands for the virgin state, in which all are zero.
            time: [s], shape (n,), rising from 0; None: a second for each value. It matters where the law has a `rate`.
            largest_strain_increment: steps of strain are divided until they are at most this; None: as they are given.

        Returns:
            A row for each time, with the columns of history.csv: time_s, stress_xx_Pa ..., strain_xx ..., z, zeta,
            dissipation_J_per_m3 ...; attrs["units"] has the units.

        Raises:
            InputError: a component that there is not, arrays that do not fit, conditions that determine nothing.
            ComputationError: a stress that the material cannot bear, with the time.
        """
        values = [(name, numpy.asarray(each, dtype=float)) for name, each in prescribed.items()]
        if time is None:
            time = numpy.arange(max((each.size for _, each in values), default=0), dtype=float)
        return table_of(self._law.respond(values, numpy.asarray(time, dtype=float), largest_strain_increment))

    def stress(self, strain: ArrayLike, time: ArrayLike | None = None, *,
               largest_strain_increment: float | None = None) -> NDArray[numpy.float64]:
        """The stress [Pa] of a history in which all strains are prescribed.

        Args:
            strain: [-], shape (n, 3, 3), symmetric, or (n, 6) with the tensor's components xx, yy, zz, yz, xz, xy.
            time, largest_strain_increment: as of respond().

        Returns:
            The stress, of the same shape as `strain`.

        Raises InputError and ComputationError like respond().
        """
        given = numpy.asarray(strain, dtype=float)
        if given.ndim == 3 and given.shape[1:] == (3, 3):
            if not numpy.array_equal(given, given.transpose(0, 2, 1)):
                raise InputError("strain: the tensors are not symmetric")
            columns = [given[:, i, j] for i, j in _places]
        elif given.ndim == 2 and given.shape[1] == 6:
            columns = list(given.T)
        else:
            raise InputError(f"strain: its shape is {given.shape}; (n, 3, 3) or (n, 6) is expected")
        table = self.respond({f"strain_{name}": column for name, column in zip(components, columns, strict=True)}, time,
                             largest_strain_increment=largest_strain_increment)
        found: NDArray[numpy.float64] = table[[f"stress_{name}_Pa" for name in components]].to_numpy()
        if given.ndim == 2:
            return found
        tensors = numpy.empty_like(given)
        for k, (i, j) in enumerate(_places):
            tensors[:, i, j] = tensors[:, j, i] = found[:, k]
        return tensors

    def text(self) -> str:
        """[material] of a case.toml, every number with all its digits."""
        return self._law.text()

    def __repr__(self) -> str:
        return f"<pfdm.Endochronic: E = {self.young_modulus:g} Pa, nu = {self.poisson_ratio:g}>"
