# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Contact geometry of a wheelset on its track, and measures of wheels and rails."""
from __future__ import annotations

import difflib
import functools
import inspect
import json
import math
import os
import pathlib
from typing import TYPE_CHECKING, Annotated, Any, Callable, Iterable, Mapping, NamedTuple, Sequence, TypeVar, Union, cast

import numpy as np

from . import _treadmark
from ._errors import InputError, without_folder
from ._inputs import Changes, Path, Shape, assignments, checked, file_of, is_array, taken, toml_value
from ._others import Drawn
from ._records import Array, frame, html_table
from ._surfaces import radius_of
from ._verbs import Progress, _Document, _Text

if TYPE_CHECKING:
    import pandas

#: Endings of names in files, longer ones before those that they end with: factor to SI, unit there.
_ENDINGS = (("_per_mm", 1e3, "1/m"), ("_per_m", 1.0, "1/m"), ("_mm2", 1e-6, "m^2"), ("_mrad", 1e-3, "rad"), ("_rad", 1.0, "rad"),
            ("_deg", math.pi / 180.0, "rad"), ("_MPa", 1e6, "Pa"), ("_kN", 1e3, "N"), ("_mm", 1e-3, "m"), ("_N", 1.0, "N"), ("_m", 1.0, "m"))


def in_si(key: str) -> tuple[str, float, str]:
    """The name without its unit, the factor to SI and the unit there; a key that ends with none of these units stays as it is.

    >>> in_si("gauge_mm")
    ('gauge', 0.001, 'm')
    """
    for ending, factor, unit in _ENDINGS:
        if key.endswith(ending):
            return key[: -len(ending)], factor, unit
    return key, 1.0, ""


def _array(values: Iterable[Any], factor: float = 1.0) -> Array:
    """Numbers of a file in SI, NaN for null; cannot be written to."""
    array = factor * np.array([math.nan if value is None else value for value in values], dtype=np.float64)
    array.flags.writeable = False
    return array


def _number(value: Any, factor: float = 1.0) -> float:
    return math.nan if value is None else float(factor * value)


_KINDS: dict[str, Any] = {"integer": int, "flag": bool, "file": Shape, "text": Union[str, float]}


class Setting(NamedTuple):
    """A setting of a verb of the program: its key, the keyword, the factor from one to the other, the unit in SI, the kind of its values and the meaning."""

    key: str
    name: str
    factor: float
    unit: str
    values: str
    meaning: str

    @property
    def kind(self) -> Any:
        """The annotation of its argument."""
        number: Any = Annotated[float, self.unit] if self.unit != "1" else float
        several: Any = Sequence
        if self.values in ("number", "list"):
            return number if self.values == "number" else Union[several[number], str]
        return Path if self.name == "case" else _KINDS[self.values]


_settings_of = {verb: {row[1]: Setting(*row) for row in _treadmark.request_tables()[verb]} for verb in ("geometry", "measure")}
_meanings: dict[str, str] = {key: meaning for key, meaning in _treadmark.request_tables()["measures"]}
_Function = TypeVar("_Function", bound=Callable[..., Any])


def _takes_settings(verb: str, *but: str) -> Callable[[_Function], _Function]:
    """Says in signature and help of a function what settings its **settings are."""

    def told(function: _Function) -> _Function:
        own = inspect.signature(function)
        settings = {name: one for name, one in _settings_of[verb].items() if name not in own.parameters and name not in but}

        @functools.wraps(function)
        def call(*arguments: Any, **keywords: Any) -> Any:
            return function(*arguments, **{name: taken(name, settings[name].kind, value) if name in settings and value is not None else value
                                           for name, value in keywords.items()})

        keywords = [inspect.Parameter(name, inspect.Parameter.KEYWORD_ONLY, default=None, annotation=one.kind) for name, one in settings.items()]
        parameters = [one for one in own.parameters.values() if one.kind is not inspect.Parameter.VAR_KEYWORD]
        at = next((i for i, one in enumerate(parameters) if one.kind is inspect.Parameter.KEYWORD_ONLY), len(parameters))
        setattr(call, "__signature__", own.replace(parameters=[*parameters[:at], *keywords, *parameters[at:]]))
        lines = [f"    {name}{'' if one.unit == '1' else f' [{one.unit}]'}: {one.meaning}" for name, one in settings.items()]
        call.__doc__ = (function.__doc__ or "").replace("    SETTINGS", "\n".join(lines))
        return cast(_Function, call)

    return told


