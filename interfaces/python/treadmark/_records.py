# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Results as plain records. Their numbers and fields are those of the tables of the library: what is new there is here, too."""
from __future__ import annotations

import copy
import dataclasses
import html
import json
import math
import pathlib
from typing import TYPE_CHECKING, Any, Callable, ClassVar, Iterator, Mapping, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _treadmark
from ._errors import without_folder
from ._inputs import Path, checked
from ._others import needed

if TYPE_CHECKING:
    import pandas
    import xarray

Array = npt.NDArray[np.float64]
#: Points (n, 3) [m], faces of their indices (m, 3 or 4), and, where there are fields, "cell_data" by name, a value a face.
Mesh = dict[str, Any]


class Said:
    """What is left of a result in C++ when it is pickled: some of what it says."""

    def __init__(self, said: Mapping[str, Any]) -> None:
        self._said = said

    def __getattr__(self, name: str) -> Callable[[], Any]:
        if name.startswith("_"):
            raise AttributeError(name)
        if name not in self._said:
            raise ValueError("a result that was pickled, read from JSON or made by a pair has numbers and fields only: write it where it was made")
        return lambda: self._said[name]


class Held:
    """A result that something in C++ stands behind. Copies share that, pickles keep what it says."""

    _held: Any
    #: What of it pickles keep.
    _kept: ClassVar[tuple[str, ...]] = ("json", "summary")

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_held": Said({name: getattr(self._held, name)() for name in self._kept if hasattr(self._held, name)}
                                               if self._is_whole() else getattr(self._held, "_said", {}))}

    def __copy__(self) -> Any:
        made: Any = object.__new__(type(self))
        made.__dict__.update(self.__dict__)
        return made

    def __deepcopy__(self, memo: dict[int, Any]) -> Any:
        made = memo[id(self)] = copy.copy(self)
        made.__dict__.update({name: copy.deepcopy(value, memo) for name, value in self.__dict__.items() if name != "_held"})
        return made

    def _is_whole(self) -> bool:
        return not isinstance(self._held, (Said, type(None)))

    def _whole(self) -> Any:
        return self._held if self._is_whole() else Said({}).whole()


class Quantity(NamedTuple):
    """A number of results: its name, unit in SI ("" or "1": none) and meaning; where result.json has it, as SI times ``in_file``, of
    a shift times ``in_file_shift``."""

    name: str
    unit: str
    meaning: str
    object: str
    key: str
    in_file: float
    in_file_shift: float


class Field(NamedTuple):
    """A field of a patch: name, unit in SI, meaning."""

    name: str
    unit: str
    meaning: str


_tables: dict[str, list[tuple[Any, ...]]] = _treadmark.tables()
#: Numbers of cases and of patches, and fields of patches, by their names.
CASE_QUANTITIES = {row[0]: Quantity(*row) for row in _tables["case"]}
PATCH_QUANTITIES = {row[0]: Quantity(*row) for row in _tables["patch"]}
FIELDS = {row[0]: Field(*row) for row in _tables["fields"]}
FIELDS["state"] = Field("state", "", "0 exterior, 1 adhesion, 2 slip, 3 plastic")


def _last_parts(quantities: Mapping[str, Quantity]) -> dict[str, str]:
    """Such as "x_tr" for "reference.x_tr": of several the first."""
    short = {name.rpartition(".")[2]: name for name in reversed(list(quantities))}
    return {**short, **{name: name for name in quantities}}


class _Named:
    """Attributes from numbers: ``patch.fn``, ``patch.x_tr`` for ``patch.numbers["reference.x_tr"]``; NaN where it was not computed."""

    _short: ClassVar[Mapping[str, str]] = {}
    numbers: dict[str, float]

    def __getattr__(self, name: str) -> Any:
        full = type(self)._short.get(name)
        if full is None:
            raise AttributeError(f"{type(self).__name__} has no {name!r}; see its numbers" + (" and fields" if hasattr(type(self), "fields") else ""))
        return self.numbers.get(full, math.nan)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *type(self)._short]

    def _vector(self, *names: str) -> Array:
        return np.array([self.numbers.get(name, math.nan) for name in names])


