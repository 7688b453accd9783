// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <pybind11/numpy.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <optional>
#include <utility>

#include "treadmark/app/cases/case_sequence.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/app/surfaces/trace_line.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parametric.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/c/many.hpp"
#include "treadmark/interfaces/c/surfaces.hpp"
#include "treadmark/interfaces/python/python.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/model/magnitudes.hpp"
#include "treadmark/model/shape/body_name.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::python {
namespace {

using Numbers = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Corners = py::array_t<std::int32_t, py::array::c_style | py::array::forcecast>;

tm_body body_named(const std::string& name) {
  if (name == "rail") return TM_RAIL;
  if (name == "wheel") return TM_WHEEL;
  throw c::BadArgument{"body must be \"rail\" or \"wheel\""};
}

const char* or_null(const std::string& text) { return text.empty() ? nullptr : text.c_str(); }

using Case = Owned<tm_case>;
using Surf = Owned<tm_surface>;

// ---- surfaces

/// Shapes of arrays are checked by the package.
Surf of_slices(const std::string& body, const Numbers& u, const Numbers& y, const Numbers& z, double radius) {
  return released([&] {
    return made<tm_surface>([&](tm_surface** out) {
      return tm_surface_from_slices(body_named(body), u.data(), static_cast<std::size_t>(u.size()), y.data(), z.data(),
                                    static_cast<std::size_t>(u.size() > 0 ? y.size() / u.size() : 0), radius, out);
    });
  });
}

/// The same surface with other defects: assignments with the keys of case files.
Surf with_defects(const tm_surface& from, const Strings& assignments) {
  return released([&] {
    SurfaceSpec spec = from.natural->spec;
    io::Case holder;
    holder.number = 1;
    auto& given = std::get<io::WheelRailCase>(holder.content);
    (spec.body == Body::wheel ? given.wheel : given.rail).defects = spec.defects;
    for (const std::string& assignment : assignments) io::apply_assignment(holder, io::parse_override(assignment), {});
    spec.defects = (spec.body == Body::wheel ? given.wheel : given.rail).defects;
    return Surf(c::natural_surface(create_natural(std::move(spec))).release());
  });
}

/// Read again and compared before the file gets its name.
void save(const tm_surface& s, const std::filesystem::path& file, double resolution) {
  released([&] {
    app::ConvertSettings settings;
    settings.resolution = resolution;
    app::write_surface(*s.natural, file, settings);
  });
}

/// (vertices [m], corners)
py::tuple triangles(const tm_surface& s, double resolution) {
  const auto mesh = released([&] {
    return std::make_shared<const TriangleMesh>(to_triangles(*s.natural, {"", resolution, {}}));
  });
  const py::object owner = owner_of(mesh);
  const auto n = static_cast<py::ssize_t>(mesh->vertices.size()), m = static_cast<py::ssize_t>(mesh->triangles.size());
  return py::make_tuple(
      view(mesh->vertices.data(), 'd', {n, 3}, {sizeof(Vec3), sizeof(double)}, owner),
      view(mesh->triangles.data(), 'I', {m, 3}, {3 * sizeof(std::uint32_t), sizeof(std::uint32_t)}, owner));
}

/// Heights, and slopes where they are wanted, over points (x, y) of a plane.
py::tuple heights(const tm_surface& s, const Numbers& x, const Numbers& y, const std::optional<Numbers>& origin,
                  const std::optional<Numbers>& rotation, bool slopes) {
  const std::vector<py::ssize_t> shape(x.shape(), x.shape() + x.ndim());
  Numbers z(shape), dzdx(slopes ? shape : std::vector<py::ssize_t>{0}), dzdy(dzdx.request().shape);
  double *to_z = z.mutable_data(), *to_x = slopes ? dzdx.mutable_data() : nullptr,
         *to_y = slopes ? dzdy.mutable_data() : nullptr;
  released([&] {
    check([&] {
      return tm_surface_heights(&s, origin ? origin->data() : nullptr, rotation ? rotation->data() : nullptr, x.data(),
                                y.data(), static_cast<std::size_t>(x.size()), to_z, to_x, to_y);
    });
  });
  return py::make_tuple(z, dzdx, dzdy);
}

/// Heights of a rail or radii of a wheel at lateral positions y of one station u.
Numbers section(const tm_surface& s, double u, const Numbers& y) {
  Numbers z(y.size());
  const auto n = static_cast<std::size_t>(y.size());
  double* const to = z.mutable_data();
  released([&] { section_heights(*s.represented.surface, s.natural->spec.body, u, {y.data(), n}, {{to, n}, {}, {}}); });
  return z;
}

/// What is found at points (x, y) seen along z of the surface's own axes: found, position, normal, principal
/// curvatures, parameters.
py::tuple locate(const tm_surface& s, const Numbers& x, const Numbers& y) {
  const auto n = static_cast<std::size_t>(x.size());
  auto points = std::make_shared<std::vector<SurfacePoint>>(n);
  released([&] {
    std::vector<Vec2> places;
    for (std::size_t i = 0; i < n; ++i) {
      c::require(std::isfinite(x.data()[i]) && std::isfinite(y.data()[i]), "x and y must be finite");
      places.emplace_back(x.data()[i], y.data()[i]);
    }
    s.represented.surface->locate({}, places, *points);
  });
  const py::object owner = owner_of(points);
  const auto count = static_cast<py::ssize_t>(n);
  constexpr py::ssize_t kStep = sizeof(SurfacePoint), kDouble = sizeof(double);
  const SurfacePoint* first = points->data();
  const auto column = [&](const void* data, char item) { return view(data, item, {count}, {kStep}, owner); };
  return py::make_tuple(column(&first->status, 'B'), view(&first->position_S, 'd', {count, 3}, {kStep, kDouble}, owner),
                        view(&first->normal_S, 'd', {count, 3}, {kStep, kDouble}, owner),
                        column(&first->curvature_1, 'd'), column(&first->curvature_2, 'd'), column(&first->u, 'd'),
                        column(&first->v, 'd'));
}

/// Position, derivatives, normal, curvatures and directions at parameters, and whether derivatives are exact.
py::tuple evaluate_at(const tm_surface& s, const Numbers& u, const Numbers& v) {
  struct Shaped {
    SurfaceJet jet;
    SurfaceShape shape;
  };
  const auto n = static_cast<std::size_t>(u.size());
  auto all = std::make_shared<std::vector<Shaped>>(n);
  const Surface& surface = *s.represented.surface;
  released([&] {
    std::vector<Vec2> uv;
    uv.reserve(n);
    for (std::size_t i = 0; i < n; ++i) uv.emplace_back(u.data()[i], v.data()[i]);
    std::vector<SurfaceJet> jets(n);
    evaluate(surface, uv, jets);
    for (std::size_t i = 0; i < n; ++i) (*all)[i] = {jets[i], shape_of(jets[i])};
  });
  const py::object owner = owner_of(all);
  const auto count = static_cast<py::ssize_t>(n);
  constexpr py::ssize_t kStep = sizeof(Shaped), kDouble = sizeof(double);
  const Shaped* first = all->data();
  const auto vectors = [&](const Vec3* data) { return view(data, 'd', {count, 3}, {kStep, kDouble}, owner); };
  const auto numbers = [&](const double* data) { return view(data, 'd', {count}, {kStep}, owner); };
  return py::make_tuple(vectors(&first->jet.p), vectors(&first->jet.pu), vectors(&first->jet.pv),
                        vectors(&first->jet.puu), vectors(&first->jet.puv), vectors(&first->jet.pvv),
                        vectors(&first->shape.normal), numbers(&first->shape.curvature_1),
                        numbers(&first->shape.curvature_2), vectors(&first->shape.direction_1),
                        vectors(&first->shape.direction_2), has_exact_derivatives(surface));
}

/// A line by arc length: s, u, v, position, normal, principal curvatures, curvature along.
py::tuple trace(const tm_surface& s, bool section, double at, std::optional<std::pair<double, double>> range,
                double step) {
  auto line = std::make_shared<app::TracedLine>();
  released([&] {
    c::require(s.natural->spec.roller_radius == 0.0, "lines are traced on rails and wheels, not on rollers");
    *line = app::trace_line(*s.represented.surface, s.natural->spec.body, {section, at, range, step});
  });
  const py::object owner = owner_of(line);
  const auto count = static_cast<py::ssize_t>(line->points.size());
  constexpr py::ssize_t kStep = sizeof(app::TracedPoint), kDouble = sizeof(double);
  const app::TracedPoint* first = line->points.data();
  const auto numbers = [&](const double* data) { return view(data, 'd', {count}, {kStep}, owner); };
  const auto vectors = [&](const Vec3* data) { return view(data, 'd', {count, 3}, {kStep, kDouble}, owner); };
  return py::make_tuple(numbers(&first->s), numbers(&first->u), numbers(&first->v), vectors(&first->position),
                        vectors(&first->normal), numbers(&first->curvature_1), numbers(&first->curvature_2),
                        numbers(&first->curvature_along));
}

py::tuple bounds(const tm_surface& s) {
  const Box3 box = s.represented.surface->bounds();
  return py::make_tuple(py::make_tuple(box.min.x(), box.min.y(), box.min.z()),
                        py::make_tuple(box.max.x(), box.max.y(), box.max.z()));
}

// ---- solving

using Pair = Owned<tm_pair>;

/// The solution as results say it, with a copy of nothing that is large.
py::dict solved(tm_solution& solution) {
  std::shared_ptr<const io::CaseResult> result;
  {
    const py::gil_scoped_release free;
    result = std::make_shared<const io::CaseResult>(std::move(c::result_of(&solution)));
  }
  return to_python(std::move(result));
}

/// Independent problems, each from rest, on all threads; their order is kept.
py::list solve_all(const tm_pair& pair, const std::vector<tm_case*>& cases) {
  auto results = std::make_shared<std::vector<io::CaseResult>>(cases.size());
  released([&] {
    app::SolverPool pool;
    parallel_for(cases.size(), [&](std::size_t i) {
      app::SolverPool::Lease lease = pool.take(pair.geometry);
      tm_pair own{pair.geometry, std::move(*lease.pair), pair.wheel_radius, pair.roller_radius};
      const auto solution = made<tm_solution>([&](auto out) { return tm_pair_solve(&own, cases[i], out); });
      io::CaseResult& result = (*results)[i];
      result = app::to_result(std::get<io::WheelRailCase>(cases[i]->content->content), *solution->pair);
      result.number = static_cast<int>(i) + 1;
      *lease.pair = std::move(own.pair);
      pool.give_back(std::move(lease));
    });
  });
  return to_python(results, *results);
}

/// Independent instants, row by row: arrays of the numbers wanted (SI), codes of statuses, and (row, text) of those
/// that are not ok. given: a number of cases by its id, and an array of it.
py::tuple solve_many(const tm_pair& pair, const tm_case& common,
                     const std::vector<std::pair<std::size_t, Numbers>>& given, const Strings& wanted, std::size_t rows,
                     const py::object& progress, int threads) {
  c::ManyRows many{rows, {}, {}};
  for (const auto& [id, values] : given) {
    c::require(id < c::case_numbers().size(), "no number of cases has this id");
    c::require(static_cast<std::size_t>(values.size()) == rows, "an array has another length than there are rows");
    many.given.emplace_back(&c::case_numbers()[id], values.data());
  }
  py::list numbers;
  for (const std::string& name : wanted) {
    Numbers made(static_cast<py::ssize_t>(rows));
    many.wanted.emplace_back(io::listed_number(name, io::Names::si), made.mutable_data());
    numbers.append(made);
  }
  py::array_t<std::uint8_t> codes(static_cast<py::ssize_t>(rows));
  std::uint8_t* const code = codes.mutable_data();
  auto said = with_progress(progress, threads, [&](const Progress& report) {
    std::vector<std::pair<std::size_t, std::string>> texts;
    c::solve_many(
        pair, common, many,
        [&](std::size_t row, Status end, const std::string& message) {
          constexpr std::uint8_t kDoubtful = 4;
          code[row] = end == Status::ok && !message.empty() ? kDoubtful : static_cast<std::uint8_t>(end);
          if (!message.empty()) texts.emplace_back(row, message);
        },
        report);
    ranges::sort(texts);
    return texts;
  });
  return py::make_tuple(numbers, codes, said);
}

/// One field after the other, as arrays.
py::list fields_on(const std::vector<Grid2>& grids, const std::shared_ptr<std::vector<double>>& values) {
  const py::object owner = owner_of(values);
  py::list fields;
  const double* first = values->data();
  for (const Grid2& grid : grids) {
    fields.append(view(first, 'd', {grid.ny, grid.nx},
                       {static_cast<py::ssize_t>(sizeof(double)) * grid.nx, sizeof(double)}, owner));
    first += grid.size();
  }
  return fields;
}

/// A number of an instant, which starts from rest, and its derivatives by names, or without names by the gaps of each
/// patch. The pair keeps what its last solution left.
py::tuple gradient(const tm_pair& pair, const tm_case& c, const std::string& number, const Strings& by) {
  double value = 0.0;
  Numbers derivatives(static_cast<py::ssize_t>(by.size()));
  double* const to = derivatives.mutable_data();
  std::vector<Grid2> grids;
  auto gaps = std::make_shared<std::vector<double>>();
  released([&] {
    tm_pair own{pair.geometry, wheelrail::Pair(pair.geometry), pair.wheel_radius, pair.roller_radius};
    const auto solution = made<tm_solution>([&](auto out) { return tm_pair_solve(&own, &c, out); });
    const io::CaseResult& result = c::result_of(solution.get());
    value = io::listed_number(number, io::Names::si).si(result);
    const char* const name = number.c_str();
    if (by.empty()) {
      for (const io::PatchResult& patch : result.patches) grids.push_back(patch.fields.grid);
      gaps->resize(std::accumulate(grids.begin(), grids.end(), std::size_t{0},
                                   [](std::size_t sum, const Grid2& grid) { return sum + grid.size(); }));
      check([&] { return tm_pair_gradient_by_gap(&own, solution.get(), name, gaps->data(), gaps->size()); });
      return;
    }
    std::vector<const char*> names;
    for (const std::string& one : by) names.push_back(one.c_str());
    check([&] { return tm_pair_gradient(&own, solution.get(), &name, 1, names.data(), names.size(), to); });
  });
  return py::make_tuple(value, derivatives, fields_on(grids, gaps));
}

/// A number of an instant as above, and its derivatives by all that a body's shape follows from: with where each acts,
/// whether they are exact, and by heights over the elements of each patch.
py::tuple shape_gradient(const tm_pair& pair, const tm_case& c, const std::string& number, const std::string& body) {
  const tm_body of = body_named(body);
  const Surface& surface = of == TM_RAIL ? *pair.geometry.rail : *pair.geometry.wheel;
  const auto count = static_cast<py::ssize_t>(surface.parameter_count());
  double value = 0.0;
  int exact = 0;
  Numbers by(count), places(std::vector<py::ssize_t>{count, 3});
  double *const to = by.mutable_data(), *at = places.mutable_data();
  std::vector<Grid2> grids;
  auto heights = std::make_shared<std::vector<double>>();
  released([&] {
    tm_pair own{pair.geometry, wheelrail::Pair(pair.geometry), pair.wheel_radius, pair.roller_radius};
    const auto solution = made<tm_solution>([&](auto out) { return tm_pair_solve(&own, &c, out); });
    const io::CaseResult& result = c::result_of(solution.get());
    value = io::listed_number(number, io::Names::si).si(result);
    for (const io::PatchResult& patch : result.patches) grids.push_back(patch.fields.grid);
    std::size_t elements = 0;
    for (const Grid2& grid : grids) elements += grid.size();
    heights->resize(elements);
    const char* const name = number.c_str();
    check([&] {
      return tm_pair_gradient_by_shape(&own, solution.get(), name, of, to, static_cast<std::size_t>(count), &exact);
    });
    check([&] { return tm_pair_gradient_by_height(&own, solution.get(), name, of, heights->data(), elements); });
    for (const ShapeParameter& one : surface.parameters()) at = std::copy_n(one.place_S.data(), 3, at);
  });
  return py::make_tuple(value, by, places, exact != 0, fields_on(grids, heights));
}

py::bytes bytes_of(const tm_state& state) {
  std::size_t size = 0;
  check([&] { return tm_state_to_bytes(&state, nullptr, &size); });
  std::string bytes(size, '\0');
  check([&] { return tm_state_to_bytes(&state, bytes.data(), &size); });
  return bytes;
}

Owned<tm_state> state_of(const py::bytes& bytes) {
  const std::string_view text = bytes;
  return made<tm_state>([&](tm_state** out) { return tm_state_from_bytes(text.data(), text.size(), out); });
}

void add_cases(py::module_& module) {
  py::class_<tm_case, Case>(module, "Case")
      .def_static(
          "create",
          [](bool patch) { return made<tm_case>([&](auto out) { return tm_case_create(patch ? 1 : 0, out); }); })
      .def_static("read",
                  [](const std::filesystem::path& file, int number) {
                    return released([&] {
                      return made<tm_case>([&](auto out) { return tm_case_read(file.c_str(), number, out); });
                    });
                  })
      .def_static("parse",
                  [](const std::string& text, const std::string& folder, int number) {
                    return made<tm_case>([&](auto out) {
                      return tm_case_parse(text.data(), text.size(), or_null(folder), number, out);
                    });
                  })
      .def("copy", [](const tm_case& c) { return made<tm_case>([&](auto out) { return tm_case_copy(&c, out); }); })
      .def("set", [](tm_case& c,
                     const std::string& assignment) { check([&] { return tm_case_set(&c, assignment.c_str()); }); })
      .def("set_number",
           [](tm_case& c, int id, double value) { check([&] { return tm_case_set_number_by_id(&c, id, value); }); })
      .def("get_number",
           [](const tm_case& c, const std::string& name) {
             double value = 0.0;
             check([&] { return tm_case_get_number(&c, name.c_str(), &value); });
             return value;
           })
      .def_property_readonly("patch", [](const tm_case& c) { return c.content->content.index() == 1; });
}

void add_surfaces(py::module_& module) {
  py::class_<tm_surface, Surf>(module, "Surface")
      .def_static("read",
                  [](const std::filesystem::path& file, const std::string& body, double radius, double scale) {
                    return released([&] {
                      return made<tm_surface>([&](auto out) {
                        return tm_surface_read(file.c_str(), body_named(body), radius, scale, out);
                      });
                    });
                  })
      .def_static("of_case",
                  [](const tm_case& c, const std::string& body) {
                    return released([&] {
                      return made<tm_surface>([&](auto out) { return tm_surface_of_case(&c, body_named(body), out); });
                    });
                  })
      .def_static("profile",
                  [](const std::string& body, const Numbers& y, const Numbers& z, double radius, double strength) {
                    return released([&] {
                      return made<tm_surface>([&](auto out) {
                        return tm_surface_from_profile(body_named(body), y.data(), z.data(),
                                                       static_cast<std::size_t>(y.size()), radius, strength, out);
                      });
                    });
                  })
      .def_static("slices", of_slices)
      .def_static("mesh",
                  [](const std::string& body, const Numbers& vertices, const Corners& corners, double radius) {
                    return released([&] {
                      return made<tm_surface>([&](auto out) {
                        return tm_surface_from_triangles(body_named(body), vertices.data(),
                                                         static_cast<std::size_t>(vertices.size() / 3), corners.data(),
                                                         static_cast<std::size_t>(corners.size() / 3), radius, out);
                      });
                    });
                  })
      .def("represent",
           [](const tm_surface& s, const std::string& backend, double resolution) {
             return released([&] {
               return made<tm_surface>(
                   [&](auto out) { return tm_surface_represent(&s, backend.c_str(), resolution, out); });
             });
           })
      .def("with_defects", with_defects)
      .def("save", save)
      .def("triangles", triangles)
      .def("heights", heights)
      .def("section", section)
      .def("locate", locate)
      .def("evaluate", evaluate_at)
      .def("trace", trace)
      .def("bounds", bounds)
      .def_property_readonly("body", [](const tm_surface& s) { return body_name(s.natural->spec.body); })
      .def_property_readonly("nominal_radius", [](const tm_surface& s) { return s.natural->spec.nominal_radius; })
      .def_property_readonly("backend",
                             [](const tm_surface& s) { return std::string(s.represented.surface->backend()); })
      .def_property_readonly("resolution", [](const tm_surface& s) { return s.represented.resolution; })
      .def_property_readonly("constant_profile", [](const tm_surface& s) { return s.natural->constant_profile(); })
      .def_property_readonly("memory_bytes", [](const tm_surface& s) { return s.represented.surface->memory_bytes(); })
      .def_property_readonly("note", [](const tm_surface& s) { return s.natural->note + s.represented.note; })
      .def_property_readonly("parameters", [](const tm_surface& s) {
        std::vector<std::pair<std::string, std::string>> all;
        for (ShapeParameter& one : s.represented.surface->parameters())
          all.emplace_back(std::move(one.name), std::move(one.unit));
        return all;
      });
}

}  // namespace

