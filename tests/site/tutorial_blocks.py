"""Blocks of a page in Markdown, and what can be done with one."""

import re
import subprocess
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path


class Skipped(Exception):
    """What a step needs is not installed."""


@dataclass
class Block:
    language: str  # "" of an indented one
    text: str


def blocks_of(page):
    """Fenced and indented blocks in their order."""
    found, lines, at = [], page.splitlines(), 0
    while at < len(lines):
        if fence := re.match(r"```(\w*)$", lines[at]):
            end = lines.index("```", at + 1)
            found.append(Block(fence[1], "\n".join(lines[at + 1:end]) + "\n"))
            at = end
        elif lines[at].startswith("    ") and not lines[at - 1].strip():
            end = at
            while end < len(lines) and (lines[end].startswith("    ") or not lines[end].strip()):
                end += 1
            found.append(Block("", re.sub("^    ", "", "\n".join(lines[at:end]).rstrip() + "\n", flags=re.M)))
            at = end - 1
        at += 1
    return found


@dataclass
class Tried:
    """How far a tutorial is."""

    folder: Path
    with_slow: bool
    said: str = ""
    other_words: dict | None = None  # of the next block

    def run(self, commands):
        done = subprocess.run(["bash", "-e", "-c", commands], cwd=self.folder, capture_output=True, text=True)
        self.said = done.stdout + done.stderr
        if done.returncode != 0:
            raise AssertionError(f"status {done.returncode} of\n{commands}\n{self.said[-2000:]}")

    def expect(self, words):
        squeezed = " ".join(self.said.split())
        for each in words:
            if " ".join(each.split()) not in squeezed:
                raise AssertionError(f"nothing says \"{each}\" in\n{self.said[-3000:]}")


@dataclass
class Command:
    """Commands are run. `slow` ones only where that is asked for, but the lines with the word `quick`."""

    says: tuple = ()
    slow: bool = False
    quick: str = ""

    def __call__(self, block, tried):
        if block.language:
            raise AssertionError(f"commands were expected in place of\n{block.text}")
        if not self.slow or tried.with_slow:
            tried.run(block.text)
            tried.expect(self.says)
        elif self.quick:
            tried.run("\n".join(line for line in block.text.splitlines() if f" {self.quick} " in line))


@dataclass
class Write:
    """The block is a file, or its end."""

    path: str
    append: bool = False

    def __call__(self, block, tried):
        file = tried.folder / self.path
        file.parent.mkdir(parents=True, exist_ok=True)
        file.write_text((file.read_text() + "\n" if self.append else "") + block.text)


@dataclass
class Merge:
    """The block's keys get its values in the tables that have them."""

    path: str

    def __call__(self, block, tried):
        file = tried.folder / self.path
        text, table = file.read_text(), ""
        for line in block.text.splitlines():
            if line.startswith("["):
                table = line.strip()
            elif line.strip():
                key, value = (part.strip() for part in line.split("=", 1))
                place = rf"({re.escape(table)}(?:(?!\n\[).)*?\n{key} *= )[^#\n]*"
                text, n = re.subn(place, lambda m, value=value: m[1] + value, text, count=1, flags=re.S)
                if n != 1:
                    raise AssertionError(f"{self.path}: no {key} in {table}")
        file.write_text(text)


@dataclass
class Replace:
    """The block takes the place of all tables with a name and of what is below them, or of a key."""

    path: str
    what: str
    first_only: bool = False
    then: str = ""
    says: tuple = ()

    def __call__(self, block, tried):
        file = tried.folder / self.path
        new = block.text
        for word, other in (tried.other_words or {}).items():
            if word not in new:
                raise AssertionError(f"no {word} in\n{new}")
            new = new.replace(word, other)
        text = file.read_text() + "\n"
        table = rf"^{re.escape(self.what)}[^\n]*\n(?:(?!\[).*\n)*"
        below = rf"(?:\[+{re.escape(self.what.strip('[]'))}\..*\n(?:(?!\[).*\n)*)*"
        found = re.compile(table + below if self.what.startswith("[") else rf"^{self.what} = .*\n", re.M)
        if not found.search(text):
            raise AssertionError(f"{self.path}: there is no {self.what}")
        file.write_text(found.sub(lambda _: new, text, count=1) if self.first_only else found.sub("", text) + new)
        if self.then:
            tried.run(self.then)
            tried.expect(self.says)


@dataclass
class Shown:
    """The block stands in the file."""

    path: str

    def __call__(self, block, tried):
        if block.text.strip() not in (tried.folder / self.path).read_text():
            raise AssertionError(f"{self.path} does not have\n{block.text}")


@dataclass
class Said:
    """The last command has said the block."""

    def __call__(self, block, tried):
        tried.expect(block.text.splitlines())


@dataclass
class Python:
    """The block is a script; what a reader adds to it stands before and after."""

    before: str = ""
    after: str = ""

    def __call__(self, block, tried):
        (tried.folder / "script.py").write_text(self.before + block.text + self.after)
        tried.run("./pfdm python script.py")


@dataclass
class Skip:
    """The block is not tried."""

    why: str

    def __call__(self, block, tried):
        pass


@dataclass
class Do:
    """What the text says between two blocks. What it returns are other words of the next block."""

    act: Callable
