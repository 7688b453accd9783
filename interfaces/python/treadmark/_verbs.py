# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""What the program's verbs do, and readers of the files that they write."""
from __future__ import annotations

import csv
import dataclasses
import difflib
import html
import importlib
import json
import math
import os
import pathlib
import re
import urllib.parse
from typing import TYPE_CHECKING, Annotated, Any, Callable, Iterable, NamedTuple, Optional, Sequence

import numpy as np
import numpy.typing as npt

from . import _treadmark
from ._errors import ARRAYS, Cancelled, InputError, MissingFileError, without_folder
from ._inputs import Changes, Input, Metre, Path, Shape, assignments, checked, file_of, is_array, source as _source
from ._others import Drawn
from ._records import Array, Case, Held, Result, case_of, frame, html_table, result_of, result_of_json

if TYPE_CHECKING:
    import pandas

#: Told (finished, total, what); returning False ends the work early.
Progress = Optional[Callable[[int, int, str], Any]]


@checked
def run(source: Input, *, set: Changes = None, folder: Path | None = None, backend: str | None = None, wheel_backend: str | None = None,
        rail_backend: str | None = None, resolution: Metre | None = None, progress: Progress = None, threads: int = 0) -> Result:
    """Solves all cases of a case file (.toml, .inp), of its text or of a dictionary, as ``treadmark run`` does.

    set: changes of keys, {"wheelset.y_mm": 5.0}; folder: from which names of files in text count; backend: representation of both surfaces,
    or of each; resolution [m]: of what is sampled for it; progress: called with (finished, total, what); threads: at most, 0 = all.
    A case that fails has its status; the others go on. Errors: InputError with file, line and column. Ctrl-C ends it.

    >>> result = run({"rail.shape.standard": "60E1", "wheel.shape.standard": "S1002", "wheelset.vertical_force_N": 80e3,
    ...               "discretisation": {"dx_mm": 1.0, "ds_mm": 1.0}})
    >>> result.cases[0].patches[0].pressure.ndim
    2
    """
    changes = assignments(set)
    for body, own in (("wheel", wheel_backend), ("rail", rail_backend)):
        if own or backend:
            changes.append(f"{body}.backend={own or backend}")
        if resolution is not None:
            changes.append(f"{body}.resolution_mm={1e3 * resolution!r}")
    return result_of(_treadmark.run(_source(source, changes, folder), progress, threads))


class CheckedProfile(NamedTuple):
    """What is seen of a profile: facts and warnings as (name, text)."""

    name: str
    facts: list[tuple[str, str]]
    doubts: list[tuple[str, str]]
    notes: list[str]


class Position(NamedTuple):
    """A wheel over its rail without mechanics: curves across the track (n, 2) of y, z in track axes [m]; least gap along z [m]: negative where
    they lie in each other, NaN where no wheel is over the rail."""

    case: int
    least_gap: float
    rail: Array
    wheel: Array

    def svg(self) -> str:
        """The section as a picture."""
        gap = "no wheel over the rail" if self.least_gap != self.least_gap else f"least gap {1e3 * self.least_gap:.4g} mm"
        return _treadmark.position_svg(f"Case {self.case}: {gap}", [(y, z) for y, z in self.rail.tolist()], [(y, z) for y, z in self.wheel.tolist()])

    def _repr_svg_(self) -> str:
        return self.svg()


@dataclasses.dataclass(eq=False)
class Check:
    """What check() understood of an input without errors."""

    kind: str  #: "cases", "simulation", "study" or "profile"
    count: int  #: of cases or runs
    notes: list[str]
    profiles: list[CheckedProfile]
    positions: list[Position]  #: of each case of a wheel on a rail

    def __repr__(self) -> str:
        doubts = sum(len(profile.doubts) for profile in self.profiles)
        return f"<Check: {self.kind}, {self.count}, no errors, {doubts} warnings>"

    def _repr_html_(self) -> str:
        rows = [{"profile": p.name, "what": name, "": text} for p in self.profiles for name, text in (*p.facts, *p.doubts)]
        return html.escape(repr(self)) + html_table(rows) + "".join(position.svg() for position in self.positions[:6])


