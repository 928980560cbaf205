"""What the plots share: reading the program's CSV files, the look of a picture."""

import csv
import io
import math

import matplotlib
import matplotlib.transforms
from PIL import Image

matplotlib.use("Agg")
import matplotlib.pyplot as plt

plt.rcParams.update({"font.size": 9, "font.family": ["Liberation Sans", "DejaVu Sans"]})

PREFIXES = {1e-9: "n", 1e-6: "\N{MICRO SIGN}", 1e-3: "m", 1.0: "", 1e3: "k", 1e6: "M"}


def is_number(text):
    try:
        float(text)
        return True
    except ValueError:
        return False


def read_columns(path):
    """Columns by name as lists of numbers; lines that begin with #, and a line of units, are left out."""
    with open(path, newline="", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(line for line in file if not line.startswith("#"))]
    rows = [row for row in rows if is_number(next(iter(row.values())))]
    if not rows:
        raise SystemExit(f"{path} has no rows")
    return {name: [float(row[name] or "nan") for row in rows] for name in rows[0]}


def prefix_of(value):
    """The factor and the prefix of a unit in which a value has one to three digits before the point."""
    factor = max((f for f in PREFIXES if f <= abs(value) * 1.0000001), default=1e-9)
    return factor, PREFIXES[factor]


def with_unit(value, unit, digits=3):
    factor, prefix = prefix_of(value) if value else (1.0, "")
    return f"{value / factor:.{digits}g} {prefix}{unit}"


def nice_length(width):
    """About a fifth of a width: 1, 2 or 5 times a power of ten."""
    power = 10.0 ** math.floor(math.log10(width / 5))
    return max(f * power for f in (1, 2, 5) if f * power <= width / 5)


def new_picture(height=4.0):
    return plt.subplots(figsize=(6.0, height), constrained_layout=True)


def new_body(width, tall):
    """A figure as wide as these pixels, and axes for a body `tall` times as high as wide, with room for its colours."""
    inches = width / 100
    height = min(0.8 * inches * tall, inches) + 0.75
    figure = plt.figure(figsize=(inches, height))
    return figure, figure.add_axes([0.03, 0.3 / height, 0.87, 1.0 - 0.75 / height])


def save_picture(figure, axes, x_label, y_label, path):
    axes.set_xlabel(x_label)
    axes.set_ylabel(y_label)
    axes.grid(alpha=0.3)
    if len(axes.get_legend_handles_labels()[1]) > 1:
        axes.legend(frameon=False)
    figure.savefig(path, dpi=160)
    print(path)


def draw_scale(axes):
    """A bar of a round length under the left corner of axes in metres without ticks."""
    (left, right), bottom = axes.get_xlim(), axes.get_ylim()[0]
    length = nice_length(right - left)
    below = axes.transData + matplotlib.transforms.ScaledTranslation(0.0, -0.12, axes.figure.dpi_scale_trans)
    axes.plot([left, left + length], [bottom, bottom], color="0.1", linewidth=2.5, clip_on=False, solid_capstyle="butt",
              transform=below)
    axes.text(left + 1.1 * length, bottom, with_unit(length, "m"), va="center", fontsize=9, transform=below)


def draw_colours(axes, shown, label, below=False):
    """The bar of colours beside a picture of a body, or below a flat one."""
    place = {"fraction": 0.045, "pad": 0.03}
    if below:
        place = {"fraction": 0.1, "pad": 0.06, "location": "bottom", "shrink": 0.45, "anchor": (1.0, 1.0)}
    bar = axes.figure.colorbar(shown, ax=axes, aspect=30, **place)
    bar.set_label(label, fontsize=9), bar.ax.tick_params(labelsize=8), bar.outline.set_visible(False)


def draw_caption(figure, words, warp):
    """The load above a picture of a body, and by how much its displacements are drawn too large."""
    moved = "" if warp == 1.0 else f", drawn {warp:g} times as far"
    figure.text(0.03, 1.0 - 0.25 / figure.get_figheight(), words + moved, fontsize=11, weight="bold")


def image_of(figure, width):
    """A figure of 100 pixels an inch as an image of that many pixels, drawn finer and made smaller. Closes the figure."""
    memory = io.BytesIO()
    figure.savefig(memory, format="png", dpi=200)
    plt.close(figure)
    image = Image.open(memory).convert("RGB")
    return image.resize((width, round(width * image.height / image.width)), Image.LANCZOS)
