// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/chords.hpp"

#include <cmath>
#include <utility>

#include "treadmark/backends/spline/fit_profile.hpp"
#include "treadmark/backends/spline/prismatic_surface.hpp"
#include "treadmark/backends/spline/revolution_surface.hpp"
#include "treadmark/backends/spline/slices/fit_slices.hpp"
#include "treadmark/backends/spline/slices/slice_surface.hpp"
#include "treadmark/core/cancellation.hpp"
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

/// A strip: both of its edges at each station, in places so close that the cubic through them is a straight line.
SampledSlices strip(const sampling::PointGrid& points, std::size_t from, std::size_t to, double zero) {
  constexpr int kPlaces = 4;
  SampledSlices all{kPlaces, {}};
  all.slices.resize(points.u.size());
  const auto at = [&](std::size_t iu, std::size_t iy) {
    const std::size_t i = points.index(iu, iy);
    return NetPair{points.own_y.empty() ? points.y[iy] : points.own_y[i], points.h[i] - zero};
  };
  for (std::size_t iu = 0; iu < points.u.size(); ++iu) {
    if (!points.present(iu, from) || !points.present(iu, to)) continue;
    auto& places = all.slices[iu].points;
    places.reserve(kPlaces);
    const NetPair a = at(iu, from), b = at(iu, to);
    for (int k = 0; k < kPlaces; ++k) places.push_back(a + (k / (kPlaces - 1.0)) * (b - a));
  }
  return all;
}

/// Leaves out what too few successive stations have; whether anything is left.
bool drop_short_runs(SampledSlices& all) {
  constexpr std::size_t kLeast = 4;
  bool any = false;
  for (std::size_t first = 0; first < all.slices.size();) {
    if (all.slices[first].points.empty()) {
      ++first;
      continue;
    }
    std::size_t end = first;
    while (end < all.slices.size() && !all.slices[end].points.empty()) ++end;
    const bool enough = end - first >= kLeast;
    any = any || enough;
    for (std::size_t i = first; i < end && !enough; ++i) all.slices[i].points.clear();
    first = end;
  }
  return any;
}

}  // namespace

std::shared_ptr<const Surface> make_chord_surface(const Profile& profile, double nominal_radius) {
  if (profile.body == Body::rail) return std::make_shared<PrismaticSurface>(polyline(profile));
  return std::make_shared<RevolutionSurface>(polyline(profile), nominal_radius);
}

std::vector<std::shared_ptr<const Surface>> make_chord_strips(const sampling::PointGrid& points,
                                                              double nominal_radius) {
  const bool wheel = points.body == Body::wheel;
  SliceSet stations;
  stations.body = points.body;
  stations.name = "chords";
  stations.u = points.u;
  stations.profiles.resize(points.u.size());
  std::vector<std::shared_ptr<const Surface>> strips;
  strips.reserve(points.y.size());
  for (std::size_t k = 0; k + 1 < points.y.size(); ++k, check_cancelled()) {
    // sections of wheels run with decreasing y
    SampledSlices sampled = wheel ? strip(points, k + 1, k, nominal_radius) : strip(points, k, k + 1, 0.0);
    if (!drop_short_runs(sampled)) continue;
    SliceNet net = fit_slices(stations, sampled);
    if (wheel)
      strips.push_back(std::make_shared<SliceWheel>(std::move(net), nominal_radius));
    else
      strips.push_back(std::make_shared<SliceRail>(std::move(net), 0.0));
  }
  if (strips.empty())
    throw Error(ErrorKind::input_data, "there are no chords: four stations with two points side by side are needed", {},
                "sample more densely");
  return strips;
}

}  // namespace treadmark::spline
