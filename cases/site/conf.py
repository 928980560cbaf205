"""The documentation site: `./pfdm docs` builds it from the Markdown of the checkout, which is the source folder.

Words for Sphinx: https://www.sphinx-doc.org/en/master/usage/configuration.html
"""

import re
import subprocess
import sys
from pathlib import Path

here = Path(__file__).resolve().parent
checkout = here.parents[1]
sys.path[:0] = [str(here), str(checkout / "cases/python")]

project = "pfdm"
version = re.search(r"project\(pfdm VERSION ([0-9.]+)", (checkout / "CMakeLists.txt").read_text())[1]
release = version
author = copyright = "the authors of pfdm"

root_doc = "cases/site/index"
include_patterns = ["*.md", "cases/**.md", "mesh/**.md", "physics/**.md", "postproc/**.md", "solver/**.md", "tests/**.md"]
exclude_patterns = ["build", "tests/postproc", "cases/*/results", "**/.*", "**/node_modules"]

extensions = ["myst_parser", "sphinx.ext.autodoc", "sphinx.ext.napoleon", "sphinx.ext.mathjax", "sphinx_copybutton", "breathe",
              "checkout_links", "gallery"]
myst_enable_extensions = ["dollarmath"]
myst_heading_anchors = 4
suppress_warnings = ["myst.header"]  # a page may begin a section one level deeper
highlight_language = "none"
copybutton_exclude = ".linenos, .gp, .go"
autodoc_member_order = "bysource"
autodoc_typehints = "description"
autodoc_typehints_description_target = "documented"

html_theme = "furo"
html_title = f"pfdm {version}"
html_static_path = ["static", "/usr/share/javascript/katex"]  # Debian's libjs-katex: no file from the network
html_css_files = ["katex.min.css", "site.css"]
mathjax_path = "formulas.js"  # in place of MathJax: draws with KaTeX the formulas that this extension has marked
html_show_sphinx = False
html_copy_source = False

# The classes that programs in C++ begin with, by Doxygen.
doxygen_inputs = [
    "mesh/mesh.h", "mesh/generators/box_hexes.h", "physics/error.h", "physics/damage/softening_law.h",
    "physics/materials/small_strain_material.h", "physics/materials/hyperelastic.h", "physics/interfaces/interface_law.h",
    "solver/momentum/body/boundary_condition.h", "solver/fracture/model/fracture_model.h", "solver/fracture/fracture_run.h",
    "solver/fracture/model/state.h", "cases/program/fracture/case/opened_case.h",
]
breathe_default_project = "pfdm"
breathe_domain_by_extension = {"h": "cpp"}


def read_headers(app):
    """Runs Doxygen over doxygen_inputs into the folder of Sphinx's own files."""
    folder = Path(app.doctreedir) / "doxygen"
    folder.mkdir(parents=True, exist_ok=True)
    settings = {"INPUT": " ".join(doxygen_inputs), "OUTPUT_DIRECTORY": folder, "GENERATE_XML": "YES", "GENERATE_HTML": "NO",
                "GENERATE_LATEX": "NO", "QUIET": "YES", "WARN_IF_UNDOCUMENTED": "NO", "EXTRACT_ALL": "YES",
                "JAVADOC_AUTOBRIEF": "YES", "HAVE_DOT": "NO", "ENABLE_PREPROCESSING": "NO"}
    subprocess.run(["doxygen", "-"], input="".join(f"{key} = {value}\n" for key, value in settings.items()), text=True,
                   cwd=checkout, check=True)
    app.config.breathe_projects = {"pfdm": str(folder / "xml")}


def lead_to_first_page(app, failure):
    """Makes index.html of the whole site, which leads to the first page in its folder."""
    if failure is None and app.builder.name == "html":
        first = app.builder.get_target_uri(root_doc)
        (Path(app.outdir) / "index.html").write_text(
            f'<!doctype html><meta charset="utf-8"><title>{html_title}</title>'
            f'<meta http-equiv="refresh" content="0; url={first}"><a href="{first}">{html_title}</a>\n')


def setup(app):
    app.connect("builder-inited", read_headers)
    app.connect("build-finished", lead_to_first_page)
