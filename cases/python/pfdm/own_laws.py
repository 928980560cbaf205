"""Laws written in Python for fracture runs in this process."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy
from numpy.typing import ArrayLike, NDArray

from .errors import InputError


class InterfaceResponse(NamedTuple):
    """What a face bears at the end of a step, along its normal and along two directions across it.

    Attributes:
        traction: [Pa], shape (3,); the first is positive in tension.
        tangent: its derivative by the separation [Pa/m], shape (3, 3).
        history: (history_size,), what the law remembers at the end of the step.
        stored: energy that the face gives back when it unloads [J/m^2].
        dissipated: energy that this step has dissipated [J/m^2].
    """

    traction: ArrayLike
    tangent: ArrayLike
    history: ArrayLike = ()
    stored: float = 0.0
    dissipated: float = 0.0


class MaterialResponse(NamedTuple):
    """What a cell without damage bears at the end of a step. Tensors are vectors of six, (xx, yy, zz, r yz, r xz, r xy) with
    r = sqrt(2) (Mandel), so that stress @ strain is twice an elastic energy.

    Attributes:
        stress: [Pa], shape (6,).
        tangent: its derivative by the strain at the end of the step [Pa], shape (6, 6).
        history: (history_size,), what the law remembers at the end of the step.
        locked: energy that is stored besides the elastic one, as by hardening [J/m^3].
        dissipated: energy that this step has dissipated [J/m^3].
    """

    stress: ArrayLike
    tangent: ArrayLike
    history: ArrayLike = ()
    locked: float = 0.0
    dissipated: float = 0.0


class OwnInterfaceLaw(ABC):
    """The law of a cohesive interface, in place of that of an [[interface]] of the case, at small strain. Derive from it:

        class Spring(pfdm.OwnInterfaceLaw):
            def respond(self, separation, history, duration, strength, toughness):
                return pfdm.InterfaceResponse(1e12 * separation, 1e12 * numpy.eye(3), stored=5e11 * separation @ separation)

    Threads of the program ask it. A process that is forked meanwhile, by the law or by another thread (os.fork,
    multiprocessing with "fork"), can wait forever: start processes with multiprocessing's "spawn" method.

    Attributes:
        history_size: how many numbers it remembers of each face, at most 9; they are 0 at first.
        depends_on_rate: whether it needs the duration of steps, and the case a loading.duration.
    """

    history_size: int = 0
    depends_on_rate: bool = False

    @abstractmethod
    def respond(self, separation: NDArray[numpy.float64], history: NDArray[numpy.float64], duration: float,
                strength: float, toughness: float) -> InterfaceResponse:
        """What a face bears, by its arguments alone: a step is computed many times, by several threads in any order.

        Contact is the law's own too: it has to resist a negative separation along the normal. All directions across the
        normal have to be alike. A face counts as debonded from 90 % of its toughness on, that it has dissipated.
        Traction, tangent and energies have to be finite: others end the step with an InputError.

        Args:
            separation: of the face's sides at the end of the step [m], shape (3,): along the normal, positive where it
                opens, and along two directions across.
            history: (history_size,), at its start.
            duration: of the step [s], 0 without loading.duration. Fields ask for the traction again after the step, with
                the history of its end and a duration of 0: it has to be the same.
            strength, toughness: of the case at this face [Pa], [J/m^2].
        """


class OwnMaterial(ABC):
    """The material of a region, in place of the law that the case has there, at small strain. Derive from it:

        class Softened(pfdm.OwnMaterial):
            def respond(self, strain_before, strain, history, duration):
                return pfdm.MaterialResponse(self.C @ strain, self.C)

    The first iteration of each step takes the elasticity of the case, young_modulus and poisson_ratio. The elastic strain
    is that of the stress by this elasticity; its energy and the locked one drive damage. The fields of the run get the
    rest of the strain as "inelastic_strain", and the history as "history_0", "history_1" ...

    Threads of the program ask it. A process that is forked meanwhile, by the law or by another thread (os.fork,
    multiprocessing with "fork"), can wait forever: start processes with multiprocessing's "spawn" method.

    Attributes:
        history_size: how many numbers it remembers of each cell, at most 1000; they are 0 at first.
        depends_on_rate: whether it needs the duration of steps, and the case a loading.duration.
    """

    history_size: int = 0
    depends_on_rate: bool = False

    @abstractmethod
    def respond(self, strain_before: NDArray[numpy.float64], strain: NDArray[numpy.float64],
                history: NDArray[numpy.float64], duration: float) -> MaterialResponse:
        """What a cell bears, by its arguments alone: a step is computed many times, by several threads in any order.
        With a stress or a tangent that is not finite the step is tried anew by a smaller increment. With finite ones the
        energies have to be finite and the dissipated one not negative: others end the step with an InputError.

        Args:
            strain_before, strain: at the start and at the end of the step [-], shape (6,), as of MaterialResponse.
            history: (history_size,), at its start.
            duration: of the step [s], 0 without loading.duration.
        """


def laws_by_name(argument: str, laws: Mapping[str, Any] | None, kind: type[Any]) -> dict[str, Any]:
    """As the extension takes them. Raises InputError for what is no law of this kind."""
    for name, law in (laws or {}).items():
        if not isinstance(law, kind):
            raise InputError(f"{argument}[\"{name}\"]: an object of a class derived from pfdm.{kind.__name__} is expected, "
                             f"found {law!r}")
    return dict(laws or {})
