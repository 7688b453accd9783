// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/track_rails.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {

TrackRails separate_rails(std::span<const Vec3> points, const RailLine& line) {
  constexpr double kFrom = 0.5, kTo = 1.9, kCell = 10e-3;  // across [m]
  constexpr double kHigh = 0.145;   // heads are, seen from the other one [m]: it may lean by 1:20
  constexpr double kBeside = 0.25;  // points of a rail, from the middle of its head [m]
  constexpr std::size_t kHead = 8;  // cells
  std::vector<Vec3> straight(points.begin(), points.end());
  line.straighten(straight);
  const auto cells = to_whole<std::size_t>(2.0 * kTo / kCell);
  std::vector<std::size_t> count(cells, 0);
  const auto is_along = [&](const Vec3& p) {
    return p.x() > line.from() && p.x() < line.to() && std::fabs(p.z()) < kHigh;
  };
  std::size_t own = 0;
  for (const Vec3& p : straight) {
    if (!is_along(p)) continue;
    const double beside = std::fabs(p.y());
    own += beside < 0.5 * kBeside ? 1 : 0;
    if (beside > kFrom && beside < kTo) ++count[std::min(cells - 1, to_whole<std::size_t>((p.y() + kTo) / kCell))];
  }
  std::size_t best = 0, most = 0;
  for (std::size_t k = 0; k + kHead <= cells; ++k) {
    std::size_t sum = 0;
    for (std::size_t i = k; i < k + kHead; ++i) sum += count[i];
    if (sum > most) most = sum, best = k;
  }
  constexpr std::size_t kLeastPart = 10;  // of the points that the first rail has
  if (most == 0 || kLeastPart * most < own)
    throw Error(ErrorKind::input_data,
                "beside the rail that was found, 0.5 to 1.9 m to its left or right, lies no other", {},
                "are both rails of a track in the scan? if it is one rail, say scan.rails=one");
  const double from = kCell * static_cast<double>(best) - kTo, to = from + kCell * static_cast<double>(kHead);
  std::vector<double> across, up;
  for (const Vec3& p : straight)
    if (is_along(p) && p.y() > from && p.y() < to) across.push_back(p.y()), up.push_back(p.z());
  const double y = median_of(across), z = median_of(up);
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
