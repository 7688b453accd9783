# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Contact of wheels and rails, of any shape.

All numbers are in SI units (m, N, Pa, rad, s); axes are x along the track, y to the right, z down; forces act on the rail. Whole files:
``run``, ``check``, ``compare``, ``bench``, ``import_scan``, ``simulate``, ``assess``, ``stability``, ``response``, ``sweep``, ``evolve``, ``track``. Profiles:
``geometry``, ``measure``, ``profiles``. Single instants: ``Surface``, ``Pair``, ``Problem``; tabulated: ``ForceTable``.
The handbook is docs/python.md.
"""
from __future__ import annotations

from . import _treadmark
from ._errors import Cancelled, ConvergenceWarning, InputError, MissingFileError, NumericalError, TreadmarkError
from ._inputs import checked as _checked
from ._records import (CASE_QUANTITIES, FIELDS, PATCH_QUANTITIES, Case, Field, Grid, KnownNumber, Patch, Quantity, Remark, Result,
                       Uncertainty)
from ._requests import (Conicity, GaugeMap, Geometry, Jump, LibraryProfile, LimitCheck, Measure, Measured, SecondContact, ShiftLimit, geometry,
                        measure, measure_files, measures_to_pandas, profiles)
from ._solving import Gradient, Pair, PatchSolver, Problem, ShapeGradient, Solution, State, hertz, settings
from ._surfaces import Evaluated, Line, Located, Surface, backends, load_plugins, register_backend
from ._tables import ForceTable, TableError
from ._verbs import (Assessment, BandMap, Bench, Check, CheckedProfile, Column, Comparison, Event, Evolution, LivePage, Mode, Position, Response,
                     ScanImport, Simulation, Stability, Sweep, SweepRun, Track, Value, assess, bench, check, compare, evolve, import_scan, live,
                     read_bench, read_comparison, read_import, read_result, read_simulation, read_sweep, report, response, run, simulate, stability,
                     sweep, track)

__version__: str = _treadmark.version()


def version_text() -> str:
    """Version, revision, parts and licence of this build, as ``treadmark --version``."""
    return _treadmark.version_text()


def parts() -> dict[str, bool]:
    """Which parts this build has: "hdf5", "vehicle", "scans", ..."""
    return _treadmark.parts()


@_checked
def set_threads(count: int) -> None:
    """Threads of all calls of this process, at most; 0 = all of the machine. Results do not depend on it."""
    _treadmark.set_threads(count)


__all__ = [name for name in dir() if not name.startswith("_") and name != "annotations"] + ["__version__"]
