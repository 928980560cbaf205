"""A directive {gallery}: a card for each shipped case of a kind, with its picture, title and first sentence.

A case whose results have a page for the browser (`pfdm report`) gets a link to a copy of it.
"""

import re
import shutil
import tomllib
from pathlib import Path
from posixpath import join, relpath

from docutils import nodes
from docutils.parsers.rst import Directive
from sphinx import addnodes


def first_sentence(readme):
    """The first sentence of the first paragraph under the title, links and marks taken off."""
    paragraphs = [part for part in readme.split("\n\n")[1:] if part and part[0] not in "#![|` \n<-"]
    words = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", " ".join(paragraphs[0].split())) if paragraphs else ""
    return re.match(r".*?[.:](?= |$)|.*", re.sub(r"[`*$\\]", "", words))[0].rstrip(":")


def picture_in(folder, readme):
    """Path of the first picture that the README shows and that is there, else None."""
    for name in re.findall(r"!\[[^]]*\]\(([^)]+)\)", readme):
        if (folder / name).is_file():
            return name
    return None


def time_of(name, readme):
    """What the README's first command of the case takes, by the remark behind it, "8 CPU s"; else None."""
    command = re.search(rf"\./pfdm (?:run|fit|sweep) cases/{name}(?:/\w+\.toml)?(?: [^#\n]*)?#([^\n]*)", readme)
    time = re.search(r"[\d.]+ (?:CPU )?(?:s|seconds|minutes)\b", command[1]) if command else None
    return time and time[0]


class Gallery(Directive):
    """Cards of the cases of the kinds that the argument names, "fracture homogenize"."""

    required_arguments = 1
    final_argument_whitespace = True

    def run(self):
        env = self.state.document.settings.env
        gallery = nodes.container(classes=["gallery"])
        cards = []
        for file in sorted(Path(env.srcdir).glob("cases/*/case.toml")):
            case = tomllib.loads(file.read_text())
            env.note_dependency(str(file))
            if case.get("kind") in self.arguments[0].split():
                cards.append(self.card(env, file.parent, case["title"]))
        if not cards:
            raise self.error(f"no case is of kind {self.arguments[0]}")
        gallery += sorted(cards, key=lambda card: not isinstance(card[0], nodes.image))  # those with a picture first
        return [gallery]

    def card(self, env, folder, title):
        readme = (folder / "README.md").read_text()
        page = f"cases/{folder.name}/README"
        link = addnodes.pending_xref("", nodes.strong("", title), refdomain="std", reftype="doc", reftarget="/" + page,
                                     refexplicit=True, refdoc=env.docname)
        card = nodes.container(classes=["card"])
        picture = picture_in(folder, readme)
        if picture:
            place = relpath(join("cases", folder.name, picture), "cases/site")
            card += nodes.image(uri=place, alt=title)
        card += nodes.paragraph("", "", link)
        card += nodes.paragraph("", first_sentence(readme))
        time = time_of(folder.name, readme)
        if time is None:
            raise self.error(f"{folder.name}/README.md does not say behind its first command how long it takes, as # 8 CPU s")
        card += nodes.paragraph("", "", nodes.literal("", f"cases/{folder.name}"), nodes.Text(f", {time}"), classes=["folder"])
        if page_of_run(folder).is_file():
            moving = nodes.reference("", "its run, in motion", refuri=f"../{folder.name}/report.html", internal=True)
            card += nodes.paragraph("", "", moving, classes=["folder"])
        return card


def page_of_run(folder):
    """The page for the browser that `pfdm report` makes of the case in this folder."""
    return folder / "results/report/index.html"


def copy_pages_of_runs(app, failure):
    """Puts the pages of runs where the cards look for them."""
    if failure is None and app.builder.name == "html":
        for page in Path(app.srcdir).glob("cases/*/results/report/index.html"):
            place = Path(app.outdir) / "cases" / page.parents[2].name
            place.mkdir(parents=True, exist_ok=True)
            shutil.copy(page, place / "report.html")


def setup(app):
    app.add_directive("gallery", Gallery)
    app.connect("build-finished", copy_pages_of_runs)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
