// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::scans::scanner {

/// Heights z or radii r along one station, NaN where there is no surface (the far side of a wheel is none); slopes may
/// be empty.
void heights_along(const Surface& surface, Body body, double u, std::span<const double> y, const HeightsOut& out);

/// Unit normal out of the material in the plane of the station. Slopes may be infinite; unknown ones count as level.
Vec3 normal_in_plane(Body body, double dzdx, double dzdy);

/// The line of a surface at one station, measured by its arc length.
class Station {
 public:
  Station() = default;
  /// Looks at raster (ascending y) and between, until no step along the line is longer than longest; jumps are left
  /// out.
  Station(const Surface& surface, Body body, double u, std::span<const double> raster, double longest);

  double length() const { return arc_.empty() ? 0.0 : arc_.back(); }
  /// Where the line was looked at, ascending; heights may be NaN.
  const std::vector<double>& y() const { return y_; }
  const std::vector<double>& h() const { return h_; }
  /// Arc length from the beginning to each y, the same on both sides of a gap.
  const std::vector<double>& arc() const { return arc_; }
  /// y at an arc length in [0, length()]. piece is where the search starts, 1 at first, for lengths that do not
  /// decrease.
  double y_at(double arc, std::size_t& piece) const;

 private:
  void add(const Surface& surface, Body body, double u, std::vector<double> y);
  void find_ends(const Surface& surface, Body body, double u);
  void refine(const Surface& surface, Body body, double u, double longest);

  std::vector<double> y_, h_, arc_;
};

/// Evenly spaced y from low to high, both included, with the steep places of the given stations looked at more closely.
std::vector<double> raster(const Surface& surface, Body body, std::span<const double> stations, double low, double high,
                           double longest);

}  // namespace treadmark::scans::scanner
