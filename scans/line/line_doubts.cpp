// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/line_doubts.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <string>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kMostLooked = 400'000;

double share_of(std::vector<double>& values, double share) {
  const auto at = values.begin() + to_whole<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

std::optional<measured::Doubt> gaps_of(const FoundLine& found) {
  if (found.gaps.empty()) return std::nullopt;
  constexpr std::size_t kMostTold = 3;
  std::string places;
  for (std::size_t k = 0; k < std::min(kMostTold, found.gaps.size()); ++k)
    places += fmt::format("{}{:.2f} to {:.2f} m", k > 0 ? ", " : "", found.gaps[k].from - found.line.from(),
                          found.gaps[k].to - found.line.from());
  if (found.gaps.size() > kMostTold) places += fmt::format(" and {} more places", found.gaps.size() - kMostTold);
  return measured::Doubt{
      "line_gap",
      fmt::format("nothing of the rail was scanned from {} of its line, which was taken on from both sides: "
                  "what lies behind may be shifted along it; scan these places, or cut the scan there",
                  places)};
}

/// Behind a gap that is too long to be crossed, or where the rail could not be followed. straight: points along the
/// line, those that are kept.
std::optional<measured::Doubt> beyond_ends(std::span<const Vec3> straight, const RailLine& line) {
  constexpr double kShare = 0.02;  // of the points
  std::size_t beyond = 0;
  for (const Vec3& p : straight) beyond += p.x() < line.from() - kLeastGap || p.x() > line.to() + kLeastGap ? 1 : 0;
  if (beyond == 0 || static_cast<double>(beyond) < kShare * static_cast<double>(straight.size())) return std::nullopt;
  return measured::Doubt{
      "line_gap",
      fmt::format("{:.0f} % of the points lie beyond the ends of the {:.2f} m along which the rail could be followed: "
                  "nothing is known of its line there; scan what is missing between, or import the parts alone",
                  100.0 * static_cast<double>(beyond) / static_cast<double>(straight.size()), line.length())};
}

/// straight: as above.
std::optional<measured::Doubt> others_of(std::span<const Vec3> straight, double from) {
  constexpr double kBeside = 0.25, kShare = 0.02;  // [m]; of the points
  std::vector<double> along, across;
  for (const Vec3& p : straight) {
    if (!(std::hypot(p.y(), p.z()) > kBeside)) continue;
    along.push_back(p.x() - from);
    across.push_back(p.y());
  }
  if (along.empty() || static_cast<double>(along.size()) < kShare * static_cast<double>(straight.size()))
    return std::nullopt;
  constexpr double kAlmostNone = 0.01, kAlmostAll = 0.99;
  const double beside = median_of(across);
  return measured::Doubt{
      "several_rails",
      fmt::format("{:.0f} % of the points lie beside this rail, usually {:.2f} m to its {}, from {:.2f} to {:.2f} m of "
                  "its line: they are left out; are there several rails or tracks in the scan? cut out one, or say "
                  "which by placement.line",
                  100.0 * static_cast<double>(along.size()) / static_cast<double>(straight.size()), std::fabs(beside),
                  beside < 0.0 ? "left" : "right", share_of(along, kAlmostNone), share_of(along, kAlmostAll))};
}

/// Of one pass, in the order of its points.
std::optional<measured::Doubt> backward(std::span<const double> along, double from, double length) {
  constexpr std::size_t kBlocks = 1000, kFewest = 50;
  constexpr double kNarrow = 0.2, kBack = 0.5;  // of the length; [m]
  const std::size_t size = std::max(kFewest, along.size() / kBlocks), blocks = along.size() / size;
  constexpr std::size_t kFewestBlocks = 8;
  if (blocks < kFewestBlocks) return std::nullopt;
  std::vector<double> middles, widths;
  for (std::size_t b = 0; b < blocks; ++b) {
    std::vector<double> block(along.begin() + static_cast<std::ptrdiff_t>(b * size),
                              along.begin() + static_cast<std::ptrdiff_t>((b + 1) * size));
    constexpr double kTenth = 0.1;
    widths.push_back(share_of(block, 1.0 - kTenth) - share_of(block, kTenth));
    middles.push_back(median_of(block));
  }
  // points in any order say nothing of runs
  if (median_of(widths) > kNarrow * length) return std::nullopt;
  std::size_t on = 0;
  for (std::size_t b = 1; b < blocks; ++b) on += middles[b] > middles[b - 1] ? 1 : 0;
  const double way = 2 * on >= blocks - 1 ? 1.0 : -1.0;
  double farthest = way * middles.front(), back = 0.0, low = 0.0, high = 0.0;
  for (const double middle : middles) {
    if (const double off = farthest - way * middle; off > std::max(kBack, back)) {
      back = off;
      low = way * middle;
      high = farthest;
    }
    farthest = std::max(farthest, way * middle);
  }
  if (!(back > 0.0)) return std::nullopt;
  const double one = way * low - from, other = way * high - from;
  return measured::Doubt{
      "backward_run",
      fmt::format("after {:.2f} m of the line the points go back to {:.2f} m, so that places between were scanned "
                  "twice: both are taken for one pass, and where they do not lie on each other noise is the larger; "
                  "number the passes, or cut one of them out",
                  other, one)};
}

}  // namespace

std::vector<measured::Doubt> line_doubts(std::span<const Vec3> points, std::span<const std::uint8_t> keep,
                                         std::span<const std::uint16_t> passes, const FoundLine& found) {
  std::vector<measured::Doubt> out;
  if (auto doubt = gaps_of(found)) out.push_back(*std::move(doubt));
  std::vector<Vec3> straight;
  std::vector<std::uint16_t> pass_of;
  const std::size_t stride = 1 + points.size() / kMostLooked;
  for (std::size_t i = 0; i < points.size(); i += stride) {
    if (!keep.empty() && keep[i] == 0) continue;
    straight.push_back(points[i]);
    pass_of.push_back(passes.empty() ? std::uint16_t{0} : passes[i]);
  }
  found.line.straighten(straight);
  if (auto doubt = beyond_ends(straight, found.line)) out.push_back(*std::move(doubt));
  if (auto doubt = others_of(straight, found.line.from())) out.push_back(*std::move(doubt));
  std::map<std::uint16_t, std::vector<double>> along;
  for (std::size_t i = 0; i < straight.size(); ++i)
    if (std::hypot(straight[i].y(), straight[i].z()) < kLeastGap) along[pass_of[i]].push_back(straight[i].x());
  for (const auto& [pass, places] : along)
    if (auto doubt = backward(places, found.line.from(), found.line.length())) {
      out.push_back(*std::move(doubt));
      break;
    }
  return out;
}

}  // namespace treadmark::scans
