// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/interfaces/python/python.hpp"

namespace treadmark::python {

void add_pages(py::module_& module) {
  for (const char* name : {"report_run", "report_folder", "report_geometry", "report_measures", "live_page"})
    module.def(name, [](const py::args&) { left_out("report", "reports"); });
}

}  // namespace treadmark::python
