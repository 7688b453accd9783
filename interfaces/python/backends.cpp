// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <pybind11/numpy.h>

#include <utility>

#include "treadmark/app/plugins/plugin.hpp"
#include "treadmark/backends/assembly/renamed_surface.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/interfaces/python/python.hpp"

namespace treadmark::python {
namespace {

py::array_t<double> copy_of(const std::vector<double>& values, std::vector<py::ssize_t> shape) {
  return py::array_t<double>(std::move(shape), values.data());
}

/// make(u, y, z, body, nominal radius) -> Surface, of samples z over the stations u and the lateral positions y; of
/// wheels z is over the nominal radius. Any thread.
std::shared_ptr<const Surface> represented_by(py::handle make, const std::string& name, Resampling& resampling) {
  resampling.limit_rail();
  const sampling::PointGrid grid = resampling.points(true);
  const double radius = resampling.spec().body == Body::wheel ? resampling.spec().nominal_radius : 0.0;
  const auto n_u = static_cast<py::ssize_t>(grid.u.size()), n_y = static_cast<py::ssize_t>(grid.y.size());
  std::vector<double> z = grid.h;
  for (double& value : z) value -= radius;
  const py::gil_scoped_acquire held;
  try {
    const py::object made = make(copy_of(grid.u, {n_u}), copy_of(grid.y, {n_y}), copy_of(z, {n_u, n_y}),
                                 radius > 0.0 ? "wheel" : "rail", radius);
    return assembly::rename_surface(made.cast<const tm_surface&>().represented.surface, name);
  } catch (py::error_already_set& raised) {
    if (raised.matches(PyExc_KeyboardInterrupt)) {
      PyErr_SetInterrupt();  // raised again where the call ends
      throw Cancelled();
    }
    throw Error(ErrorKind::configuration, "the backend '" + name + "' in Python raised " + raised.what());
  }
}

}  // namespace

void add_backends(py::module_& module) {
  module.def("backend_names", [] {
    Strings names;
    for (const std::string_view name : backend_names()) names.emplace_back(name);
    return names;
  });
  module.def("load_plugins", [](const Strings& files) { app::load_plugins(files); });
  module.def("plugins_of_environment", [] { return app::plugins_of_environment(); });
  module.def("register_backend",
             [](const std::string& name, const std::string& summary, double order, const py::function& make) {
               Backend row;
               row.name = name;
               row.summary = summary;
               row.order = order;
               // Rows are for ever, and so is what they call.
               row.resample = [kept = py::handle(make.inc_ref()), name](Resampling& resampling) {
                 return represented_by(kept, name, resampling);
               };
               register_backend(std::move(row));
             });
}

}  // namespace treadmark::python
