# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What Treadmark raises and warns of."""
from __future__ import annotations


class TreadmarkError(Exception):
    """Something is wrong with what was asked: what, where in the input, and what to do instead.

    Attributes: ``message``, ``file``, ``line`` and ``column`` (from 1; 0 = unknown), ``advice`` (may be empty).
    """

    def __init__(self, message: str, file: str = "", line: int = 0, column: int = 0, advice: str = "") -> None:
        super().__init__(message, file, line, column, advice)
        self.message, self.file, self.line, self.column, self.advice = message, file, line, column, advice

    def __str__(self) -> str:
        place = ":".join(str(part) for part in (self.file, self.line, self.column) if part)
        return (place + ": " if place else "") + self.message + (f" ({self.advice})" if self.advice else "")


class InputError(TreadmarkError, ValueError):
    """An argument, a setting or a file is wrong, missing or not supported."""


class NumericalError(TreadmarkError, ArithmeticError):
    """A computation that has no meaningful result."""


class Cancelled(TreadmarkError):
    """Work that ended early because its caller asked for it."""


class ConvergenceWarning(UserWarning):
    """A solution has the status "not_converged" or "failed": its message says why."""
