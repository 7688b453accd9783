// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/points/byte_blocks.hpp"
#include "treadmark/io/scans/column_layout.hpp"

namespace treadmark::io::scans {

/// The first lines of a matrix, without comments and empty lines.
struct MapHead {
  std::vector<std::string> lines;
  FieldStyle style;
  bool corner_missing = false;  ///< separated by blanks, the first row has one field less than the others
};

/// Leaves the bytes where they are.
MapHead find_map_head(ByteBlocks& bytes);

}  // namespace treadmark::io::scans
