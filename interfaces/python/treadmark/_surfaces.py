# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Wheels and rails."""
from __future__ import annotations

import pathlib
from typing import Annotated, Any, Callable, Mapping, NamedTuple

import numpy as np
import numpy.typing as npt

from . import _treadmark
from ._errors import InputError
from ._inputs import Input, Metre, Path, Radian, checked, source as _source, toml_value, to_toml

Array = npt.NDArray[np.float64]


def numbers(values: Any, name: str, *shape: int) -> Array:
    """Values as finite numbers of a shape (-1: any length), or an error that says which shape is wanted; without one all numbers are taken."""
    try:
        array = np.asarray(values, dtype=np.float64, order="C")
    except (TypeError, ValueError) as error:
        raise InputError(f"{name} must be numbers: {error}") from None
    if not shape:
        return array
    if array.ndim != len(shape) or any(wanted not in (-1, got) for wanted, got in zip(shape, array.shape)):
        raise InputError(f"{name} has the shape {array.shape}", advice=f"it must be ({', '.join('n' if n < 0 else str(n) for n in shape)})")
    if not np.isfinite(array).all():
        raise InputError(f"{name} holds a number that is not finite")
    return array


def radius_of(radius: float) -> float:
    """A nominal radius; 0: none is given. Errors: InputError for one that no wheel has."""
    least, most = _treadmark.wheel_radii()
    if radius != 0.0 and not least <= radius <= most:
        raise InputError(f"no wheel has a nominal_radius of {radius:g} m", advice="it is in metres: 0.46 for 460 mm")
    return radius


class Located(NamedTuple):
    """Points of a surface: found (bool), position (n, 3) [m], unit normal out of the material (n, 3), principal curvatures [1/m], and
    the parameters: u is x of a rail [m] or the angle of a wheel [rad], v the representation's own."""

    found: npt.NDArray[np.bool_]
    position: Array
    normal: Array
    curvature_1: Array
    curvature_2: Array
    u: Array
    v: Array


class Evaluated(NamedTuple):
    """A surface at parameters (u, v): position (n, 3) [m], first and second derivatives by them, unit normal out of the material,
    principal curvatures [1/m] (positive: convex) and their unit directions; NaN where nothing is. exact: derivatives are those of the
    representation itself, else central differences."""

    position: Array
    by_u: Array
    by_v: Array
    by_uu: Array
    by_uv: Array
    by_vv: Array
    normal: Array
    curvature_1: Array
    curvature_2: Array
    direction_1: Array
    direction_2: Array
    exact: bool


class Line(NamedTuple):
    """A line on a surface: arc length (n,) [m], parameters, position (n, 3) [m], normal, principal curvatures and the curvature of the
    normal section along the line [1/m]."""

    s: Array
    u: Array
    v: Array
    position: Array
    normal: Array
    curvature_1: Array
    curvature_2: Array
    curvature_along: Array


