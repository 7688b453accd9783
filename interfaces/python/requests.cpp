// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <limits>
#include <mutex>
#include <utility>

#include <fmt/format.h>

#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/backends/profile_library.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/interfaces/python/python.hpp"
#include "treadmark/interfaces/python/requests.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark::python {
namespace {

FoundGeometry geometry(const Strings& settings, const py::object& progress, int threads) {
  return with_progress(progress, threads, [&](const Progress& told) {
    const CancellationScope scope(told.stop);
    app::SectionStore store;
    auto result = std::make_shared<const app::GeometryResult>(
        app::run_geometry(app::geometry_request(io::given_settings(settings)), store));
    FoundGeometry found{result, result->notes};
    for (std::string& doubt : app::profile_doubts(result->request)) found.notes.push_back(std::move(doubt));
    if (told.report) told.report(1, 1, "geometry");
    return found;
  });
}

void write_geometry_folder(const FoundGeometry& found, const std::filesystem::path& folder) {
  const py::gil_scoped_release free;
  app::write_geometry_folder(folder, *found.result);
}

Body measured_body(const std::string& name) {
  c::require(name == "rail" || name == "wheel", "body must be \"rail\" or \"wheel\"");
  return name == "wheel" ? Body::wheel : Body::rail;
}

FoundMeasures found_measures(app::MeasuredFile file, const app::MeasureRequest& request) {
  return {std::make_shared<const app::MeasuredFile>(std::move(file)), request};
}

FoundMeasures measure(const std::string& body, const std::string& file, const Strings& settings,
                      const py::object& progress, int threads) {
  return with_progress(progress, threads, [&](const Progress& told) {
    const CancellationScope scope(told.stop);
    const app::MeasureRequest request = app::measure_request(measured_body(body), io::given_settings(settings));
    FoundMeasures found = found_measures(app::measure_file(file, request), request);
    if (told.report) told.report(1, 1, file);
    return found;
  });
}

/// Of each file, in the order of their names; those that fail say why.
std::vector<FoundMeasures> measure_files(const std::string& body, const Strings& files, const Strings& settings,
                                         const py::object& progress, int threads) {
  return with_progress(progress, threads, [&](const Progress& told) {
    const app::MeasureRequest request = app::measure_request(measured_body(body), io::given_settings(settings));
    if (!request.mate.empty()) throw Error(ErrorKind::configuration, "mate is the other wheel of one wheel");
    const Strings names = app::measured_names(files, request.body);
    std::vector<FoundMeasures> found(names.size());
    std::size_t finished = 0;
    std::mutex reporting;
    const auto failed = [&](std::size_t i, const std::string& why) {
      app::MeasuredFile file;
      file.file = names[i];
      file.error = why;
      if (request.body == Body::rail) file.numbers = app::RailNumbers{};
      found[i] = found_measures(std::move(file), request);
    };
    parallel_for(names.size(), [&](std::size_t i) {
      const CancellationScope scope(told.stop);
      try {
        check_cancelled();
        found[i] = found_measures(app::measure_file(names[i], request), request);
      } catch (const Cancelled&) {
        failed(i, "stopped before it was measured");
        return;
      } catch (const std::exception& error) {
        failed(i, error.what());
      }
      const std::lock_guard lock(reporting);
      ++finished;
      if (told.report) told.report(finished, names.size(), names[i]);
    });
    return found;
  });
}

/// (name, body, height [m], width [m], area [m2], mass [kg/m], source, shape, other names, whether it has a
/// placeholder)
py::list profile_rows() {
  py::list rows;
  const auto known = [](double value) { return value > 0.0 ? value : std::numeric_limits<double>::quiet_NaN(); };
  for (const LibraryProfile& p : profile_library())
    rows.append(py::make_tuple(p.name, body_name(p.body), known(p.height), known(p.width), known(p.area),
                               known(p.mass_per_m), p.source, p.shape, p.also, p.family));
  return rows;
}

/// "rail" or "wheel"; empty where the library has no such profile.
std::string profile_body(const std::string& name) {
  const std::optional<Body> body = library_body(name);
  return body ? body_name(*body) : "";
}

const char* kind_of(const io::KeyInfo& key) {
  const bool file = key.option.ends_with(" PROFILE") || key.option.ends_with(" FILE");
  switch (key.type) {
    case io::KeyType::number:
      return "number";
    case io::KeyType::integer:
      return "integer";
    case io::KeyType::flag:
      return "flag";
    case io::KeyType::value_list:
      return "list";
    default:
      return file ? "file" : "text";
  }
}

/// Settings as (key, name without its unit, factor to SI, unit there, kind, meaning), and (key, meaning) of measures.
py::dict request_tables() {
  const auto keys = [](const io::TableKeys& all) {
    py::list rows;
    for (const io::KeyInfo& key : all) {
      const io::KeyUnit unit = io::unit_at_end(key.path);
      rows.append(py::make_tuple(key.path, key.path.substr(0, key.path.size() - unit.ending.size()), unit.si,
                                 std::string(unit.si_name), kind_of(key), key.doc));
    }
    return rows;
  };
  py::list measures;
  for (const auto& row : app::number_rows(app::WheelNumbers{})) measures.append(py::make_tuple(row.key, row.label));
  for (const auto& row : app::number_rows(app::RailNumbers{})) measures.append(py::make_tuple(row.key, row.label));
  using namespace py::literals;
  return py::dict("geometry"_a = keys(app::geometry_keys().infos), "measure"_a = keys(app::measure_keys().infos),
                  "measures"_a = measures);
}

}  // namespace

void add_requests(py::module_& module) {
  using Found = FoundGeometry;
  py::class_<Found>(module, "Geometry")
      .def_property_readonly("notes", [](const Found& g) { return g.notes; })
      .def("json", [](const Found& g) { return app::geometry_json(*g.result); })
      .def("summary", [](const Found& g) { return app::geometry_text(*g.result); })
      .def("charts_svg", [](const Found& g) { return app::geometry_charts_svg(*g.result); })
      .def("points_svg", [](const Found& g) { return app::contact_points_svg(*g.result); })
      .def("gauges_svg", [](const Found& g) { return g.result->sweep ? app::gauge_sweep_svg(*g.result->sweep) : ""; })
      .def("write_folder", write_geometry_folder);
  using Measured = FoundMeasures;
  py::class_<Measured>(module, "Measured")
      .def("json", [](const Measured& m) { return app::measure_json(*m.file, m.request); })
      .def("summary", [](const Measured& m) { return app::measure_text(*m.file, m.request); });
  module.def("geometry", geometry);
  module.def("measure", measure);
  module.def("measure_files", measure_files);
  module.def("profiles", profile_rows);
  module.def("profile_body", profile_body);
  module.def("request_tables", request_tables);
}

}  // namespace treadmark::python
