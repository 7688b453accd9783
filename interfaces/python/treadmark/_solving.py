# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Contact at single instants: problems, pairs of a wheel and a rail, patches of given geometry."""
from __future__ import annotations

import functools
import threading
import warnings
from typing import Any, Callable, Mapping, NamedTuple, Sequence

import numpy as np
import numpy.typing as npt

from . import _treadmark
from ._errors import ConvergenceWarning, InputError
from ._inputs import Changes, Input, Newton, Path, assignments, checked, number as as_number, toml_value
from ._records import Case, Patch, Result, Solution, case_of
from ._surfaces import Surface, case_of_input

_numbers: dict[str, int] = {}
_names: dict[int, str] = {}
_units: dict[int, str] = {}
for _id, _row in enumerate(_treadmark.tables()["case_numbers"]):
    _numbers.setdefault(_row[0], _id)
    _names[_id] = _row[0]
    _units[_id] = _row[1]
#: Keys of case files; of those that hold a number its name, and how much one of their unit is in SI.
_keys: dict[str, tuple[str, float]] = {row[0]: (row[4], row[5]) for row in _treadmark.tables()["case_keys"]}
_WHEEL_RAIL = ("wheelset", "friction", "discretisation", "material", "case", "contact", "solver", "track", "damping", "influence", "heat", "roller")
_PATCH = ("patch", "patch.hertz", "patch.gap", "friction", "material", "case", "solver", "influence", "heat")
_ALIASES = {"speed": "wheelset.velocity", "pitch_rate": "wheelset.vpitch", "roll_rate": "wheelset.vroll", "yaw_rate": "wheelset.vyaw",
            "friction": "friction.coefficient", "load": "wheelset.vertical_force"}
_STATUSES = np.array(["ok", "no_contact", "not_converged", "failed", "doubtful"], dtype=object)
#: What solve_many returns unless it is asked for others.
_USUAL = ("z", "npatch", "fx_tr", "fy_tr", "fz_tr", "fn", "fx", "fs", "mn", "xi", "eta", "phi", "pmax", "approach", "dissipated", "x_tr", "y_tr", "z_tr", "angle")


@functools.lru_cache(maxsize=None)
def _find(name: str, patch: bool) -> tuple[int | None, str]:
    """Number and name, or None and the key, of a short name."""
    name = name.replace("__", ".")
    alias = _ALIASES.get(name)
    if "." in name:
        full = [name]
    else:
        full = [alias] if alias and not (patch and alias.startswith("wheelset")) else [f"{section}.{name}" for section in (_PATCH if patch else _WHEEL_RAIL)]
    for candidate in full:
        if candidate in _numbers:
            return _numbers[candidate], candidate
        if candidate in _keys:
            return None, candidate
    import difflib

    near = difflib.get_close_matches(name, [*_numbers, *_keys, *{n.rpartition(".")[2] for n in _numbers}], 3)
    raise InputError(f"no setting has the name {name!r}", advice="did you mean " + " or ".join(near) if near else "treadmark.settings() lists them")


def _array_number(name: str) -> tuple[int, float]:
    """Number of a name that may end with a unit ("y_mm"), and how much one of it is in SI."""
    number, full = _find(name, False)
    base, si = ("", 0.0) if number is not None else _keys[full]
    if number is None and base in _numbers:
        return _numbers[base], si
    if number is None:
        raise InputError(f"{full} cannot differ from row to row")
    return number, 1.0


def _by(name: str) -> tuple[str, float]:
    """The full name of a number by which derivatives are wanted, which may end with a unit, and how much one of that is in SI."""
    if name.startswith(("rail.", "wheel.")):  # of a surface
        return name, 1.0
    number, si = _array_number(name)
    return _names[number], si


def _listed(name: str) -> str:
    """The full name of a number of results, which may be given by its last part."""
    patch, dot, rest = name.partition(".")
    if dot and patch.startswith("patch_"):
        return f"{patch}.{Patch._short.get(rest, rest)}"
    return Case._short.get(name, Patch._short.get(name, name))