@checked
class Surface:
    """A wheel or rail. It never changes, and any number of threads may use it.

    Profile coordinates: y to the right, z down. A rail's profile runs with growing y, a wheel's with falling y, z = 0 at its
    nominal radius. A rail's axes are those of its profile; a wheel's origin lies on the axle.
    """

    __slots__ = ("_surface",)
    _surface: _treadmark.Surface

    def __init__(self) -> None:
        raise TypeError("surfaces are made by Surface.read, .standard, .profile, .slices, .mesh, .function or .of_case")

    @classmethod
    def _of(cls, surface: _treadmark.Surface) -> "Surface":
        made = object.__new__(cls)
        made._surface = surface
        return made

    @classmethod
    def read(cls, file: Path, body: str, nominal_radius: Metre = 0.0, scale_to_mm: float = 1.0) -> "Surface":
        """A profile, slices, triangles or offsets from a file.

        body: "rail" or "wheel"; nominal_radius [m]: of a wheel, 0 where the file has it; scale_to_mm: unit of profiles and triangles.
        Errors: InputError for a file that is missing, broken or implausible.
        """
        return cls._of(_treadmark.Surface.read(pathlib.Path(file), body, radius_of(nominal_radius), scale_to_mm))

    @classmethod
    def standard(cls, name: str, body: str | None = None, nominal_radius: Metre = 0.46) -> "Surface":
        """A standard profile by its published formula: "60E1" (rail), "S1002" (wheel) or another one of ``profiles()``. nominal_radius [m]: of a
        wheel. body: asked for no more than to be checked."""
        which = _treadmark.profile_body(name) or body or "rail"
        if body is not None and body != which:
            raise InputError(f"{name} is the profile of a {which}")
        other = "60E1" if which == "wheel" else "S1002"
        shape = {which: name, ("rail" if which == "wheel" else "wheel"): other}
        case = {f"{part}.shape.standard": profile for part, profile in shape.items()}
        return cls.of_case({**case, "wheelset.nominal_radius_mm": 1e3 * radius_of(nominal_radius), "wheelset.vertical_force_N": 1.0}, which)

    @classmethod
    def of_case(cls, given: Input, body: str, case: int = 1, folder: Path | None = None) -> "Surface":
        """The rail or wheel that a case names (a file, TOML text or a dictionary), in the representation that it asks for, with its
        defects. folder: from which names of files in text count."""
        return cls._of(_treadmark.Surface.of_case(case_of_input(given, case, folder), body))

    @classmethod
    def profile(cls, y: Any, z: Any, body: str, nominal_radius: Metre = 0.0, smoothing: Annotated[float, "m^3"] = 0.0) -> "Surface":
        """A cross-section through points, shapes (n,) [m], in order: rails with growing, wheels with falling y.

        nominal_radius [m]: of a wheel; smoothing [m^3]: strength, 0 = through the points.
        """
        y = numbers(y, "y", -1)
        return cls._of(_treadmark.Surface.profile(body, y, numbers(z, "z", len(y)), radius_of(nominal_radius), smoothing))

    @classmethod
    def slices(cls, u: Any, y: Any, z: Any, body: str, nominal_radius: Metre = 0.0) -> "Surface":
        """Cross-sections at growing u, shape (n,): x along the track [m] or angles round the wheel [rad]. y, z: shapes (n, m) or, y,
        (m,) [m]; z of wheels is radial, over the nominal radius, downwards."""
        u = numbers(u, "u", -1)
        z = numbers(z, "z", len(u), -1)
        y = numbers(np.broadcast_to(numbers(y, "y", z.shape[1]), z.shape) if np.ndim(y) == 1 else y, "y", *z.shape)
        return cls._of(_treadmark.Surface.slices(body, u, y, z, radius_of(nominal_radius)))

    @classmethod
    def mesh(cls, vertices: Any, faces: Any, body: str, nominal_radius: Metre = 0.0) -> "Surface":
        """Triangles: vertices (n, 3) [m], faces (m, 3) of their indices, counter-clockwise seen from outside the material."""
        vertices = numbers(vertices, "vertices", -1, 3)
        corners = np.asarray(faces)
        if corners.ndim != 2 or corners.shape[1] != 3 or corners.dtype.kind not in "iu":
            raise InputError(f"faces has the shape {corners.shape} of {corners.dtype}", advice="it must be (m, 3) whole numbers")
        if corners.size and (corners.min() < 0 or corners.max() >= len(vertices)):
            raise InputError("a face names a vertex that does not exist")
        return cls._of(_treadmark.Surface.mesh(body, vertices, corners.astype(np.int32), radius_of(nominal_radius)))

    @classmethod
    def function(cls, heights: Any, body: str, u: tuple[float, float], y: tuple[float, float], n_u: int = 201, n_y: int = 401,
                 nominal_radius: Metre = 0.0) -> "Surface":
        """A function of one's own, sampled: heights(u, y) -> z, or an object with such a method.

        It is called once with arrays of the shape (n_u, n_y): u from u[0] to u[1] along the track [m] or round the wheel [rad], y from
        y[0] to y[1] across [m]. It gives z of a rail, or of a wheel the radial height over the nominal radius, downwards [m]. The surface
        is the spline through these points. Errors: InputError for another shape, and for values that are not finite.
        """
        call: Callable[[Array, Array], Any] = getattr(heights, "heights", heights)
        if not callable(call):
            raise TypeError("a function, or an object with a method heights(u, y), is needed")
        if n_u < 2 or n_y < 2 or not (u[1] > u[0] and y[1] > y[0]):
            raise InputError("the rectangle is empty", advice="give u and y as (least, greatest), and two points at least each way")
        across = np.linspace(y[0], y[1], n_y)
        grid_u, grid_y = np.meshgrid(np.linspace(u[0], u[1], n_u), across[::-1] if body == "wheel" else across, indexing="ij")
        return cls.slices(grid_u[:, 0], grid_y, numbers(call(grid_u, grid_y), "what the function gives", n_u, n_y), body, nominal_radius)

    def represent(self, backend: str, resolution: Metre = 0.0) -> "Surface":
        """The same surface by another backend ("spline", "mesh", "offset", ...), sampled at a resolution [m]; 0 = its default."""
        return Surface._of(self._surface.represent(backend, resolution))

    def with_defects(self, **defects: Any) -> "Surface":
        """The surface with lists of defects as in case files: ``flats=[{"depth_mm": 1.0, "length_mm": 60.0}]``, ``squats``,
        ``corrugations``, ``polygonizations``, ... A list replaces that of the surface. Not for surfaces from files of offsets."""
        return Surface._of(self._surface.with_defects([f"{self.body}.{name}={toml_value(items)}" for name, items in defects.items()]))

    def with_flat(self, length: Metre, depth: Metre | None = None, angle: Radian = 0.0, y: Metre = 0.0, width: Metre = 0.0) -> "Surface":
        """A wheel with a flat: length along the circumference, depth of a rounded one (None: a fresh chord), middle y, width across (0:
        the whole profile) [m]; angle of its middle round the wheel [rad]."""
        flat: dict[str, Any] = {"shape": "fresh" if depth is None else "rounded", "length_mm": 1e3 * length, "y_center_mm": 1e3 * y,
                                "width_mm": 1e3 * width, "theta_center_deg": float(np.degrees(angle))}
        return self.with_defects(flats=[flat if depth is None else {**flat, "depth_mm": 1e3 * depth}])

    def heights(self, x: Any, y: Any, origin: Any = None, rotation: Any = None, slopes: bool = False) -> Any:
        """Heights z over points (x, y) of a plane [m], in the shape of x and y broadcast; NaN where nothing is.

        origin (3,) [m] and rotation (3, 3): the plane's axes in the surface's; None: the surface's own axes. slopes=True: (z, dz/dx, dz/dy).
        """
        xs, ys = np.broadcast_arrays(numbers(x, "x"), numbers(y, "y"))
        found = self._surface.heights(np.ascontiguousarray(xs), np.ascontiguousarray(ys),
                                      None if origin is None else numbers(origin, "origin", 3),
                                      None if rotation is None else numbers(rotation, "rotation", 3, 3), slopes)
        wanted = tuple(z.reshape(xs.shape)[()] for z in found[: 3 if slopes else 1])
        return wanted if slopes else wanted[0]

    def section(self, u: float, y: Any) -> Array:
        """The section at a station u, along the track [m] or round the wheel [rad], at lateral positions y, shape (n,) [m]: z of a rail, the
        height of a wheel over its nominal radius, downwards; NaN where nothing is."""
        return self._surface.section(u, numbers(y, "y", -1)) - (self.nominal_radius if self.body == "wheel" else 0.0)

    def locate(self, x: Any, y: Any) -> Located:
        """Points, normals and curvatures seen along z of the surface's own axes at points (x, y), shapes (n,) [m]."""
        x = numbers(x, "x", -1)
        status, *rest = self._surface.locate(x, numbers(y, "y", len(x)))
        return Located(status != 1, *rest)

    def evaluate(self, u: Any, v: Any) -> Evaluated:
        """Positions, derivatives and curvatures at parameters as locate gives them, shapes (n,)."""
        u = numbers(u, "u", -1)
        return Evaluated(*self._surface.evaluate(u, numbers(v, "v", len(u))))

    def section_line(self, u: float, step: Metre = 1e-3, y: tuple[float, float] | None = None) -> Line:
        """The line across at u, with growing y, from end to end or between two y [m]; step: arc length between points [m]."""
        return Line(*self._surface.trace(True, u, y, step))

    def line_along(self, y: Metre, u: tuple[float, float], step: Metre = 1e-3) -> Line:
        """The line of constant v along a rail or round a wheel, from the point at y [m] on, between two u ([m] or [rad])."""
        return Line(*self._surface.trace(False, y, u, step))

    def triangles(self, resolution: Metre = 0.0) -> tuple[Array, npt.NDArray[np.uint32]]:
        """Triangles over the surface, sampled at a resolution [m]: vertices (n, 3) [m] and faces (m, 3)."""
        return self._surface.triangles(resolution)

    def to_mesh(self, resolution: Metre = 0.0) -> dict[str, Any]:
        """The same as a dictionary: "points" (n, 3) [m] and "faces" (m, 3)."""
        return dict(zip(("points", "faces"), self.triangles(resolution)))

    def save(self, file: Path, resolution: Metre = 0.0) -> None:
        """Writes triangles (.ply .stl .obj .off), slices (.slcs .slcw) or offsets (.vdb .nvdb), sampled at a resolution [m]."""
        self._surface.save(pathlib.Path(file), resolution)

    @property
    def body(self) -> str:
        """"rail" or "wheel"."""
        return self._surface.body

    @property
    def backend(self) -> str:
        """Its representation."""
        return self._surface.backend

    @property
    def nominal_radius(self) -> float:
        """Of a wheel [m]; 0 of a rail."""
        return self._surface.nominal_radius

    @property
    def constant_profile(self) -> bool:
        """Whether all its sections are alike."""
        return self._surface.constant_profile

    @property
    def bounds(self) -> Array:
        """Least and greatest x, y, z, shape (2, 3) [m]; may be infinite."""
        return np.array(self._surface.bounds())

    @property
    def memory_bytes(self) -> int:
        """About what it takes."""
        return self._surface.memory_bytes

    @property
    def parameters(self) -> list[tuple[str, str]]:
        """Numbers that its shape follows from and says exactly how, as points of profiles: name and unit ("m", "rad", "1"), for Pair.gradient."""
        return self._surface.parameters

    @property
    def note(self) -> str:
        """Repairs worth knowing; may be empty."""
        return self._surface.note

    def __repr__(self) -> str:
        radius = f", nominal radius {self.nominal_radius:g} m" if self.body == "wheel" else ""
        return f"<Surface: {self.body} by {self.backend}{radius}, {'constant' if self.constant_profile else 'changing'} section>"

    def _repr_svg_(self) -> str:
        y = np.linspace(self.bounds[0, 1], self.bounds[1, 1], 800)
        curve = [(a, b) for a, b in zip(y, self.heights(0.0, y)) if b == b]
        wheel = self.body == "wheel"
        return _treadmark.position_svg(repr(self).strip("<>"), [] if wheel else curve, curve if wheel else [])


