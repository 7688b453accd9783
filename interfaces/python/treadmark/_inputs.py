# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What functions take as input: files, TOML text, dictionaries, changes of keys."""
from __future__ import annotations

import atexit
import collections.abc as abc
import dataclasses
import functools
import hashlib
import inspect
import io
import json
import operator
import os
import pathlib
import reprlib
import shutil
import tempfile
import threading
import types
import typing
from typing import Annotated, Any, Iterable, Mapping, TypeVar, Union

import numpy as np
import numpy.typing as npt

from . import _treadmark
from ._errors import ARRAYS, InputError

#: A file (.toml, .inp), text of a .toml file (anything with more than one line), or a dictionary of its tables.
Input = Union[str, os.PathLike[str], Mapping[str, Any]]
#: Changes of keys as ``--set`` of the program: {"wheelset.y_mm": 5.0} or ["wheelset.y_mm=5.0"].
Changes = Union[Mapping[str, Any], Iterable[str], None]
Path = Union[str, os.PathLike[str]]
#: A file, or what it would hold [m]: a profile (n, 2) of y and z, or a cloud (n, 3) of x, y and z.
Shape = Union[Path, npt.NDArray[Any]]
Metre = Annotated[float, "m"]
Newton = Annotated[float, "N"]
Radian = Annotated[float, "rad"]

T = TypeVar("T")
#: What is wanted in words: one of it, several of it.
_WORDS: dict[Any, tuple[str, str]] = {
    float: ("a number", "numbers"), int: ("a whole number", "whole numbers"), str: ("text", "texts"), bool: ("True or False", ""), bytes: ("bytes", ""),
    os.PathLike: ("a file name", "file names"), np.ndarray: ("an array", "arrays"), abc.Mapping: ("a dictionary", ""), abc.Callable: ("a function", ""), Any: ("", "them")}


def _words(kind: Any, several: int = 0) -> str:
    origin, parts = typing.get_origin(kind) or kind, typing.get_args(kind)
    if origin is Annotated:
        return _words(parts[0], several) + f" in {parts[1]}"
    if origin in (Union, types.UnionType):
        return " or ".join(_words(part, several) for part in parts if part is not type(None) and not (part is str and os.PathLike[str] in parts))
    if origin not in _WORDS and parts:
        return (f"{len(parts)} " if origin is tuple else "a list of ") + _words(parts[0], 1)
    return _WORDS[origin][several] if origin in _WORDS else f"{'' if several else 'a '}{origin.__name__}"


def _taken(kind: Any, value: Any) -> Any:
    """The value as this kind. Errors: TypeError and others for what is none."""
    origin, parts = typing.get_origin(kind) or kind, typing.get_args(kind)
    if origin is Annotated:
        return _taken(parts[0], value)
    if origin in (Union, types.UnionType):
        for part in parts:
            try:
                return _taken(part, value)
            except (TypeError, ValueError, OverflowError):
                pass
    elif origin is Any or origin is abc.Callable and callable(value):
        return value
    elif origin is float and not isinstance(value, (str, bytes)):
        return float(value)
    elif origin is int and not isinstance(value, bool):
        return operator.index(value)
    elif origin is np.ndarray and hasattr(value, "__array__"):
        return np.asarray(value)
    elif origin in (tuple, abc.Iterable, abc.Sequence):
        if not isinstance(value, (str, bytes, Mapping)) and (origin is not tuple or len(value) == len(parts)):
            return tuple(map(_taken, parts, value)) if origin is tuple else [_taken(parts[0], item) for item in value]
    elif origin not in (float, int, abc.Callable) and isinstance(value, (bool, np.bool_) if origin is bool else origin):
        return value
    raise TypeError


def taken(name: str, kind: Any, value: Any) -> Any:
    """An argument as this kind. Errors: TypeError that names it and says what is wanted."""
    try:
        return value if kind is Any else _taken(kind, value)
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name} must be {_words(kind)}, not {reprlib.repr(value)}") from None


def checked(thing: T) -> T:
    """The function, or the class with all its methods, with arguments that are checked by their annotations: a TypeError says which of them is
    wrong and what is wanted."""
    if inspect.isclass(thing):
        for name, member in list(vars(thing).items()):
            if not name.startswith("_") or name == "__init__" and not dataclasses.is_dataclass(thing):
                if isinstance(member, classmethod):
                    setattr(thing, name, classmethod(checked(member.__func__)))
                elif inspect.isfunction(member):
                    setattr(thing, name, checked(member))
        return typing.cast(T, thing)
    function: Any = thing
    parameters = inspect.signature(function).parameters.values()
    names = [one.name for one in parameters if one.kind is one.POSITIONAL_OR_KEYWORD]

    @functools.lru_cache(maxsize=None)
    def kinds() -> dict[str, Any]:  # what the names mean is known when the modules are whole
        return {one.name: eval(one.annotation, function.__globals__) for one in parameters
                if one.annotation is not one.empty and one.kind not in (one.VAR_POSITIONAL, one.VAR_KEYWORD)}

    def take(name: str, value: Any) -> Any:
        return taken(name, kinds().get(name, Any), value)

    @functools.wraps(function)
    def call(*arguments: Any, **keywords: Any) -> Any:
        return function(*map(take, names, arguments), *arguments[len(names):], **{name: take(name, value) for name, value in keywords.items()})

    return typing.cast(T, call)


