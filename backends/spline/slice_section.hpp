// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/backends/spline/grid_lines.hpp"
#include "treadmark/backends/spline/slice_geometry.hpp"
#include "treadmark/backends/spline/slice_net.hpp"

namespace treadmark::spline {

/// A slice surface cut at one value c of the across coordinate, for SectionRaster. The cut has u = u(v): every evaluation
/// corrects u by one Newton step. Lines are visited one after the other; the cut of the last one starts the next.
template <class Geometry>
class SliceSection {
 public:
  static constexpr double kStep = 4e-5;   // of a cell of 0.5 mm
  static constexpr double kFine = 1e-12;
  static constexpr double kStepU = Geometry::kStepU;

  SliceSection(const SliceNet& net, const Geometry& geometry, const Vec3& across, const Vec3& along, const Vec3& normal,
               const Vec3& origin)
      : net_(net), geometry_(geometry), across_direction_(across), normal_direction_(normal), origin_(origin),
        across_(across, origin), along_(along, origin), normal_(normal, origin),
        breaks_(static_cast<std::size_t>(net.positions())), u_by_c_(breaks_.size()) {}

  /// Cuts all lines v = 1, 2, ...; afterwards break_at(k) is v = k + 1.
  void cut(double c) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    const double shift = c - c_;
    c_ = c;
    const double guess = geometry_.guess_u(across_direction_, normal_direction_, origin_, c);
    set_reference(guess);
    double before = guess, slope = 0.0;
    for (std::size_t k = 0; k < breaks_.size(); ++k) {
      SectionPoint& p = breaks_[k];
      // From the last cut, else from the neighbour.
      double u = cut_before_ && !std::isnan(p.s) ? p.u + shift * u_by_c_[k] : before + slope;
      int left = kMaxCutSteps;
      do {
        p = at_break(static_cast<int>(k), u, u_by_c_[k]);
        p.u_step = std::clamp(p.u_step, -Geometry::kLargestStepU, Geometry::kLargestStepU);
        u += p.u_step;
      } while (std::abs(p.u_step) > kStepU && --left > 0);
      if (left == 0 || std::isnan(p.u_step)) {
        p.s = kNaN;
        continue;
      }
      p.u = u;
      before = u, slope = p.du;
    }
    cut_before_ = true;
  }

  const SectionPoint& break_at(int k) const { return breaks_[static_cast<std::size_t>(k)]; }

  SectionPoint point(int cell, double v, double u) const {
    const SliceNet::Place place = net_.find(u, span_);
    span_ = place.span;
    double unused;
    return combine(u, net_.at(place, cell, v - (cell + 1)), unused);
  }

  /// Slopes of the surface along and across at a hit.
  struct Slopes {
    double along, across;
  };
  Slopes slopes(int cell, double v, double u) const {
    const SliceNet::Place place = net_.find(u, span_);
    const NetValue value = net_.at(place, cell, v - (cell + 1));
    double sine, cosine;
    Geometry::sine_cosine(u - reference_, sine, cosine);
    const PlaneCoordinate a = across_.of(u, sine, cosine, value), s = along_.of(u, sine, cosine, value);
    const PlaneCoordinate n = normal_.of(u, sine, cosine, value);
    const double area = a.by_u * s.by_v - s.by_u * a.by_v;
    return {(a.by_u * n.by_v - n.by_u * a.by_v) / area, (n.by_u * s.by_v - s.by_u * n.by_v) / area};
  }

 private:
  static constexpr int kMaxCutSteps = 30;

  void set_reference(double u) {
    reference_ = u;
    across_.set_reference(u);
    along_.set_reference(u);
    normal_.set_reference(u);
  }

  SectionPoint at_break(int k, double u, double& u_by_c) const {
    const SliceNet::Place place = net_.find(u, span_);
    span_ = place.span;
    return combine(u, net_.at_break(place, k), u_by_c);
  }

  SectionPoint combine(double u, const NetValue& value, double& u_by_c) const {
    double sine, cosine;
    Geometry::sine_cosine(u - reference_, sine, cosine);
    const PlaneCoordinate a = across_.of(u, sine, cosine, value), s = along_.of(u, sine, cosine, value);
    const PlaneCoordinate n = normal_.of(u, sine, cosine, value);
    u_by_c = 1.0 / a.by_u;
    const double step = (c_ - a.value) * u_by_c, du = -a.by_v * u_by_c;
    return {s.value + s.by_u * step, n.value + n.by_u * step, s.by_v + s.by_u * du, n.by_v + n.by_u * du, u + step, du, step};
  }

  const SliceNet& net_;
  const Geometry& geometry_;
  Vec3 across_direction_, normal_direction_, origin_;
  typename Geometry::Axis across_, along_, normal_;
  std::vector<SectionPoint> breaks_;
  std::vector<double> u_by_c_;
  double c_ = 0.0, reference_ = 0.0;
  bool cut_before_ = false;
  mutable int span_ = 0;  // of the last evaluation; neighbours are near
};

}  // namespace treadmark::spline
