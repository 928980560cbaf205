"""The schema that editors check a case file against accepts every file of a shipped case that names it.

check_schema.py CASES_DIR; skipped (77) where Python lacks jsonschema or tomllib.
"""

import json
import sys
from pathlib import Path

try:
    import tomllib

    import jsonschema
except ImportError as absent:
    print(absent)
    sys.exit(77)


def first_line(path):
    with path.open(encoding="utf-8") as file:
        return file.readline().strip()


def deepest(error):
    """Of an error with alternatives that all failed, the one that got furthest into the file."""
    while error.context:
        error = max(error.context, key=lambda inner: len(inner.absolute_path))
    return error


def schema_named_by(path):
    """The schema file that the first line of a case file names, or None."""
    head, _, name = first_line(path).partition(" ")
    return (path.parent / name).resolve() if head == "#:schema" else None


def main():
    cases = Path(sys.argv[1]).resolve()
    schema_path = cases / "case.schema.json"
    schema = json.loads(schema_path.read_text(encoding="utf-8"))
    jsonschema.Draft4Validator.check_schema(schema)
    validator = jsonschema.Draft4Validator(schema)
    held, refused = 0, 0
    for path in sorted(cases.glob("*/*.toml")):
        if schema_named_by(path) != schema_path:
            if path.name == "case.toml":
                refused += 1
                print(f"{path}: the first line names no schema")
            continue
        held += 1
        for error in validator.iter_errors(tomllib.loads(path.read_text(encoding="utf-8"))):
            refused += 1
            found = deepest(error)
            print(f"{path}: {'.'.join(map(str, found.absolute_path))}: {found.message[:200]}")
    print(f"{held} files held against {schema_path.name}, {refused} errors")
    return 1 if refused or not held else 0


if __name__ == "__main__":
    sys.exit(main())
