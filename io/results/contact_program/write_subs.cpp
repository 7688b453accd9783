// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/contact_program/write_subs.hpp"

#include <array>
#include <string_view>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/output_file.hpp"
#include "treadmark/io/results/contact_program/write_mat.hpp"
#include "treadmark/io/results/subsurface_table.hpp"

namespace treadmark::io {
namespace {

constexpr std::array<std::string_view, 3> kSizeNames{"NX", "NY", "NZ"};
constexpr std::array<std::string_view, 14> kNames{"X",     "Y",     "Z",     "UX",    "UY",    "UZ",    "SIGHYD",
                                                  "SIGVM", "SIGXX", "SIGXY", "SIGXZ", "SIGYY", "SIGYZ", "SIGZZ"};
constexpr std::size_t kWithoutTensor = 8;

std::array<double, kNames.size()> columns(const SubsurfaceValue& v) {
  const Vec3 p = kMilli * v.point, u = kMilli * v.displacement;
  const Mat3 s = kMega * v.stress;
  return {p.x(),   p.y(),   p.z(),   u.x(),   u.y(),   u.z(),  v.hydrostatic * kMega, v.von_mises * kMega,
          s(0, 0), s(0, 1), s(0, 2), s(1, 1), s(1, 2), s(2, 2)};
}

}  // namespace

std::string blocks_to_subs(std::span<const SubsurfaceBlock> blocks, bool full_tensor) {
  check_blocks(blocks, "");
  const std::size_t count = full_tensor ? kNames.size() : kWithoutTensor;
  std::string text;
  for (const SubsurfaceBlock& block : blocks) {
    const std::array<double, 3> size{static_cast<double>(block.nx), static_cast<double>(block.ny),
                                     static_cast<double>(block.nz)};
    text += column_head(kSizeNames) + column_line(size) + column_head(std::span(kNames).first(count));
    for (const SubsurfaceValue& value : block.values) {
      const auto line = columns(value);
      text += column_line(std::span(line).first(count));
    }
  }
  return text;
}

void write_subs(const std::filesystem::path& path, std::span<const SubsurfaceBlock> blocks, bool full_tensor) {
  write_file(path, blocks_to_subs(blocks, full_tensor));
}

}  // namespace treadmark::io
