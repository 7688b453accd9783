// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/voxels.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

constexpr double kHalf = 1 << 20;
constexpr std::uint64_t kNone = ~std::uint64_t{0};

using Entry = std::pair<std::uint64_t, std::uint32_t>;  // number of a cube, index of a point

constexpr std::size_t kSorted = 1 << 15;  // points of a task

/// Sorts pairs below a bound by key, then index: least significant digits first, 11 bits at a time (Knuth 1998, 5.2.5),
/// in blocks that know where the values of those before them go.
void sort_by_key(std::vector<Entry>& entries, std::uint64_t bound) {
  constexpr int kBits = 11;
  constexpr std::size_t kDigits = std::size_t{1} << kBits;
  const std::size_t blocks = (entries.size() + kSorted - 1) / kSorted;
  std::vector<Entry> other(entries.size());
  std::vector<std::array<std::uint32_t, kDigits>> start(blocks);
  for (int shift = 0; shift < 64 && bound >> shift > 0; shift += kBits) {
    const auto digit = [&](const Entry& entry) { return (entry.first >> shift) & (kDigits - 1); };
    parallel_blocks(entries.size(), kSorted, [&](std::size_t from, std::size_t to) {
      auto& count = start[from / kSorted];
      count.fill(0);
      for (std::size_t i = from; i < to; ++i) ++count[digit(entries[i])];
    });
    std::uint32_t sum = 0;
    for (std::size_t value = 0; value < kDigits; ++value)
      for (auto& place : start) sum += std::exchange(place[value], sum);
    parallel_blocks(entries.size(), kSorted, [&](std::size_t from, std::size_t to) {
      auto& place = start[from / kSorted];
      for (std::size_t i = from; i < to; ++i) other[place[digit(entries[i])]++] = entries[i];
    });
    entries.swap(other);
  }
}

/// Bounds of cells along the three axes.
struct Cells {
  std::array<std::uint64_t, 3> least, most;

  Cells() {
    least.fill(std::uint64_t{1} << 21);
    most.fill(0);
  }
  void widen(const std::array<std::uint64_t, 3>& cell) {
    for (std::size_t k = 0; k < 3; ++k) least[k] = std::min(least[k], cell[k]), most[k] = std::max(most[k], cell[k]);
  }
};

std::array<std::uint64_t, 3> split(std::uint64_t key) {
  constexpr std::uint64_t kAxis = (std::uint64_t{1} << 21) - 1;
  return {key & kAxis, (key >> 21) & kAxis, key >> 42};
}

}  // namespace

Voxels::Voxels(std::span<const Vec3> points, const Vec3& origin, double size, std::span<const std::uint8_t> keep)
    : size_(size) {
  std::vector<Entry> entries(points.size());
  std::vector<Cells> of_block((points.size() + kSorted - 1) / kSorted);
  parallel_blocks(points.size(), kSorted, [&](std::size_t from, std::size_t to) {
    Cells seen;
    for (std::size_t i = from; i < to; ++i) {
      std::uint64_t key = 0;
      for (int axis = 2; axis >= 0 && key != kNone; --axis) {
        const double cell = std::floor((points[i][axis] - origin[axis]) / size) + kHalf;
        key = cell >= 1.0 && cell < 2.0 * kHalf - 1.0 ? key << 21 | to_whole<std::uint64_t>(cell) : kNone;
      }
      if (!keep.empty() && keep[i] == 0) key = kNone;
      entries[i] = {key, static_cast<std::uint32_t>(i)};
      if (key != kNone) seen.widen(split(key));
    }
    of_block[from / kSorted] = seen;
  });
  std::erase_if(entries, [](const Entry& entry) { return entry.first == kNone; });
  Cells all;
  for (const Cells& one : of_block)
    if (one.most[0] > 0) all.widen(one.least), all.widen(one.most);
  // cells counted from the first one along each axis: small numbers are soon sorted, and in the same order
  std::array<std::uint64_t, 3> width{1, 1, 1};
  if (!entries.empty())
    for (std::size_t k = 0; k < 3; ++k) width[k] = all.most[k] - all.least[k] + 1;
  parallel_blocks(entries.size(), kSorted, [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i) {
      const auto [x, y, z] = split(entries[i].first);
      entries[i].first = ((z - all.least[2]) * width[1] + (y - all.least[1])) * width[0] + (x - all.least[0]);
    }
  });
  sort_by_key(entries, width[0] * width[1] * width[2] - 1);
  order_.reserve(entries.size());
  std::uint64_t last = kNone;
  for (const auto& [number, index] : entries) {
    if (number != last) {
      last = number;
      const std::uint64_t row = number / width[0];
      keys_.push_back((row / width[1] + all.least[2]) << 42 | (row % width[1] + all.least[1]) << 21 |
                      (number % width[0] + all.least[0]));
      begin_.push_back(static_cast<std::uint32_t>(order_.size()));
    }
    order_.push_back(index);
  }
  begin_.push_back(static_cast<std::uint32_t>(order_.size()));
}

std::size_t Voxels::first_not_below(std::uint64_t key) const {
  return static_cast<std::size_t>(std::lower_bound(keys_.begin(), keys_.end(), key) - keys_.begin());
}

}  // namespace treadmark::scans