@checked
def check(source: Input | Shape, *, set: Changes = None, folder: Path | None = None, body: str = "", kind: str = "") -> Check:
    """Reads all that a file of cases, a simulation, a study or a profile names, without solving anything.

    body: "wheel" or "rail" of a profile that does not tell, which may be an array (n, 2) of y and z [m], too; kind: "simulation" of text (else cases). Errors: InputError with the place.
    """
    file: Any = file_of(source, body or "profile") if is_array(source) else source
    given = _source(file, set, folder)
    kind = given.kind if given.kind != "text" else kind or "cases"
    if kind == "profile":
        if assignments(set):
            raise InputError("set changes keys of case files, this is a profile")
        return Check(kind, 1, [], [CheckedProfile(without_folder(name), *p) for name, *p in _treadmark.check_profile(pathlib.Path(file), body)], [])
    if kind != "cases":
        count, notes = _treadmark.check_simulation(given, kind == "study")
        return Check(kind, count, notes, [], [])
    count, notes, profiles, positions = _treadmark.check_cases(given)
    return Check(kind, count, [without_folder(note) for note in notes], [CheckedProfile(*p) for p in profiles], [Position(*p) for p in positions])


class _Text(Held):
    """What the JSON text of the same content says: names with their units, None where nothing is known."""

    _kept = ("json", "summary", "csv", "table", "maps", *(f"{name}svg" for name in ("", "charts_", "points_", "gauges_", "pressures_", "errors_", "costs_",
                                                                                 "before_", "removed_", "fitted_", "residual_")))

    def to_json(self) -> str:
        """The text of the JSON file."""
        return without_folder(self._held.json())

    @property
    def document(self) -> dict[str, Any]:
        """The content of the JSON file."""
        content: dict[str, Any] = json.loads(self.to_json())
        return content


@checked
class _Document(_Text):
    """The same with a folder and a report."""

    def write(self, folder: Path) -> None:
        """Writes the folder that the program writes with -o."""
        self._whole().write_folder(pathlib.Path(folder))

    def report(self, file: Path) -> None:
        """Writes the HTML report of this content."""
        import tempfile

        with tempfile.TemporaryDirectory() as folder:
            self.write(folder)
            _treadmark.report_folder(pathlib.Path(folder), pathlib.Path(file))


@checked
class Comparison(_Document, Drawn):
    """The same cases through several representations of the surfaces: the first candidate is the reference."""

    def __init__(self, held: _treadmark.Comparison) -> None:
        self._held = held
        self._document = super().document

    @property
    def document(self) -> dict[str, Any]:
        """The content of compare.json."""
        return self._document

    @property
    def complete(self) -> bool:
        """False where it was stopped."""
        return bool(self._document["complete"])

    @property
    def candidates(self) -> list[dict[str, Any]]:
        """Each representation, its bodies and how far they are from the reference, as in compare.json."""
        return list(self._document["candidates"])

    def cases(self, candidate: int) -> list[Case]:
        """Results of a candidate, from 0, with their fields."""
        if not 0 <= candidate < len(self.candidates):
            raise IndexError(f"there are {len(self.candidates)} candidates")
        return [case_of(raw) for raw in self._whole().cases(candidate)]

    def rows(self) -> list[dict[str, Any]]:
        """A dictionary a candidate and case, with names and units of compare.csv."""
        return list(self._document["rows"])

    def to_pandas(self) -> "pandas.DataFrame":
        """A row a candidate and case. Needs pandas."""
        return frame(self.rows())

    def table(self) -> str:
        """A line a candidate, for people."""
        return str(self._held.table())

    def svg(self, what: str = "errors") -> str:
        """A picture: "errors" over resolution, "costs", or "pressures"."""
        if what not in ("errors", "costs", "pressures"):
            raise ValueError('what must be "errors", "costs" or "pressures"')
        return str(getattr(self._held, what + "_svg")())

    def __repr__(self) -> str:
        return f"<Comparison of {len(self.candidates)} representations>"

    def _repr_html_(self) -> str:
        return self.svg() + self.svg("pressures") + f"<pre>{html.escape(self.table())}</pre>"