def settings() -> list[tuple[str, str, str]]:
    """All numbers of a case that solve() takes, as (name, unit in SI, meaning)."""
    return [(row[0], row[1], row[2]) for row in _treadmark.tables()["case_numbers"]]


def _change(case: _treadmark.Case, values: Mapping[str, Any], changes: Changes = None) -> None:
    patch = case.patch
    for name, value in values.items():
        if value is None:
            continue
        number, full = _find(name, patch)
        if number is not None and not (isinstance(value, str) and full in _keys):
            case.set_number(number, as_number(value, name, _units[number]))
        else:
            case.set(f"{full}={toml_value(value, full)}")
    for assignment in assignments(changes):
        case.set(assignment)


@checked
class Problem:
    """What is given at one instant, all of it with defaults. It does not change: ``replace`` makes another one.

    source: None for defaults, or a case file, TOML text or dictionary, of which ``case`` (from 1) is taken. patch=True: one patch of given
    geometry instead of a wheel on a rail. Keywords are settings in SI units, by the last part of their name ("y" for "wheelset.y", "dx"
    for "discretisation.dx") or, where that is not clear, with two underscores ("track__rail_y"); ``settings()`` lists them. set: changes
    with keys and units of case files.
    """

    __slots__ = ("_case",)

    def __init__(self, source: Input | None = None, *, case: int = 1, patch: bool = False, folder: Path | None = None, set: Changes = None,
                 **values: Any) -> None:
        if source is not None:
            self._case = case_of_input(source, case, folder)
        else:
            self._case = _treadmark.Case.create(patch)
            for shape in () if patch else ("rail.shape.standard=60E1", "wheel.shape.standard=S1002"):  # a pair has surfaces of its own
                self._case.set(shape)
        _change(self._case, values, set)

    def replace(self, set: Changes = None, **values: Any) -> "Problem":
        """The same with other values."""
        other: Problem = object.__new__(Problem)
        other._case = self._case.copy()
        _change(other._case, values, set)
        return other

    def __getitem__(self, name: str) -> float:
        """A number in SI, by any of its names."""
        return self._case.get_number(_find(name, self._case.patch)[1])

    @property
    def patch(self) -> bool:
        """Whether it is one patch of given geometry."""
        return self._case.patch

    def __repr__(self) -> str:
        return "<Problem: one patch>" if self.patch else f"<Problem: wheel on rail, y {self['y']:g} m>"


def _warned(solution: Solution) -> Solution:
    if solution.status in ("not_converged", "failed"):
        warnings.warn(f"{solution.status}: {solution.message}", ConvergenceWarning, stacklevel=4)
    return solution


@checked
class State:
    """What a pair remembers after a solution: to go on from it, in any pair of the same surfaces, to the same bits. Can be pickled."""

    __slots__ = ("_state",)

    def __init__(self, data: bytes) -> None:
        """From to_bytes() of this kind of machine. Errors: InputError for other bytes."""
        self._state = _treadmark.State.from_bytes(data)

    def to_bytes(self) -> bytes:
        """As bytes."""
        return self._state.to_bytes()

    def __reduce__(self) -> tuple[Any, ...]:
        return State, (self.to_bytes(),)


class Gradient(NamedTuple):
    """A number of a solution and its derivatives: by what was named, in that order, or by the gaps of elements, an array of shape (ny, nx)
    for each patch. In SI."""

    value: float
    by: npt.NDArray[np.float64]
    by_gap: list[npt.NDArray[np.float64]]


