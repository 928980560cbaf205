"""Links of the checkout's Markdown as GitHub follows them: to folders, and to places marked by <a id="name">."""

from pathlib import Path
from posixpath import dirname, join, normpath

from docutils import nodes


def page_of(env, folder, path):
    """The page that a path from a folder names: a Markdown file, or a folder by its README.md; None if there is none."""
    name = normpath(join(folder, path)).removesuffix(".md")
    for page in (name, join(name, "README").removeprefix("./")):
        if page in env.found_docs:
            return page
    return None


def resolve(app, env, node, content):
    """A reference for a pending link of MyST, or None: then Sphinx warns of it."""
    path, _, place = node["reftarget"].partition("#")
    here = node["refdoc"]
    page = page_of(env, dirname(here), path) if path else here
    if page is None and not place and (Path(env.srcdir) / dirname(here) / path).is_dir():
        return content  # a folder of sources: its name alone
    if page is None or (place and f'id="{place}"' not in Path(env.doc2path(page)).read_text()):
        return None
    to = app.builder.get_relative_uri(here, page) + ("#" + place if place else "")
    return nodes.reference("", "", *content.children, internal=True, refuri=to)


def setup(app):
    app.connect("missing-reference", resolve)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
