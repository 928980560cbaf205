"""Laws of cohesive interfaces and of softening, as functions of arrays."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import ArrayLike, NDArray

from .native import extension
from .tables import table_of
from .toml_text import toml_piece

if TYPE_CHECKING:
    import _pfdm
    import pandas


def _lines(values: dict[str, Any]) -> str:
    return "".join(f"{name} = {toml_piece(value)}\n" for name, value in values.items())


class InterfaceLaw:
    """The traction-separation law of a cohesive interface, in one mode or in mixed mode, with its memory.

    Arguments are the keys of [[interface]] of a fracture case that do not say where it is (./pfdm help interface);
    quantities are texts with units, quantities of pint, or numbers in SI units. Equations and sources are in
    physics/interfaces. Laws with a straight rise need its `stiffness`.

        InterfaceLaw(law="exponential", strength="2 MPa", toughness="100 J/m^2", stiffness="1e13 Pa/m")

    Args:
        folder: where the path of a `table` starts.
        **interface: law, strength, toughness, stiffness, mixed_mode, shear_strength ...

    Raises:
        InputError: what is wrong and what is allowed.
        Error: there is no compiled extension.
    """

    def __init__(self, *, folder: str | Path = ".", **interface: Any) -> None:
        self._law: _pfdm.InterfaceLaw = extension().InterfaceLaw.from_text(_lines(interface), Path(folder))

    @staticmethod
    def names() -> list[str]:
        """The laws that there are."""
        names: list[str] = extension().interface_laws()
        return names

    @property
    def strength(self) -> float:
        """Largest traction in opening [Pa]."""
        return self._law.strength

    @property
    def toughness(self) -> float:
        """Energy per area of opening [J/m^2]."""
        return self._law.toughness

    def traction(self, opening: ArrayLike) -> NDArray[numpy.float64]:
        """Traction [Pa] at openings [m] of any shape, each on an interface that nothing has happened to."""
        return self._law.traction(opening)

    def respond(self, separation: ArrayLike) -> pandas.DataFrame:
        """What the interface bears as its sides part, one separation after the other; unloading goes to the origin.

        Args:
            separation: [m], shape (n, 3): along the normal, positive where it opens, and along two directions across;
                or shape (n,), along the normal alone.

        Returns:
            A row for each: separation_n_m, separation_s_m, separation_t_m, traction_n_Pa ..., damage (the part of the
            toughness that is dissipated), dissipated_J_per_m2, stored_J_per_m2; attrs["units"] has the units.

        Raises InputError for another shape and for what is not finite.
        """
        given = numpy.asarray(separation, dtype=float)
        if given.ndim == 1:
            given = numpy.stack([given, numpy.zeros_like(given), numpy.zeros_like(given)], axis=1)
        found = self._law.follow(given)
        columns = {f"separation_{axis}_m": given[:, k] for k, axis in enumerate("nst")}
        columns |= {f"traction_{axis}_Pa": found["traction"][:, k] for k, axis in enumerate("nst")}
        return table_of({**columns, "damage": found["damage"], "dissipated_J_per_m2": found["dissipated"],
                         "stored_J_per_m2": found["stored"]})

    def __repr__(self) -> str:
        return f"<pfdm.InterfaceLaw {self._law.name}: {self.strength:g} Pa, {self.toughness:g} J/m^2>"


def softening(law: str, opening: ArrayLike, *, strength: Any, toughness: Any) -> NDArray[numpy.float64]:
    """The traction [Pa] of a crack that softens, at openings [m] of any shape: what a phase field of the model "Wu"
    follows (Wu, J. Mech. Phys. Solids 103 (2017) 72).

    Args:
        law: its name, one of softening_laws().
        opening: w [m].
        strength, toughness: ft and Gf: texts with units, quantities of pint, or numbers in Pa and J/m^2.

    Raises:
        InputError: a law that there is not, values that are not positive.
        Error: there is no compiled extension.
    """
    text = _lines({"strength": strength, "toughness": toughness})
    found: NDArray[numpy.float64] = extension().softening(law, text, opening)
    return found


def softening_laws() -> list[str]:
    """Names of the softening laws. Raises Error without the compiled extension."""
    names: list[str] = extension().softening_laws()
    return names
