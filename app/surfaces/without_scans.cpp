// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/offset_table.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::app {

OffsetMap read_offset_table(const io::OffsetsInput& table, NaturalSurface&) {
  throw Error(ErrorKind::configuration, left_out_message("scans", "tables of deviations"), table.where,
              left_out_advice("scans"));
}

}  // namespace treadmark::app
