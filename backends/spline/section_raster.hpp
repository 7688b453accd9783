// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {

// A section is the curve in which a plane spanned by a grid line and the direction of heights cuts a surface:
// (s(v), n(v)), s along the grid line, n the height. It comes in cells between breaks of v, smooth inside.
// Rastering a section means finding n at the positions s of grid points: cells are cut into pieces with monotonic s,
// and on each piece s(v) = s_i is solved by Newton's method, started from the inverse Hermite cubic and kept inside a
// bracket. Every hit is found this way, folds included; which one to keep is up to the receiver.

/// A point of a section: position, derivatives along v, and the surface parameter u that goes with it.
struct SectionPoint {
  double s, n, ds, dn;
  double u = 0.0, du = 0.0;
  double u_step = 0.0;  ///< last correction of u; the point lies on the section up to its square
};

/// Grid points first + i step, 0 <= i < count, step > 0.
struct Samples {
  double first, step;
  int count;
  double last() const { return first + step * (count - 1); }
};

/// A grid point to be hit, with a first guess on a piece of the section from va to vb with monotonic s.
struct HitGuess {
  double target, v, u;
  double va, vb;
  double step_limit;
  int i, cell;
  bool rising;
};

inline constexpr int kMaxCellHalvings = 8;
inline constexpr int kMaxSolveSteps = 100;
/// Part of a grid step by which a grid point may miss the end of a surface and still count as on it.
inline constexpr double kEdgeSlack = 1e-9;

/// Section: point(cell, v, u) const, kStep and kStepU: corrections of v and u below which a hit is converged (its error
/// is their square times curvature), kFine: the same next to a fold. near_cubic(cell, a, b): whether s(v), n(v) and
/// u(v) are cubic on the cell to well below the accuracy wanted; then the cubics through the ends (Hermite) are solved
/// instead of the surface. hit(i, n, cell, v, u): called for every grid point i that a piece covers; ends of pieces may
/// be reported twice. Use: cell(...) for all cells, then finish(). Guesses are collected first, so that the evaluations
/// run without branches.
template <class Section, class Hit>
class SectionRaster {
 public:
  /// queue: room for guesses, kept between lines.
  SectionRaster(const Section& section, const Samples& samples, Hit& hit, std::vector<HitGuess>& queue)
      : section_(section),
        samples_(samples),
        hit_(hit),
        queue_(queue),
        inverse_step_(1.0 / samples.step),
        low_(samples.first - kEdgeSlack * samples.step),
        high_(samples.last() + kEdgeSlack * samples.step) {
    queue_.clear();
  }

  /// Solves for all grid points met so far.
  void finish() {
    for (const HitGuess& guess : queue_) {
      const SectionPoint p = section_.point(guess.cell, guess.v, guess.u);
      const double step = (guess.target - p.s) / p.ds;
      if (std::abs(step) <= guess.step_limit && std::abs(p.u_step) <= section_.kStepU)
        hit_(guess.i, p.n + step * p.dn, guess.cell, std::clamp(guess.v + step, guess.va, guess.vb), p.u + step * p.du);
      else
        solve(guess);
    }
    queue_.clear();
  }

