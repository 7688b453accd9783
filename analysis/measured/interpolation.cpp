// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/interpolation.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "treadmark/analysis/measured/smoothing.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark::measured {
namespace {

/// The cubic spline through at least three values over growing places; it bends alike in its first two places and its
/// last two, so that its ends tell nothing of their own.
class CubicThrough {
 public:
  CubicThrough(const std::vector<double>& t, const std::vector<double>& f) : t_(t), f_(f), bend_(t.size(), 0.0) {
    const std::size_t n = t.size();
    std::vector<double> diagonal(n, 1.0), above(n, 0.0);
    above[0] = -1.0;
    for (std::size_t i = 1; i < n; ++i) {  // Gauss without exchanges: the diagonal dominates
      const bool last = i + 1 == n;
      const double before = t[i] - t[i - 1], after = last ? 0.0 : t[i + 1] - t[i];
      const double below = last ? -1.0 : before / 6.0;
      if (!last) {
        diagonal[i] = (before + after) / 3.0;
        above[i] = after / 6.0;
        bend_[i] = (f[i + 1] - f[i]) / after - (f[i] - f[i - 1]) / before;
      }
      const double factor = below / diagonal[i - 1];
      diagonal[i] -= factor * above[i - 1];
      bend_[i] -= factor * bend_[i - 1];
    }
    for (std::size_t i = n; i-- > 0;) bend_[i] = (bend_[i] - (i + 1 < n ? above[i] * bend_[i + 1] : 0.0)) / diagonal[i];
  }
  /// At a place between the k-th and the next.
  double value(std::size_t k, double x) const {
    const double h = t_[k + 1] - t_[k], a = (t_[k + 1] - x) / h, b = 1.0 - a;
    return a * f_[k] + b * f_[k + 1] + h * h / 6.0 * ((a * a * a - a) * bend_[k] + (b * b * b - b) * bend_[k + 1]);
  }
  double slope(std::size_t k, double x) const {
    const double h = t_[k + 1] - t_[k], a = (t_[k + 1] - x) / h, b = 1.0 - a;
    return (f_[k + 1] - f_[k]) / h + h / 6.0 * ((1.0 - 3.0 * a * a) * bend_[k] + (3.0 * b * b - 1.0) * bend_[k + 1]);
  }

 private:
  std::vector<double> t_, f_, bend_;
};

std::vector<double> chord_lengths(const Profile& p) {
  std::vector<double> s(p.y.size(), 0.0);
  for (std::size_t i = 1; i < s.size(); ++i) s[i] = s[i - 1] + std::hypot(p.y[i] - p.y[i - 1], p.z[i] - p.z[i - 1]);
  return s;
}

/// Of each point the distance from the spline through the others of every second point; 0 at the ends.
std::vector<double> misses(const Profile& p, const std::vector<double>& s) {
  std::vector<double> out(s.size(), 0.0);
  for (const std::size_t first : {std::size_t{0}, std::size_t{1}}) {
    std::vector<double> t, y, z;
    for (std::size_t i = first; i < s.size(); i += 2) t.push_back(s[i]), y.push_back(p.y[i]), z.push_back(p.z[i]);
    const CubicThrough of_y(t, y), of_z(t, z);
    for (std::size_t k = 0; k + 1 < t.size(); ++k) {
      const std::size_t i = first + 2 * k + 1;
      const Vec2 along(of_y.slope(k, s[i]), of_z.slope(k, s[i]));
      const Vec2 off(p.y[i] - of_y.value(k, s[i]), p.z[i] - of_z.value(k, s[i]));
      out[i] = std::fabs(off.y() * along.x() - off.x() * along.y()) / along.norm();
    }
  }
  return out;
}

}  // namespace

BetweenPoints known_between(const Profile& exact) {
  constexpr std::size_t kFewest = 16;
  constexpr double kNear = 0.6e-3;  // [m] a joint of 300 and 80 mm in 60E1 then changes the pressure by 1 % at most
  BetweenPoints out{chord_lengths(exact), {}};
  const std::vector<double>& s = out.s;
  const std::size_t n = s.size();
  const auto step = [&](std::size_t i) { return s[i + 1] - s[i]; };
  bool far = false, apart = true;
  for (std::size_t i = 0; i + 1 < n; ++i) far = far || step(i) > kNear, apart = apart && step(i) > 0.0;
  if (n < kFewest || !far || !apart) return out;
  const std::vector<double> missed = misses(exact, s);
  out.deviation.assign(n - 1, 0.0);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    if (!(step(i) > kNear)) continue;
    for (const std::size_t j : {i, i + 1})
      if (j > 0 && j + 1 < n)
        out.deviation[i] = std::max(out.deviation[i], missed[j] * std::pow(step(i) / (s[j + 1] - s[j - 1]), 2));
    if (!(out.deviation[i] > kExactPoints)) out.deviation[i] = 0.0;
  }
  if (ranges::none_of(out.deviation, [](double d) { return d > 0.0; })) out.deviation.clear();
  return out;
}

Profile with_middles(const Profile& exact, const BetweenPoints& known, std::vector<double>& s) {
  Profile out = exact;
  s = known.s;
  if (known.deviation.empty()) return out;
  const CubicThrough of_y(known.s, exact.y), of_z(known.s, exact.z);
  out.y.clear(), out.z.clear(), s.clear();
  for (std::size_t i = 0; i < known.s.size(); ++i) {
    out.y.push_back(exact.y[i]), out.z.push_back(exact.z[i]), s.push_back(known.s[i]);
    if (i == known.deviation.size() || !(known.deviation[i] > 0.0)) continue;
    const double middle = 0.5 * (known.s[i] + known.s[i + 1]);
    out.y.push_back(of_y.value(i, middle)), out.z.push_back(of_z.value(i, middle)), s.push_back(middle);
  }
  return out;
}

}  // namespace treadmark::measured