class Grid(NamedTuple):
    """Elements of a patch in contact axes: counts, centre of the first one and steps [m]."""

    nx: int
    ny: int
    x0: float
    y0: float
    dx: float
    dy: float


class Remark(NamedTuple):
    """A warning about a case. patch: from 1, 0 = the case; grave: numbers may be wrong."""

    name: str
    text: str
    patch: int
    grave: bool


@dataclasses.dataclass(eq=False)
class Patch(_Named):
    """A contact patch. Forces and tractions act on the rail; axes are x forward, s along the rail's profile, n into the rail.

    ``numbers``: what is known, by name in SI (``treadmark.PATCH_QUANTITIES``), also as attributes: ``patch.fn`` [N], ``patch.pmax`` [Pa].
    ``fields``: arrays of shape (ny, nx), by name in SI (``treadmark.FIELDS``), also as attributes: ``patch.pressure`` [Pa]. They are
    views without a copy, read-only, and keep what they look at alive.
    """

    _short: ClassVar[Mapping[str, str]] = _last_parts(PATCH_QUANTITIES)

    numbers: dict[str, float]
    fields: dict[str, npt.NDArray[Any]] = dataclasses.field(default_factory=dict)
    grid: Grid = Grid(0, 0, 0.0, 0.0, 0.0, 0.0)
    origin: Array = dataclasses.field(default_factory=lambda: np.zeros(3))  #: of the grid's axes in track axes [m]
    rotation: Array = dataclasses.field(default_factory=lambda: np.eye(3))  #: track axes = origin + rotation @ contact axes
    id: int = 0  #: stays with the patch through a sequence in time; 0 = unknown
    came_from: list[int] = dataclasses.field(default_factory=list)
    shift: bool = False  #: creepages are lengths [m] and an angle [rad], power is work [J]
    row_angle: Array = dataclasses.field(default_factory=lambda: np.zeros(0))  #: conformal contact: of each row [rad], else empty
    subsurface: list[dict[str, Array]] = dataclasses.field(default_factory=list)  #: blocks of arrays (nz, ny, nx, ...) in SI
    by_creepage: Array | None = None  #: sensitivities: of (fx, fs) by xi, eta, phi, shape (3, 2)
    by_approach: Array | None = None  #: of (fn, fx, fs) by the approach, shape (3,)

    def __getattr__(self, name: str) -> Any:
        if not name.startswith("__") and name not in ("numbers", "fields"):
            if name in self.fields:
                return self.fields[name]
            if name in FIELDS:
                raise AttributeError(f"the field {name!r} was not computed")
        return super().__getattr__(name)

    def __dir__(self) -> list[str]:
        return [*super().__dir__(), *self.fields]

    def __repr__(self) -> str:
        return f"<Patch of {self.grid.ny} x {self.grid.nx} elements: fn {self.fn:.5g} N, fx {self.fx:.4g} N, fs {self.fs:.4g} N, pmax {self.pmax / 1e6:.5g} MPa>"

    @property
    def x(self) -> Array:
        """Centres of the columns in contact axes, shape (nx,) [m]."""
        return self.grid.x0 + self.grid.dx * np.arange(self.grid.nx)

    @property
    def s(self) -> Array:
        """Centres of the rows in contact axes, shape (ny,) [m]."""
        return self.grid.y0 + self.grid.dy * np.arange(self.grid.ny)

    def to_xarray(self) -> "xarray.Dataset":
        """All fields over (s, x), with units and meanings, and the numbers as attributes. Needs xarray."""
        variables = {name: (("s", "x"), values, {"units": FIELDS[name].unit, "long_name": FIELDS[name].meaning}) for name, values in self.fields.items()}
        coordinates = {"s": ("s", self.s, {"units": "m"}), "x": ("x", self.x, {"units": "m"})}
        made: "xarray.Dataset" = needed("xarray", "to_xarray").Dataset(variables, coordinates, self.numbers)
        return made

    @checked
    def plot(self, field: str = "pressure", **options: Any) -> Any:
        """A field over (x, s), by xarray with its options (``ax``, ``cmap``); gives the axes of matplotlib back. Needs both."""
        needed("matplotlib", "plot")
        return self.to_xarray()[field].plot(**options).axes

    def to_mesh(self) -> Mesh:
        """Its elements in track axes with all fields: "points" (n, 3) [m], "faces" (m, 4), "cell_data" by name."""
        nx, ny, x0, y0, dx, dy = self.grid
        x, s = np.meshgrid(x0 + dx * (np.arange(nx + 1) - 0.5), y0 + dy * (np.arange(ny + 1) - 0.5))
        points = self.origin + np.stack([x.ravel(), s.ravel(), np.zeros(x.size)], axis=1) @ self.rotation.T
        first = (np.arange(ny)[:, None] * (nx + 1) + np.arange(nx)).reshape(-1, 1)
        return {"points": points, "faces": first + [0, 1, nx + 2, nx + 1], "cell_data": {name: values.ravel() for name, values in self.fields.items()}}


