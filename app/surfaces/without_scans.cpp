// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/offset_table.hpp"
#include "treadmark/app/surfaces/surface_check.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::app {

OffsetMap read_offset_table(const io::OffsetsInput& table, NaturalSurface&) {
  throw Error(ErrorKind::configuration, left_out_message("scans", "tables of deviations"), table.where,
              left_out_advice("scans"));
}

bool is_cloud_file(const std::filesystem::path&) { return false; }

CheckedProfile check_cloud(const std::filesystem::path& file) {
  throw Error(ErrorKind::configuration, left_out_message("scans", "points of scanners"), {file.string()},
              left_out_advice("scans"));
}

}  // namespace treadmark::app
