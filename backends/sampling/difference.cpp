// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/difference.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/backends/sampling/lateral_nodes.hpp"
#include "treadmark/backends/sampling/sample_points.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::sampling {
namespace {

constexpr std::size_t kReferenceStations = 33;
constexpr std::size_t kCurvatureStride = 7;  // curvatures cost more: every so many points

struct Sums {
  SurfaceDifference d;
  double height = 0.0, slope = 0.0, curvature = 0.0;
  std::size_t curvatures = 0;
};

Vec3 normal(double dzdx, double dzdy) { return Vec3(-dzdx, -dzdy, 1.0).normalized(); }

double mean_curvature(const SurfacePoint& p) { return 0.5 * (p.curvature_1 + p.curvature_2); }

Sums compare_station(const Surface& reference, const Surface& candidate, Body body, double u,
                     const std::vector<double>& y) {
  const std::size_t n = y.size();
  std::vector<double> za(n), xa(n), ya(n), zb(n), xb(n), yb(n);
  section_heights(reference, body, u, y, {za, xa, ya});
  section_heights(candidate, body, u, y, {zb, xb, yb});
  Sums sums;
  std::vector<Vec2> chosen;
  for (std::size_t i = 0; i < n; ++i) {
    if (std::isnan(za[i])) continue;
    if (std::isnan(zb[i])) {
      ++sums.d.missing;
      continue;
    }
    const Vec3 na = normal(xa[i], ya[i]), nb = normal(xb[i], yb[i]);
    const double height = std::fabs(zb[i] - za[i]) * na.z(), slope = std::atan2(na.cross(nb).norm(), na.dot(nb));
    ++sums.d.points;
    if (height > sums.d.height_max) {
      sums.d.height_max = height;
      sums.d.worst_u = u;
      sums.d.worst_y = y[i];
    }
    sums.d.slope_max = std::max(sums.d.slope_max, slope);
    sums.height += height * height;
    sums.slope += slope * slope;
    if (i % kCurvatureStride == 0) chosen.push_back({0.0, y[i]});
  }
  std::vector<SurfacePoint> pa(chosen.size()), pb(chosen.size());
  const Pose plane = natural_plane(body, u);
  reference.locate(plane, chosen, pa);
  candidate.locate(plane, chosen, pb);
  for (std::size_t i = 0; i < chosen.size(); ++i) {
    if (pa[i].status == LocateStatus::outside || pb[i].status == LocateStatus::outside) continue;
    const double c = std::fabs(mean_curvature(pa[i]) - mean_curvature(pb[i]));
    if (!std::isfinite(c)) continue;
    sums.d.curvature_max = std::max(sums.d.curvature_max, c);
    sums.curvature += c * c;
    ++sums.curvatures;
  }
  return sums;
}

std::vector<double> thinned(std::vector<double> u, std::size_t most) {
  // not at the stations of the data, and not at the ends of the region
  std::vector<double> out;
  const std::size_t n = std::min(most, u.size() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t k = i * (u.size() - 1) / n;
    const double share = 0.25 + 0.5 * std::fmod(0.6180339887498949 * static_cast<double>(i), 1.0);
    out.push_back(u[k] + share * (u[k + 1] - u[k]));
  }
  return out;
}

double root_mean(double sum, std::size_t n) { return n == 0 ? 0.0 : std::sqrt(sum / static_cast<double>(n)); }

}  // namespace

SurfaceDifference difference(const Surface& reference, const Surface& candidate, Body body, double nominal_radius,
                             const DifferenceSettings& settings) {
  bool closed = false;
  const std::vector<double> u =
      thinned(stations(reference, body, nominal_radius, settings.region, 2.0 * settings.spacing, closed),
              settings.most_stations);
  const std::vector<double> some = thinned(u, std::min(kReferenceStations, u.size() - 1));
  std::vector<double> y =
      lateral_nodes(reference, body, some, settings.spacing, settings.region.y_min, settings.region.y_max);
  const double low = y.front() + settings.margin, high = y.back() - settings.margin;
  std::erase_if(y, [&](double value) { return value < low || value > high; });

  std::vector<Sums> parts(u.size());
  parallel_for(u.size(), [&](std::size_t i) { parts[i] = compare_station(reference, candidate, body, u[i], y); });
  Sums total;
  for (const Sums& part : parts) {
    total.d.points += part.d.points;
    total.d.missing += part.d.missing;
    if (part.d.height_max > total.d.height_max) {
      total.d.height_max = part.d.height_max;
      total.d.worst_u = part.d.worst_u;
      total.d.worst_y = part.d.worst_y;
    }
    total.d.slope_max = std::max(total.d.slope_max, part.d.slope_max);
    total.d.curvature_max = std::max(total.d.curvature_max, part.d.curvature_max);
    total.height += part.height;
    total.slope += part.slope;
    total.curvature += part.curvature;
    total.curvatures += part.curvatures;
  }
  total.d.height_rms = root_mean(total.height, total.d.points);
  total.d.slope_rms = root_mean(total.slope, total.d.points);
  total.d.curvature_rms = root_mean(total.curvature, total.curvatures);
  return total.d;
}

}  // namespace treadmark::sampling
