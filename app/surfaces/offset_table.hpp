// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/create.hpp"
#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/model/shape/offset_map.hpp"

namespace treadmark::app {

/// A table of deviations for a wheel or rail, which it must lie on as a whole. What is worth knowing is added to the
/// note of the surface: deviations at the border of the table, where the surface steps back to what it was. Errors:
/// those of io::read_deviation_map; Error(input_data) with file:line:column for a cell without a number, or one beside
/// the surface.
OffsetMap read_offset_table(const io::OffsetsInput& table, NaturalSurface& surface);

}  // namespace treadmark::app
