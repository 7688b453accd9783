// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <utility>

#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/interfaces/python/python.hpp"
#include "treadmark/report/pictures/imports/import_pictures.hpp"

namespace treadmark::python {
namespace {

struct Imported {
  std::shared_ptr<const io::ImportReport> report;
};

Imported import_scan(const std::vector<std::filesystem::path>& scans, const std::vector<std::filesystem::path>& outputs,
                     const std::optional<std::filesystem::path>& settings, const Strings& assignments,
                     const py::object& progress, int threads) {
  app::ImportRequest request;
  request.scans = scans;
  request.outputs = outputs;
  return with_progress(progress, threads, [&](const Progress& told) {
    if (settings) io::read_import_settings(*settings, request.settings);
    for (const std::string& assignment : assignments) io::set_import_setting(request.settings, assignment);
    return Imported{std::make_shared<const io::ImportReport>(app::import_scan(request, told))};
  });
}

/// By name: values over (a, s), and the ends of a and s [m].
py::dict maps_of(const Imported& imported) {
  const io::ImportReport& r = *imported.report;
  const py::object owner = owner_of(imported.report);
  py::dict maps;
  const std::pair<const char*, const io::BandMap*> all[] = {{"density", &r.density}, {"removed", &r.removed_map},
                                                            {"fitted", &r.fitted},   {"residual", &r.residual},
                                                            {"noise", &r.noise_map}, {"error", &r.error_map}};
  for (const auto& [name, map] : all)
    if (!map->value.empty())
      maps[name] = py::make_tuple(
          view(map->value, 'f', {static_cast<py::ssize_t>(map->rows), static_cast<py::ssize_t>(map->columns)}, owner),
          map->a_min, map->a_max, map->s_min, map->s_max);
  return maps;
}

}  // namespace

void add_scans(py::module_& module) {
  py::class_<Imported>(module, "Imported")
      .def_static("read_folder",
                  [](const std::filesystem::path& folder) {
                    return Imported{with_files(
                        [&] { return std::make_shared<const io::ImportReport>(io::read_import_report(folder)); })};
                  })
      .def("json", [](const Imported& i) { return io::import_json(*i.report, false); })
      .def("summary", [](const Imported& i) { return io::import_summary(*i.report); })
      .def("maps", maps_of)
      .def("before_svg", [](const Imported& i) { return pictures::import_before_svg(*i.report); })
      .def("removed_svg", [](const Imported& i) { return pictures::import_removed_svg(*i.report); })
      .def("fitted_svg", [](const Imported& i) { return pictures::import_fitted_svg(*i.report); })
      .def("residual_svg", [](const Imported& i) { return pictures::import_residual_svg(*i.report); })
      .def("write_folder", [](const Imported& i, const std::filesystem::path& folder) {
        with_files([&] { pictures::write_import_report(folder.string(), *i.report); });
      });
  module.def("import_scan", import_scan);
}

}  // namespace treadmark::python