class KnownNumber(NamedTuple):
    """A number with its standard deviation, in SI."""

    value: float
    sigma: float  #: NaN: not known; 0: below what solutions leave open
    sampled: bool  #: from a sample of solutions, else by derivatives
    shares: list[float]  #: of each of the sources in the variance; NaN: not known
    dominant: str  #: source of the largest share, or ""


@dataclasses.dataclass(eq=False)
class Uncertainty:
    """How well the numbers of a case are known, where it or its surfaces say how well they are."""

    numbers: dict[str, KnownNumber]  #: by name: "wheelset.z", "patch_1.pmax"
    sources: list[tuple[str, float]]  #: what is known how well: name, and sigma in the unit of the key or mm
    message: str = ""  #: why nothing is known
    why: str = ""  #: there is a sample
    checked: int = 0  #: solutions that derivatives were held to
    samples: int = 0  #: solutions of the sample; 0: derivatives do
    others: int = 0  #: of the sample, with another number of patches or none


@dataclasses.dataclass(eq=False)
class Case(Held, _Named):
    """What came out of a case: a wheel on a rail at one instant, or one patch.

    ``numbers``: by name in SI (``treadmark.CASE_QUANTITIES``), also as attributes: ``case.z`` for ``case.numbers["wheelset.z"]``.
    """

    _short: ClassVar[Mapping[str, str]] = _last_parts(CASE_QUANTITIES)
    _kept = ("summary",)

    numbers: dict[str, float]
    number: int = 1  #: in its input, from 1
    status: str = "ok"  #: or "doubtful", "no_contact", "not_converged", "failed"
    message: str = ""  #: why the status is not ok
    remarks: list[Remark] = dataclasses.field(default_factory=list)
    seconds: float = 0.0
    patches: list[Patch] = dataclasses.field(default_factory=list)
    force_iterations: list[tuple[float, float]] = dataclasses.field(default_factory=list)  #: (z [m], vertical force [N])
    uncertainty: Uncertainty | None = None  #: where the case or its surfaces say how well they are known
    _held: Any = dataclasses.field(default=None, repr=False)

    def __repr__(self) -> str:
        count = len(self.patches)
        return f"<{type(self).__name__} {self.number}: {self.status}, {count} patch{'' if count == 1 else 'es'}, force {self.force} N>"

    @property
    def ok(self) -> bool:
        """Whether the status is "ok"."""
        return self.status == "ok"

    @property
    def force(self) -> Array:
        """Total force on the rail in track axes, shape (3,) [N]; of one patch in contact axes x, s, n."""
        if "force_on_rail.fx_tr" not in self.numbers and len(self.patches) == 1:
            return self.patches[0]._vector("fx", "fs", "fn")
        return self._vector("force_on_rail.fx_tr", "force_on_rail.fy_tr", "force_on_rail.fz_tr")

    @property
    def moment(self) -> Array:
        """Total moment on the rail about its origin, track axes, shape (3,) [N m]."""
        return self._vector("force_on_rail.mx_r", "force_on_rail.my_r", "force_on_rail.mz_r")

    @property
    def force_wheelset(self) -> Array:
        """The total force on the rail in wheelset axes, shape (3,) [N]."""
        return self._vector("force_on_rail.fx_ws", "force_on_rail.fy_ws", "force_on_rail.fz_ws")

    @property
    def moment_wheel(self) -> Array:
        """The total moment on the rail about the wheel's origin, wheelset axes, shape (3,) [N m]."""
        return self._vector("force_on_rail.mx_w", "force_on_rail.my_w", "force_on_rail.mz_w")

    def summary(self) -> str:
        """As the program prints it."""
        return str((self._held or self._whole()).summary())

    def _repr_svg_(self) -> str | None:
        return self._held.run().svg() if self._is_whole() and any(p.fields for p in self.patches) else None


