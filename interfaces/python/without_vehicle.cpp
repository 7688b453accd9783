// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/parts.hpp"
#include "treadmark/interfaces/python/python.hpp"

namespace treadmark::python {

void add_simulations(py::module_& module) {
  for (const char* name :
       {"simulate", "sweep", "read_sweep", "check_simulation", "evolve", "track", "stability", "response", "assess"})
    module.def(name, [](const py::args&) { left_out("vehicle", "simulations and studies"); });
}

}  // namespace treadmark::python