def number(value: Any, name: str, unit: str = "m") -> float:
    """A value as a number, or a TypeError that says what is wanted. unit: what numbers of this name are in."""
    try:
        return float(_taken(float, value))
    except (TypeError, ValueError, OverflowError):
        raise TypeError(f"{name} must be a number{'' if unit in ('', '1') else ' in ' + unit}, not {value!r}") from None


@functools.lru_cache(maxsize=None)
def _folder() -> pathlib.Path:
    """Of files that are written for arrays. It goes when this process ends: results may still ask for them."""
    made = pathlib.Path(tempfile.mkdtemp(prefix=ARRAYS))
    atexit.register(shutil.rmtree, made, ignore_errors=True)
    return made


def is_array(value: Any) -> bool:
    """Whether it stands for a file: an array, or (x, y, values) of a map."""
    return hasattr(value, "__array__") or isinstance(value, (tuple, list)) and len(value) == 3 and hasattr(value[2], "__array__") and np.ndim(value[0]) == 1


def file_of(given: Any, name: str) -> str:
    """The name of a file, where an array is given of one that is written for it.

    Arrays [m]: a profile (n, 2) of y and z; a cloud (n, 3) of x, y and z; a map (x, y, values) of the shapes (n,), (m,) and (n, m).
    """
    if isinstance(given, (str, os.PathLike)):
        return os.fspath(given)
    head, ending, text = "y [m],z [m]", ".csv", io.StringIO()
    try:
        if isinstance(given, (tuple, list)):
            x, y, values = (np.asarray(part, dtype=np.float64) for part in given)
            fits, array, head = values.shape == (len(x), len(y)), np.column_stack([x, values]), ",".join(["m", *map(repr, y.tolist())])
        else:
            array = np.ascontiguousarray(given, dtype="<f8")
            fits = array.ndim == 2 and array.shape[1] in (2, 3)
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must be numbers: {error}") from None
    if not fits:
        raise InputError(f"{name} has the shape {array.shape}", advice="a profile is (n, 2), a cloud (n, 3), a map (x, y, values): (n,), (m,) and (n, m)")
    if array.shape[1] == 3 and not isinstance(given, (tuple, list)):
        lines = ["ply", "format binary_little_endian 1.0", "comment [m]", f"element vertex {len(array)}", *(f"property double {axis}" for axis in "xyz"), "end_header\n"]
        data, ending = "\n".join(lines).encode() + array.tobytes(), ".ply"
    else:
        np.savetxt(text, array, fmt="%.17g", delimiter=",", header=head, comments="")
        data = text.getvalue().encode()
    file = _folder() / str(threading.get_native_id()) / f"{name.replace('.', '-')}-{hashlib.sha256(data).hexdigest()[:8]}{ending}"
    file.parent.mkdir(exist_ok=True)
    file.write_bytes(data)
    return str(file)


def toml_value(value: Any, key: str = "") -> str:
    """A value as TOML; an array under a key that names a file is written into one."""
    if key.rpartition(".")[2] in ("file", "nominal") and is_array(value):
        value = file_of(value, key)
    if hasattr(value, "tolist"):  # of NumPy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (int, float)):
        return repr(value)
    if isinstance(value, (str, os.PathLike)):
        return json.dumps(os.fspath(value), ensure_ascii=False)
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{_key(key)} = {toml_value(item, key)}" for key, item in value.items()) + "}"
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
            yield f"{name} = {toml_value(value, name)}"


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
        return [f"{_key(key)}={toml_value(value, key)}" for key, value in changes.items()]
    return [str(change) for change in changes]


def source(given: Input, changes: Changes, folder: Path | None = None) -> _treadmark.Source:
    """What verbs read. folder: from which names of files in text and dictionaries count; None: the current one."""
    if isinstance(given, Mapping):
        text = to_toml(given)
    elif isinstance(given, str) and "\n" in given:
        text = given
    else:
        if folder is not None:
            raise InputError("a file has a folder of its own", advice="give folder with text and dictionaries only")
        return _treadmark.Source(pathlib.Path(given), None, assignments(changes))
    name = "dictionary" if isinstance(given, Mapping) else "text"
    return _treadmark.Source(pathlib.Path("" if folder is None else folder) / name, text, assignments(changes))