#: What Pair.solve gives.
Solution = Case


#: Names of numbers in result.json: theirs here, and what one in SI is there.
_IN_FILES = {part: {(f"{q.object}." if q.object else "") + q.key: (name, q.in_file) for name, q in table.items()}
             for part, table in (("", CASE_QUANTITIES), ("patch", PATCH_QUANTITIES))}


def uncertainty_of(raw: dict[str, Any] | None) -> Uncertainty | None:
    """What result.json says of a case, in SI."""
    if raw is None:
        return None

    def real(value: float | None) -> float:
        return math.nan if value is None else value

    sources = [(source["name"], real(source["sigma"])) for source in raw["sources"]]
    numbers = {}
    for number in raw["numbers"]:
        patch, _, rest = number["name"].partition(".")
        of_patch = patch.startswith("patch_")
        name, factor = _IN_FILES["patch" if of_patch else ""][rest if of_patch else number["name"]]
        shares = [real(share) for share in number["shares"]]
        largest = max(((share, source) for share, (source, _) in zip(shares, sources) if share == share), default=(math.nan, ""))[1]
        numbers[f"{patch}.{name}" if of_patch else name] = KnownNumber(
            real(number["value"]) / factor, real(number["sigma"]) / factor, number["sampled"], shares, largest)
    return Uncertainty(numbers, sources, *(raw[key] for key in ("message", "why", "checked", "samples", "others")))


def patch_of(raw: dict[str, Any]) -> Patch:
    raw["grid"] = Grid(*raw["grid"])
    return Patch(**raw)


def case_of(raw: dict[str, Any]) -> Case:
    raw["number"] = raw["number"] or 1  # of a pair's solution there is none
    raw["patches"] = [patch_of(patch) for patch in raw["patches"]]
    raw["uncertainty"] = uncertainty_of(raw["uncertainty"])
    raw["remarks"] = [Remark(name, without_folder(text), *rest) for name, text, *rest in raw["remarks"]]
    return Case(_held=raw.pop("_handle"), **raw)


def frame(rows: Any) -> "pandas.DataFrame":
    return needed("pandas", "to_pandas").DataFrame(rows)


def html_table(rows: list[dict[str, Any]], caption: str = "") -> str:
    """Rows with the same keys as a table, numbers with five digits."""

    def text(value: Any) -> str:
        return format(value, ".5g") if isinstance(value, float) else html.escape(str(value))

    if not rows:
        return ""
    head = "".join(f"<th>{html.escape(key)}</th>" for key in rows[0])
    body = "".join("<tr>" + "".join(f"<td>{text(value)}</td>" for value in row.values()) + "</tr>" for row in rows)
    return f"<table><caption>{html.escape(caption)}</caption><thead><tr>{head}</tr></thead><tbody>{body}</tbody></table>"


def _write_text(file: Path, text: str) -> None:
    pathlib.Path(file).write_text(text, encoding="utf-8")