def _settings(verb: str, values: Mapping[str, Any], changes: Changes = None) -> list[str]:
    """Keywords in SI as "key=value" with the units of the program's options."""
    made = []
    for name, value in values.items():
        if name not in _settings_of[verb]:
            near = difflib.get_close_matches(name, _settings_of[verb], 1)
            raise TypeError(f"there is no keyword {name!r}" + (f": did you mean {near[0]!r}?" if near else f" of {', '.join(_settings_of[verb])}"))
        if value is None:
            continue
        setting = _settings_of[verb][name]
        if name == "nominal_radius":
            radius_of(value)
        if is_array(value):
            value = file_of(value, name)
        elif setting.factor != 1.0 and not isinstance(value, str):
            value = np.asarray(value, dtype=np.float64) / setting.factor
        made.append(f"{setting.key}={toml_value(value)}")
    return made + assignments(changes)


class Conicity(NamedTuple):
    """Equivalent conicity over the amplitude of the motion, arrays of one length. Amplitude, wavelength and turning points [m]; NaN where
    there is none, and ``reasons`` says why. harmonic: by harmonic linearization."""

    amplitude: Array
    tan_gamma_e: Array
    harmonic: Array
    wavelength: Array
    turns_left: Array
    turns_right: Array
    reasons: list[str]


class Jump(NamedTuple):
    """A contact that changes its place at once: shift, side, places on rail and wheel before and after, differences of radii [m]."""

    y: float
    side: str
    from_rail_y: float
    to_rail_y: float
    from_wheel_y: float
    to_wheel_y: float
    dr_before: float
    dr_after: float


class SecondContact(NamedTuple):
    """A place that nearly touches besides the first one: shift, side, places on wheel and rail [m], angle [rad], gap above the first [m]."""

    y: float
    side: str
    wheel_y: float
    rail_y: float
    angle: float
    gap: float


class ShiftLimit(NamedTuple):
    """The last shift to one side [m]; limited: by what the reason says, not by the shifts that were asked for."""

    y: float
    limited: bool
    reason: str


class GaugeMap(NamedTuple):
    """Conicity over the gauge: gauge [m] and value at 3 mm, shape (n,); amplitude [m], shape (m,); tan_gamma_e, shape (n, m)."""

    gauge: Array
    tan_gamma_e_3mm: Array
    amplitude: Array
    tan_gamma_e: Array
    reasons: list[str]