@checked
def compare(source: Input, *, set: Changes = None, folder: Path | None = None, backends: Iterable[str] = (), resolutions: Iterable[float] = (),
            bodies: str = "auto", wheel_backends: Iterable[str] = (), rail_backends: Iterable[str] = (), progress: Progress = None,
            threads: int = 0) -> Comparison:
    """The cases with the surfaces as given and in every representation at every resolution [m], as ``treadmark compare`` does.

    backends: default all that the shapes allow; bodies: "wheel", "rail", "both", or "auto": those that change along their length;
    wheel_backends with rail_backends: every one with every other. What cannot be built is a failure of that candidate.
    """
    if bodies not in ("auto", "wheel", "rail", "both"):
        raise InputError('bodies must be "auto", "wheel", "rail" or "both"')
    return Comparison(_treadmark.compare(_source(source, set, folder), list(backends), list(resolutions), bodies, list(wheel_backends),
                                         list(rail_backends), progress, threads))


@checked
class Bench(_Document, Drawn):
    """What representations cost: time and memory."""

    def __init__(self, held: _treadmark.Bench) -> None:
        self._held = held

    def rows(self) -> list[dict[str, Any]]:
        """A dictionary a representation and body, with names and units of bench.csv."""
        return list(self.document["rows"])

    def to_pandas(self) -> "pandas.DataFrame":
        """A row a representation and body. Needs pandas."""
        return frame(self.rows())

    def table(self) -> str:
        """For people."""
        return str(self._held.table())

    def svg(self) -> str:
        """Costs by backend and resolution as a picture."""
        return str(self._held.svg())

    def _repr_html_(self) -> str:
        return self.svg() + f"<pre>{html.escape(self.table())}</pre>"


@checked
def bench(source: Input | None = None, *, set: Changes = None, folder: Path | None = None, backends: Iterable[str] = (),
          resolutions: Iterable[float] = (), seconds_per_measure: float = 0.2, progress: Progress = None, threads: int = 1) -> Bench:
    """Times the representations of the surfaces of a case, by default a wheel with a flat on a rail with a squat. Checks agreement first."""
    given = None if source is None else _source(source, set, folder)
    return Bench(_treadmark.bench(given, assignments(set), list(backends), list(resolutions), seconds_per_measure, progress, threads))


class BandMap(NamedTuple):
    """Values over the unrolled running band, shape (rows along a, columns along s), NaN where nothing is; ends of a and s [m]."""

    values: npt.NDArray[np.float32]
    a_min: float
    a_max: float
    s_min: float
    s_max: float


@checked
class ScanImport(_Document):
    """What was done to a scan, from the points to the surface."""

    def __init__(self, held: _treadmark.Imported) -> None:
        self._held = held

    @property
    def maps(self) -> dict[str, BandMap]:
        """"density" and "removed" [1/m^2], "fitted", "residual", "noise" and "error" [m], without copies."""
        return {name: BandMap(*value) for name, value in self._held.maps().items()}

    def summary(self) -> str:
        """A page of text."""
        return str(self._held.summary())

    def svg(self, what: str = "fitted") -> str:
        """A picture: "before", "removed", "fitted" or "residual"."""
        if what not in ("before", "removed", "fitted", "residual"):
            raise ValueError('what must be "before", "removed", "fitted" or "residual"')
        return str(getattr(self._held, what + "_svg")())

    def _repr_html_(self) -> str:
        return self.svg() + f"<pre>{html.escape(self.summary())}</pre>"


@checked
def import_scan(scans: Shape | Sequence[Any], outputs: Path | Sequence[Path], *, settings: Path | None = None, set: Changes = None,
                progress: Progress = None, threads: int = 0) -> ScanImport:
    """From points of a scanner (or a gridded map of deviations) to a surface, as ``treadmark import`` does.

    scans: several files are several passes; an array (n, 3) of x, y and z [m] stands for a file, and so do (x, y, deviations) [m] of the shapes
    (n,), (m,) and (n, m) for that of a map; outputs: .slcs .slcw .ply .stl .obj .off .vdb .nvdb, read again by Surface.read; settings: a TOML
    file; set: changes of settings, {"scan.body": "wheel"}. Errors: InputError naming the file.
    """

    def paths(given: Any) -> list[pathlib.Path]:
        many = [given] if isinstance(given, (str, os.PathLike)) or is_array(given) else given
        return [pathlib.Path(file_of(one, "scan")) for one in many]

    read = paths(scans)
    if not read:
        raise InputError("there is no scan to import", advice="name its file")
    try:
        return ScanImport(_treadmark.import_scan(read, paths(outputs), None if settings is None else pathlib.Path(settings), assignments(set),
                                                 progress, threads))
    finally:
        for file in read:
            if ARRAYS in str(file):
                file.unlink(missing_ok=True)  # clouds are large