def _moved(cases: list[Case]) -> dict[str, list[Any]]:
    """What differs between the positions of cases of which nothing else is known any more."""
    found = {name: [case.numbers.get(name, math.nan) for case in cases] for name in CASE_QUANTITIES if name.startswith("wheelset.") and name != "wheelset.z"}
    return {name: values for name, values in found.items() if any(value != values[0] for value in values)}


@checked
@dataclasses.dataclass(eq=False)
class Result(Held):
    """All cases of a run."""

    cases: list[Case]
    version: str = ""
    git: str = ""
    threads: int = 1
    seconds: float = 0.0  #: wall clock
    input_file: str = ""
    input_sha256: str = ""
    title: str = ""
    geometry_sha256: list[tuple[str, str]] = dataclasses.field(default_factory=list)
    settings: list[str] = dataclasses.field(default_factory=list)  #: changes of keys
    complete: bool = True  #: False where it was stopped: fewer cases than cases_total
    cases_total: int = 0
    surfaces: list[dict[str, Any]] = dataclasses.field(default_factory=list)  #: backends, resolutions [m], memory
    notes: list[str] = dataclasses.field(default_factory=list)
    #: What differs between the cases, a value a case: numbers by their names in SI ("wheelset.y"), other keys as in files.
    varied: dict[str, list[Any]] = dataclasses.field(default_factory=dict)
    _held: Any = dataclasses.field(default=None, repr=False)

    def __len__(self) -> int:
        return len(self.cases)

    def __getitem__(self, index: int) -> Case:
        return self.cases[index]

    def __iter__(self) -> Iterator[Case]:
        return iter(self.cases)

    def __repr__(self) -> str:
        bad = [case.number for case in self.cases if not case.ok]
        return f"<Result of {self.input_file or 'problems'}: {len(self.cases)} of {self.cases_total} cases" + (f", not ok: {bad}>" if bad else ">")

    def _head(self, index: int) -> dict[str, Any]:
        case = self.cases[index]
        return {"case": case.number, "status": case.status, **{name: values[index] for name, values in self.varied.items()}}

    def rows(self) -> list[dict[str, Any]]:
        """A dictionary a patch: case, status, what was varied, patch (from 1), then its numbers in SI by their names; NaN where one was not
        computed."""
        return [{**self._head(i), "patch": k + 1, **{name: patch.numbers.get(name, math.nan) for name in PATCH_QUANTITIES}}
                for i, case in enumerate(self.cases) for k, patch in enumerate(case.patches)]

    def case_rows(self) -> list[dict[str, Any]]:
        """A dictionary a case: its number, status, what was varied and numbers in SI."""
        return [{**self._head(i), **{name: case.numbers.get(name, math.nan) for name in CASE_QUANTITIES}} for i, case in enumerate(self.cases)]

    def to_pandas(self, per: str = "patch") -> "pandas.DataFrame":
        """A row a patch (or a case: per="case"), a column a number in SI. Needs pandas."""
        if per not in ("patch", "case"):
            raise ValueError('per must be "patch" or "case"')
        return frame(self.rows() if per == "patch" else self.case_rows())

    def to_xarray(self, case: int = 1, patch: int = 1) -> "xarray.Dataset":
        """Fields of a patch, counted from 1, as Patch.to_xarray has them, with the case and what was varied as coordinates: those of several
        cases can be put together by xarray.concat. Needs xarray."""
        index = next((i for i, c in enumerate(self.cases) if c.number == case), None)
        if index is None or not 1 <= patch <= len(self.cases[index].patches):
            raise IndexError(f"there is no patch {patch} of a case {case}")
        return self.cases[index].patches[patch - 1].to_xarray().assign_coords({**self._head(index), "patch": patch})

    def plot(self, y: str = "pmax", x: str | None = None, **options: Any) -> Any:
        """A number of the patches or cases, by its name or the last part of it, over one that was varied (None: the first, or the case), by pandas with
        its options; gives the axes of matplotlib back. Needs both."""
        needed("matplotlib", "plot")
        per, full = ("patch", Patch._short[y]) if y in Patch._short else ("case", Case._short[y])
        return self.to_pandas(per).plot(x or next(iter(self.varied), "case"), full, **{"style": "o", **options})

    def to_json(self) -> str:
        """The text of result.json, as ``treadmark run --json`` writes it."""
        return str((self._held or self._whole()).json())

    def summary(self) -> str:
        """Cases and patches as text, as the program prints them."""
        return "".join(case.summary() + "\n" for case in self.cases)

    def write(self, file: Path) -> None:
        """Writes .json (numbers), .h5 (all fields), .html (a report), .svg (pressures), or, to a name without an ending, a folder with all
        that ``treadmark run -o`` writes."""
        run, path = self._whole(), pathlib.Path(file)
        writers: dict[str, Callable[[], Any]] = {
            ".json": lambda: run.write_json(path),
            ".h5": lambda: run.write_hdf5(path),
            ".html": lambda: _treadmark.report_run(run, path),
            ".svg": lambda: _write_text(path, run.svg()),
            "": lambda: run.write_folder(path),
        }
        if path.suffix not in writers:
            raise ValueError(f"results are not written to files {path.suffix}: use .json, .h5, .html, .svg, or a folder")
        writers[path.suffix]()

    def report(self, file: Path) -> None:
        """The report of ``treadmark run --report``: one HTML file."""
        _treadmark.report_run(self._whole(), pathlib.Path(file))

    def svg(self) -> str:
        """Pressures of all cases as a picture."""
        return str(self._whole().svg())

    def _repr_svg_(self) -> str | None:
        return self.svg() if self._is_whole() and any(p.fields for c in self.cases for p in c.patches) else None

    def _repr_html_(self) -> str:
        names = ("case", "status", *self.varied, "patch", "fn", "fx", "fs", "pmax", "approach", "reference.y_tr")
        rows = [{name: row[name] for name in names} for row in self.rows()[:50]]
        return (self._repr_svg_() or "") + html_table(rows, f"{self!r}, SI units")


