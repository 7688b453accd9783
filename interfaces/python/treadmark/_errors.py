# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What Treadmark raises and warns of."""
from __future__ import annotations

import errno
import pathlib
import re

#: What the program calls otherwise.
_WORDS = (("--nominal-radius in mm", "nominal_radius in m"), ("--body wheel or --body rail", 'body="wheel" or body="rail"'),
          ("treadmark list profiles", "treadmark.profiles()"), ("treadmark list backends", "treadmark.backends()"))
#: What the folder of files begins with that are written for arrays.
ARRAYS = "treadmark-arrays-"


def without_folder(text: str) -> str:
    """The same without the folder of files that are written for arrays."""
    return re.sub(rf"[^\s'\"]*{ARRAYS}\w+/\d+/", "", text)


def _in_python(text: str) -> str:
    """The same with the names that functions of this package have for options and verbs of the program."""
    text = re.sub(r"^override '.*?': ", "", text)
    for theirs, ours in _WORDS:
        text = text.replace(theirs, ours)
    return re.sub(r"(?<![\w-])--([a-z][a-z-]*)", lambda option: option[1].replace("-", "_"), text)


class TreadmarkError(Exception):
    """Something is wrong with what was asked: what, where in the input, and what to do instead.

    Attributes: ``message``, ``file``, ``line`` and ``column`` (from 1; 0 = unknown), ``advice`` (may be empty).
    """

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0, advice: str = "") -> None:
        message, file, advice = _in_python(without_folder(message)), without_folder(file), _in_python(without_folder(advice))
        if pathlib.PurePath(file).name == "dictionary":  # of which nobody sees lines
            file, line, column = "", 0, 0
        super().__init__(message, file, line, column, advice)
        self.message, self.file, self.line, self.column, self.advice = message, file, line, column, advice

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        if pathlib.PurePath(self.file).name == "text" and self.line:
            place = f"line {self.line}, column {self.column} of the text"
        return (place + ": " if place else "") + self.message + (f" ({self.advice})" if self.advice else "")


class InputError(TreadmarkError, ValueError):
    """An argument, a setting or a file is wrong, missing or not supported."""


class MissingFileError(InputError, FileNotFoundError):
    """A file that is not there."""

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0, advice: str = "") -> None:
        super().__init__(message, file, line, column, advice)
        self.errno, self.filename = errno.ENOENT, file or None


class NumericalError(TreadmarkError, ArithmeticError):
    """A computation that has no meaningful result."""


class Cancelled(TreadmarkError):
    """Work that ended early because its caller asked for it."""


class ConvergenceWarning(UserWarning):
    """A solution has the status "not_converged" or "failed": its message says why."""
