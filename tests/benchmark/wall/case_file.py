"""Reads what the wall's cases have of `case.toml`, and makes their grids with NumPy, so that a peer computes the very same problem.

Only the generator `box_hexes` with blocks, holes, slits and patches, one material, and displacements on patches are known.
Lengths are in m, moduli in Pa, toughnesses in J/m^2.
"""

import re
import tomllib

import numpy as np

UNITS = {"m": 1.0, "mm": 1e-3, "um": 1e-6, "Pa": 1.0, "kPa": 1e3, "MPa": 1e6, "GPa": 1e9, "J/m^2": 1.0, "kJ/m^2": 1e3}


def quantity(text):
    """'2.5 mm' in SI units; ValueError names an unknown unit."""
    number, unit = str(text).split()
    if unit not in UNITS:
        raise ValueError(f"'{text}': unit {unit} is none of {', '.join(UNITS)}")
    return float(number) * UNITS[unit]


def lines_of(blocks, start, refinement):
    """Coordinates of the grid's lines [m]: each block's cells grow geometrically, the last `ratio` times the first."""
    lines = [start]
    for block in blocks:
        cells = max(1, round(block["cells"] * refinement))
        growth = block.get("ratio", 1.0) ** (1 / max(cells - 1, 1))
        sizes = growth ** np.arange(cells)
        lines.extend(lines[-1] + quantity(block["length"]) * np.cumsum(sizes) / sizes.sum())
    return np.array(lines)


def corners(box):
    return np.array([[quantity(x) for x in box[k]] for k in ("lower", "upper")])


class Case:
    """The case of a file: `refinement` multiplies the cells of each block (a block of one cell along z stays)."""

    def __init__(self, path, refinement=1.0):
        with open(path, "rb") as file:
            self.table = tomllib.load(file)
        mesh = self.table["mesh"]
        self.flat = len(mesh["z"]) == 1 and mesh["z"][0]["cells"] == 1
        origin = [quantity(x) for x in mesh.get("origin", ["0 m"] * 3)]
        self.thickness = quantity(mesh["z"][0]["length"]) if self.flat else 1.0
        self.dimension = 2 if self.flat else 3
        self.axes = [lines_of(mesh[a], o, refinement) for a, o in zip("xyz"[: self.dimension], origin)]
        self.scale = max(a[-1] - a[0] for a in self.axes)
        (self.material,) = self.table["materials"].values()
        self.fracture = self.table["fracture"]
        self.make_grid(mesh)

    def inside(self, places, box, slack=1e-7):
        lower, upper = (c[: self.dimension] for c in corners(box))
        gap = slack * self.scale
        return np.all((places > lower - gap) & (places < upper + gap), axis=-1)

    def make_grid(self, mesh):
        """Points (n, dimension) and cells (m, 2^dimension), corners numbered as a tensor product, x first."""
        shape = [len(a) for a in self.axes]
        grids = np.meshgrid(*self.axes, indexing="ij")
        self.points = np.stack([g.ravel() for g in grids], axis=1)
        number = np.arange(np.prod(shape)).reshape(shape)
        ends = [(slice(None, -1), slice(1, None))] * self.dimension
        picks = [[ends[a][(c >> a) & 1] for a in range(self.dimension)] for c in range(2**self.dimension)]
        self.cells = np.stack([number[tuple(p)].ravel() for p in picks], axis=1)
        index = np.stack([i.ravel() for i in np.meshgrid(*[np.arange(n - 1) for n in shape], indexing="ij")], axis=1)
        self.parity = index.sum(axis=1) % 2
        for hole in mesh.get("holes", []):
            self.keep(~self.inside(self.points[self.cells].mean(axis=1), hole))
        for slit in mesh.get("slits", []):
            self.cut(slit)

    def keep(self, kept):
        self.parity = self.parity[kept]
        used, cells = np.unique(self.cells[kept], return_inverse=True)
        self.points, self.cells = self.points[used], cells.reshape(-1, 2**self.dimension)

    def cut(self, slit):
        """Doubles the points of a slit normal to y for the cells above it; those on its edge inside the body stay single."""
        box = corners(slit)[:, : self.dimension]
        for axis, lines in enumerate(self.axes):
            for end in box[:, axis]:
                if np.abs(lines - end).min() > 1e-7 * self.scale:
                    raise ValueError(f"slit {slit['name']}: {end} m is no line of the grid along {'xyz'[axis]}")
        on = self.inside(self.points, slit)
        x = self.points[:, 0]
        for end in box[:, 0]:  # the front, where it is not the body's side
            if self.axes[0][0] + 1e-7 * self.scale < end < self.axes[0][-1] - 1e-7 * self.scale:
                on &= np.abs(x - end) > 1e-7 * self.scale
        above = self.points[self.cells].mean(axis=1)[:, 1] > box[0, 1]
        twin = np.arange(len(self.points))
        twin[on] = len(self.points) + np.arange(on.sum())
        self.points = np.vstack([self.points, self.points[on]])
        self.cells[above] = twin[self.cells[above]]

    def patch(self, name):
        """A function of places (dimension, n), whether they lie on the patch; a facet does where all its corners do."""
        plain = re.fullmatch(r"([xyz])(min|max)", name)
        if plain:
            axis = "xyz".index(plain[1])
            at = self.axes[axis][0 if plain[2] == "min" else -1]
            return lambda x: np.abs(x[axis] - at) < 1e-7 * self.scale
        (box,) = [p for p in self.table["mesh"]["patches"] if p["name"] == name]
        return lambda x: self.inside(x[: self.dimension].T, box)

    def held(self):
        """(patch, component, value) of each displacement that is given; value(x, t) in m, x of shape (3, n)."""
        for boundary in self.table["boundary"]:
            for patch in boundary.get("patches", [boundary.get("patch")]):
                for component, text in enumerate(boundary.get("displacement", [])[: self.dimension]):
                    if text != "free":
                        yield patch, component, value_of(text)

    def loads(self, factor=1.0):
        """Load parameters of the steps, equal ones; `factor` multiplies their number."""
        loading = self.table["loading"]
        steps = round(factor * loading["end"] / loading["maximum_increment"])
        return loading["end"] * np.arange(1, steps + 1) / steps


def value_of(text):
    """A plain quantity is reached at t = 1; an expression is of x, y, z and t."""
    if not isinstance(text, dict):
        final = quantity(text)
        return lambda x, t: np.full(x.shape[1], final * t)
    code, factor = text["expr"].replace("^", "**"), UNITS[text["unit"]]
    known = {"sqrt": np.sqrt, "cos": np.cos, "sin": np.sin, "atan2": np.arctan2, "pi": np.pi}
    return lambda x, t: factor * eval(code, {"__builtins__": {}}, known | {"x": x[0], "y": x[1], "z": x[2], "t": t})
