// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs_fit.hpp"

#include <cmath>
#include <numbers>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::spline {
namespace {

// Slopes of interpolating cubic splines with given knots.
class SplineSlopes {
 public:
  /// period = 0: not periodic.
  SplineSlopes(std::span<const double> knots, double period)
      : closed_(period > 0.0), size_(static_cast<int>(knots.size())), lu_(size_, closed_ ? 2 : 1), rhs_(knots.size()) {
    for (int i = 0; i < size_; ++i) {
      const bool last = i + 1 == size_;
      if (last && !closed_) break;
      h_.push_back(last ? period - (knots[static_cast<std::size_t>(i)] - knots[0])
                        : knots[static_cast<std::size_t>(i) + 1] - knots[static_cast<std::size_t>(i)]);
    }
    for (int i = 0; i < size_; ++i) {
      if (!closed_ && (i == 0 || i + 1 == size_)) continue;
      const double before = step(i - 1), after = step(i);
      lu_.at(place(i), place(next(i, -1))) += after;
      lu_.at(place(i), place(i)) += 2.0 * (before + after);
      lu_.at(place(i), place(next(i, 1))) += before;
    }
    if (!closed_) {
      lu_.at(0, 0) = step(1);
      lu_.at(0, 1) = step(0) + step(1);
      lu_.at(size_ - 1, size_ - 1) = step(size_ - 3);
      lu_.at(size_ - 1, size_ - 2) = step(size_ - 2) + step(size_ - 3);
    }
    lu_.factor();
  }

  /// values(i) -> value at knot i; set(i, slope).
  template <class Values, class Set>
  void solve(const Values& values, const Set& set) {
    const auto rise = [&](int i) { return (values(next(i, 1)) - values(next(i, 0))) / step(i); };
    for (int i = 0; i < size_; ++i) {
      double& b = rhs_[static_cast<std::size_t>(place(i))];
      if (!closed_ && i == 0)
        b = end(step(0), step(1), rise(0), rise(1));
      else if (!closed_ && i + 1 == size_)
        b = end(step(size_ - 2), step(size_ - 3), rise(size_ - 2), rise(size_ - 3));
      else
        b = 3.0 * (step(i) * rise(i - 1) + step(i - 1) * rise(i));
    }
    lu_.solve(rhs_);
    for (int i = 0; i < size_; ++i) set(i, rhs_[static_cast<std::size_t>(place(i))]);
  }

 private:
  // Not-a-knot: the cubics of the outer two intervals are one.
  static double end(double outer, double inner, double outer_rise, double inner_rise) {
    return ((3.0 * outer + 2.0 * inner) * inner * outer_rise + outer * outer * inner_rise) / (outer + inner);
  }
  int next(int i, int by) const { return closed_ ? (i + by + size_) % size_ : i + by; }
  double step(int i) const { return h_[static_cast<std::size_t>(next(i, 0))]; }
  // A ring folded flat, so that neighbours stay within two places.
  int place(int i) const {
    if (!closed_) return i;
    return 2 * i < size_ ? 2 * i : 2 * (size_ - i) - 1;
  }

  bool closed_;
  int size_;
  std::vector<double> h_;
  BandedLu lu_;
  std::vector<double> rhs_;
};

void require_points(bool good, const char* message, const char* advice = "") {
  if (!good) throw Error(ErrorKind::input_data, message, {}, advice);
}

void check(const sampling::PointGrid& grid) {
  require_points(grid.u.size() >= 4 && grid.y.size() >= 4, "a surface through points needs at least 4 x 4 of them");
  require_points(grid.h.size() == grid.u.size() * grid.y.size(),
                 "a point grid has another number of heights than of points");
  for (const auto* values : {&grid.u, &grid.y}) {
    for (const double x : *values) require_points(std::isfinite(x), "a coordinate of a point grid is not finite");
    for (std::size_t i = 0; i + 1 < values->size(); ++i)
      require_points((*values)[i] < (*values)[i + 1], "the stations and nodes of a point grid must increase");
  }
  require_points(!grid.closed || grid.body == Body::wheel, "only a wheel can be closed");
  require_points(grid.body == Body::rail || grid.u.back() - grid.u.front() < 2.0 * std::numbers::pi * (1.0 + 1e-12),
                 "the stations of a wheel cover more than one turn");
  require_points(!grid.closed || grid.u.back() - grid.u.front() < 2.0 * std::numbers::pi * (1.0 - 1e-9),
                 "the last station of a closed wheel repeats the first");
  for (const double h : grid.h) {
    require_points(!std::isnan(h), "a full-parametric spline surface cannot have gaps",
                   "use another backend, or cut the gaps off");
    require_points(std::isfinite(h), "a coordinate of a point grid is not finite");
    require_points(grid.body == Body::rail || h > 0.0, "a wheel's radius must be positive at all points");
  }
}

}  // namespace

NurbsNet fit_point_grid(const sampling::PointGrid& grid) {
  check(grid);
  const std::size_t nu = grid.u.size(), nv = grid.y.size();
  std::vector<NurbsNet::Corner> corners(nu * nv);
  for (std::size_t i = 0; i < nu; ++i)
    for (std::size_t j = 0; j < nv; ++j) corners[grid.index(i, j)].p = grid.point(i, j);
  std::vector<double> u = grid.u, v(nv, 0.0);
  for (std::size_t j = 0; j + 1 < nv; ++j) {
    double chords = 0.0;
    for (std::size_t i = 0; i < nu; ++i)
      chords += (corners[grid.index(i, j + 1)].p - corners[grid.index(i, j)].p).norm();
    v[j + 1] = v[j] + chords / static_cast<double>(nu);
  }

  SplineSlopes along_u(u, grid.closed ? 2.0 * std::numbers::pi : 0.0), along_v(v, 0.0);
  using Corner = NurbsNet::Corner;
  const auto by_u = [&](Vec3 Corner::*from, Vec3 Corner::*to) {
    for (std::size_t j = 0; j < nv; ++j)
      for (int k = 0; k < 3; ++k)
        along_u.solve(
            [&](int i) { return (corners[grid.index(static_cast<std::size_t>(i), j)].*from)[k]; },
            [&](int i, double slope) { (corners[grid.index(static_cast<std::size_t>(i), j)].*to)[k] = slope; });
  };
  for (std::size_t i = 0; i < nu; ++i)
    for (int k = 0; k < 3; ++k)
      along_v.solve([&](int j) { return corners[grid.index(i, static_cast<std::size_t>(j))].p[k]; },
                    [&](int j, double slope) { corners[grid.index(i, static_cast<std::size_t>(j))].p_v[k] = slope; });
  by_u(&Corner::p, &Corner::p_u);
  by_u(&Corner::p_v, &Corner::p_uv);
  if (grid.closed) u.push_back(u.front() + 2.0 * std::numbers::pi);
  return NurbsNet(std::move(u), std::move(v), std::move(corners));
}

}  // namespace treadmark::spline
