// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <limits>
#include <vector>

#include "treadmark/backends/spline/grid_lines.hpp"
#include "treadmark/backends/spline/slice_geometry.hpp"
#include "treadmark/backends/spline/slice_hulls.hpp"
#include "treadmark/backends/spline/slice_net.hpp"

namespace treadmark::spline {

/// A slice surface cut at one value c of the across coordinate, for SectionRaster. The cut has u = u(v): every evaluation
/// corrects u by one Newton step. Cuts follow one another, with the same lines each time;
/// one starts from the last.
template <class Geometry>
class SliceSection {
 public:
  static constexpr double kStep = 4e-5;   // of a cell of 0.5 mm
  static constexpr double kFine = 1e-12;
  static constexpr double kStepU = Geometry::kStepU;

  SliceSection(const SliceNet& net, const SliceHulls& hulls, const Geometry& geometry, const Vec3& across, const Vec3& along, const Vec3& normal,
               const Vec3& origin)
      : net_(net), hulls_(hulls), geometry_(geometry), across_direction_(across), normal_direction_(normal), origin_(origin),
        along_direction_(along), breaks_(static_cast<std::size_t>(net.positions()), SectionPoint{}), spans_(breaks_.size()),
        u_by_c_(breaks_.size()), change_(breaks_.size()), predicted_u_by_c_(breaks_.size()) {}

  /// Forgets the cuts so far: the next ones may have other lines.
  void restart() { started_ = false; }

  /// Moves to the across coordinate c.
  void start_cut(double c) {
    shift_ = started_ ? c - c_ : 0.0;
    started_ = true;
    c_ = c;
    before_ = geometry_.guess_u(across_direction_, normal_direction_, origin_, c);
    slope_ = 0.0;
    set_reference(before_);
  }

  /// Cuts the lines v = first + 1 .. last + 1; afterwards break_at(k) is v = k + 1.
  void cut(int first, int last) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    for (int line = first; line <= last; ++line) {
      const auto k = static_cast<std::size_t>(line);
      SectionPoint& p = breaks_[k];
      // From the last cut, else from the neighbour.
      const bool known = shift_ != 0.0 && std::abs(shift_ * predicted_u_by_c_[k]) < Geometry::kLargestPrediction && !std::isnan(p.s);
      double u = known ? p.u + shift_ * predicted_u_by_c_[k] : before_ + slope_;
      double u_by_c = 0.0;
      int left = kMaxCutSteps;
      do {
        p = at_break(line, u, u_by_c);
        p.u_step = std::clamp(p.u_step, -Geometry::kLargestStepU, Geometry::kLargestStepU);
        u += p.u_step;
      } while (std::abs(p.u_step) > kCutStepU && --left > 0);
      if (left == 0 || std::isnan(p.u_step)) {
        p.s = kNaN;
        continue;
      }
      // Adams and Bashforth's step of order 3 to the next cut, at the same distance.
      const double change = known ? u_by_c - u_by_c_[k] : 0.0;
      const double change_of_change = known && change_[k] != 0.0 ? change - change_[k] : 0.0;
      predicted_u_by_c_[k] = u_by_c + 0.5 * change + (5.0 / 12.0) * change_of_change;
      u_by_c_[k] = u_by_c;
      change_[k] = change;
      p.u = u;
      spans_[k] = span_;
      before_ = u, slope_ = p.du;
    }
  }
  const SectionPoint& break_at(int k) const { return breaks_[static_cast<std::size_t>(k)]; }

  SectionPoint point(int cell, double v, double u) const {
    const SliceNet::Place place = net_.find(u, span_);
    span_ = place.span;
    double unused;
    return combine(u, net_.at(place, cell, v - (cell + 1)), unused);
  }

