// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/run_page.hpp"
#include "treadmark/app/cases/pages/solving_page.hpp"
#include "treadmark/app/geometry/pages/geometry_page.hpp"
#include "treadmark/app/pages/read_report.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/interfaces/python/python.hpp"
#include "treadmark/interfaces/python/requests.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/report/write_page.hpp"

namespace treadmark::python {

void add_pages(py::module_& module) {
  module.def("report_run", [](Run& run, const std::filesystem::path& file) {
    with_files([&] {
      run.whole();
      write_file(file, report::to_html(app::pages::run_page(run.result, io::to_json(*run.result))));
    });
  });
  module.def("live_page", [](const Source& source, int number, const std::filesystem::path& file,
                             const py::object& progress, int threads) {
    with_progress(progress, threads, [&](const Progress& said) {
      write_file(file, report::to_html(app::pages::solving_page(cases_of(source), number, said)));
      return true;
    });
  });
  module.def("report_geometry", [](const FoundGeometry& found, const std::filesystem::path& file) {
    const py::gil_scoped_release free;
    write_file(file, report::to_html(app::geometry_page(*found.result)));
  });
  module.def("report_measures", [](const FoundMeasures& found, const std::filesystem::path& file) {
    const py::gil_scoped_release free;
    write_file(file, report::to_html(app::measure_page(*found.file, found.request)));
  });
  module.def("report_folder", [](const std::filesystem::path& folder, const std::filesystem::path& file) {
    with_files([&] { write_file(file, report::to_html(app::pages::read_report(folder))); });
  });
}

}  // namespace treadmark::python
