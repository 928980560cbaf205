"""Checks a built site: every link within it leads to a file and a place that are there, and the search finds what it should.

    check_site.py FOLDER

Exit status: 0, or 1 with a line for each fault.
"""

import json
import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

WORDS = ["debonding", "toughness", "Prony", "Krylov", "endochronic", "Sylgard", "homogenize", "snap-back", "irreversibility",
         "traction-separation", "phase-field", "viscoelastic"]


class Page(HTMLParser):
    """The links and the marked places of a page."""

    def __init__(self, text):
        super().__init__()
        self.links, self.places = [], set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name in ("id", "name"):
                self.places.add(value)
            elif name in ("href", "src") and value:
                self.links.append(value)


def faults_of_links(folder):
    pages = {file: Page(file.read_text()) for file in folder.rglob("*.html")}
    for file, page in pages.items():
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme in ("http", "https", "mailto", "data"):
                continue
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            if not target.is_file():
                yield f"{file.relative_to(folder)}: {link} leads nowhere"
            elif parts.fragment and target in pages and unquote(parts.fragment) not in pages[target].places:
                yield f"{file.relative_to(folder)}: {link}: no such place in that page"


def faults_of_search(folder):
    """The search's index is by stems of words in small letters; a word joined by a hyphen is searched by its parts."""
    index = json.loads(re.search(r"Search\.setIndex\((.*)\)", (folder / "searchindex.js").read_text(), re.S)[1])
    terms = set(index["terms"]) | set(index["titleterms"])
    for word in WORDS:
        for part in word.lower().split("-"):
            if not any(term.startswith(part[:5]) and part.startswith(term[:5]) for term in terms):
                yield f"the search does not find {word}"


def main():
    folder = Path(sys.argv[1]).resolve()
    faults = [*faults_of_links(folder), *faults_of_search(folder)]
    print("\n".join(faults) or f"{len(list(folder.rglob('*.html')))} pages, no broken link")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