class Value(NamedTuple):
    """A number of a simulation with its unit and meaning."""

    name: str
    value: float
    unit: str
    meaning: str


class Column(NamedTuple):
    """A column of a history."""

    name: str
    unit: str
    meaning: str


class Event(NamedTuple):
    """A wheel that loses or regains contact, at a time [s] and a position [m]."""

    time: float
    position: float
    wheel: str
    kind: str


class Mode(NamedTuple):
    """A mode of the linearised system."""

    frequency: float  #: [Hz]
    damping_ratio: float
    shape: str


@checked
@dataclasses.dataclass(eq=False)
class Simulation(Held, Drawn):
    """A vehicle on its track in time. ``simulation["t_s"]`` is a column of its history, without a copy."""

    title: str
    status: str  #: "complete", "derailed", "interrupted" or "failed"
    message: str
    version: str
    input_file: str
    settings: list[str]
    swept: list[tuple[str, str]]  #: keys and values of the study it belongs to
    columns: list[Column]
    values: Array  #: shape (instants, columns), a view
    events: list[Event]
    summary: dict[str, Value]
    statics: dict[str, Value]
    modes: list[Mode]
    snapshots: list[Case]  #: contact fields at chosen instants
    snapshot_times: list[float]  #: [s]
    _held: Any = dataclasses.field(default=None, repr=False)

    def __getitem__(self, column: str) -> Array:
        names = [c.name for c in self.columns]
        if column not in names:
            raise KeyError(f"there is no column {column}; near are {difflib.get_close_matches(column, names)}, all are in columns")
        return self.values[:, names.index(column)]

    def __repr__(self) -> str:
        return f"<Simulation {self.title!r}: {self.status}, {len(self.values)} instants of {len(self.columns)} columns>"

    def to_pandas(self) -> "pandas.DataFrame":
        """A row an instant, a column a quantity (units in the names). Needs pandas."""
        return frame({c.name: self.values[:, k] for k, c in enumerate(self.columns)})

    def _axes(self) -> tuple[str, list[str]]:
        """Vertical forces of the wheels over time."""
        return "t_s", ([c.name for c in self.columns if c.name.endswith("Q_N")] or [c.name for c in self.columns[1:4]])[:6]

    def to_json(self) -> str:
        """The summary as ``treadmark simulate --json`` writes it."""
        return str((self._held or self._whole()).json())

    def write(self, folder: Path) -> None:
        """simulation.h5, history.csv, events.csv, modes.csv and pictures."""
        self._whole().write_folder(pathlib.Path(folder))

    def svg(self, columns: Sequence[str] = (), x: str = "t_s") -> str:
        """Columns over another one as a picture; default: vertical forces of the wheels."""
        return str(self._whole().svg(x, list(columns)[:6] or self._axes()[1], self.title))

    def _repr_html_(self) -> str:
        rows = [v._asdict() for v in self.summary.values()]
        return (self.svg() if self._is_whole() and len(self.values) > 1 else "") + html_table(rows, repr(self))


def _simulation_of(held: _treadmark.Simulated) -> Simulation:
    raw = held.content()
    raw["columns"] = [Column(*c) for c in raw["columns"]]
    raw["events"] = [Event(**e) for e in raw["events"]]
    raw["modes"] = [Mode(**m) for m in raw["modes"]]
    for name in ("summary", "statics"):
        raw[name] = {v[0]: Value(*v) for v in raw[name]}
    raw["snapshots"] = [case_of(c) for c in raw["snapshots"]]
    return Simulation(**raw, _held=held)


