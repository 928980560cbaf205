"""The problems of the wall, a row each: meshes, and what every code must reach."""

from dataclasses import dataclass, field


@dataclass
class Problem:
    title: str
    measures: dict  # name: (title, unit, function of the curve's columns)
    meshes: tuple = (1, 2, 4)  # factors on the cells of each block
    finer: dict = field(default_factory=dict)  # code: factor of the mesh that is its reference alone
    exact: dict = field(default_factory=dict)  # closed forms, by measure
    variants: tuple = ("corrected",)  # of the peer, see VARIANTS


def total(load):
    """Elastic and surface energy [J] at a load parameter."""
    return lambda c: at(c, load, "elastic_energy_J") + at(c, load, "fracture_energy_J")


def at(columns, load, name):
    """A column at the step that ends at this load; KeyError if there is none."""
    for t, value in zip(columns["load"], columns[name]):
        if abs(t - load) < 1e-6:
            return value
    raise KeyError(f"no step ends at load {load}")


def surface(load):
    return lambda c: at(c, load, "fracture_energy_J")


def growth(start, end):
    return lambda c: at(c, end, "fracture_energy_J") - at(c, start, "fracture_energy_J")


def force(load):
    return lambda c: at(c, load, "force_N")


def peak(columns):
    return max(abs(f) for f in columns["force_N"])


PROBLEMS = {
    "sent_tension": Problem(
        "notched plate in tension, AT2",
        {"total_before": ("total energy at 5.4 um, before the crack runs", "J", total(54 / 70)),
         "peak": ("peak force", "N", peak),
         "surface_after": ("surface energy at 7 um, the plate broken", "J", surface(1.0))},
        finer={"pfdm": 8}, variants=("corrected", "bilinear", "relaxed"),
    ),
    "surfing": Problem(
        "crack driven by a moving field, AT1",
        {"growth": ("surface energy while the field moves from 0.2 to 0.4 mm", "J", growth(0.2, 0.4)),
         "total_end": ("total energy at the end", "J", total(0.4)),
         "force_end": ("force on the upper side at the end", "N", force(0.4))},
        exact={"growth": 2700 * 0.2e-3 * 1e-3},
    ),
    "l_panel": Problem(
        "crack from the corner of an L-shaped panel, AT1, volumetric-deviatoric split",
        {"total_before": ("total energy at 0.3 mm, before the crack runs", "J", total(0.5)),
         "peak": ("peak force", "N", peak),
         "total_end": ("total energy at 0.6 mm", "J", total(1.0)),
         "surface_end": ("surface energy at 0.6 mm", "J", surface(1.0))},
    ),
    "sent_shear": Problem(
        "notched plate in shear, AT2, volumetric-deviatoric split",
        {"total_before": ("total energy at 7.5 um, before the crack runs", "J", total(0.5)),
         "peak": ("peak force", "N", peak),
         "surface_after": ("surface energy at 12 um", "J", surface(0.8))},
    ),
    "torsion_bar": Problem(
        "notched square bar in torsion, AT2, in space",
        {"total_before": ("total energy at 0.033 rad, before the crack runs", "J", total(0.55)),
         "surface_after": ("surface energy at 0.048 rad, the bar broken", "J", surface(0.8))},
        meshes=(0.5, 1, 2),
    ),
    "three_point_bend": Problem(
        "beam notched off its middle in three-point bending, AT2, volumetric-deviatoric split",
        {"total_before": ("total energy at 32.5 um, before the crack runs", "J", total(0.325)),
         "peak": ("peak force", "N", peak),
         "total_end": ("total energy at 80 um", "J", total(0.8)),
         "surface_end": ("surface energy at 80 um", "J", surface(0.8))},
        meshes=(0.5, 1, 2),
    ),
}

VARIANTS = {"corrected": ["--corrected"], "bilinear": ["--cells", "boxes"], "relaxed": ["--over-relaxation", "1.5"]}
