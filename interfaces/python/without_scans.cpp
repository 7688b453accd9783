// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/interfaces/python/python.hpp"

namespace treadmark::python {

void add_scans(py::module_& module) {
  for (const char* name : {"import_scan"})
    module.def(name, [](const py::args&) { left_out("scans", "imports of scans"); });
}

}  // namespace treadmark::python