@checked
def simulate(source: Input, *, set: Changes = None, folder: Path | None = None, modes_only: bool = False, progress: Progress = None,
             threads: int = 0) -> Simulation:
    """A vehicle on its track in time, as ``treadmark simulate`` does; modes_only: equilibrium and modes, without integration.

    A numerical failure on the way gives the status "failed" and the history up to there.
    """
    return _simulation_of(_treadmark.simulate(_source(source, set, folder), modes_only, progress, threads))


def _table(text: str) -> "pandas.DataFrame":
    """A table of numbers and words in CSV. Needs pandas."""

    def value(cell: str) -> Any:
        try:
            return float(cell)
        except ValueError:
            return cell or math.nan

    return frame([{name: value(cell) for name, cell in row.items()} for row in csv.DictReader(text.splitlines())])


@checked
class _Table(_Text, Drawn):
    """The same as a table."""

    def __init__(self, held: Any) -> None:
        self._held = held

    def to_pandas(self) -> "pandas.DataFrame":
        """The rows of the program's table in CSV, with its names and units. Needs pandas."""
        return _table(self._held.csv())

    def summary(self) -> str:
        """For people."""
        return str(self._held.summary())


@checked
class _Found(_Table):
    """The same with a folder."""

    def write(self, folder: Path) -> None:
        """Writes the folder that the program writes with -o."""
        self._whole().write_folder(pathlib.Path(folder))


class _Drawn(_Found):
    """The same with a picture."""

    def svg(self) -> str:
        """As a picture."""
        return str(self._held.svg())

    def _repr_html_(self) -> str:
        return self.svg()


class Track(_Drawn):
    """How a track gives way under a wheel: a row a frequency. With a fitted track ``write`` adds fitted.toml."""

    @property
    def frequencies(self) -> npt.NDArray[np.float64]:
        """[Hz]"""
        return np.array(self.document["frequency_Hz"])

    @property
    def receptances(self) -> dict[str, npt.NDArray[np.complex128]]:
        """Motion of the rail under a force at it, by name [m/N]: "between" sleepers, "over" one, "mean" of a flexible track, "rail" of a
        lumped one, "fitted", "lateral"; where rails bend sideways also "lateral_between" and "lateral_over"."""
        return {name: np.array(curve["m_per_N"]) * np.exp(1j * np.radians(np.array(curve["phase_deg"])))
                for name, curve in self.document["curves"].items()}


@checked
def track(file: Path, *, set: Changes = None, from_Hz: Annotated[float, "Hz"] = 10.0, to_Hz: Annotated[float, "Hz"] = 1500.0, count: int = 200, fit: int = 0) -> Track:
    """How the track of a file gives way, as ``treadmark track`` does; fit: layers of a lumped track that is fitted to it, 0 = none."""
    return Track(_treadmark.track(pathlib.Path(file), assignments(set), (from_Hz, to_Hz), count, fit))


class Stability(_Drawn):
    """Eigenvalues of a vehicle by its speed: a row a speed and mode."""

    @property
    def verdict(self) -> str:
        """"stable" or "unstable" at all speeds, "critical": a critical speed is between them, or "unknown"."""
        return str(self.document["verdict"])

    @property
    def critical_speed(self) -> float:
        """[m/s]; NaN where none was found."""
        return float(self.document.get("critical_speed_m_s", math.nan))


@checked
def stability(file: Path, *, set: Changes = None, from_m_s: Annotated[float, "m/s"] = 10.0, to_m_s: Annotated[float, "m/s"] = 100.0, count: int = 46, tolerance: float = 0.01,
              shown_Hz: float = 20.0, threads: int = 0) -> Stability:
    """Eigenvalues of the vehicle of a simulation file by its speed, as ``treadmark stability`` does; tolerance: of the critical speed
    [m/s]; shown_Hz: highest frequency in the picture."""
    return Stability(_treadmark.stability(pathlib.Path(file), assignments(set), (from_m_s, to_m_s), count, tolerance, shown_Hz, threads))


