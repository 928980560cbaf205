"""What goes wrong, as exceptions."""

from __future__ import annotations

import difflib
import re
from collections.abc import Iterable


def no_such(key: str, names: Iterable[str]) -> KeyError:
    """A KeyError of a name that is not there, with those that are spelled like it."""
    alike = {str(name): difflib.SequenceMatcher(None, str(name), key).ratio() for name in names}
    least = max(0.6, max(alike.values(), default=0.0) - 0.1)
    near = sorted((name for name in alike if alike[name] >= least), key=lambda name: -alike[name])[:3]
    return KeyError(f"{key} (near: {', '.join(near)})" if near else key)


class Error(Exception):
    """Base of what this module raises. str(error) is the message of the program, without its option --set."""


class InputError(Error):
    """A case, a key or a file that is wrong (exit status 2 of the program).

    Attributes:
        file: path of the file that the message names, or None.
        line: number of the line in it, from 1, or None, as for a value that was set and is not in the file.
        key: the key of case.toml in question, as "materials.glass.poisson_ratio", or None.
    """

    def __init__(self, message: str) -> None:
        super().__init__(re.sub(r"^--set (?=[^:=\s]+: )", "", message.replace(" with --set:", ":")))
        place = re.match(r"(?P<file>[^:\n]+?)(?: with --set)?(?::(?P<line>\d+))?: ", message)
        if place and (message.startswith("--") or not re.search(r"/|\.\w+$", place["file"])):
            place = None  # words of an option or of a value
        self.file: str | None = place["file"] if place else None
        self.line: int | None = int(place["line"]) if place and place["line"] else None
        within = re.search(r"\[(?P<table>[\w.\[\]-]+)\] (?:\"(?P<unknown>[^\"]+)\"|(?P<key>[\w.\[\]-]+):)", message)
        of_set = re.match(r"--set (?P<key>[^:=\s]+)", message)
        self.key: str | None = of_set["key"] if of_set else None
        if within:
            self.key = f"{within['table']}.{within['unknown'] or within['key']}"


class ComputationError(Error):
    """A computation that failed: no convergence, no memory, a full disk (exit status 1 of the program)."""


class MissingResult(Error):
    """A result that is not there (yet), with the command that makes it."""
