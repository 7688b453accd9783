// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/defects/cutter_ray.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::analytic {

CutterRay::CutterRay(const Cutter& cutter, const Vec3& direction) : cutter_(&cutter), n_(direction) {
  const double c = std::cos(cutter.roll_middle()), s = std::sin(cutter.roll_middle());
  const double swing = 2.0 * std::sin(0.5 * cutter.roll_half()) * std::hypot(n_.y(), n_.z());
  least_q_ = c * n_.z() - s * n_.y() - swing;
  most_s_ = std::fabs(c * n_.y() + s * n_.z()) + swing;
}

/// Bound of the terms of dq/dt and ds/dt that come from the path, within twice the distance from its origin.
double CutterRay::rate_of_x_terms(const Cutter::Place& at) const {
  if (n_.x() == 0.0) return 0.0;
  const double reach = 2.0 * std::hypot(at.s, at.q) + 0.01;
  return std::fabs(n_.x()) * (cutter_->roll_rate() * reach + cutter_->path_slope());
}

/// The root of a gap that falls at least with a known rate: Newton from the depth of the neighbour, held between the
/// bounds known so far. at: the place of the result.
double CutterRay::descend(double t, const Cutter::Place& from, double least_rate, double t_last, Cutter::Place& at) {
  double low = t, high = t_last;
  at = from;
  if (depth_ > 0.0 && t + depth_ < t_last) at = place(t += depth_);
  constexpr double kRounding = 1e-16, kNear = 1e-9;  // [m] the error after a Newton step below kNear is below rounding
  for (int i = 0; i < 100; ++i) {
    const double gap = at.gap();
    if (gap == 0.0) return t;
    (gap > 0.0 ? low : high) = t;
    const double rate = cutter_->gradient(Cutter::kSection, at).dot(n_);
    double next = t - gap / std::min(rate, -least_rate);
    const bool held = next >= low && next <= high;
    if (!held) next = 0.5 * (low + high);
    const bool done = std::fabs(next - t) <= (held ? kNear * least_rate : kRounding) || high - low <= kRounding;
    t = next;
    at = place(t);
    if (done) break;
  }
  return t;
}

/// Where s passes an end of the section between a (inside) and b (outside).
double CutterRay::cross_end(double s_end, double a, double b) {
  const double inside = place(a).s - s_end;
  double t = b;
  for (int i = 0; i < 100 && b - a > 1e-16; ++i) {
    const Cutter::Place at = place(t);
    const double value = at.s - s_end;
    if (value == 0.0) return t;
    ((value > 0.0) == (inside > 0.0) ? a : b) = t;
    double next = t - value / (at.s_x * n_.x() + at.cos * n_.y() + at.sin * n_.z());
    if (!(next > a && next < b)) next = 0.5 * (a + b);
    if (next == t) break;
    t = next;
  }
  return t;
}

/// Steps that never pass a bound, because none of them changes faster than the rate used (Hart 1996). Steps are at
/// least kLeastStep long: what is thinner along the line may be passed over.
double CutterRay::march(double t, Cutter::Bound& bound) {
  constexpr double kLeastStep = 1e-7;  // [m]
  constexpr int kSteps = 200'000;
  constexpr Cutter::Bound kBounds[] = {Cutter::kSection, Cutter::kStart, Cutter::kEnd, Cutter::kFirst, Cutter::kLast};
  for (int i = 0; i < kSteps; ++i) {
    const Cutter::Place at = place(t);
    double step = std::numeric_limits<double>::infinity();
    const double path = rate_of_x_terms(at), s_rate = most_s_ + path, q_rate = 1.0 + path;
    for (const Cutter::Bound b : kBounds) {
      const double rate = b == Cutter::kSection                       ? cutter_->steepest() * s_rate + q_rate
                          : b == Cutter::kFirst || b == Cutter::kLast ? std::fabs(n_.x())
                                                                      : s_rate;
      if (rate > 0.0) step = std::min(step, cutter_->value(b, at, x(t)) / rate);
    }
    step = std::min(step, 0.5 * std::hypot(at.s, at.q) + 0.005);  // the rates hold so far
    if (step > kLeastStep) {
      t += step;
      continue;
    }
    // a bound is near: look just behind it, else creep on
    double a = t, b = t + kLeastStep;
    const auto outside = [&](double at_t, Cutter::Bound* which) {
      const Cutter::Place p = place(at_t);
      for (const Cutter::Bound k : kBounds)
        if (!(cutter_->value(k, p, x(at_t)) > 0.0)) {
          if (which != nullptr) *which = k;
          return true;
        }
      return false;
    };
    if (!outside(b, &bound)) {
      t = b;
      continue;
    }
    for (int k = 0; k < 40; ++k) {
      const double m = 0.5 * (a + b);
      (outside(m, &bound) ? b : a) = m;
    }
    return b;
  }
  return t;
}

bool CutterRay::leave(const Vec3& origin, double t, Hit& hit) {
  o_ = origin;
  const double x0 = x(t);
  if (!(x0 > cutter_->x_min() && x0 < cutter_->x_max())) return false;
  const Cutter::Place from = place(t);
  if (!(from.gap() > 0.0 && cutter_->in_domain(from, x0))) return false;

  const double path = rate_of_x_terms(from);
  const double least_rate = least_q_ - path - cutter_->steepest() * (most_s_ + path);
  const double t_last = t + from.gap() / least_rate;
  constexpr double kLeastRate = 0.02;
  hit.bound = Cutter::kSection;
  if (least_rate > kLeastRate && t_last - t < std::hypot(from.s, from.q) + 0.01) {
    Cutter::Place at;
    hit.t = descend(t, from, least_rate, t_last, at);
    depth_ = hit.t - t;
    const double s = at.s;
    if (s < cutter_->s_min() || s > cutter_->s_max()) {
      hit.bound = s < cutter_->s_min() ? Cutter::kStart : Cutter::kEnd;
      hit.t = cross_end(s < cutter_->s_min() ? cutter_->s_min() : cutter_->s_max(), t, hit.t);
    }
    const double x_hit = x(hit.t);
    if (x_hit < cutter_->x_min() || x_hit > cutter_->x_max()) {
      hit.bound = x_hit < cutter_->x_min() ? Cutter::kFirst : Cutter::kLast;
      hit.t = ((x_hit < cutter_->x_min() ? cutter_->x_min() : cutter_->x_max()) - o_.x()) / n_.x();
    }
    if (hit.bound == Cutter::kSection) {
      hit.gradient = cutter_->gradient(hit.bound, at);
      return true;
    }
  } else {
    hit.t = march(t, hit.bound);
  }
  hit.gradient = cutter_->gradient(hit.bound, place(hit.t));
  return true;
}

}  // namespace treadmark::analytic
