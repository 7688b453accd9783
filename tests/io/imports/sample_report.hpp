// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/imports/import_report.hpp"

namespace treadmark::testing {

/// A whole wheel with a flat, two pits, holes and stray points, all numbers as of an import; the same each time.
io::ImportReport sample_report();

/// What an import of a gridded map of deviations of a rail knows: no points and no placement.
io::ImportReport sample_map_report();

}  // namespace treadmark::testing
