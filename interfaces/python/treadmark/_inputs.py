# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What functions take as input: files, TOML text, dictionaries, changes of keys."""
from __future__ import annotations

import json
import os
import pathlib
from typing import Any, Iterable, Mapping, Union

from . import _treadmark
from ._errors import InputError

#: A file (.toml, .inp), text of a .toml file (anything with more than one line), or a dictionary of its tables.
Input = Union[str, "os.PathLike[str]", Mapping[str, Any]]
#: Changes of keys as ``--set`` of the program: {"wheelset.y_mm": 5.0} or ["wheelset.y_mm=5.0"].
Changes = Union[Mapping[str, Any], Iterable[str], None]
Path = Union[str, "os.PathLike[str]"]


def number(value: Any, name: str, unit: str = "m") -> float:
    """A value as a number, or a TypeError that says what is wanted. unit: what numbers of this name are in."""
    if not isinstance(value, (str, bytes)):
        try:
            return float(value)
        except (TypeError, ValueError):
            pass
    raise TypeError(f"{name} must be a number{'' if unit in ('', '1') else ' in ' + unit}, not {value!r}")


def toml_value(value: Any) -> str:
    """A value as TOML."""
    if hasattr(value, "tolist"):  # of NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {toml_value(item)}" for key, item in value.items()) + "}"
    if isinstance(value, Iterable):
        return "[" + ", ".join(toml_value(item) for item in value) + "]"
    raise TypeError(f"{type(value).__name__} cannot stand in a case: use numbers, text, lists and dictionaries")


def _key(key: Any) -> str:
    if not isinstance(key, str) or not all(part.replace("_", "").replace("-", "").isalnum() and part.isascii() for part in key.split(".")):
        raise InputError(f"{key!r} is not the name of a key", advice="use names with dots, as in \"wheelset.y_mm\"")
    return key


def _lines(table: Mapping[str, Any], prefix: str) -> Iterable[str]:
    for key, value in table.items():
        name = prefix + _key(key)
        if isinstance(value, Mapping) and value:
            yield from _lines(value, name + ".")
        else:
            yield f"{name} = {toml_value(value)}"


def to_toml(tables: Mapping[str, Any]) -> str:
    """The text of a case file from its tables: nested dictionaries, or keys with dots. A list ``cases`` becomes [[cases]]."""
    tables = dict(tables)
    cases = tables.pop("cases", [])
    lines = list(_lines(tables, ""))
    for case in cases:
        lines += ["[[cases]]", *_lines(case, "")]
    return "\n".join(lines) + "\n"


def assignments(changes: Changes) -> list[str]:
    """Changes as "key=value"."""
    if changes is None:
        return []
    if isinstance(changes, Mapping):
        return [f"{_key(key)}={toml_value(value)}" for key, value in changes.items()]
    if isinstance(changes, str):
        raise TypeError("set must be a dictionary, or a list of texts like \"wheelset.y_mm=5\"")
    return [str(change) for change in changes]


def source(given: Input, changes: Changes, folder: Path | None = None) -> _treadmark.Source:
    """What verbs read. folder: from which names of files in text and dictionaries count; None: the current one."""
    if isinstance(given, Mapping):
        text = to_toml(given)
    elif isinstance(given, str) and "\n" in given:
        text = given
    elif isinstance(given, (str, os.PathLike)):
        if folder is not None:
            raise InputError("a file has a folder of its own", advice="give folder with text and dictionaries only")
        return _treadmark.Source(pathlib.Path(given), None, assignments(changes))
    else:
        raise TypeError(f"a file name, TOML text or a dictionary is needed, not {type(given).__name__}")
    name = "dictionary" if isinstance(given, Mapping) else "text"
    return _treadmark.Source(pathlib.Path("" if folder is None else folder) / name, text, assignments(changes))
