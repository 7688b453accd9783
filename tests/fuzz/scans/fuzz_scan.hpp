// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/io/scans/parse_scan.hpp"

namespace treadmark::fuzz {

/// What the users of a scan rely on: finite points, as many normals and passes or none, no more points than the bytes
/// can stand for.
inline void require_sound(const io::Scan& scan, std::size_t size, std::size_t points_per_byte) {
  const PointCloud& cloud = scan.cloud;
  const std::size_t n = cloud.points.size();
  bool sound = n > 0 && n <= points_per_byte * size && (cloud.normals.empty() || cloud.normals.size() == n) &&
               (cloud.passes.empty() || cloud.passes.size() == n) &&
               scan.points_in_file == n + scan.not_finite + scan.withheld;
  for (const Vec3& p : cloud.points) sound = sound && p.allFinite();
  if (!sound) std::abort();
}

/// Feeds the bytes to one reader, whole and in small blocks, which must give the same. An Error is a fair answer.
template <class Parser>
void parse_scan(const std::uint8_t* data, std::size_t size, Parser parser, std::size_t points_per_byte = 1) {
  const std::string_view text(reinterpret_cast<const char*>(data), size);
  const auto parse = [&](std::size_t block, std::string& what) -> std::optional<io::Scan> {
    try {
      io::scans::ByteBlocks bytes(text, "fuzz", block);
      io::Scan scan = parser(bytes, {});
      require_sound(scan, size, points_per_byte);
      return scan;
    } catch (const Error& error) {
      what = error.what();
      return std::nullopt;
    }
  };
  std::string whole_error, small_error;
  const auto whole = parse(io::scans::ByteBlocks::kBlock, whole_error), small = parse(13, small_error);
  if (whole_error != small_error || whole.has_value() != small.has_value() ||
      (whole && (whole->cloud.points != small->cloud.points || whole->cloud.passes != small->cloud.passes ||
                 whole->format != small->format || whole->unit != small->unit)))
    std::abort();
}

}  // namespace treadmark::fuzz