@checked
class Geometry(_Document, Drawn):
    """How a wheelset sits on its track at every shift, without forces.

    ``numbers``: what is one number, by its name in geometry.json without the unit, in SI ("track.gauge", "wheelset.active_faces",
    "conicity_at.tan_gamma_e", "equilibrium_y"), also as attributes by the last part of the name where only one ends so: ``geometry.clearance``.
    NaN: not known; ``reasons`` says why. ``functions``: arrays over the shift ``functions["y"]``: "delta_r", "rail_y_right",
    "angle_left" and so on, in the units of ``units``. ``document`` has all of it as the program writes it.
    """

    def __init__(self, held: _treadmark.Geometry) -> None:
        self._held = held
        g = self.document["geometry"]
        self.notes = [without_folder(note) for note in held.notes]  #: warnings, about profile files too
        self.functions: dict[str, Array] = {}
        self.units: dict[str, str] = {}  #: of the functions
        self.numbers: dict[str, float] = {}
        self.reasons: dict[str, str] = {}  #: why a number is NaN, by the part of its name before the last one, or its own
        for key, values in g["functions"].items():
            if not any(isinstance(value, str) for value in values) and not key.startswith("no_"):
                name, factor, self.units[in_si(key)[0]] = in_si(key)
                self.functions[name] = _array(values, factor)
        for key, value in g.items():
            if key not in ("profiles", "method", "functions", "limits", "conicity", "gauge_sweep"):
                self._add(key, value)
        parts = [name.rpartition(".")[2] for name in self.numbers]
        self._short = {part: name for part, name in zip(parts, self.numbers) if parts.count(part) == 1}
        c = g["conicity"]
        self.conicity = Conicity(_array(c["amplitude_mm"], 1e-3), _array(c["tan_gamma_e"]), _array(c.get("harmonic", [])),
                                 _array(c["wavelength_mm"], 1e-3), _array(c["turns_left_mm"], 1e-3), _array(c["turns_right_mm"], 1e-3),
                                 [reason or "" for reason in c["reason"]])
        self.jumps = [Jump(**self._row(row)) for row in g["jumps"]]
        self.second_contacts = [SecondContact(**self._row(row)) for row in g["second_contacts"]]
        self.limits = {side: ShiftLimit(1e-3 * at["y_mm"], at["limited"], at["reason"] or "") for side, at in g["limits"].items()}
        sweep = g.get("gauge_sweep")
        self.gauges: GaugeMap | None = None  #: where gauges were asked for
        if sweep is not None:
            width = len(sweep["amplitude_mm"])
            rows = np.array([_array(row) if row else np.full(width, math.nan) for row in sweep["tan_gamma_e"]]).reshape(-1, width)
            rows.flags.writeable = False
            self.gauges = GaugeMap(_array(sweep["gauge_mm"], 1e-3), _array(sweep["tan_gamma_e_3mm"]), _array(sweep["amplitude_mm"], 1e-3), rows,
                                   [reason or "" for reason in sweep["reason"]])

    def _add(self, key: str, value: Any) -> None:
        """Numbers of the document by their names, and reasons."""
        parent = key.rpartition(".")[0]
        if isinstance(value, dict):
            for inner, item in value.items():
                self._add(f"{key}.{inner}", item)
        elif key.endswith("reason"):
            if value:
                self.reasons[parent or key.removesuffix("_reason")] = value
        elif value is None or isinstance(value, (int, float)) and not isinstance(value, bool):
            name, factor, _ = in_si(key)
            if name.rpartition(".")[2] != "side":
                self.numbers[name] = _number(value, factor)

    @staticmethod
    def _row(row: Mapping[str, Any]) -> dict[str, Any]:
        return {in_si(key)[0]: value if isinstance(value, str) else _number(value, in_si(key)[1]) for key, value in row.items()}

    def __getattr__(self, name: str) -> float:
        full = self.__dict__.get("_short", {}).get(name)
        if full is None:
            raise AttributeError(f"Geometry has no {name!r}; see its numbers")
        return self.numbers[full]

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self._short]

    @property
    def equilibrium(self) -> float:
        """The shift with equal rolling radii [m]; NaN where there is none: reasons["equilibrium"]."""
        return self.numbers["equilibrium_y"]

    def summary(self) -> str:
        """As the program prints it."""
        return str(self._held.summary())

    def to_pandas(self) -> "pandas.DataFrame":
        """The functions, a row a shift, in SI. Needs pandas."""
        return frame(self.functions)

    def _axes(self) -> tuple[str, str]:
        return "y", "delta_r"

    def svg(self, what: str = "charts") -> str:
        """A picture: "charts" over the shift and of the conicity, "points" in contact, or "gauges" where they were asked for."""
        if what not in ("charts", "points", "gauges") or what == "gauges" and self.gauges is None:
            raise ValueError('what must be "charts", "points" or, where gauges were asked for, "gauges"')
        return str(getattr(self._held, what + "_svg")())

    def report(self, file: Path) -> None:
        """The report of ``treadmark geometry --report``: one HTML file with a slider over the shift."""
        _treadmark.report_geometry(self._whole(), pathlib.Path(file))

    def __repr__(self) -> str:
        profiles = self.document["geometry"]["profiles"]
        at = self.numbers
        return (f"<Geometry of {profiles['wheel_right']} on {profiles['rail_right']}: conicity {at['conicity_at.tan_gamma_e']:.4g} "
                f"at {1e3 * at['conicity_at.amplitude']:.3g} mm, {len(self.jumps)} jumps>")

    def _repr_svg_(self) -> str:
        return self.svg()

    def _repr_html_(self) -> str:
        rows = [{"number": name, "value": value} for name, value in self.numbers.items()]
        return self.svg() + html_table(rows, f"{self!r}, SI units")