  /// One cell from a to b (parameters va < vb).
  void cell(int cell, double va, const SectionPoint& a, double vb, const SectionPoint& b, int halvings = 0,
            bool beside_fold = false) {
    const double h = vb - va, rise = b.s - a.s;
    // A cubic stays within this of its ends; also leaves out cells with an end where there is no surface (NaN).
    const double reach = h * std::max(std::abs(a.ds), std::abs(b.ds));
    if (!(std::max(a.s, b.s) + reach >= low_ && std::min(a.s, b.s) - reach <= high_)) return;
    // Sufficient for a monotonic cubic (Fritsch and Carlson 1980).
    const double limit = 3.0 * std::abs(rise);
    if (a.ds * rise >= 0.0 && b.ds * rise >= 0.0 && reach <= limit)
      return piece(cell, va, a, vb, b, beside_fold ? section_.kFine : section_.kStep);
    if (halvings >= kMaxCellHalvings) return piece(cell, va, a, vb, b, section_.kFine);
    if (a.ds * b.ds < 0.0) {
      const auto [vm, m] = fold(cell, va, a, vb, b);
      this->cell(cell, va, a, vm, m, halvings + 1, true);
      this->cell(cell, vm, m, vb, b, halvings + 1, true);
    } else {
      const double vm = 0.5 * (va + vb);
      const SectionPoint m = on_section(cell, vm, a.u + a.du * (vm - va));
      this->cell(cell, va, a, vm, m, halvings + 1, beside_fold);
      this->cell(cell, vm, m, vb, b, halvings + 1, beside_fold);
    }
  }

 private:
  // A cubic on [0, 1] by its first value, its rise and its end slopes.
  struct Hermite {
    Hermite(double first, double rise, double slope_0, double slope_1)
        : c0(first), c1(slope_0), c2(3.0 * rise - 2.0 * slope_0 - slope_1), c3(slope_0 + slope_1 - 2.0 * rise) {}
    double value(double f) const { return c0 + f * (c1 + f * (c2 + f * c3)); }
    double slope(double f) const { return c1 + f * (2.0 * c2 + 3.0 * f * c3); }
    double c0, c1, c2, c3;
  };

  SectionPoint on_section(int cell, double v, double u) const {
    SectionPoint p = section_.point(cell, v, u);
    for (int i = 0; i < 20 && std::abs(p.u_step) > section_.kStepU; ++i) p = section_.point(cell, v, p.u);
    return p;
  }

  // Where ds = 0, by regula falsi of the Illinois kind (Dowell and Jarratt 1971), now and then a bisection.
  std::pair<double, SectionPoint> fold(int cell, double va, const SectionPoint& a, double vb, const SectionPoint& b) {
    double low = va, high = vb, at_low = a.ds, at_high = b.ds, vm = 0.5 * (va + vb);
    SectionPoint m = a;
    int stays = 0;  // the end that the last step left alone: 1 high, -1 low
    for (int i = 0; i < 60; ++i) {
      const double before = vm, guess = low - at_low * (high - low) / (at_high - at_low);
      vm = i % 4 != 3 && guess > low && guess < high ? guess : 0.5 * (low + high);
      m = on_section(cell, vm, m.u + m.du * (vm - (i == 0 ? va : before)));
      if (m.ds == 0.0 || high - low <= section_.kFine || (i > 0 && std::abs(vm - before) <= section_.kFine)) break;
      if (m.ds * at_low > 0.0) {
        low = vm, at_low = m.ds;
        if (stays == 1) at_high *= 0.5;
        stays = 1;
      } else {
        high = vm, at_high = m.ds;
        if (stays == -1) at_low *= 0.5;
        stays = -1;
      }
    }
    m.ds = 0.0;
    return {vm, m};
  }

