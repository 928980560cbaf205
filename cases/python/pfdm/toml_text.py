"""Values of Python as pieces of TOML, and values of a case by their keys."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping, Sequence
from typing import Any

from .errors import no_such


def _name(key: object) -> str:
    """A key as TOML writes it: in quotes where it has other than letters, digits, "_" and "-"."""
    return str(key) if re.fullmatch(r"[A-Za-z0-9_-]+", str(key)) else json.dumps(str(key), ensure_ascii=False)


def toml_piece(value: Any) -> str:
    """A piece of TOML for a text, a number, a bool, a list, a dict, a number of NumPy or a quantity of pint.

    Raises TypeError for anything else.
    """
    if hasattr(value, "magnitude") and hasattr(value, "units"):  # pint
        return json.dumps(f"{float(value.magnitude)!r} {value.units:~C}", ensure_ascii=False)
    if hasattr(value, "tolist") and not isinstance(value, (str, bytes)):  # NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return json.dumps(value, ensure_ascii=False)
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, Mapping):
        return "{ " + ", ".join(f"{_name(name)} = {toml_piece(v)}" for name, v in value.items()) + " }"
    if isinstance(value, Sequence) and not isinstance(value, bytes):
        return "[" + ", ".join(toml_piece(v) for v in value) + "]"
    raise TypeError(f"a case has no value of the type {type(value).__name__}: {value!r}")


def toml_text(table: Mapping[str, Any], name: str = "") -> str:
    """A whole file of TOML: values, then a section for each dict, below the head [name].

    Lists of dicts are one element a line. Raises TypeError as toml_piece().
    """
    lines, sections = [], []
    for key, value in table.items():
        if isinstance(value, Mapping):
            sections.append(toml_text(value, f"{name}.{_name(key)}" if name else _name(key)))
        elif isinstance(value, (list, tuple)) and value and all(isinstance(v, Mapping) for v in value):
            lines.append(f"{_name(key)} = [\n" + "".join(f"  {toml_piece(v)},\n" for v in value) + "]\n")
        else:
            lines.append(f"{_name(key)} = {toml_piece(value)}\n")
    head = f"[{name}]\n" if name and (lines or not sections) else ""
    return "\n".join([head + "".join(lines), *sections] if head or lines else sections)


def parts_of(key: str) -> list[str | int]:
    """"boundary[1].displacement[2]" as ["boundary", 1, "displacement", 2]."""
    parts: list[str | int] = []
    for name, index in re.findall(r"([^.\[\]]+)|\[(\d+)\]", key):
        parts.append(name if name else int(index))
    return parts


def value_at(table: Any, key: str) -> Any:
    """The value of a dotted key in nested tables and lists. Raises KeyError with the key, and those like it, where there
    is none."""
    whole = table
    for part in parts_of(key):
        try:
            table = table[part]
        except (KeyError, IndexError, TypeError):
            raise no_such(key, leaves_of(whole)) from None
    return table


def set_at(table: Any, key: str, value: Any) -> None:
    """Sets the value of a dotted key in nested tables and lists; tables that are missing are made.

    Raises KeyError with the key where a list has no such element, or what it leads through is no table.
    """
    *way, last = parts_of(key)
    try:
        for part in way:
            if isinstance(part, str):
                table.setdefault(part, {})
            table = table[part]
        if not isinstance(last, str):
            table[last]  # an element that is there
        table[last] = value
    except (AttributeError, IndexError, TypeError):
        raise KeyError(key) from None


def leaves_of(table: Any, prefix: str = "") -> dict[str, Any]:
    """All keys with a value that is no table and no list of tables, as {"materials.glass.poisson_ratio": 0.2}."""
    leaves: dict[str, Any] = {}
    for name, value in table.items():
        key = f"{prefix}.{name}" if prefix else name
        if isinstance(value, dict):
            leaves |= leaves_of(value, key)
        elif isinstance(value, list) and value and all(isinstance(v, dict) for v in value):
            for i, element in enumerate(value):
                leaves |= leaves_of(element, f"{key}[{i}]")
        else:
            leaves[key] = value
    return leaves