class Response(_Drawn):
    """Transfer functions of a vehicle that runs steadily: a row an input, channel and frequency."""

    @property
    def frequencies(self) -> npt.NDArray[np.float64]:
        """[Hz]"""
        return np.array(self.document["frequency_Hz"])

    @property
    def curves(self) -> dict[tuple[str, str], npt.NDArray[np.complex128]]:
        """Complex amplitudes of a channel per unit of an input, by (input, channel), over the frequencies [SI]."""
        return {(one["input"], one["channel"]): np.array(one["real"]) + 1j * np.array(one["imaginary"]) for one in self.document["responses"]}

    @property
    def spectra(self) -> dict[str, npt.NDArray[np.float64]]:
        """One-sided power spectral density of each channel on the track of the file [SI squared per Hz]; empty without spectra of the track."""
        return {one["channel"]: np.array(one["density"]) for one in self.document.get("spectra", [])}

    def modes_svg(self) -> str:
        """The vibrations as pictures; empty without any."""
        return str(self._held.modes_svg())


@checked
def response(file: Path, *, set: Changes = None, from_Hz: Annotated[float, "Hz"] = 0.5, to_Hz: Annotated[float, "Hz"] = 50.0, count: int = 201,
             inputs: Sequence[str] = (), channels: Sequence[str] = (), iso_3095: bool = False, threads: int = 0) -> Response:
    """How the vehicle of a simulation file answers to irregularities, roughness and forces at its wheels, as ``treadmark response`` does; inputs,
    channels: names, * for any letters; iso_3095: spectra also of both rails as rough as that standard allows."""
    return Response(_treadmark.response(pathlib.Path(file), assignments(set), (from_Hz, to_Hz), count, list(inputs), list(channels), iso_3095, threads))


class Evolution(_Table):
    """Surfaces that contact changes: a row a generation."""

    @property
    def status(self) -> str:
        """"complete", "interrupted" (the same call goes on) or "failed"."""
        return str(self.document["status"])


@checked
def evolve(file: Path, output: Path, *, set: Changes = None, resume: bool = False, progress: Progress = None, threads: int = 0) -> Evolution:
    """Evolves the surfaces of a file with [evolve] into a folder, or goes on there, as ``treadmark evolve -o`` does."""
    return Evolution(_treadmark.evolve(pathlib.Path(file), assignments(set), pathlib.Path(output), resume, progress, threads))


class Assessment(_Found):
    """Runs against limits: a row a run, section, place and quantity."""


@checked
def assess(results: Path | Sequence[Path], *, vehicle: str = "passenger", begin: Metre = 0.0,
           sections: Sequence[Sequence[Any]] = (), spectra: Sequence[str] = (), laws: Sequence[str] = (),
           channels: Sequence[str] = (), limits: Path | None = None) -> Assessment:
    """Reads out of folders of simulations, or their simulation.h5, what ``treadmark assess`` does.

    sections: (name, from, to) or (name, from, to, kind) with places in m, kind "straight", "curve" or "transition"; begin [m]: where the
    assessment begins without them; spectra: channels whose spectra are wanted; laws: named ones of wear and fatigue that are asked of the wheels
    (``treadmark list laws``); channels: those that ``write`` draws over the distance; limits: a file of them in place of the usual ones.
    """
    files = [results] if isinstance(results, (str, os.PathLike)) else list(results)
    parts: list[Any] = [(*section, "straight")[:4] for section in sections]
    if any(len(part) < 4 for part in parts):
        raise InputError("a section has a name, from and to [m], and maybe a kind")
    return Assessment(_treadmark.assess([str(file) for file in files], vehicle, begin, parts, list(spectra), list(laws), list(channels),
                                         "" if limits is None else os.fspath(limits)))


class SweepRun(NamedTuple):
    """One simulation of a study."""

    number: int
    label: str
    status: str
    message: str
    swept: dict[str, str]
    summary: dict[str, Value]
    store: str  #: its simulation.h5, for read_simulation; may be empty


