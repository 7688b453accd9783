// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/track_rails.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {

namespace {

constexpr double kGridCell = 10e-3, kGridWide = 2.1, kGridHigh = 0.45;  // of points across; to both sides, up, down [m]
constexpr std::size_t kHeadWide = 8, kHeadDeep = 5;                     // cells that a head has

/// Points by where they lie across a line, along all of it.
class AcrossGrid {
 public:
  AcrossGrid(std::span<const Vec3> straight, double from, double to) : sums_((wide() + 1) * (high() + 1), 0) {
    for (const Vec3& p : straight)
      if (p.x() > from && p.x() < to && std::fabs(p.y()) < kGridWide && std::fabs(p.z()) < kGridHigh)
        ++sums_[at(cell(p.y(), kGridWide, wide()) + 1, cell(p.z(), kGridHigh, high()) + 1)];
    for (std::size_t y = 1; y <= wide(); ++y)
      for (std::size_t z = 1; z <= high(); ++z)
        sums_[at(y, z)] += sums_[at(y - 1, z)] + sums_[at(y, z - 1)] - sums_[at(y - 1, z - 1)];
  }
  static std::size_t wide() { return to_whole<std::size_t>(std::round(2.0 * kGridWide / kGridCell)); }
  static std::size_t high() { return to_whole<std::size_t>(std::round(2.0 * kGridHigh / kGridCell)); }

  /// Points in cells [y, y + kHeadWide) and [z, z + kHeadDeep).
  double head(std::size_t y, std::size_t z) const { return count(y, y + kHeadWide, z, z + kHeadDeep); }
  /// To how many sides such a head stands free: as far as it is wide no sleeper or street lies beside it, about as
  /// high.
  std::size_t open_sides(std::size_t y, std::size_t z) const {
    constexpr std::size_t kGroove = 4, kAbout = 3;
    constexpr double kFree = 0.25;
    const std::size_t left = y > kGroove ? y - kGroove : 0, right = std::min(wide(), y + kHeadWide + kGroove);
    const std::size_t from = z > kAbout ? z - kAbout : 0, to = std::min(high(), z + kHeadDeep + kAbout);
    const double most = kFree * head(y, z), on_left = count(left > kHeadWide ? left - kHeadWide : 0, left, from, to),
                 on_right = count(right, std::min(wide(), right + kHeadWide), from, to);
    return (on_left <= most ? 1u : 0u) + (on_right <= most ? 1u : 0u);
  }

 private:
  static std::size_t cell(double x, double half, std::size_t count) {
    return std::min(count - 1, to_whole<std::size_t>((x + half) / kGridCell));
  }
  static std::size_t at(std::size_t y, std::size_t z) { return y * (high() + 1) + z; }
  double count(std::size_t left, std::size_t right, std::size_t above, std::size_t below) const {
    return static_cast<double>(sums_[at(right, below)] + sums_[at(left, above)] - sums_[at(left, below)] -
                               sums_[at(right, above)]);
  }
  std::vector<std::size_t> sums_;  ///< of all cells before
};

}  // namespace

TrackRails separate_rails(std::span<const Vec3> points, const RailLine& line) {
  constexpr double kFrom = 0.5, kTo = 1.9;  // of the other rail, across [m]
  constexpr double kOwn = 0.06;             // of this one [m]
  constexpr double kBeside = 0.25;          // points of a rail, from the middle of its head [m]
  std::vector<Vec3> straight(points.begin(), points.end());
  line.straighten(straight);
  const AcrossGrid grid(straight, line.from(), line.to());
  // in streets heads stand free to no side
  constexpr double kWorth[] = {0.1, 0.5, 1.0};  // by sides
  double own = 0.0, count = 0.0, most = 0.0;
  std::size_t best_y = 0, best_z = 0;
  for (std::size_t y = 0; y + kHeadWide <= AcrossGrid::wide(); ++y) {
    const double beside = std::fabs(kGridCell * static_cast<double>(y + kHeadWide / 2) - kGridWide);
    if (beside > kOwn && (beside < kFrom || beside > kTo)) continue;
    for (std::size_t z = 0; z + kHeadDeep <= AcrossGrid::high(); ++z) {
      const double here = grid.head(y, z);
      if (beside <= kOwn) {
        own = std::max(own, here);
      } else if (here > most) {
        const double worth = here * kWorth[grid.open_sides(y, z)];
        if (worth > most) most = worth, count = here, best_y = y, best_z = z;
      }
    }
  }
  constexpr double kLeastPart = 0.1;  // of the points that the first rail has
  if (!(count > 0.0) || count < kLeastPart * own)
    throw Error(ErrorKind::input_data,
                "beside the rail that was found, 0.5 to 1.9 m to its left or right, lies no other", {},
                "are both rails of a track in the scan, and is up right (placement.up)? if it is one rail, say "
                "scan.rails=one");
  constexpr double kRounding = 1e-9;
  const double y_min = kGridCell * static_cast<double>(best_y) - kGridWide - kRounding,
               z_min = kGridCell * static_cast<double>(best_z) - kGridHigh - kRounding;
  const double y_max = y_min + kGridCell * static_cast<double>(kHeadWide) + 2.0 * kRounding,
               z_max = z_min + kGridCell * static_cast<double>(kHeadDeep) + 2.0 * kRounding;
  std::vector<double> across, down;
  for (const Vec3& p : straight)
    if (p.x() > line.from() && p.x() < line.to() && p.y() >= y_min && p.y() <= y_max && p.z() >= z_min &&
        p.z() <= z_max)
      across.push_back(p.y()), down.push_back(p.z());
  const double y = median_of(across), z = median_of(down);
  TrackRails out;
  out.forward = (line.position(line.to()) - line.position(line.from())).normalized();
  out.other = y > 0.0 ? TrackRail::right : TrackRail::left;
  out.of_point.assign(points.size(), TrackRail::none);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec3& p = straight[i];
    if (std::hypot(p.y(), p.z()) < kBeside)
      out.of_point[i] = y > 0.0 ? TrackRail::left : TrackRail::right;
    else if (std::hypot(p.y() - y, p.z() - z) < kBeside)
      out.of_point[i] = out.other;
  }
  return out;
}

}  // namespace treadmark::scans
