// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>

#include "fuzz_scan.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

TREADMARK_FUZZ_TARGET(fuzz_deviation_map) {
  using namespace treadmark;
  const std::string_view text = fuzz::as_text(data, size);
  for (const std::size_t block : {std::size_t{13}, io::scans::ByteBlocks::kBlock})
    for (const auto parser : {io::scans::parse_map_matrix, io::scans::parse_esri_grid}) {
      try {
        io::scans::ByteBlocks bytes(text, "fuzz", block);
        io::scans::sniff_map(bytes);
        io::MapReadOptions options;
        if (size % 2 == 1) options.body = Body::wheel, options.nominal_radius = 0.46;
        const OffsetMap map = parser(bytes, options);
        const Grid2& g = map.grid;
        bool sound = g.nx >= 2 && g.ny >= 2 && g.dx > 0.0 && g.dy > 0.0 && std::isfinite(g.x(g.nx)) &&
                     std::isfinite(g.y(g.ny)) && map.offset.size() == g.size() && g.size() <= size;
        for (const float v : map.offset) sound = sound && (std::isnan(v) || std::abs(v) < 0.0501f);
        if (!sound) std::abort();
      } catch (const Error&) {
      }
    }
  return 0;
}
