"""Cases, runs, fits and studies of pfdm, the phase-field fracture solver on cell-centred finite volumes.

    import pfdm

    case = pfdm.Case("cases/glass_bead_quick")
    case["regions.interface.toughness"] = "300 J/m^2"
    run = case.run(output="tough")
    run.curve.plot(x="displacement_m", y="force_z_N")

A case is computed by the program `pfdm` in a process of its own: results are the same to the last bit as those of the
command line, several runs go side by side, and neither Ctrl-C nor a failing run harms the script. Quantities that go in
are texts with units, as in case.toml ("300 J/m^2"), or quantities of pint; what comes out is in SI units.

With the compiled extension pieces of it run in this process, on arrays of NumPy: fracture runs step by step
(FractureRun), also with laws written in Python (OwnInterfaceLaw, OwnMaterial, OwnHyperelastic), composites (homogenize),
and laws as functions: MassMaterial, Endochronic, InterfaceLaw, softening.
"""

from .case import Case, Check, specimen
from .endochronic import Endochronic
from .errors import ComputationError, Error, InputError, MissingResult
from .fit_results import Fit
from .fracture_run import FractureRun, State
from .homogenization import homogenize
from .interface_law import InterfaceLaw, softening, softening_laws
from .mass_material import MassMaterial
from .mesh import Mesh
from .native import set_threads
from .new_case import new_case
from .own_laws import (HyperelasticResponse, InterfaceResponse, MaterialResponse, OwnHyperelastic, OwnInterfaceLaw,
                       OwnMaterial)
from .results import Frame, Results, open  # noqa: A004
from .study import sweep
from .vtu import Grid

__all__ = ["Case", "Check", "ComputationError", "Endochronic", "Error", "Fit", "FractureRun", "Frame", "Grid",
           "HyperelasticResponse", "InputError", "InterfaceLaw", "InterfaceResponse", "MassMaterial", "MaterialResponse",
           "Mesh", "MissingResult", "OwnHyperelastic", "OwnInterfaceLaw", "OwnMaterial", "Results", "State", "homogenize",
           "new_case", "open", "set_threads", "softening", "softening_laws", "specimen", "sweep"]
