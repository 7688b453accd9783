# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Forces of a wheel on a rail from a table, with their error against the exact theory."""
from __future__ import annotations

import threading
import warnings
from pathlib import PurePath
from typing import Any, Mapping, NamedTuple

import numpy as np

from . import _treadmark
from ._errors import ConvergenceWarning, InputError
from ._inputs import Changes, Path, assignments, checked
from ._records import Array
from ._solving import Pair, Problem

_MOTION = [row[0] for row in _treadmark.tables()["motion"]]
_FORCES = [row[0] for row in _treadmark.tables()["forces"]]


class TableError(NamedTuple):
    """How far a number of a table is from the exact theory at the points of the comparison; "z" in m, the others without unit."""

    worst: float
    rms: float


@checked
class ForceTable:
    """Forces of a round wheel on a prismatic rail, tabulated by lateral place, roll, yaw and load, for programs that ask often.

    ``ForceTable.of_pair(pair)`` makes one, ``ForceTable.read(file)`` reads what it or ``treadmark table`` wrote. What it is and how far to
    trust it: docs/tables.md. Several threads may use one; they wait for each other.
    """

    __slots__ = ("_table", "_lock")

    #: Names of what forces() takes and gives, in SI units: (name, unit, meaning).
    motion_numbers: list[tuple[str, str, str]] = [(row[0], row[1], row[2]) for row in _treadmark.tables()["motion"]]
    force_numbers: list[tuple[str, str, str]] = [(row[0], row[1], row[2]) for row in _treadmark.tables()["forces"]]

    def __init__(self, held: _treadmark.ForceTable) -> None:
        self._table = held
        self._lock = threading.Lock()

    @classmethod
    def of_pair(cls, pair: Pair, problem: Problem | None = None, *, set: Changes = None) -> "ForceTable":
        """Solves all nodes and compares with the exact theory: minutes. problem: of which track, wheelset, material, friction and vertical
        force count; None: that of the pair. set: options of ``treadmark table`` by their names with underscores and units:
        ``set={"lateral_range_mm": 8, "yaw_mrad": 20}``."""
        given = problem or pair.problem
        return cls(_treadmark.ForceTable.create(pair._open(), given._case, assignments(set)))

    @classmethod
    def read(cls, file: Path) -> "ForceTable":
        """From a file .h5 or .json. Errors: InputError for what is no table."""
        return cls(_treadmark.ForceTable.read(PurePath(file)))

    def write(self, file: Path) -> None:
        """As a file .h5 or .json, which hold all of it, or .csv, which holds the nodes."""
        with self._lock:
            self._table.write(PurePath(file))

    def forces(self, **motion: Any) -> dict[str, Array]:
        """Forces of motions in SI units: ``table.forces(y=3e-3, vx=20.0, vpitch=-43.5, vertical_load=60e3)``.

        Arrays are broadcast; every force has their shape. What is not named is 0. Where the wheel is in the air all forces are 0; what the
        table does not cover is NaN, and warned of (ConvergenceWarning). Errors: InputError for other names.
        """
        for name in motion:
            if name not in _MOTION:
                raise InputError(f"a table of forces knows no {name!r}", advice="it takes " + ", ".join(_MOTION))
        try:
            given = np.broadcast_arrays(*(np.asarray(value, dtype=np.float64) for value in motion.values()))
        except ValueError as error:
            raise InputError(f"the arrays do not fit each other: {error}") from None
        shape = given[0].shape if given else ()
        rows = np.zeros((int(np.prod(shape)), len(_MOTION)))
        for name, values in zip(motion, given):
            rows[:, _MOTION.index(name)] = values.ravel()
        with self._lock:
            found, status, messages = self._table.evaluate(rows, len(_FORCES))
        outside = [i for i, word in enumerate(status) if word in ("failed", "not_converged")]
        if outside:
            warnings.warn(f"{status[outside[0]]}: {messages[outside[0]]}" + (f" ({len(outside)} motions)" if len(outside) > 1 else ""),
                          ConvergenceWarning, stacklevel=3)
        return {name: found[:, i].reshape(shape) for i, name in enumerate(_FORCES)}

    @property
    def errors(self) -> Mapping[str, TableError]:
        """Of the numbers that were compared with the exact theory, by their names."""
        return {name: TableError(*self._table.error(name)) for name in ("z", "normal_force", "fx", "fy", "spin_moment", "t_gamma")}

    def __repr__(self) -> str:
        return f"<ForceTable: normal force within {100.0 * self.errors['normal_force'].worst:.3g} % of the exact theory>"
