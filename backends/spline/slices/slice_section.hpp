// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "treadmark/backends/spline/grid_lines.hpp"
#include "treadmark/backends/spline/slices/slice_geometry.hpp"
#include "treadmark/backends/spline/slices/slice_hulls.hpp"
#include "treadmark/backends/spline/slices/slice_kernels.hpp"
#include "treadmark/backends/spline/slices/slice_net.hpp"
#include "treadmark/core/kernel.hpp"

namespace treadmark::spline {

/// Memory for sections, used again by the next one of the same thread.
struct SectionWorkspace {
  static constexpr std::size_t kArrays = 12;
  std::vector<double> numbers;
  std::vector<int> spans, first_sample, sample_count;
  std::vector<char> trouble, fast, redo;
  std::vector<CellCubics> cells;

  void fit(std::size_t breaks) {
    if (spans.size() >= breaks) return;
    numbers.assign(kArrays * breaks, std::numeric_limits<double>::quiet_NaN());
    spans.assign(breaks, 0), first_sample.resize(breaks), sample_count.resize(breaks);
    trouble.resize(breaks), fast.resize(breaks), redo.assign(breaks, 0);
    cells.resize(breaks);
  }
};

/// A slice surface cut at one value c of the across coordinate, for SectionRaster. The cut has u = u(v): every
/// evaluation corrects u by one Newton step. Cuts follow one another, with the same lines each time; one starts from
/// the last.
template <class Geometry>
class SliceSection {
 public:
  static constexpr double kStep = 4e-5;  // of a cell of 0.5 mm
  static constexpr double kFine = 1e-12;
  static constexpr double kStepU = Geometry::kStepU;

  SliceSection(const SliceNet& net, const SliceHulls& hulls, const Geometry& geometry, const Vec3& across,
               const Vec3& along, const Vec3& normal, const Vec3& origin, SectionWorkspace& workspace,
               const SliceKernel& kernels = fastest_kernel<SliceKernel>())
      : net_(net),
        hulls_(hulls),
        geometry_(geometry),
        kernels_(kernels),
        work_(workspace),
        across_direction_(across),
        normal_direction_(normal),
        origin_(origin),
        along_direction_(along) {
    const std::size_t breaks = (static_cast<std::size_t>(net.positions()) + 3) / 4 * 4 + 4;
    work_.fit(breaks);
    double* p = work_.numbers.data();
    SectionArrays& a = arrays_;
    for (double** array :
         {&a.s, &a.n, &a.ds, &a.dn, &a.u, &a.du, &a.u_by_c, &a.change, &a.predicted, &a.ds_end, &a.dn_end, &a.du_end})
      *array = p, p += breaks;
    if (net.straight())
      ++a.ds_end, ++a.dn_end, ++a.du_end;
    else
      a.ds_end = a.ds + 1, a.dn_end = a.dn + 1, a.du_end = a.du + 1;
    a.spans = work_.spans.data();
    a.net = net.arrays();
    a.wheel = Geometry::kTurns;
    a.u_tolerance = kCutStepU, a.largest_step = Geometry::kLargestStepU,
    a.largest_prediction = Geometry::kLargestPrediction;
    a.span = 0;
    twist_ = {hulls.twist(0, 0), hulls.twist_stride(), SliceHulls::kSpansPerGroup,
              kGreatestError,    kGreatestTurn,        Geometry::kTurnsNormal};
  }

  /// Forgets the cuts so far: the next ones may have other lines.
  void restart() { started_ = false; }

  /// Moves to the across coordinate c.
  void start_cut(double c) {
    constexpr double kTurn = 2.0 * std::numbers::pi;
    const double last = guess_;
    arrays_.shift = started_ ? c - arrays_.c : 0.0;
    arrays_.c = c;
    guess_ = geometry_.guess_u(across_direction_, normal_direction_, origin_, c);
    // in the turn of the cut before, from which u goes on
    if (started_ && net_.closed() && !std::isnan(last)) guess_ += kTurn * std::round((last - guess_) / kTurn);
    started_ = true;
    set_reference(guess_);
    arrays_.turn = 0.0;
    if (net_.closed() && guess_ == guess_) {
      const SliceNet::Place place = net_.find(guess_, span_);
      arrays_.span = span_ = place.span;
      arrays_.turn = kTurn * std::round((net_.span_start(place.span) + place.t - guess_) / kTurn);
    } else if (!net_.closed()) {
      arrays_.span = span_ = net_.find(guess_, span_).span;
    }
  }