@_takes_settings("geometry")
@checked
def geometry(wheel: Shape | None = None, rail: Shape | None = None, *, set: Changes = None, progress: Progress = None, threads: int = 0,
             **settings: Any) -> Geometry:
    """Contact of a wheelset with its rails at every lateral shift, without forces, and its equivalent conicity, as ``treadmark geometry``.

    wheel, rail: files, arrays (n, 2) of y and z [m], or names of ``profiles()``, of both sides or of the right one. set: changes of keys
    of the case. In SI, profiles as arrays too:

    SETTINGS

    Lists of lengths may be text in mm, "from:to:step". Errors: InputError for what cannot be read or placed, NumericalError for wheelsets
    that cannot stand on their rails.

    >>> found = geometry("S1002", "60E1", gauge=1.435, cant="1:40")
    >>> round(float(found.conicity.tan_gamma_e[20]), 2), len(found.jumps) > 0
    (0.17, True)
    """
    return Geometry(_treadmark.geometry(_settings("geometry", {"wheel": wheel, "rail": rail, **settings}, set), progress, threads))


class Measure(NamedTuple):
    """A number of a wheel or rail in its unit, half the width that holds it in 95 of 100 cases as far as points scatter; both NaN where it was
    not measured: reason."""

    value: float
    uncertainty: float
    unit: str
    meaning: str
    reason: str


class LimitCheck(NamedTuple):
    """A limit and how a number stands to it: "within", "outside" or "not measured"; sure: farther away than the uncertainty. min and max are
    infinite where there is none."""

    name: str
    value: float
    uncertainty: float
    min: float
    max: float
    status: str
    sure: bool


@checked
class Measured(_Text):
    """What was measured of a wheel or rail.

    ``numbers``: by name without the unit, in SI ("flange_height" [m], "area_lost" [m^2], "flange_angle" [rad]); "loss_percent" and
    "roughness_exceedance_db" stay in percent and dB. ``document`` has all of it with names and units of measure.json: flats,
    orders, roughness, and numbers over the position. Can be pickled; one that was cannot write reports any more.
    """

    def __init__(self, held: _treadmark.Measured) -> None:
        self._held = held
        d = self.document
        self.file: str = d["file"]
        self.body: str = d["body"]
        self.kind: str = d["kind"] or ""  #: "profile", "library profile", "surface", "scan"
        self.error: str = d["error"] or ""  #: why nothing was measured; empty: it was
        self.verdict: str = d["status"]  #: the worst of the limits: "no limits", "within", "not measured", "outside"; or "failed"
        self.notes: list[str] = d["notes"]
        self.numbers: dict[str, Measure] = {}
        found = d.get(self.body, {"uncertainty": {}, "reasons": {}})
        for key in found:
            if key in found["uncertainty"] or key in found["reasons"]:
                name, factor, unit = _measured_in(key)
                value, width = _number(found[key], factor), _number(found["uncertainty"].get(key), factor)
                self.numbers[name] = Measure(value, width, unit, _meanings.get(key, ""), found["reasons"].get(key, ""))
        self.limits: list[LimitCheck] = []
        for row in d["limits"]:
            name, factor, _ = _measured_in(row["key"])
            low = -math.inf if row["min"] is None else factor * row["min"]
            high = math.inf if row["max"] is None else factor * row["max"]
            value, width = _number(row["value"], factor), _number(row["uncertainty"], factor)
            self.limits.append(LimitCheck(name, value, width, low, high, row["status"], row["sure"]))

    def summary(self) -> str:
        """The table that the program prints; of a file that failed, why."""
        return self.error or without_folder(self._held.summary())

    def report(self, file: Path) -> None:
        """The report of ``treadmark measure --report``: one HTML file."""
        if self.error:
            raise InputError(self.error)
        _treadmark.report_measures(self._whole(), pathlib.Path(file))

    def __repr__(self) -> str:
        known = sum(1 for number in self.numbers.values() if not number.reason)
        return f"<Measured {self.body} {self.file!r}: " + (f"failed: {self.error}>" if self.error else f"{known} numbers, {self.verdict}>")

    def _repr_html_(self) -> str:
        rows = [{"number": name, "value": n.value, "uncertainty": n.uncertainty, "unit": n.unit, "meaning": n.meaning, "": n.reason}
                for name, n in self.numbers.items()]
        return html_table(rows, repr(self)) or html_table([{"": self.error}], repr(self))


