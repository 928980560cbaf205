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
        flow_stress: of a material that `flows`, the norm of the deviatoric stress less back stresses at which it does, at the
            end of the step [Pa]: sqrt(2/3) times the yield stress of von Mises.
    """

    stress: ArrayLike
    tangent: ArrayLike
    history: ArrayLike = ()
    locked: float = 0.0
    dissipated: float = 0.0
    flow_stress: float = 0.0


class HyperelasticResponse(NamedTuple):
    """A strain energy and its derivatives at a deformation gradient F.

    Attributes:
        energy: W per reference volume [J/m^3]; a constant in it changes nothing.
        stress: first Piola-Kirchhoff stress P = dW/dF [Pa], shape (3, 3).
        tangent: dP_ij/dF_kl [Pa], shape (3, 3, 3, 3). Without one it is found by differences, with 12 more calls.
    """

    energy: float
    stress: ArrayLike
    tangent: ArrayLike | None = None


class OwnInterfaceLaw(ABC):
    """The law of a cohesive interface, in place of that of an [[interface]] of the case. Derive from it:

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
        normal have to be alike. At finite strain an opened face has to pull along its separation, which is that per
        reference area of two points that were one; the normal turns with the body, and what the history has of directions
        across it does not. A face counts as debonded from 90 % of its toughness on, that it has dissipated.
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
        flows: whether inelastic strains stay, as plastic ones. What strains differ by at the faces of a cell then flows with
            it. Otherwise it is elastic, and bodies that yield as a whole bear more than their limit load.
    """

    history_size: int = 0
    depends_on_rate: bool = False
    flows: bool = False

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


class OwnHyperelastic(ABC):
    """The strain energy of a region at finite strain, in place of that of the law that the case has there, as of
    "neo_hookean". Derive from it:

        class NeoHookean(pfdm.OwnHyperelastic):
            def respond(self, F):
                return pfdm.HyperelasticResponse(0.5 * mu * numpy.sum(F * F), mu * F)

    The energy is isotropic, and its shear modulus at F = 1 is that of the young_modulus and poisson_ratio of the case. What
    it lacks of their bulk modulus is added: Lambda U(J) - p0 ln J, J = det F, U by `volumetric` of the case, with p0 the
    stress at F = 1. So the energy above, which has no volume terms, and one that has them both work. Above a poisson_ratio
    of 0.47 (with shear_branches above 0.4) leave the volume terms out: cells have a pressure then. Damage and
    shear_branches of the case go on as with its own law.

    Stress and tangent are compared with differences once, at the start. Faces have the stabilising stiffness that they have with
    laws that stiffen, as "ogden": with the energy of "neo_hookean" forces differ from those of that law by what the mesh
    does. Threads of the program ask the law. A process that
    is forked meanwhile (os.fork, multiprocessing with "fork") can wait forever: start processes with multiprocessing's
    "spawn" method.
    """

    @abstractmethod
    def respond(self, F: NDArray[numpy.float64]) -> HyperelasticResponse:
        """Energy, stress and tangent of a cell, by its argument alone: several threads ask in any order. With numbers that
        are not finite the step is tried anew by a smaller increment.

        Args:
            F: the deformation gradient without its rotation [-], shape (3, 3), symmetric: the stretch U of
                F = R U. Formulas of any F can be taken as they are.
        """


def laws_by_name(argument: str, laws: Mapping[str, Any] | None, *kinds: type[Any]) -> dict[str, Any]:
    """As the extension takes them. Raises InputError for what is no law of one of these kinds."""
    for name, law in (laws or {}).items():
        if not isinstance(law, kinds):
            names = " or ".join(f"pfdm.{kind.__name__}" for kind in kinds)
            raise InputError(f"{argument}[\"{name}\"]: an object of a class derived from {names} is expected, found {law!r}")
    return dict(laws or {})
