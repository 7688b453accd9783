// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/io/points/byte_blocks.hpp"
#include "treadmark/io/points/fields.hpp"
#include "treadmark/io/scans/read_scan.hpp"

namespace treadmark::io::scans {

using namespace points;

/// The readers behind read_scan, one a format. Errors: Error(input_data) that name the line and column or the byte.
Scan parse_ply(ByteBlocks& bytes, const ScanReadOptions& options);
Scan parse_stl(ByteBlocks& bytes, const ScanReadOptions& options);
Scan parse_obj(ByteBlocks& bytes, const ScanReadOptions& options);
Scan parse_off(ByteBlocks& bytes, const ScanReadOptions& options);
Scan parse_columns(ByteBlocks& bytes, const ScanReadOptions& options);
Scan parse_las(ByteBlocks& bytes, const ScanReadOptions& options);
Scan parse_pcd(ByteBlocks& bytes, const ScanReadOptions& options);
Scan parse_ptx(ByteBlocks& bytes, const ScanReadOptions& options);
/// Error(configuration) in a build without Expat.
Scan parse_e57(ByteBlocks& bytes, const ScanReadOptions& options);

/// A text of nothing but rows of heights, as line scanners write them: a row a profile.
struct HeightRows {
  FieldStyle style;
  std::size_t heights = 0;  ///< of a row
  bool encoder = false;     ///< the place of the row stands before them
};
std::optional<HeightRows> sniff_height_rows(ByteBlocks& bytes);
Scan parse_height_rows(ByteBlocks& bytes, const HeightRows& rows, const HeightRowOptions& how,
                       const ScanReadOptions& options);

/// The readers behind read_deviation_map.
OffsetMap parse_map_matrix(ByteBlocks& bytes, const MapReadOptions& options);
OffsetMap parse_esri_grid(ByteBlocks& bytes, const MapReadOptions& options);

/// Behind is_deviation_map: which of the two the bytes are.
enum class MapKind { none, matrix, esri_grid };
MapKind sniff_map(ByteBlocks& bytes);

}  // namespace treadmark::io::scans
