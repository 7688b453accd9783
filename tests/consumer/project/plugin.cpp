// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/plugins/plugin.hpp"

#include "chebyshev_backend.hpp"
#include "fine_grid.hpp"

TREADMARK_PLUGIN() {
  register_chebyshev();
  register_fine_grid();
}