@checked
@dataclasses.dataclass(eq=False)
class Sweep(Drawn):
    """Simulations that differ in the values of some keys."""

    title: str
    version: str
    input_file: str
    settings: list[str]
    runs: list[SweepRun]
    complete: bool = True
    runs_total: int = 0

    def rows(self) -> list[dict[str, Any]]:
        """A dictionary a run: number, label, status, swept keys (numbers where they are), summary."""

        def number(text: str) -> Any:
            try:
                return float(text)
            except ValueError:
                return text

        return [{"run": r.number, "label": r.label, "status": r.status, **{key: number(text) for key, text in r.swept.items()},
                 **{name: v.value for name, v in r.summary.items()}} for r in self.runs]

    def to_pandas(self) -> "pandas.DataFrame":
        """A row a run. Needs pandas."""
        return frame(self.rows())

    def __repr__(self) -> str:
        return f"<Sweep {self.title!r}: {len(self.runs)} of {self.runs_total or len(self.runs)} runs>"

    def _repr_html_(self) -> str:
        return html_table([dict(list(row.items())[:10]) for row in self.rows()], repr(self))


def _sweep_of(raw: dict[str, Any]) -> Sweep:
    raw["runs"] = [SweepRun(number, label, status, message, dict(swept), {v[0]: Value(*v) for v in summary}, store)
                   for number, label, status, message, swept, summary, store in raw["runs"]]
    return Sweep(**raw)


@checked
def sweep(source: Path, output: Path, *, set: Changes = None, resume: bool = False, progress: Progress = None, threads: int = 0,
          client: Any = None, runs_per_task: int = 1) -> Sweep:
    """Solves the runs of a study file that are not finished yet, into a folder, as ``treadmark sweep -o`` does.

    client: a dask.distributed.Client, whose workers solve the runs, runs_per_task in one task, each task on threads (0 = 1 there). They see
    study and folder under the same names and import this package in this version. What a worker that died has left, another one takes over
    from its last checkpoint; the files in the folder are the same bytes however the runs were solved. Where progress returns False, or after
    an error, tasks that no worker has begun are withdrawn. Errors: those of Dask too, such as KilledWorker.
    """
    if runs_per_task < 1:
        raise InputError(f"runs_per_task is {runs_per_task}, which is no number of runs", advice="1 or more")
    if client is None:
        return _sweep_of(_treadmark.sweep(_source(source, set), pathlib.Path(output), resume, progress, threads, None))
    source, output, changes = os.path.abspath(source), pathlib.Path(os.path.abspath(output)), assignments(set)
    # Takes the folder for this study, so that the workers need not look at runs of others.
    begun = _treadmark.sweep(_source(source, changes), output, resume, None, threads, _NO_RUNS)
    _solve_on_workers(client, begun, (source, str(output), changes, max(1, threads)), progress, runs_per_task)
    return _sweep_of(_treadmark.sweep(_source(source, changes), output, True, None, threads, _NO_RUNS))


_NO_RUNS = (0, 0)


def _solve_share(source: str, output: str, changes: list[str], threads: int, first: int, last: int) -> int:
    """What a worker does: solves the runs from first to last. Returns how many there are."""
    raw = _treadmark.sweep(_source(source, changes), pathlib.Path(output), True, None, threads, (first, last))
    if not raw["complete"]:
        raise Cancelled(f"runs {first} to {last} were interrupted")
    return len(raw["runs"])


def _solve_on_workers(client: Any, begun: dict[str, Any], work: tuple[str, str, list[str], int], progress: Progress, size: int) -> None:
    """begun: what there is of the study; work: the first arguments of _solve_share."""
    total, finished = begun["runs_total"], {run[0] for run in begun["runs"]}
    shares = [(first, min(first + size - 1, total)) for first in range(1, total + 1, size)]
    shares = [(first, last) for first, last in shares if not finished.issuperset(range(first, last + 1))]
    tasks = [client.submit(_solve_share, *work, first, last, pure=False) for first, last in shares]
    count = total - sum(last - first + 1 for first, last in shares)
    try:
        for task in importlib.import_module("distributed").as_completed(tasks):
            count += task.result()
            if progress is not None and progress(count, total, f"{count} runs") is False:
                break
    finally:
        client.cancel(tasks)


