"""Case files with one thing wrong each, made from good cases and from the schema of their keys."""

import copy
import json
import math
import subprocess
import tomllib
from pathlib import Path

LONG = "x" * 100_000


class Bytes(bytes):
    """What stands in the file as it is."""


def value_text(value):
    """A value as TOML, in bytes."""
    if isinstance(value, Bytes):
        return bytes(value)
    if isinstance(value, bool):
        return b"true" if value else b"false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=True).encode()
    if isinstance(value, float):
        return (repr(value) if math.isfinite(value) else str(value)).encode()
    if isinstance(value, list):
        return b"[" + b", ".join(value_text(v) for v in value) + b"]"
    if isinstance(value, dict):
        return b"{ " + b", ".join(json.dumps(k).encode() + b" = " + value_text(v) for k, v in value.items()) + b" }"
    return str(value).encode()


def file_text(case):
    """A case as a file: tables on a line of their own each key."""
    plain = {k: v for k, v in case.items() if not isinstance(v, dict)}
    lines = [json.dumps(k).encode() + b" = " + value_text(v) for k, v in plain.items()]
    for name, table in case.items():
        if isinstance(table, dict):
            lines.append(b"\n[" + json.dumps(name).encode() + b"]")
            lines += [json.dumps(k).encode() + b" = " + value_text(v) for k, v in table.items()]
    return b"\n".join(lines) + b"\n"


def leaves(value, path=()):
    """(path, value) of all that is in a case, lists and tables included."""
    if path:
        yield path, value
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, (*path, key))
    elif isinstance(value, list):
        for i, inner in enumerate(value[:2]):
            yield from leaves(inner, (*path, i))


def with_value(case, path, value):
    """The case with another value at the path; None removes it."""
    changed = copy.deepcopy(case)
    at = changed
    for key in path[:-1]:
        at = at[key]
    if value is None:
        del at[path[-1]]
    else:
        at[path[-1]] = value
    return changed


def is_quantity(value):
    head, _, unit = value.partition(" ")
    try:
        float(head)
    except ValueError:
        return False
    return bool(unit)


def wrong_values(value):
    """(what, value, whether it is surely wrong) to be put in place of a good one."""
    nested = Bytes(b"[" * 2000 + b"]" * 2000)
    yield "missing", None, False
    yield "table for value", {"unknown_key_of_a_table": 1}, not isinstance(value, dict)
    yield "not UTF-8", Bytes(b'"l\xe4tin"'), True
    yield "too deep", nested, True
    yield "long", LONG, isinstance(value, (int, float, list, dict))
    yield "control characters", "a\x1b[2J\nb\x00c", False
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        yield "number for value", 12345678, isinstance(value, bool)
    if not isinstance(value, bool):
        yield "flag for value", True, True
    if isinstance(value, str) and is_quantity(value):
        number, _, unit = value.partition(" ")
        yield "wrong unit", number + " kg s^7", True
        yield "no such unit", number + " furlongs_per_" + "y" * 500, True
        yield "no unit", number, False
        yield "not a number", "nan " + unit, True
        yield "infinite", "inf " + unit, True
        yield "negative", "-" + number + " " + unit, False
        yield "huge", "1e300 " + unit, False
        yield "overflow", "1e999 " + unit, True
        yield "tiny", "1e-300 " + unit, False
    elif isinstance(value, str):
        yield "empty text", "", False
        yield "unknown word", "no_such_word", False
        yield "upwards", "../" * 200 + "x", False
    elif isinstance(value, (int, float)):
        for what, number in (("not a number", math.nan), ("infinite", math.inf)):
            yield what, number, True
        for what, number in (("negative", -value - 1), ("huge", 10**18), ("overflow", 1e300), ("fraction", 0.123456)):
            yield what, number, False
        yield "beyond integers", Bytes(b"9" * 400), False
    elif isinstance(value, list):
        yield "empty list", [], False
        yield "long list", value[:1] * 5000, False
        yield "mixed list", [*value, {"a": [1, "b"]}], False
    elif isinstance(value, dict):
        yield "unknown key", {**value, "no_such_key": 1}, False
        yield "long key", {**value, LONG: 1}, False
        yield "key of quotes", {**value, "a\nb\"c'\x7f": 1}, False


def absent_keys(schema, case):
    """Paths of keys that a table of the case could have."""
    for name, node in schema["properties"].items():
        if name not in case:
            yield (name,)
        elif isinstance(case[name], dict):
            for key in node.get("properties", {}):
                if key not in case[name]:
                    yield (name, key)


def bad_versions(case, schema):
    """(what, function that gives the bytes of the file, whether it is surely wrong) of a good case."""

    def changed(path, wrong):
        return lambda: file_text(with_value(case, path, wrong))

    for path, value in leaves(case):
        where = ".".join(str(part) for part in path)
        for what, wrong, surely in wrong_values(value):
            if wrong is None and isinstance(path[-1], int):
                continue
            yield f"{where}: {what}", changed(path, wrong), surely
    for path in absent_keys(schema, case):
        where = ".".join(path)
        for what, wrong in (("added, a date", Bytes(b"1979-05-27")), ("added, not a number", math.nan)):
            yield f"{where}: {what}", changed(path, wrong), True
    text = file_text(case)
    surely_wrong = ("twice", "empty", "bytes", "zeros", "byte order mark of UTF-16")
    for what, wrong in (
        ("line of blanks", text + b" " * 200_000 + b"\n"),
        ("long comment", text + b"# " + b"c" * 200_000 + b"\n"),
        ("comment in Latin-1", text + b"# Pr\xfcfk\xf6rper\n"),
        ("byte order mark of UTF-16", text.decode().encode("utf-16")),
        ("zeros", text[:100] + b"\0" * 100 + text[100:]),
        ("dotted key", b".".join([b"a"] * 30_000) + b" = 1\n" + text),
        ("twice", text + text),
        ("cut", text[: len(text) * 2 // 3]),
        ("empty", b""),
        ("bytes", bytes(range(256)) * 20),
        ("tables in tables", b"".join(b"[a" + b".a" * i + b"]\n" for i in range(300)) + text),
    ):
        yield f"file: {what}", lambda wrong=wrong: wrong, what in surely_wrong


def read_case(file):
    return tomllib.loads(Path(file).read_text(encoding="utf-8"))


def read_schema(program):
    return json.loads(subprocess.run([program, "help", "--schema"], check=True, capture_output=True).stdout)
