// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <vector>

#include "treadmark/backends/spline/column_hits.hpp"
#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/point_batches.hpp"
#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/backends/spline/section_raster.hpp"

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

/// The profile turned into a view; s = w, n = depth.
class ViewedProfile {
 public:
  static constexpr double kStep = 1e-8, kStepU = 1e-8, kFine = 1e-15;

  ViewedProfile(const ProfileSpline& profile, const ProfileView& view) : breaks_(profile.breaks()) {
    cells_.reserve(profile.segments().size());
    for (const CubicSegment& c : profile.segments()) {
      CubicSegment& turned = cells_.emplace_back();
      for (int k = 0; k < 4; ++k) {
        turned.y[k] = view.width.x() * c.y[k] + view.width.y() * c.z[k];
        turned.z[k] = view.depth.x() * c.y[k] + view.depth.y() * c.z[k];
      }
    }
  }

  SectionPoint point(int cell, double v, double) const {
    const CubicSegment& c = cells_[static_cast<std::size_t>(cell)];
    const double t = v - breaks_[static_cast<std::size_t>(cell)];
    return {c.y[0] + t * (c.y[1] + t * (c.y[2] + t * c.y[3])), c.z[0] + t * (c.z[1] + t * (c.z[2] + t * c.z[3])),
            c.y[1] + t * (2.0 * c.y[2] + 3.0 * t * c.y[3]), c.z[1] + t * (2.0 * c.z[2] + 3.0 * t * c.z[3])};
  }

  // By construction.
  static bool near_cubic(int, const SectionPoint&, const SectionPoint&) { return true; }

  void raster(const Samples& samples, ColumnHits& hits) const {
    SectionRaster<ViewedProfile, ColumnHits> raster(*this, samples, hits, hits.queue);
    for (int k = 0; k < static_cast<int>(cells_.size()); ++k) {
      const double a = breaks_[static_cast<std::size_t>(k)], b = breaks_[static_cast<std::size_t>(k) + 1];
      raster.cell(k, a, point(k, a, 0.0), b, point(k, b, 0.0));
    }
    raster.finish();
  }

 private:
  std::span<const double> breaks_;
  std::vector<CubicSegment> cells_;
};

/// The same for points in any order: the cells that may lie over each of equal parts of the width are listed once.
class SortedProfile {
 public:
  explicit SortedProfile(const ProfileSpline& profile, const ProfileView& view) : viewed_(profile, view) {
    const auto breaks = profile.breaks();
    const std::size_t cells = breaks.size() - 1;
    std::vector<Interval> reach(cells);
    Interval all = Interval::none();
    for (std::size_t k = 0; k < cells; ++k) {
      const SectionPoint a = viewed_.point(static_cast<int>(k), breaks[k], 0.0), b = viewed_.point(static_cast<int>(k), breaks[k + 1], 0.0);
      ends_.push_back({breaks[k], breaks[k + 1], a, b});
      // A cubic stays within this of its ends.
      const double slack = kSlack + (breaks[k + 1] - breaks[k]) * std::max(std::abs(a.ds), std::abs(b.ds));
      reach[k] = {std::min(a.s, b.s) - slack, std::max(a.s, b.s) + slack};
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
    for (std::size_t k = 0; k < cells; ++k) each_part(k, [&](std::size_t i) { cells_[count[i]++] = static_cast<int>(k); });
  }

  SectionPoint point(int cell, double v) const { return viewed_.point(cell, v, 0.0); }

  void hit(double s, ColumnHits& hits) const {
    hits.clear();
    if (!((s - first_) * inverse_width_ > -1.0 && (s - first_) * inverse_width_ < static_cast<double>(parts_) + 1.0)) return;
    const Samples samples = one_sample(s);
    SectionRaster<ViewedProfile, ColumnHits> raster(viewed_, samples, hits, hits.queue);
    const std::size_t i = part(s);
    for (std::size_t k = begin_[i]; k < begin_[i + 1]; ++k) {
      const Ends& e = ends_[static_cast<std::size_t>(cells_[k])];
      raster.cell(cells_[k], e.va, e.a, e.vb, e.b);
    }
    raster.finish();
  }

 private:
  static constexpr double kSlack = 1e-9;  // [m]
  struct Ends {
    double va, vb;
    SectionPoint a, b;
  };
  std::size_t part(double s) const {
    return static_cast<std::size_t>(std::clamp((s - first_) * inverse_width_, 0.0, static_cast<double>(parts_) - 1.0));
  }

  ViewedProfile viewed_;
  std::vector<Ends> ends_;
  std::size_t parts_ = 1;
  double first_ = 0.0, inverse_width_ = 0.0;
  std::vector<std::size_t> begin_;  // of each part in cells_
  std::vector<int> cells_;
};

}  // namespace treadmark::spline
