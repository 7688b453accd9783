// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::detection {

/// A wheel as CONTACT's search sees it: exact points of equally spaced cross-sections about the lowest point, joined by
/// bilinear facets. The rail then has for all x the inclination of its section at x = 0 of T.
struct WheelFacets {
  enum class Sections {
    angles,  ///< through the axle
    planes,  ///< of one x in the wheel's frame; a round wheel only
  } kind = Sections::angles;
  double half_range = 0.2;    ///< sections from -half_range to +half_range about the lowest point [rad] or [m]
  int sections = 0;           ///< >= 2
  std::vector<double> lines;  ///< y of corners in the wheel's frame, mesh_lines()
};

/// Least and greatest x in T of the sections' points [m], over the whole width of the wheel.
struct LongitudinalRange {
  double x_min = 0.0, x_max = 0.0;
};
LongitudinalRange facet_range(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets);

/// The facets, made where they are asked for. One per thread.
class FacetWheel {
 public:
  FacetWheel(const Surface& wheel, const Pose& X_TW, const WheelFacets& facets);

  /// A rectangle over which every corner of the facets over r lies, so that bounds of the wheel there are bounds of the
  /// facets over r. Facets steeper than five to one are not followed.
  Rectangle reach(const Rectangle& r) const;

  /// Heights [m] over a grid seen along z of T; NaN where there are no facets.
  void heights(const Grid2& part_T, std::span<double> z);

 private:
  /// Corners first .. first + points.size() - 1 of a section, in T; NaN where the wheel is missing.
  struct Section {
    int first = 0;
    std::vector<Vec3> points;
  };
  const Vec3& corner(int k, int j) {
    const Section& s = sections_[static_cast<std::size_t>(k)];
    const auto i = static_cast<std::size_t>(j - s.first);
    return i < s.points.size() ? s.points[i] : make_corner(k, j);
  }
  const Vec3& make_corner(int k, int j);
  std::vector<Vec3> corners(int k, int first, int last) const;
  double corner_near(double y) const;  ///< index, not whole, of the corner over y of T on an upright wheel
  double height_over(double x, double y, double& a, double& b);

  const Surface& wheel_;
  Pose X_TW_;
  WheelFacets facets_;
  double widest_ = 0.0;  ///< distance of corners
  int across_;
  int wanted_first_ = 0, wanted_last_ = 0;  ///< corners that the grid at hand needs
  std::vector<Section> sections_;
};

/// A place on a mesh of rows x columns corners: facet (k, j) and where in it.
struct FacetPlace {
  int k = 0, j = 0;
  double u = 0.0, v = 0.0;  ///< from corner (k, j) to (k + 1, j) and to (k, j + 1)
};

/// Where on a mesh of bilinear facets (x, y) lies: Newton's method, facet by facet, from indices (a, b) that need not
/// be whole and that are replaced by those found. corner(k, j) gives a corner. Returns false where there are no facets,
/// or none near.
template <class Corner>
bool find_facet(Corner&& corner, int rows, int columns, double x, double y, double& a, double& b, FacetPlace& place) {
  constexpr int kMaxSteps = 40;
  for (int step = 0; step < kMaxSteps; ++step) {
    const int k = std::clamp(to_whole<int>(std::floor(a)), 0, rows - 2);
    const int j = std::clamp(to_whole<int>(std::floor(b)), 0, columns - 2);
    const double u = a - k, v = b - j;
    // Copies: corners may be made, and moved, by asking for others.
    const Vec3 p00 = corner(k, j), p01 = corner(k, j + 1), p10 = corner(k + 1, j), p11 = corner(k + 1, j + 1);
    const Vec3 along = p10 - p00, twist = (p11 - p01) - along, du = along + v * twist, across = p01 - p00,
               dv = across + u * twist;
    const double rx = x - (p00.x() + u * along.x() + v * dv.x()), ry = y - (p00.y() + u * along.y() + v * dv.y());
    const double inverse = 1.0 / (du.x() * dv.y() - du.y() * dv.x());
    const double da = (rx * dv.y() - ry * dv.x()) * inverse, db = (ry * du.x() - rx * du.y()) * inverse;
    if (!std::isfinite(da) || !std::isfinite(db)) return false;
    // The rest of the way is twist * da * db.
    constexpr double kClose = 1e-11;  // [m]
    constexpr double kRim = 1e-7;     // of a facet
    if (std::abs(da * db) * (std::abs(twist.x()) + std::abs(twist.y())) < kClose) {
      const double u_end = u + da, v_end = v + db;
      if (u_end > -kRim && u_end < 1 + kRim && v_end > -kRim && v_end < 1 + kRim) {
        place = {k, j, u_end, v_end};
        a = k + u_end, b = j + v_end;
        return true;
      }
      if (std::abs(da) < kRim && std::abs(db) < kRim) return false;
    }
    a = std::clamp(a + da, -0.5, rows - 0.5);
    b = std::clamp(b + db, -0.5, columns - 0.5);
  }
  return false;
}

}  // namespace treadmark::detection