py::object view(const void* data, char item, const std::vector<py::ssize_t>& shape,
                const std::vector<py::ssize_t>& strides, const py::object& owner) {
  static const py::dtype kDouble("d"), kByte("B"), kFloat("f"), kUnsigned("I");
  const py::dtype& type = item == 'd' ? kDouble : item == 'B' ? kByte : item == 'f' ? kFloat : kUnsigned;
  py::array array(type, shape, strides, data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

void add_handles(py::module_& module) {
  module.def("wheel_radii", [] { return py::make_tuple(kLeastWheelRadius, kMostWheelRadius); });
  add_cases(module);
  add_surfaces(module);
  py::class_<tm_state, Owned<tm_state>>(module, "State")
      .def_static("from_bytes", state_of)
      .def("to_bytes", bytes_of)
      .def(py::pickle([](const tm_state& state) { return bytes_of(state); },
                      [](const py::bytes& bytes) { return state_of(bytes); }));
  py::class_<tm_pair, Pair>(module, "Pair")
      .def(py::init([](const tm_surface& rail, const tm_surface& wheel) {
        return made<tm_pair>([&](auto out) { return tm_pair_create(&rail, &wheel, out); });
      }))
      .def("solve",
           [](tm_pair& pair, const tm_case& c) {
             const auto solution =
                 released([&] { return made<tm_solution>([&](auto out) { return tm_pair_solve(&pair, &c, out); }); });
             return solved(*solution);
           })
      .def("solve_all", solve_all)
      .def("solve_many", solve_many)
      .def("gradient", gradient)
      .def("shape_gradient", shape_gradient)
      .def("reset", [](tm_pair& pair) { check([&] { return tm_pair_reset(&pair); }); })
      .def("save",
           [](const tm_pair& pair) { return made<tm_state>([&](auto out) { return tm_pair_save(&pair, out); }); })
      .def("restore",
           [](tm_pair& pair, const tm_state& state) { check([&] { return tm_pair_restore(&pair, &state); }); });
  py::class_<tm_patch, Owned<tm_patch>>(module, "PatchSolver")
      .def(py::init([] { return made<tm_patch>(tm_patch_create); }))
      .def("solve", [](tm_patch& patch, const tm_case& c) {
        const auto solution =
            released([&] { return made<tm_solution>([&](auto out) { return tm_patch_solve(&patch, &c, out); }); });
        return solved(*solution);
      });
}

}  // namespace treadmark::python