def _measured_in(key: str) -> tuple[str, float, str]:
    name, factor, unit = in_si(key)
    return name, factor, unit or ("%" if key.endswith("_percent") else "dB" if key.endswith("_db") else "")


@_takes_settings("measure")
@checked
def measure(body: str, file: Shape, *, set: Changes = None, progress: Progress = None, threads: int = 0, **settings: Any) -> Measured:
    """Measures a "wheel" or "rail" from a profile, slices, triangles, offsets, a scan, a case file or a name of ``profiles()``, as
    ``treadmark measure`` does; profiles and scans may be arrays [m] of the shapes (n, 2) and (n, 3), too. set: changes of a case's keys. In SI:

    SETTINGS

    Errors: InputError naming the file. Limits that do not hold are no errors: see ``verdict``.

    >>> round(1e3 * measure("wheel", "S1002").numbers["flange_height"].value, 2)
    28.0
    """
    return Measured(_treadmark.measure(body, file_of(file, body), _settings("measure", settings, set), progress, threads))


@_takes_settings("measure", "mate")
@checked
def measure_files(body: str, files: Path | Iterable[Shape], *, set: Changes = None, progress: Progress = None, threads: int = 0,
                  **settings: Any) -> list[Measured]:
    """The same of many on all cores, in their order. Folders stand for the files in them, "@LIST" for those that a text file names.

    What fails has its ``error`` and does not stop the rest, also what was not measured before progress returned False. In SI:

    SETTINGS
    """
    named: list[Any] = [files] if isinstance(files, (str, os.PathLike)) else list(files)
    made = _settings("measure", settings, set)
    return [Measured(held) for held in _treadmark.measure_files(body, [file_of(file, body) for file in named], made, progress, threads)]


@checked
def measures_to_pandas(measured: Iterable[Measured]) -> "pandas.DataFrame":
    """A row a file: its name, verdict and error, and all numbers in SI. Needs pandas."""
    return frame([{"file": m.file, "verdict": m.verdict, "error": m.error, **{name: number.value for name, number in m.numbers.items()}}
                  for m in measured])


class LibraryProfile(NamedTuple):
    """A profile that can be named: height and width of a rail's section and foot, of a wheel its flange and from flange back to field end [m],
    area of a rail [m^2], mass [kg/m]; NaN: not known. family: the number in the name stands for others."""

    name: str
    body: str
    height: float
    width: float
    area: float
    mass: float
    source: str
    shape: str
    also: str
    family: bool


def profiles() -> list[LibraryProfile]:
    """The profiles that are built in, rails first, as ``treadmark list profiles``: names for ``geometry``, ``measure``, ``Surface.standard``
    and ``shape.standard`` of cases."""
    return [LibraryProfile(*row) for row in _treadmark.profiles()]