def case_of_input(given: Input, case: int, folder: Path | None) -> _treadmark.Case:
    if isinstance(given, Mapping) or (isinstance(given, str) and "\n" in given):
        if not isinstance(given, Mapping):
            return _treadmark.Case.parse(given, str(folder or ""), case)
        try:
            return _treadmark.Case.parse(to_toml(given), str(folder or ""), case)
        except InputError as error:
            if pathlib.PurePath(error.file).name != "text":
                raise
            raise type(error)(error.message, advice=error.advice) from None  # nobody sees lines of a dictionary
    _source(given, None, folder)  # the same errors as elsewhere
    return _treadmark.Case.read(pathlib.Path(given), case)


@checked
def register_backend(name: str, representation: Callable[..., Any], summary: str = "", order: float = 2.0, refine: int = 4) -> None:
    """A representation of surfaces in Python: from now on ``name`` is a choice in Surface.represent, in the keys ``wheel.backend`` and
    ``rail.backend``, in compare() and in bench(), in this process.

    representation: a class (or function) called with keywords u (n,), y (m,) and z (n, m): samples of a surface as the method ``heights``
    of Surface.function gives them, and body. What it makes has such a method: ``heights(u, y) -> z``, arrays of one shape. It is asked
    once, refine times as finely as the samples, and is a spline from then on. order: of its accuracy, for lists. What it raises is the reason
    why there are no numbers of it. Errors: InputError for a name that is taken or is none.
    """

    def finer(values: Array, times: int) -> Array:
        return np.interp(np.arange((len(values) - 1) * times + 1) / times, np.arange(len(values)), values)

    def make(u: Array, y: Array, z: Array, body: str, radius: float) -> _treadmark.Surface:
        fitted = representation(u=u, y=y, z=z, body=body)
        across = finer(y, refine)
        grid_u, grid_y = np.meshgrid(finer(u, refine), across[::-1] if body == "wheel" else across, indexing="ij")
        heights = numbers(fitted.heights(grid_u, grid_y), "what heights(u, y) gives", *grid_u.shape)
        return Surface.slices(grid_u[:, 0], grid_y, heights, body, radius)._surface

    _treadmark.register_backend(name, summary or (representation.__doc__ or "").strip().split("\n")[0] or "a backend in Python", order, make)


def backends() -> list[str]:
    """Names of all representations that this process has."""
    return _treadmark.backend_names()


@checked
def load_plugins(*files: Path) -> list[str]:
    """Loads plug-ins (.so), as ``--plugin`` of the program; without files those that the variable ``TREADMARK_PLUGINS`` names. Their backends and
    detectors are choices by name from then on, in this process. Gives the names of the new representations. Errors: MissingFileError; InputError
    for what is no plug-in, was built for another Treadmark, or has a name that is taken.
    """
    known = backends()
    _treadmark.load_plugins([str(pathlib.Path(file)) for file in files] if files else _treadmark.plugins_of_environment())
    return [name for name in backends() if name not in known]
