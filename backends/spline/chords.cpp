// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/chords.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/backends/spline/prismatic_surface.hpp"
#include "treadmark/backends/spline/revolution_surface.hpp"
#include "treadmark/backends/spline/slices/fit_slices.hpp"
#include "treadmark/backends/spline/slices/slice_surface.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

ProfileSpline polyline(const Profile& profile) {
  std::vector<double> s = arc_length(profile);
  const std::size_t n = s.size();
  std::vector<CubicSegment> chords;
  chords.reserve(n - 1);
  for (std::size_t k = 0; k + 1 < n; ++k) {
    const double h = s[k + 1] - s[k];
    chords.push_back({{profile.y[k], (profile.y[k + 1] - profile.y[k]) / h, 0.0, 0.0},
                      {profile.z[k], (profile.z[k + 1] - profile.z[k]) / h, 0.0, 0.0}});
  }
  const std::vector<double> kinks(s.begin() + 1, s.end() - 1);
  return ProfileSpline(std::move(s), std::move(chords), kinks);
}

constexpr NetPair kMissing{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// Leaves out the points of a line along that too few successive stations have; whether anything is left.
bool drop_short_runs(std::vector<std::vector<NetPair>>& rows, std::size_t line) {
  constexpr std::size_t kLeast = 4;
  const auto there = [&](std::size_t i) { return !std::isnan(rows[i][line].w); };
  bool any = false;
  for (std::size_t first = 0; first < rows.size();) {
    if (!there(first)) {
      ++first;
      continue;
    }
    std::size_t end = first;
    while (end < rows.size() && there(end)) ++end;
    const bool enough = end - first >= kLeast;
    any = any || enough;
    for (std::size_t i = first; i < end && !enough; ++i) rows[i][line] = kMissing;
    first = end;
  }
  return any;
}

}  // namespace

std::shared_ptr<const Surface> make_chord_surface(const Profile& profile, double nominal_radius) {
  if (profile.body == Body::rail) return std::make_shared<PrismaticSurface>(polyline(profile));
  return std::make_shared<RevolutionSurface>(polyline(profile), nominal_radius);
}

std::shared_ptr<const Surface> make_chord_surface(const sampling::PointGrid& points, double nominal_radius) {
  const bool wheel = points.body == Body::wheel;
  const std::size_t across = points.y.size();
  SliceSet stations;
  stations.body = points.body;
  stations.name = "chords";
  stations.u = points.u;
  stations.profiles.resize(points.u.size());
  std::vector<std::vector<NetPair>> rows(points.u.size());
  for (std::size_t iu = 0; iu < rows.size(); ++iu) {
    rows[iu].reserve(across);
    for (std::size_t k = 0; k < across; ++k) {
      const std::size_t iy = wheel ? across - 1 - k : k;  // sections of wheels run with decreasing y
      const std::size_t i = points.index(iu, iy);
      const double y = points.own_y.empty() ? points.y[iy] : points.own_y[i];
      rows[iu].push_back(points.present(iu, iy) ? NetPair{y, points.h[i] - (wheel ? nominal_radius : 0.0)} : kMissing);
    }
  }
  bool before = false, any = false;
  for (std::size_t k = 0; k < across; ++k) {
    const bool here = drop_short_runs(rows, k);
    any = any || (here && before);
    before = here;
  }
  if (!any)
    throw Error(ErrorKind::input_data, "there are no chords: four stations with two points side by side are needed", {},
                "sample more densely");
  SliceNet net = join_straight(stations, rows);
  if (wheel) return std::make_shared<SliceWheel>(std::move(net), nominal_radius);
  return std::make_shared<SliceRail>(std::move(net), 0.0);
}

}  // namespace treadmark::spline
