"""Fracture runs in this process, step by step."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from functools import cached_property
from typing import TYPE_CHECKING, Any

import numpy
from numpy.typing import NDArray

from .case import Case
from .errors import Error
from .mesh import Mesh
from .native import extension, place_of
from .own_laws import OwnHyperelastic, OwnInterfaceLaw, OwnMaterial, laws_by_name
from .program import Step

if TYPE_CHECKING:
    import _pfdm


class State:
    """The state of a run after a step. It never changes: a run goes on from new ones, and back to it by restore().

    Attributes:
        step: accepted load steps so far.
        load: load parameter [-].
    """

    def __init__(self, state: _pfdm.State) -> None:
        self._state = state
        self.step: int = state.step
        self.load: float = state.load

    def __repr__(self) -> str:
        return f"<pfdm.State after step {self.step}, load {self.load:g}>"


class FractureRun:
    """A case of kind "fracture", or "homogenize" with a path, in this process: its mesh, its model and its load steps. It
    writes nothing.

        with pfdm.FractureRun(pfdm.Case("cases/bar_at2")) as run:
            for row in run:
                print(row["displacement_m"], row["force_x_N"], run.damage.max())

    Steps and fields are those of `pfdm run` to the last bit. Arrays are read-only views without copies; they keep what
    they show, also after later steps and after close(). While it computes, other threads of the script go on; several
    runs may be stepped in threads of their own, one of them by one thread at a time. While one is stepped other threads
    may ask for its row, load, state and reactions, which are those before the step; its fields raise RuntimeError.

    Args:
        case: the case, with its values.
        mesh: takes the place of what [mesh] makes; its regions and patches are those that the case names. Cells and
            points are put in another order: see cell_centres.
        interfaces: laws written in Python by the names of interfaces, in place of those of the case.
        materials: the same of materials by the names of regions, at finite strain strain energies. Such runs are slow: a law
            is asked for each of its faces or cells in each iteration, which takes 5 us and what Python needs for the law.

    Raises:
        InputError: what is wrong with the case, the mesh or a law, with file, line and key.
        Error: there is no compiled extension.
    """

    def __init__(self, case: Case, mesh: Mesh | None = None, *, interfaces: Mapping[str, OwnInterfaceLaw] | None = None,
                 materials: Mapping[str, OwnMaterial | OwnHyperelastic] | None = None) -> None:
        parts = None if mesh is None else mesh.parts()
        self._opened: _pfdm.FractureRun | None = extension().FractureRun(
            *place_of(case), parts, laws_by_name("interfaces", interfaces, OwnInterfaceLaw),
            laws_by_name("materials", materials, OwnMaterial, OwnHyperelastic))
        self._names: list[str] = self._run.row()[0].split(",")

    @property
    def _run(self) -> _pfdm.FractureRun:
        if self._opened is None:
            raise Error("the run was closed")
        return self._opened

    def step(self, on_iteration: Callable[[dict[str, Any]], object] | None = None) -> Step:
        """Does one accepted load step, with increments cut back until one is, and returns its row of the curve.

        Args:
            on_iteration: called after each iteration, also of increments that are cut back, with a dict of "step",
                "iteration", "load", "damage_change", "energy_change", "remark". What it raises ends the step and is
                raised here. The remark is a text, empty unless the step takes more than two minutes, and more than
                twice as long as when a step of this run last had one: how far the step is, what holds it up and which
                keys may help. It may come between iterations, with the numbers of the last one.

        Raises:
            InputError: the load has reached its end.
            ComputationError: the smallest increment does not converge.
            KeyboardInterrupt: after Ctrl-C, once the iteration is done.
            RuntimeError: another thread steps this run.
            What a law in Python raises.
        After any of them the run is where it was before the step.
        """
        self._run.step(on_iteration)
        return self.row

    def __iter__(self) -> Iterator[Step]:
        """Steps until the end of the load; the rows of the curve from the next step on."""
        while not self.is_complete:
            yield self.step()

    @property
    def is_complete(self) -> bool:
        """Whether the load has reached its end."""
        return self._run.is_complete

    @property
    def row(self) -> Step:
        """The present state as a row of force_displacement.csv: "step", "load", "displacement_m", "force_x_N" ...; of a
        box as one of stress_strain.csv: "step", "load", "strain_xx", "stress_xx_Pa" ..."""
        return Step(zip(self._names, map(float, self._run.row()[1].split(",")), strict=True))

    @property
    def load(self) -> float:
        """The load parameter [-]."""
        return self._run.state.load

    @property
    def remarks(self) -> list[str]:
        """What the last step has to say: increments that were cut back."""
        return self._run.remarks

    @property
    def state(self) -> State:
        """The present state, without a copy. It costs the memory of a few fields as long as it is kept."""
        return State(self._run.state)

    def restore(self, state: State) -> None:
        """Goes back, or on, to a state of this run or of another one of the same case.

        Laws in Python are told apart by their places and classes. Their parameters, as what their objects hold, are not
        compared: with other ones the run goes on from this state by the laws that it has itself.

        Raises InputError if the state belongs to another mesh or model, or to other laws in Python.
        """
        self._run.restore(state._state)

    @property
    def fields(self) -> dict[str, NDArray[Any]]:
        """The fields of a frame by their names, one value for each cell: damage, displacement, stress ...

        Scalars have the shape (n_cells,), vectors (n_cells, 3), tensors (n_cells, 3, 3). They are computed when they
        are first asked for in a state. Raises RuntimeError while another thread steps this run.
        """
        return self._run.fields()

    @property
    def damage(self) -> NDArray[numpy.float64]:
        """d [-], shape (n_cells,): 0 sound, 1 broken."""
        return self.fields["damage"]

    @property
    def displacement(self) -> NDArray[numpy.float64]:
        """u [m], shape (n_cells, 3)."""
        return self.fields["displacement"]

    @property
    def stress(self) -> NDArray[numpy.float64]:
        """sigma [Pa], shape (n_cells, 3, 3); at finite strain Cauchy's."""
        return self.fields["stress"]

    @property
    def strain(self) -> NDArray[numpy.float64]:
        """eps [-], shape (n_cells, 3, 3); at finite strain Green's."""
        return self.fields["strain"]

    def reaction(self, patch: str) -> NDArray[numpy.float64]:
        """The force on a patch [N], shape (3,). Raises InputError, which lists the patches."""
        return numpy.array(self._run.reaction(patch))

    def patch_displacement(self, patch: str) -> NDArray[numpy.float64]:
        """The area mean of a patch's displacement [m], shape (3,). Raises InputError, which lists the patches."""
        return numpy.array(self._run.patch_displacement(patch))

    @cached_property
    def _mesh(self) -> _pfdm.MeshArrays:
        return self._run.mesh()

    @property
    def points(self) -> NDArray[numpy.float64]:
        """(n_points, 3), positions [m]."""
        return self._mesh["points"]

    @property
    def connectivity(self) -> NDArray[numpy.int32]:
        """Points of all cells, one cell after the other, in VTK's order; of polyhedra each point once."""
        return self._mesh["connectivity"]

    @property
    def offsets(self) -> NDArray[numpy.int32]:
        """(n_cells,), where each cell ends in `connectivity`."""
        return self._mesh["offsets"]

    @property
    def cell_centres(self) -> NDArray[numpy.float64]:
        """(n_cells, 3) [m], in the order of the fields."""
        return self._mesh["cell_centres"]

    @property
    def cell_volumes(self) -> NDArray[numpy.float64]:
        """(n_cells,) [m^3], in the order of the fields."""
        return self._mesh["cell_volumes"]

    def cells_of(self, region: str) -> NDArray[numpy.intp]:
        """Numbers of the cells of a region. Raises KeyError, which lists the regions."""
        names = self._mesh["regions"]
        if region not in names:
            raise KeyError(f"there is no region \"{region}\" (there are: {', '.join(names)})")
        return numpy.flatnonzero(self._mesh["region"] == names.index(region))

    @property
    def patches(self) -> list[str]:
        """Names of the patches of the boundary."""
        return list(self._mesh["patches"])

    def close(self) -> None:
        """Gives mesh and matrices back, but for what arrays show that are kept."""
        self._opened = None
        self.__dict__.pop("_mesh", None)

    def __enter__(self) -> FractureRun:
        return self

    def __exit__(self, *exception: object) -> None:
        self.close()

    def __repr__(self) -> str:
        if self._opened is None:
            return "<pfdm.FractureRun, closed>"
        return f"<pfdm.FractureRun of {self._run.title}: step {self._run.state.step}, load {self.load:g}>"
