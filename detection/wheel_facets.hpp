// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::detection {

/// A wheel as the search of the reference program (CONTACT) sees it: exact points of equally spaced cross-sections
/// about the lowest point, joined by bilinear facets. Only for agreement with its results; Treadmark's own search needs
/// no mesh.
struct WheelFacets {
  enum class Sections {
    angles,  ///< through the axle
    planes,  ///< of one x in the wheel's frame; a round wheel only
  } kind = Sections::angles;
  double half_range = 0.2;       ///< sections from -half_range to +half_range about the lowest point [rad] or [m]
  int sections = 0;              ///< >= 2
  double lateral_step = 0.5e-3;  ///< of corners where the wheel itself has none
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
  double lowest_;          ///< angle of the lowest section
  std::vector<double> y_;  ///< of corners, in the wheel's frame
  double widest_ = 0.0;    ///< distance of corners
  int across_;
  int wanted_first_ = 0, wanted_last_ = 0;  ///< corners that the grid at hand needs
  std::vector<Section> sections_;
};

}  // namespace treadmark::detection