  /// For one u a cell is a cubic in v, so only the change of u along the cell spoils that: the interpolation error of the
  /// Hermite cubic is its fourth derivative / 384, bounded here by the terms of the chain rule that count.
  bool near_cubic(int cell, const SectionPoint& a, const SectionPoint& b) const {
    constexpr double kGreatestError = 1e-11;  // [m]
    constexpr double kGreatestTurn = 2e-4;    // of u along a cell, [m] or [rad]; beyond, neglected terms grow
    const double turn = std::max(std::abs(a.du), std::abs(b.du)), bend = std::abs(b.du - a.du);
    if (!(turn < kGreatestTurn)) return false;
    // Pieces of a cell lie between its breaks, and those at most one span apart.
    const int span_a = spans_[static_cast<std::size_t>(cell)], span_b = spans_[static_cast<std::size_t>(cell) + 1];
    if (std::abs(span_b - span_a) > 1) return false;
    const auto error = [&](const SliceHulls::Twist& t) {
      const double vvv = t.uvvv + Geometry::kTurnsNormal * t.vvv, vv = t.uvv + Geometry::kTurnsNormal * t.vv;
      // uuu jumps where the cell leaves a span.
      return (4.0 * turn * vvv + 6.0 * bend * vv + 6.0 * turn * (turn * t.uuvv + bend * (2.0 * t.uuv + turn * t.uuu))) *
                 (1.0 / 384.0) +
             turn * turn * turn * t.uuu * (1.0 / 24.0);
    };
    return error(hulls_.twist(span_a, cell)) <= kGreatestError &&
           (span_b == span_a || error(hulls_.twist(span_b, cell)) <= kGreatestError);
  }

  /// Slopes of the surface along and across at a hit.
  struct Slopes {
    double along, across;
  };
  Slopes slopes(int cell, double v, double u) const {
    const SliceNet::Place place = net_.find(u, span_);
    const NetValue value = net_.at(place, cell, v - (cell + 1));
    const TurnedPoint at = Geometry::point(u, reference_, value);
    const double a_u = across_.of(at.by_u), a_v = across_.of(at.by_v), s_u = along_.of(at.by_u), s_v = along_.of(at.by_v);
    const double n_u = normal_.of(at.by_u), n_v = normal_.of(at.by_v);
    const double area = a_u * s_v - s_u * a_v;
    return {(a_u * n_v - n_u * a_v) / area, (n_u * s_v - s_u * n_v) / area};
  }

 private:
  static constexpr int kMaxCutSteps = 30;
  // Derivatives at the breaks serve for Hermite cubics, so that they count to first order.
  static constexpr double kCutStepU = 0.05 * kStepU;

  void set_reference(double u) {
    reference_ = u;
    across_ = Geometry::turned(across_direction_, origin_, u);
    along_ = Geometry::turned(along_direction_, origin_, u);
    normal_ = Geometry::turned(normal_direction_, origin_, u);
  }

  SectionPoint at_break(int k, double u, double& u_by_c) const {
    const SliceNet::Place place = net_.find(u, span_);
    span_ = place.span;
    return combine(u, net_.at_break(place, k), u_by_c);
  }

  SectionPoint combine(double u, const NetValue& value, double& u_by_c) const {
    const TurnedPoint at = Geometry::point(u, reference_, value);
    u_by_c = 1.0 / across_.of(at.by_u);
    const double step = (c_ + across_.origin - across_.of(at.p)) * u_by_c, du = -across_.of(at.by_v) * u_by_c;
    double p[3], d[3];
    for (int i = 0; i < 3; ++i) {
      p[i] = at.p[i] + step * at.by_u[i];
      d[i] = at.by_v[i] + du * at.by_u[i];
    }
    return {along_.of(p) - along_.origin, normal_.of(p) - normal_.origin, along_.of(d), normal_.of(d), u + step, du, step};
  }

  const SliceNet& net_;
  const SliceHulls& hulls_;
  const Geometry& geometry_;
  Vec3 across_direction_, normal_direction_, origin_, along_direction_;
  TurnedAxis across_, along_, normal_;
  std::vector<SectionPoint> breaks_;
  std::vector<int> spans_;
  std::vector<double> u_by_c_, change_, predicted_u_by_c_;
  double c_ = 0.0, reference_ = 0.0;
  double shift_ = 0.0;               // from the cut before
  double before_ = 0.0, slope_ = 0.0;  // u of the line cut last, and its change from line to line
  bool started_ = false;
  mutable int span_ = 0;  // of the last evaluation; neighbours are near
};

}  // namespace treadmark::spline
