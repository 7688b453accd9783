// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/wheel_facets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::detection {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

double lowest_angle(const Pose& X_TW) {
  const Vec3 down_W = X_TW.rotation.row(2);
  return std::atan2(down_W.x(), down_W.z());
}

/// Points of the section at a material angle, in T; NaN heights where the wheel is missing.
std::vector<Vec3> section(const Surface& wheel, const Pose& X_TW, double angle, double y_first, double y_step, int count) {
  const Pose X_WP{Vec3::Zero(), rotation_y(angle)};
  const Grid2 line{0.0, y_first, 1.0, y_step, 1, count};
  std::vector<double> radius(line.size());
  wheel.heights({X_WP, line}, {radius, {}, {}});
  const Pose X_TP = X_TW * X_WP;
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.push_back(X_TP.apply({0.0, line.y(i), radius[static_cast<std::size_t>(i)]}));
  return points;
}

/// Structured mesh of sections; indices (k, j) along sections and across.
struct Mesh {
  int sections = 0, across = 0;
  std::vector<Vec3> points;
  const Vec3& at(int k, int j) const { return points[static_cast<std::size_t>(k) * static_cast<std::size_t>(across) + static_cast<std::size_t>(j)]; }
};

// Continuous indices (a, b) of the facet point over (x, y): Newton on the bilinear map, cell by cell.
double height_over(const Mesh& mesh, double x, double y, double& a, double& b) {
  constexpr int kMaxSteps = 40;
  for (int step = 0; step < kMaxSteps; ++step) {
    const int k = std::clamp(static_cast<int>(std::floor(a)), 0, mesh.sections - 2);
    const int j = std::clamp(static_cast<int>(std::floor(b)), 0, mesh.across - 2);
    const double u = a - k, v = b - j;
    const Vec3 &p00 = mesh.at(k, j), &p10 = mesh.at(k + 1, j), &p01 = mesh.at(k, j + 1), &p11 = mesh.at(k + 1, j + 1);
    const Vec3 p = (1 - u) * (1 - v) * p00 + u * (1 - v) * p10 + (1 - u) * v * p01 + u * v * p11;
    const Vec3 du = (1 - v) * (p10 - p00) + v * (p11 - p01), dv = (1 - u) * (p01 - p00) + u * (p11 - p10);
    const double rx = x - p.x(), ry = y - p.y(), determinant = du.x() * dv.y() - du.y() * dv.x();
    const double da = (rx * dv.y() - ry * dv.x()) / determinant, db = (ry * du.x() - rx * du.y()) / determinant;
    if (!std::isfinite(da) || !std::isfinite(db)) return kNaN;
    constexpr double kTolerance = 1e-7;  // of a facet: less than a nanometre
    const bool inside = u > -kTolerance && u < 1 + kTolerance && v > -kTolerance && v < 1 + kTolerance;
    if (std::abs(da) < kTolerance && std::abs(db) < kTolerance) return inside ? p.z() : kNaN;
    a = std::clamp(a + da, -0.5, mesh.sections - 0.5);
    b = std::clamp(b + db, -0.5, mesh.across - 0.5);
  }
  return kNaN;
}

}  // namespace

LongitudinalRange facet_range(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets) {
  constexpr int kPoints = 600;
  const Box3 box = wheel.bounds();
  LongitudinalRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const double side : {-1.0, 1.0})
    for (const Vec3& p : section(wheel, X_TW, lowest_angle(X_TW) + side * facets.half_angle, box.min.y(),
                                 (box.max.y() - box.min.y()) / (kPoints - 1), kPoints)) {
      if (std::isnan(p.x())) continue;
      range.x_min = std::min(range.x_min, p.x());
      range.x_max = std::max(range.x_max, p.x());
    }
  return range;
}

std::vector<double> facet_heights(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets, const Grid2& g) {
  // Points of the sections divide the whole width; those far from the grid are left out.
  constexpr int kMargin = 20;
  const double outer = wheel.bounds().max.y(), width = outer - wheel.bounds().min.y();
  const double step = width / (1.0 + std::floor(width / facets.lateral_step));
  const double grid_low = g.y0 - X_TW.origin.y(), grid_high = g.y(g.ny - 1) - X_TW.origin.y();
  const double first = outer - step * (std::ceil((outer - grid_low) / step) + kMargin);
  Mesh mesh;
  mesh.sections = facets.sections;
  mesh.across = static_cast<int>(std::ceil((grid_high - first) / step)) + kMargin;
  for (int k = 0; k < facets.sections; ++k) {
    const double angle = lowest_angle(X_TW) + facets.half_angle * (2.0 * k / (facets.sections - 1) - 1.0);
    const auto points = section(wheel, X_TW, angle, first, step, mesh.across);
    mesh.points.insert(mesh.points.end(), points.begin(), points.end());
  }
  std::vector<double> heights(g.size());
  for (int iy = 0; iy < g.ny; ++iy) {
    double a = 0.0, b = (g.y(iy) - X_TW.origin.y() - first) / step, step_a = 0.0, step_b = 0.0;
    for (int ix = 0; ix < g.nx; ++ix) {
      double a_try = a + step_a, b_try = b + step_b;
      double z = height_over(mesh, g.x(ix), g.y(iy), a_try, b_try);
      if (std::isnan(z)) {
        // The neighbour led astray: start once more from where a regular mesh would have this point.
        a_try = static_cast<double>(ix) / (g.nx - 1) * (mesh.sections - 1);
        b_try = (g.y(iy) - X_TW.origin.y() - first) / step;
        z = height_over(mesh, g.x(ix), g.y(iy), a_try, b_try);
      }
      heights[g.index(ix, iy)] = z;
      if (std::isnan(z)) continue;
      step_a = ix > 0 ? a_try - a : 0.0, step_b = ix > 0 ? b_try - b : 0.0;
      a = a_try, b = b_try;
    }
  }
  return heights;
}

}  // namespace treadmark::detection