@checked
def read_result(file: Path) -> Result:
    """A run from fields.h5 (all of it), result.json (numbers), or a folder of ``treadmark run -o``."""
    path = pathlib.Path(file)
    if path.is_dir():
        path = path / "fields.h5" if (path / "fields.h5").exists() else path / "result.json"
    if path.suffix == ".h5":
        return result_of(_treadmark.Run.read_hdf5(path))
    try:
        return result_of_json(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        raise MissingFileError("there is no such result", str(path), advice="give result.json, fields.h5 or their folder") from None
    except OSError as error:
        raise InputError(f"cannot be read: {error.strerror}", str(path)) from None
    except (ValueError, KeyError, TypeError) as error:
        raise InputError(f"is no result of treadmark run: {error}", str(path), advice="give result.json or fields.h5") from None


@checked
def read_comparison(folder: Path) -> Comparison:
    """The folder of ``treadmark compare -o``."""
    return Comparison(_treadmark.Comparison.read_folder(pathlib.Path(folder)))


@checked
def read_bench(file: Path) -> Bench:
    """bench.json, or its folder."""
    path = pathlib.Path(file)
    return Bench(_treadmark.Bench.read(path / "bench.json" if path.is_dir() else path))


@checked
def read_import(folder: Path) -> ScanImport:
    """The folder of ``treadmark import --report``."""
    _left_out("Imported", "import_scan")
    return ScanImport(_treadmark.Imported.read_folder(pathlib.Path(folder)))


@checked
def read_simulation(file: Path) -> Simulation:
    """simulation.h5, or its folder, with its snapshots."""
    _left_out("Simulated", "simulate")
    path = pathlib.Path(file)
    return _simulation_of(_treadmark.Simulated.read(path / "simulation.h5" if path.is_dir() else path))


def _text(cell: str) -> str:
    """Without the apostrophe that keeps spreadsheets from taking a text for a formula."""
    return cell[1:] if re.match(r"'[=+\-@\t\r]", cell) else cell


@checked
def read_sweep(folder: Path) -> Sweep:
    """The folder of ``treadmark sweep -o``, or its sweep.h5."""
    path = pathlib.Path(folder)
    path = path.parent if path.suffix == ".h5" else path
    head = _treadmark.read_sweep(path / "sweep.h5")
    with open(path / "sweep.csv", newline="", encoding="utf-8") as table:
        labels = {int(row["run"]): (_text(row["label"]), _text(row["message"])) for row in csv.DictReader(table)}
    runs = []
    for number, (label, message) in sorted(labels.items()):
        store = path / "runs" / f"run_{number:04}" / "simulation.h5"
        run = read_simulation(store)
        runs.append(SweepRun(number, label, run.status, message, dict(run.swept), run.summary, str(store)))
    return Sweep(head["title"], head["version"], head["input_file"], head["settings"], runs, True, len(runs))


@checked
def report(folder: Path, file: Path) -> None:
    """Writes the HTML report of a folder of results of any verb."""
    _treadmark.report_folder(pathlib.Path(folder), pathlib.Path(file))


@dataclasses.dataclass(frozen=True)
class LivePage:
    """A page that solves the contact of a wheel on a rail in the browser and needs nothing else: notebooks show it. See docs/live.md."""

    file: pathlib.Path  #: shown in a frame by notebooks that lie in the current folder, or above the file

    def _repr_html_(self) -> str:
        source = html.escape(urllib.parse.quote(pathlib.Path(os.path.relpath(self.file)).as_posix()))
        return f'<iframe title="Contact that is solved in this frame" width="100%" height="900" style="border: 0" src="{source}"></iframe>'


@checked
def live(source: Input, file: Path = "live.html", *, set: Changes = None, folder: Path | None = None, number: int = 1, progress: Progress = None,
         threads: int = 0) -> LivePage:
    """Writes the page of ``treadmark live`` for one case (number: of its file, from 1) of a wheel on a rail. Needs the program for browsers
    (scripts/web.sh)."""
    page = pathlib.Path(file)
    _treadmark.live_page(_source(source, set, folder), number, page, progress, threads)
    return LivePage(page)


def _left_out(name: str, function: str) -> None:
    if not hasattr(_treadmark, name):
        getattr(_treadmark, function)()  # says which part this build leaves out
