"""The effective stiffness of a linear composite in this process."""

from __future__ import annotations

import json
from typing import Any

import numpy

from .case import Case
from .mesh import Mesh
from .native import extension, place_of


def homogenize(case: Case, mesh: Mesh | None = None) -> dict[str, Any]:
    """What homogenized.json has of a case of kind "homogenize" without a path, to the last bit. It writes nothing.

    Boxes with a path of mean strain have steps, which FractureRun does.

    Args:
        case: the case, with its values.
        mesh: takes the place of what [mesh] makes: it fills a box, and where boundary = "periodic" its opposite sides
            have to match. Its regions are those that the case names.

    Returns:
        "stiffness_Pa" and "compliance_per_Pa", (6, 6) in Voigt's notation, order xx, yy, zz, yz, xz, xy, shear strains of
        engineering; "isotropic": "young_modulus_Pa", "poisson_ratio" ... of the closest isotropic material;
        "phases": fractions of volume and energy; "bounds", "loss_factors", "errors" (cases/guides/homogenize.md).

    Raises:
        InputError: what is wrong with the case or the mesh, with file, line and key.
        ComputationError: a load case does not converge.
        KeyboardInterrupt: after Ctrl-C, once one of the six load cases is done.
        Error: there is no compiled extension.
    """
    parts = None if mesh is None else mesh.parts()
    found: dict[str, Any] = json.loads(extension().homogenize(*place_of(case), parts))
    for name in ("stiffness_Pa", "compliance_per_Pa"):
        found[name] = numpy.array(found[name])
    return found