  void piece(int cell, double va, const SectionPoint& a, double vb, const SectionPoint& b, double step_limit) {
    const double low = std::min(a.s, b.s), high = std::max(a.s, b.s);
    int first = 0, last = samples_.count - 1;
    if (low > samples_.first)
      first = to_whole<int>(std::min((low - samples_.first) * inverse_step_ + (1.0 - kEdgeSlack), 2e9));
    if (high < samples_.last()) {
      const double reach = (high - samples_.first) * inverse_step_ + kEdgeSlack;
      if (reach < 0.0) return;
      last = to_whole<int>(reach);
    }
    if (first > last) return;

    const double h = vb - va, rise = b.s - a.s;
    if (!(high - low > 1e-15)) {  // upright: the whole piece lies over one position
      for (int i = first; i <= last; ++i) {
        hit_(i, a.n, cell, va, a.u);
        hit_(i, b.n, cell, vb, b.u);
      }
      return;
    }
    const double inverse_rise = 1.0 / rise, inverse_h = 1.0 / h;
    const double secant = std::abs(rise) * inverse_h;
    const double slope_a = std::min(secant / std::abs(a.ds), 3.0), slope_b = std::min(secant / std::abs(b.ds), 3.0);
    const double c2 = 3.0 - 2.0 * slope_a - slope_b, c3 = slope_a + slope_b - 2.0;
    const double secant_u = (b.u - a.u), end_u = a.du * h, bend_u = b.du * h;
    if (section_.near_cubic(cell, a, b)) {
      const Hermite s{a.s, rise, a.ds * h, b.ds * h}, n{a.n, b.n - a.n, a.dn * h, b.dn * h},
          u{a.u, secant_u, end_u, bend_u};
      for (int i = first; i <= last; ++i) {
        const double target = samples_.first + i * samples_.step;
        const double x = std::clamp((target - a.s) * inverse_rise, 0.0, 1.0);
        double f = std::clamp(x * (slope_a + x * (c2 + x * c3)), 0.0, 1.0);
        double step = (target - s.value(f)) / s.slope(f);
        if (std::abs(step) * h > step_limit) {
          for (int k = 0; k < 8 && std::abs(step) * h > step_limit; ++k) {
            f = std::clamp(f + step, 0.0, 1.0);
            step = (target - s.value(f)) / s.slope(f);
          }
          if (!(std::abs(step) * h <= step_limit)) {  // flat end of a piece
            queue_.push_back({target, va + f * h, u.value(f), va, vb, step_limit, i, cell, rise > 0.0});
            continue;
          }
        }
        hit_(i, n.value(f) + step * n.slope(f), cell, va + std::clamp(f + step, 0.0, 1.0) * h,
             u.value(f) + step * u.slope(f));
      }
      return;
    }
    for (int i = first; i <= last; ++i) {
      const double target = samples_.first + i * samples_.step;
      const double x = std::clamp((target - a.s) * inverse_rise, 0.0, 1.0);
      const double f = std::clamp(x * (slope_a + x * (c2 + x * c3)), 0.0, 1.0);
      const double u =
          a.u + f * (end_u + f * (3.0 * secant_u - 2.0 * end_u - bend_u + f * (end_u + bend_u - 2.0 * secant_u)));
      queue_.push_back({target, va + f * h, u, va, vb, step_limit, i, cell, rise > 0.0});
    }
  }

  void solve(const HitGuess& guess) {
    const auto& [target, first_v, first_u, va, vb, step_limit, i, cell, rising] = guess;
    double low = va, high = vb, v = first_v, u = first_u;
    for (int iteration = 0; iteration < kMaxSolveSteps; ++iteration) {
      const SectionPoint p = section_.point(cell, v, u);
      const double miss = target - p.s;
      const double step = miss / p.ds;
      const bool settled = std::abs(p.u_step) <= section_.kStepU;
      if (std::abs(step) <= step_limit && settled)
        return hit_(i, p.n + step * p.dn, cell, std::clamp(v + step, va, vb), p.u + step * p.du);
      if (std::isnan(p.s)) return;
      // Only a point on the section says on which side of it the solution lies.
      if (settled) ((miss > 0.0) == rising ? low : high) = v;
      double next = std::clamp(v + step, va, vb);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      if (next == v && settled) return hit_(i, p.n, cell, v, p.u);
      u = p.u + p.du * (next - v);
      v = next;
    }
    // The bracket has shrunk to rounding at a fold; the height there is as good as its end.
    const SectionPoint p = on_section(cell, v, u);
    if (std::abs(target - p.s) <= 1e-9) hit_(i, p.n, cell, v, p.u);
  }

  const Section& section_;
  const Samples& samples_;
  Hit& hit_;
  std::vector<HitGuess>& queue_;
  double inverse_step_, low_, high_;
};

}  // namespace treadmark::spline