  /// Cuts the lines v = first + 1 .. last + 1, between which are the cells first .. last - 1.
  void cut(int first, int last) {
    arrays_.before = guess_, arrays_.slope = 0.0;
    char* trouble = work_.trouble.data();
    kernels_.cut(arrays_, first / 4, last / 4, trouble);
    for (int group = first / 4; group <= last / 4; ++group)
      if (trouble[group]) cut_one_by_one(std::max(first, 4 * group), std::min(last, 4 * group + 3));
  }
  /// Where a cell begins and where it ends, v = cell + 1 and cell + 2.
  SectionPoint start_of(int cell) const {
    const auto k = static_cast<std::size_t>(cell);
    const SectionArrays& a = arrays_;
    return {a.s[k], a.n[k], a.ds[k], a.dn[k], a.u[k], a.du[k]};
  }
  SectionPoint end_of(int cell) const {
    const auto k = static_cast<std::size_t>(cell);
    const SectionArrays& a = arrays_;
    return {a.s[k + 1], a.n[k + 1], a.ds_end[k], a.dn_end[k], a.u[k + 1], a.du_end[k]};
  }

  /// Hits of all samples by kernels; careful(cell) is called for cells that these do not serve. hits.v may be null.
  template <class Careful>
  void hit(int first, int last, const SampleArrays& samples, const HitArrays& hits, const Careful& careful) {
    char *fast = work_.fast.data(), *redo = work_.redo.data();
    kernels_.hit(arrays_, twist_, samples, first, last,
                 {work_.cells.data(), work_.first_sample.data(), work_.sample_count.data(), fast, redo}, hits);
    for (int k = first; k < last; ++k)
      if (!fast[k] || redo[k]) {
        redo[k] = 0;
        careful(k);
      }
  }

  /// Of all hits; arrays padded to a multiple of four.
  void slopes_of(const HitArrays& hits, int count, const SlopeArrays& slopes) {
    kernels_.slopes(arrays_, hits, count, slopes);
  }

  SectionPoint point(int cell, double v, double u) const {
    const SliceNet::Place place = net_.find(u, span_);
    span_ = place.span;
    double unused;
    return combine(u, net_.at(place, cell, v - (cell + 1)), unused);
  }

