"""Links of the checkout's Markdown to folders, which GitHub follows: to the folder's README.md, or else the name alone."""

import re
from pathlib import Path

LINK = re.compile(r"(?<!!)\[((?:[^][]|\[[^][]*\])*)\]\(([^)#: ]+)\)")


def follow_folders(app, page, source):
    """Rewrites the links of a page in place."""
    folder = Path(app.env.doc2path(page)).parent

    def follow(link):
        text, target = link.groups()
        place = folder / target
        if not place.is_dir():
            return link[0]
        return f"[{text}]({target.rstrip('/')}/README.md)" if (place / "README.md").is_file() else text

    source[0] = LINK.sub(follow, source[0])


def setup(app):
    app.connect("source-read", follow_folders)
    return {"version": "1", "parallel_read_safe": True, "parallel_write_safe": True}