def result_of(run: _treadmark.Run) -> Result:
    cases = [case_of(raw) for raw in run.cases()]
    varied = {name: [value.strip("'\"") if isinstance(value, str) else value for value in values] for name, values in run.varied}
    return Result(cases, notes=[without_folder(note) for note in run.notes], varied=varied or _moved(cases), _held=run, **run.head)


def result_of_json(text: str) -> Result:
    """Numbers of result.json; fields are in fields.h5."""
    document = json.loads(text)

    def numbers(table: Mapping[str, Quantity], item: dict[str, Any], shift: bool = False) -> dict[str, float]:
        found = {}
        for name, row in table.items():
            holder = item.get(row.object) if row.object else item
            value = holder.get(row.key) if isinstance(holder, dict) else None
            if value is not None:
                found[name] = value / (row.in_file_shift if shift else row.in_file)
        return found

    cases = []
    for c in document["cases"]:
        remarks = [Remark(r["name"], r["text"], r["patch"], r["grave"]) for r in c.get("remarks", [])]
        patches = []
        for p in c["patches"]:
            shift = "frictional_work_J" in p
            patches.append(Patch(numbers(PATCH_QUANTITIES, p, shift), id=p.get("id", 0), came_from=p.get("came_from", []), shift=shift))
        cases.append(Case(numbers(CASE_QUANTITIES, c), c["case"], c["status"], c.get("message", ""), remarks, c.get("seconds") or 0.0, patches,
                          uncertainty=uncertainty_of(c.get("uncertainty"))))
    made, given = document["treadmark"], document["input"]
    return Result(cases, made["version"], made["git"], made["threads"], made["seconds"], given["file"], given["sha256"],
                  given.get("title", ""), [(g["file"], g["sha256"]) for g in given.get("geometry", [])], settings=document["settings"],
                  complete=document["complete"], cases_total=document["cases_total"], varied=_moved(cases))