class ShapeGradient(NamedTuple):
    """A number of a solution and its total derivatives by all that the shape of a body follows from (Surface.parameters), an array of shape
    (n,), with the places where these act in the surface's axes, (n, 3) [m], NaN: at no one place. exact: else surfaces on both sides were
    differenced. by_height: by the height of the body over each element, along n, of shape (ny, nx) for each patch. In SI."""

    value: float
    by: npt.NDArray[np.float64]
    places: npt.NDArray[np.float64]
    exact: bool
    by_height: list[npt.NDArray[np.float64]]


@checked
class Pair:
    """A wheel on a rail, and what the last solution left. Several threads may use it; they wait for each other.

    problem: what solve() starts from; None: defaults with the wheel's nominal radius.
    """

    __slots__ = ("_pair", "_lock", "rail", "wheel", "problem")

    def __init__(self, rail: Surface, wheel: Surface, problem: Problem | None = None) -> None:
        self._pair: _treadmark.Pair | None = _treadmark.Pair(rail._surface, wheel._surface)
        self._lock = threading.Lock()
        self.rail, self.wheel = rail, wheel
        self.problem = problem or Problem(wheelset__nominal_radius=wheel.nominal_radius)

    @classmethod
    def of_case(cls, source: Input, case: int = 1, folder: Path | None = None) -> "Pair":
        """Both surfaces and the problem of a case (a file, TOML text or a dictionary)."""
        given = case_of_input(source, case, folder)
        problem: Problem = object.__new__(Problem)
        problem._case = given
        return cls(Surface._of(_treadmark.Surface.of_case(given, "rail")), Surface._of(_treadmark.Surface.of_case(given, "wheel")), problem)

    def _open(self) -> _treadmark.Pair:
        if self._pair is None:
            raise InputError("the pair is closed")
        return self._pair

    def solve(self, problem: Problem | None = None, *, set: Changes = None, **values: Any) -> Any:
        """Solves one instant: a Solution. It goes on from the last one only if asked to (history="continue").

        Keywords as in Problem, in SI units: ``pair.solve(y=5e-3, vertical_force=10e3, speed=2.0, pitch_rate=-4.335, friction=0.3)``.
        Arrays in place of numbers are broadcast and make independent problems, solved in parallel: a Result of them in C order.
        Warns (ConvergenceWarning) of a status "not_converged" or "failed". Errors: InputError for what makes no sense. Ctrl-C ends it.
        """
        base = problem or self.problem
        for value in values.values():
            if not isinstance(value, (float, int, str)) and np.ndim(value) > 0:
                return self._solve_all(base, set, values)
        case = base._case
        if values or set:
            case = case.copy()
            _change(case, values, set)
        with self._lock:
            raw = self._open().solve(case)
        return _warned(case_of(raw))

    def _solve_all(self, base: Problem, set: Changes, values: Mapping[str, Any]) -> Result:
        """Numbers that are arrays become one problem an element."""
        varied = {name: np.asarray(value) for name, value in values.items() if _find(name, False)[0] is not None and np.ndim(value) > 0}
        if not varied:  # lists that belong to keys
            with self._lock:
                return Result([_warned(case_of(self._open().solve(base.replace(set, **values)._case)))], cases_total=1)
        try:
            arrays = np.broadcast_arrays(*varied.values())
        except ValueError as error:
            raise InputError(f"the arrays do not fit each other: {error}") from None
        base = base.replace(set, **{name: value for name, value in values.items() if name not in varied})
        cases = []
        for row in zip(*(array.ravel() for array in arrays)):
            case = base._case.copy()
            _change(case, dict(zip(varied, map(float, row))))
            cases.append(case)
        with self._lock:
            raws = self._open().solve_all(cases)
        named = {_find(name, False)[1]: array.ravel().tolist() for name, array in zip(varied, arrays)}
        return Result([_warned(case_of(raw)) for raw in raws], cases_total=len(raws), varied=named)

    def solve_many(self, problem: Problem | None = None, *, quantities: Sequence[str] = _USUAL, set: Changes = None,
                   progress: Callable[[int, int, str], Any] | None = None, threads: int = 0, **values: Any) -> dict[str, npt.NDArray[Any]]:
        """Solves any number of instants that do not depend on each other, on all threads, for some numbers of each:
        ``pair.solve_many(y_mm=y, yaw=yaw, load=80e3, quantities=["fz_tr", "pmax", "patch_2.pmax"])``.

        Keywords as in solve(); arrays are broadcast, and names may end with a unit of case files. Returns arrays of one length, in C order,
        as a dictionary that ``pandas.DataFrame`` takes: what was varied, as it was given, then the quantities in SI: of the case, "npatch",
        of the patch with the greatest normal force ("pmax") or of one patch ("patch_2.pmax", from 1), NaN where there is none, then
        "status" and "message". A row that cannot be solved, or makes no sense, is "failed", and the others go on; "doubtful": the numbers
        may be wrong. Of such rows there is one ConvergenceWarning. Each row has the bits of solve(), the last solution stays as it was, and
        memory does not grow beyond the arrays. progress and threads as in run(). Errors: InputError for names and arrays that make no
        sense. Ctrl-C ends it, other threads go on.
        """
        base = problem or self.problem
        varied = {name: np.asarray(value) for name, value in values.items() if not isinstance(value, (float, int, str)) and np.ndim(value) > 0}
        if not varied:
            raise InputError("nothing differs from row to row", advice="give an array, or use solve")
        try:
            arrays = np.broadcast_arrays(*varied.values())
            given: list[tuple[int, npt.NDArray[np.float64]]] = []
            for name, array in zip(varied, arrays):
                number, si = _array_number(name)
                column: npt.NDArray[np.float64] = np.array(array.ravel(), dtype=np.float64)
                column *= si
                given.append((number, column))
        except (TypeError, ValueError) as error:
            if isinstance(error, InputError):
                raise
            raise InputError(f"the arrays do not fit each other, or are no numbers: {error}") from None
        common = base.replace(set, **{name: value for name, value in values.items() if name not in varied})
        rows = arrays[0].size
        with self._lock:
            numbers, codes, said = self._open().solve_many(common._case, given, [_listed(name) for name in quantities], rows, progress, threads)
        message = np.full(rows, "", dtype=object)
        for row, text in said:
            message[row] = text
        bad = [entry for entry in said if codes[entry[0]] > 1]
        if bad:
            warnings.warn(f"{len(bad)} of {rows} rows are not converged, failed or doubtful, the first of them {bad[0][0]}: {bad[0][1]}", ConvergenceWarning, stacklevel=3)
        return {**{name: array.ravel() for name, array in zip(varied, arrays)}, **dict(zip(quantities, numbers)), "status": _STATUSES[codes],
                "message": message}

    def gradient(self, quantity: str, by: Sequence[str] = (), problem: Problem | None = None, *, set: Changes = None, **values: Any) -> Gradient:
        """A number of an instant, by its name or the last part of it ("pmax", of the patch with the greatest normal force; "patch_2.fn"), and its
        derivatives: ``pair.gradient("pmax", ["y", "yaw", "load"], y=2e-3)``.

        by: settings as in solve(), which may end with a unit of case files ("y_mm": derivatives by it), or parameters of the surfaces'
        shapes ("rail.point_12", Surface.parameters): total derivatives. Without: by the gap of every element, contact planes staying where
        they are. The instant is solved from rest, as exactly as solver.tolerance says, which derivatives then are, too; what the last solution
        left stays. Errors: InputError for theories and numbers without derivatives, NumericalError where there is none, as where contact
        comes or goes.
        """
        base = problem or self.problem
        case = base.replace(set, **values)._case if values or set else base._case
        given = [_by(name) for name in by]
        with self._lock:
            value, derivatives, by_gap = self._open().gradient(case, _listed(quantity), [name for name, _ in given])
        return Gradient(value, derivatives * np.array([si for _, si in given]), by_gap)

    def shape_gradient(self, quantity: str, body: str, problem: Problem | None = None, *, set: Changes = None, **values: Any) -> ShapeGradient:
        """As gradient(), by all parameters of the surface of the body, "rail" or "wheel", at once: of a measured profile its points, of slices,
        splines, offsets and triangles their coefficients, nodes and vertices. Costs a few linear systems, however many parameters there are."""
        base = problem or self.problem
        case = base.replace(set, **values)._case if values or set else base._case
        with self._lock:
            return ShapeGradient(*self._open().shape_gradient(case, _listed(quantity), body))

    def step(self, problem: Problem | None = None, *, set: Changes = None, **values: Any) -> Solution:
        """Solves the next instant: goes on from the last solution. Keywords as in solve(), for example regime="transient"."""
        solution: Solution = self.solve(problem, set=set, **{"history": "continue", **values})
        return solution

    def save(self) -> State:
        """What the last solution left."""
        made: State = object.__new__(State)
        with self._lock:
            made._state = self._open().save()
        return made

    def restore(self, state: State) -> None:
        """Goes on from a state of any pair of the same surfaces. Errors: InputError for other surfaces."""
        with self._lock:
            self._open().restore(state._state)

    def reset(self) -> None:
        """Forgets the last solution."""
        with self._lock:
            self._open().reset()

    def close(self) -> None:
        """Gives memory back now. Results stay as they are; solving is an InputError."""
        with self._lock:
            self._pair = None

    def __enter__(self) -> "Pair":
        return self

    def __exit__(self, *raised: Any) -> None:
        self.close()

    def __repr__(self) -> str:
        return f"<Pair: {self.wheel!r} on {self.rail!r}>"