  /// For one u a cell is a cubic in v, so only the change of u along the cell spoils that: the interpolation error of
  /// the Hermite cubic is its fourth derivative / 384, bounded here by the terms of the chain rule that count.
  bool near_cubic(int cell, const SectionPoint& a, const SectionPoint& b) const {
    const double turn = std::max(std::abs(a.du), std::abs(b.du)), bend = std::abs(b.du - a.du);
    if (!(turn < kGreatestTurn)) return false;
    // Pieces of a cell lie between its breaks, and those at most one span apart.
    const int span_a = arrays_.spans[cell], span_b = arrays_.spans[cell + 1];
    if (std::abs(span_b - span_a) > 1) return false;
    const auto error = [&](const float* bounds) {
      const auto t = [&](long which) { return static_cast<double>(bounds[which * hulls_.twist_stride()]); };
      const double uuu = t(0), uuv = t(1), uuvv = t(2);
      const double vvv = t(4) + Geometry::kTurnsNormal * t(5), vv = t(3) + Geometry::kTurnsNormal * t(6);
      // uuu jumps where the cell leaves a span.
      return (4.0 * turn * vvv + 6.0 * bend * vv + 6.0 * turn * (turn * uuvv + bend * (2.0 * uuv + turn * uuu))) *
                 (1.0 / 384.0) +
             turn * turn * turn * uuu * (1.0 / 24.0);
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
    const double a_u = across_.of(at.by_u), a_v = across_.of(at.by_v), s_u = along_.of(at.by_u),
                 s_v = along_.of(at.by_v);
    const double n_u = normal_.of(at.by_u), n_v = normal_.of(at.by_v);
    const double area = a_u * s_v - s_u * a_v;
    return {(a_u * n_v - n_u * a_v) / area, (n_u * s_v - s_u * n_v) / area};
  }

 private:
  static constexpr int kMaxCutSteps = 30;
  // Derivatives at the breaks serve for Hermite cubics, so that they count to first order.
  static constexpr double kCutStepU = 0.05 * kStepU;
  static constexpr double kGreatestError = 1e-11;  // [m], of a cubic in place of the section
  static constexpr double kGreatestTurn = 2e-4;    // of u along a cell, [m] or [rad]; beyond, neglected terms grow

  void set_reference(double u) {
    reference_ = arrays_.reference = u;
    across_ = Geometry::turned(across_direction_, origin_, u);
    along_ = Geometry::turned(along_direction_, origin_, u);
    normal_ = Geometry::turned(normal_direction_, origin_, u);
    const auto set = [](double(&to)[4], const TurnedAxis& axis) {
      to[0] = axis.x, to[1] = axis.y, to[2] = axis.z, to[3] = axis.origin;
    };
    set(arrays_.across, across_);
    set(arrays_.along, along_);
    set(arrays_.normal, normal_);
  }

  // For lines that are missing or far from the guess.
  void cut_one_by_one(int first, int last) {
    constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
    double before = guess_, slope = 0.0;
    for (int line = first; line <= last; ++line) {
      const auto k = static_cast<std::size_t>(line);
      // From the last cut, else from the neighbour.
      const double change_of_u = arrays_.shift * arrays_.predicted[k];
      const bool known =
          arrays_.shift != 0.0 && std::abs(change_of_u) < Geometry::kLargestPrediction && !std::isnan(arrays_.s[k]);
      double u = known ? arrays_.u[k] + change_of_u : before + slope;
      double u_by_c = 0.0;
      int left = kMaxCutSteps;
      SectionPoint p{};
      do {
        p = at_break(line, u, SliceNet::Side::after, u_by_c);
        p.u_step = std::clamp(p.u_step, -Geometry::kLargestStepU, Geometry::kLargestStepU);
        u += p.u_step;
      } while (std::abs(p.u_step) > kCutStepU && --left > 0);
      arrays_.s[k] = p.s;
      if (left == 0 || std::isnan(p.u_step)) {
        arrays_.s[k] = kNaN;
        continue;
      }
      arrays_.n[k] = p.n, arrays_.ds[k] = p.ds, arrays_.dn[k] = p.dn, arrays_.u[k] = u, arrays_.du[k] = p.du;
      arrays_.predicted[k] = arrays_.u_by_c[k] = u_by_c;
      arrays_.change[k] = 0.0;
      arrays_.spans[k] = span_;
      if (net_.straight()) {
        double unused;
        const SectionPoint end = at_break(line, u, SliceNet::Side::before, unused);
        arrays_.ds_end[line - 1] = end.ds, arrays_.dn_end[line - 1] = end.dn, arrays_.du_end[line - 1] = end.du;
      }
      before = u, slope = std::isnan(p.du) ? 0.0 : p.du;
    }
  }

  SectionPoint at_break(int k, double u, SliceNet::Side side, double& u_by_c) const {
    const SliceNet::Place place = net_.find(u, span_);
    span_ = place.span;
    return combine(u, net_.at_break(place, k, side), u_by_c);
  }

  SectionPoint combine(double u, const NetValue& value, double& u_by_c) const {
    const TurnedPoint at = Geometry::point(u, reference_, value);
    u_by_c = 1.0 / across_.of(at.by_u);
    const double step = (arrays_.c + across_.origin - across_.of(at.p)) * u_by_c, du = -across_.of(at.by_v) * u_by_c;
    double p[3], d[3];
    for (int i = 0; i < 3; ++i) {
      p[i] = at.p[i] + step * at.by_u[i];
      d[i] = at.by_v[i] + du * at.by_u[i];
    }
    return {
        along_.of(p) - along_.origin, normal_.of(p) - normal_.origin, along_.of(d), normal_.of(d), u + step, du, step};
  }

  const SliceNet& net_;
  const SliceHulls& hulls_;
  const Geometry& geometry_;
  const SliceKernel& kernels_;
  SectionWorkspace& work_;
  SectionArrays arrays_{};
  TwistArrays twist_{};
  Vec3 across_direction_, normal_direction_, origin_, along_direction_;
  TurnedAxis across_, along_, normal_;
  double reference_ = 0.0, guess_ = 0.0;
  bool started_ = false;
  mutable int span_ = 0;  // of the last evaluation; neighbours are near
};

}  // namespace treadmark::spline
