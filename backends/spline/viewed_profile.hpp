// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <span>
#include <vector>

#include "treadmark/backends/spline/grid_lines.hpp"
#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/point_batches.hpp"
#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/backends/spline/section_raster.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {

inline Vec2 lateral(const Vec3& v) { return {v.y(), v.z()}; }

/// The view of the profile along the plane normal: w across the line of sight, depth along it.
struct ProfileView {
  Vec2 depth, width;  // unit vectors in (y, z)
  double normal_part;

  explicit ProfileView(const Vec3& normal) : depth(lateral(normal)), width(0.0, 0.0), normal_part(depth.norm()) {
    if (!visible()) return;
    depth /= normal_part;
    width = {depth.y(), -depth.x()};
  }
  static constexpr double kLeastNormalPart = 1e-9;  ///< of the plane normal in the (y, z) plane
  bool visible() const { return normal_part > kLeastNormalPart; }
};

/// Segments of the profile turned into a view; s = w, n = depth. Cells are numbered as the segments are given.
class ViewedProfile {
 public:
  static constexpr double kStep = 1e-8, kStepU = 1e-8, kFine = 1e-15;

  ViewedProfile(const ProfileSpline& profile, const ProfileView& view, std::span<const int> segments) {
    cells_.reserve(segments.size());
    for (const int segment : segments) {
      const auto k = static_cast<std::size_t>(segment);
      const CubicSegment& c = profile.segments()[k];
      Cell& cell = cells_.emplace_back();
      for (std::size_t i = 0; i < 4; ++i) {
        cell.turned.y[i] = view.width.x() * c.y[i] + view.width.y() * c.z[i];
        cell.turned.z[i] = view.depth.x() * c.y[i] + view.depth.y() * c.z[i];
      }
      cell.va = profile.breaks()[k];
      cell.vb = profile.breaks()[k + 1];
      const int index = static_cast<int>(cells_.size()) - 1;
      cell.a = point(index, cell.va, 0.0);
      cell.b = point(index, cell.vb, 0.0);
    }
  }

  SectionPoint point(int cell, double v, double) const {
    const Cell& at = cells_[static_cast<std::size_t>(cell)];
    const CubicSegment& c = at.turned;
    const double t = v - at.va;
    return {c.y[0] + t * (c.y[1] + t * (c.y[2] + t * c.y[3])), c.z[0] + t * (c.z[1] + t * (c.z[2] + t * c.z[3])),
            c.y[1] + t * (2.0 * c.y[2] + 3.0 * t * c.y[3]), c.z[1] + t * (2.0 * c.z[2] + 3.0 * t * c.z[3])};
  }

  // By construction.
  static bool near_cubic(int, const SectionPoint&, const SectionPoint&) { return true; }

  void raster(const Samples& samples, ColumnHits& hits) const {
    SectionRaster<ViewedProfile, ColumnHits> raster(*this, samples, hits, hits.queue);
    for (int k = 0; k < static_cast<int>(cells_.size()); ++k) add(k, raster);
    raster.finish();
  }
  void add(int cell, SectionRaster<ViewedProfile, ColumnHits>& raster) const {
    const Cell& c = cells_[static_cast<std::size_t>(cell)];
    raster.cell(cell, c.va, c.a, c.vb, c.b);
  }

  /// The least and greatest s of a cell; conservative.
  Interval reach(int cell) const {
    constexpr double kSlack = 1e-9;  // [m]
    const Cell& c = cells_[static_cast<std::size_t>(cell)];
    // A cubic stays within this of its ends.
    const double slack = kSlack + (c.vb - c.va) * std::max(std::abs(c.a.ds), std::abs(c.b.ds));
    return {std::min(c.a.s, c.b.s) - slack, std::max(c.a.s, c.b.s) + slack};
  }

 private:
  struct Cell {
    CubicSegment turned;
    double va, vb;
    SectionPoint a, b;
  };
  std::vector<Cell> cells_;
};

/// The whole profile in a view, for points in any order: the cells that may lie over each of equal parts of the width
/// are listed once.
class SortedProfile {
 public:
  SortedProfile(const ProfileSpline& profile, const ProfileView& view) : viewed_(profile, view, all_segments(profile)) {
    const std::size_t cells = profile.segments().size();
    std::vector<Interval> reach(cells);
    Interval all = Interval::none();
    for (std::size_t k = 0; k < cells; ++k) {
      reach[k] = viewed_.reach(static_cast<int>(k));
      all.include(reach[k]);
    }
    parts_ = std::max<std::size_t>(1, 2 * cells);
    first_ = all.low;
    inverse_width_ = static_cast<double>(parts_) / all.width();
    std::vector<std::size_t> count(parts_ + 1, 0);
    const auto each_part = [&](std::size_t k, const auto& use) {
      const std::size_t last = part(reach[k].high);
      for (std::size_t i = part(reach[k].low); i <= last; ++i) use(i);
    };
    for (std::size_t k = 0; k < cells; ++k) each_part(k, [&](std::size_t i) { ++count[i + 1]; });
    for (std::size_t i = 0; i < parts_; ++i) count[i + 1] += count[i];
    begin_ = count;
    cells_.resize(count[parts_]);
    for (std::size_t k = 0; k < cells; ++k)
      each_part(k, [&](std::size_t i) { cells_[count[i]++] = static_cast<int>(k); });
  }

  SectionPoint point(int cell, double v) const { return viewed_.point(cell, v, 0.0); }

  void hit(double s, ColumnHits& hits) const {
    hits.clear();
    if (!((s - first_) * inverse_width_ > -1.0 && (s - first_) * inverse_width_ < static_cast<double>(parts_) + 1.0))
      return;
    const Samples samples = one_sample(s);
    SectionRaster<ViewedProfile, ColumnHits> raster(viewed_, samples, hits, hits.queue);
    const std::size_t i = part(s);
    for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) viewed_.add(cells_[k], raster);
    raster.finish();
  }

 private:
  static std::vector<int> all_segments(const ProfileSpline& profile) {
    std::vector<int> all(profile.segments().size());
    for (std::size_t k = 0; k < all.size(); ++k) all[k] = static_cast<int>(k);
    return all;
  }
  std::size_t part(double s) const {
    return to_whole<std::size_t>((s - first_) * inverse_width_, 0.0, static_cast<double>(parts_) - 1.0);
  }

  ViewedProfile viewed_;
  std::size_t parts_ = 1;
  double first_ = 0.0, inverse_width_ = 0.0;
  std::vector<std::size_t> begin_;  // of each part in cells_
  std::vector<int> cells_;
};

}  // namespace treadmark::spline