@checked
class PatchSolver:
    """One patch of given geometry (Kalker's problem without wheel and rail), and what its last solution left."""

    __slots__ = ("_patch", "_lock")

    def __init__(self) -> None:
        self._patch = _treadmark.PatchSolver()
        self._lock = threading.Lock()

    def solve(self, problem: Problem | None = None, *, set: Changes = None, **values: Any) -> Solution:
        """Solves a problem made with patch=True, or given by keywords in SI units as ``[patch]`` has them:
        ``solve(normal_force=10e3, mx=20, my=20, semi_axis_x=5e-3, semi_axis_y=5e-3, set={"patch.hertz.given": "semi_axes"})``."""
        problem = problem.replace(set, **values) if problem is not None else Problem(patch=True, set=set, **values)
        with self._lock:
            raw = self._patch.solve(problem._case)
        return _warned(case_of(raw))


@checked
def hertz(normal_force: Newton, semi_axes: tuple[float, float] | None = None, curvatures: tuple[float, float] | None = None, *, mx: int = 40, my: int = 40,
          **values: Any) -> Solution:
    """Contact of two bodies as Hertz has them: normal_force [N] and either the semi-axes (a, b) of the ellipse [m] or the curvatures
    (A, B) of their distance A x^2 + B y^2 [1/m]. Further keywords as in PatchSolver.solve."""
    if (semi_axes is None) == (curvatures is None):
        raise InputError("either semi_axes or curvatures must be given")
    if semi_axes is not None:
        given: dict[str, Any] = {"patch.hertz.semi_axis_x_mm": 1e3 * semi_axes[0], "patch.hertz.semi_axis_y_mm": 1e3 * semi_axes[1]}
    else:
        assert curvatures is not None
        given = {"patch.hertz.curvature_x_per_m": float(curvatures[0]), "patch.hertz.curvature_y_per_m": float(curvatures[1])}
    return PatchSolver().solve(normal_force=normal_force, mx=mx, my=my, set={"patch.hertz.given": "semi_axes" if semi_axes is not None else "curvatures", **given}, **values)


__all__ = ["Case", "Gradient", "Pair", "PatchSolver", "Problem", "ShapeGradient", "Solution", "State", "hertz", "settings"]
