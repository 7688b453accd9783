// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/wheels/wheel_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::analytic {

namespace {

constexpr double kHullRounding = 1e-12;  // [m]

/// middle +- half.
struct Spread {
  double middle, half;
  double low() const { return middle - half; }
  double high() const { return middle + half; }
};

/// One curve (y, tau) seen along the normal, which is inclined against its axes by cos and sin.
struct TauCurve {
  double cos, sin, side;   ///< side -1: the least height is wanted
  double radius, sigma_2;  ///< r = radius + z(y)
  double stretch, bend;    ///< of tau by r: greatest slope, eighth of the greatest curvature
  bool look_early;

  ChordTree::Image operator()(double y, double h) const {
    const double r = radius + h, tau = std::sqrt(std::max(0.0, r * r - sigma_2));
    return {cos * y - sin * tau, side * (cos * tau + sin * y)};
  }
  double off(const Chord& c) const { return stretch * c.off + bend * (c.h_b - c.h_a) * (c.h_b - c.h_a); }
};

}  // namespace

WheelHull::WheelHull(const GraphCurve& curve) : chords_(curve.chords()), y_min_(curve.y_min()), y_max_(curve.y_max()) {
  constexpr int kBins = 64;
  const double width = (y_max_ - y_min_) / kBins;
  bins_per_length_ = 1.0 / width;
  all_ = {kInfinity, -kInfinity};
  for (int i = 0; i < kBins; ++i) {
    const CurveRange one = curve.range(y_min_ + (i - 0.01) * width, y_min_ + (i + 1.01) * width);
    bins_.push_back({one.h_min, one.h_max});
    all_ = {std::min(all_.low, one.h_min), std::max(all_.high, one.h_max)};
  }
}

WheelHull::Bin WheelHull::range(double y_low, double y_high) const {
  Bin sum{kInfinity, -kInfinity};
  if (!(y_high >= y_min_ && y_low <= y_max_)) return sum;
  const double last = static_cast<double>(bins_.size()) - 1.0;
  const auto bin = [&](double y) { return to_whole<std::size_t>((y - y_min_) * bins_per_length_, 0.0, last); };
  for (std::size_t i = bin(y_low), end = bin(y_high); i <= end; ++i)
    sum = {std::min(sum.low, bins_[i].low), std::max(sum.high, bins_[i].high)};
  return sum;
}

std::optional<HeightBounds> WheelHull::heights(double R, const FlatDepth& flats, const Pose& X,
                                               const Rectangle& rect) const {
  constexpr HeightBounds kNone{0.0, 0.0, true};
  const double n_x = X.rotation(0, 2), n_y = X.rotation(1, 2), n_z = X.rotation(2, 2);
  const double cos = std::sqrt(n_x * n_x + n_z * n_z), sin = n_y;
  constexpr double kAlongAxle = 1e-3;
  if (!(cos > kAlongAxle)) return {};

  // the rectangle: sigma, and v across the normal in the plane of y and tau
  const double w_x = n_x / cos, w_z = n_z / cos;
  const double half_x = 0.5 * (rect.x_max - rect.x_min), half_y = 0.5 * (rect.y_max - rect.y_min);
  const auto sigma_of = [&](const auto& p) { return p.x() * w_z - p.z() * w_x; };
  const auto v_of = [&](const auto& p) { return cos * p.y() - sin * (p.x() * w_x + p.z() * w_z); };
  const auto e_x = X.rotation.col(0), e_y = X.rotation.col(1);
  const Vec3 middle = X.origin + e_x * (rect.x_min + half_x) + e_y * (rect.y_min + half_y);
  const Spread sigma{sigma_of(middle),
                     std::fabs(sigma_of(e_x)) * half_x + std::fabs(sigma_of(e_y)) * half_y + kHullRounding};
  const Spread v{v_of(middle), std::fabs(v_of(e_x)) * half_x + std::fabs(v_of(e_y)) * half_y + kHullRounding};
  const double far = std::max(std::fabs(sigma.low()), std::fabs(sigma.high()));
  const double near =
      sigma.low() < 0.0 && sigma.high() > 0.0 ? 0.0 : std::min(std::fabs(sigma.low()), std::fabs(sigma.high()));
  const double s_high = far * far, s_low = near * near;
  const double r_least = R + all_.low - flats.max_depth();
  constexpr double kHorizon = 0.6;
  if (!(s_high < kHorizon * r_least * r_least)) return {};

  // which part of the profile can be over it
  double tau_least = std::sqrt(r_least * r_least - s_high),
         tau_most = std::sqrt((R + all_.high) * (R + all_.high) - s_low);
  const double stretch = r_least / tau_least, bend = s_high / (8.0 * tau_least * tau_least * tau_least);
  double y_low = 0.0, y_high = 0.0;
  Bin z = all_;
  for (int i = 0; i < 2; ++i) {
    const double a = sin * tau_least, b = sin * tau_most;
    y_low = (v.low() + std::min(a, b)) / cos - kHullRounding;
    y_high = (v.high() + std::max(a, b)) / cos + kHullRounding;
    z = range(y_low, y_high);
    if (z.low > z.high) return kNone;
    const double r = R + z.low - flats.max_depth();
    tau_least = std::sqrt(r * r - s_high);
    tau_most = std::sqrt((R + z.high) * (R + z.high) - s_low);
  }
  const bool look_early = y_high - y_low > 4.0 * v.half / cos + 5e-3;

  double d_low = 0.0, d_high = 0.0;
  if (!flats.empty()) {
    const double r_low = R + z.low - flats.max_depth(), r_high = R + z.high;
    const double from = std::asin(sigma.low() / (sigma.low() > 0.0 ? r_high : r_low));
    const double to = std::asin(sigma.high() / (sigma.high() > 0.0 ? r_low : r_high));
    flats.depths(std::atan2(n_x, n_z) + 0.5 * (from + to), 0.5 * (to - from) + kHullRounding, y_low, y_high, d_low,
                 d_high);
  }

  // A point between the two curves is moved along tau onto one of them, and so across by at most `aside`.
  const double gap = (s_high - s_low + (d_high - d_low) * 2.0 * (R + z.high)) / (2.0 * tau_least);
  const double aside = std::fabs(sin) * gap + kHullRounding;
  const double coarse = 1e-6 + 0.02 * (half_x + half_y);
  const TauCurve top{cos, sin, 1.0, R - d_low, s_low, stretch, bend, look_early};
  const TauCurve bottom{cos, sin, -1.0, R - d_high, s_high, stretch, bend, look_early};
  const double before = sin > 0.0 ? aside : 0.0, behind = sin < 0.0 ? aside : 0.0;
  const double greatest = chords_.greatest(top, y_low, y_high, v.low() - before, v.high() + behind, coarse);
  const double least = -chords_.greatest(bottom, y_low, y_high, v.low() - behind, v.high() + before, coarse);
  if (!(greatest >= least)) return kNone;
  const double origin = X.rotation.col(2).dot(X.origin);
  return HeightBounds{least - origin - kHullRounding, greatest - origin + kHullRounding, false};
}

}  // namespace treadmark::analytic
