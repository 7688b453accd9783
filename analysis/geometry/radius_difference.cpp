// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/geometry/radius_difference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/roots.hpp"

namespace treadmark::geometry {
namespace {

constexpr double kNothing = 1e-12;  // differences of radii below that are none [m]

int sign_of(double dr) { return dr > kNothing ? 1 : dr < -kNothing ? -1 : 0; }

/// A stretch on which dr is 0, between two signs.
struct Zero {
  double low, high;
  bool rising;
};

std::vector<Zero> zeros(const RadiusDifference& d) {
  std::vector<Zero> out;
  int before = 0;
  std::size_t last = 0;  // last point that is not 0
  for (std::size_t i = 0; i < d.y.size(); ++i) {
    const int sign = sign_of(d.dr[i]);
    if (sign == 0) continue;
    if (before != 0 && sign != before) {
      if (i == last + 1) {
        const double y = d.y[last] + (d.y[i] - d.y[last]) * d.dr[last] / (d.dr[last] - d.dr[i]);
        out.push_back({y, y, sign > 0});
      } else {
        out.push_back({d.y[last + 1], d.y[i - 1], sign > 0});
      }
    }
    before = sign, last = i;
  }
  if (before == 0) out.push_back({d.y.front(), d.y.back(), true});  // dr is 0 everywhere
  return out;
}

}  // namespace

KinematicMotion::KinematicMotion(RadiusDifference difference) : d_(std::move(difference)) {
  if (d_.y.size() < 2 || d_.dr.size() != d_.y.size())
    throw Error(ErrorKind::configuration, "a difference of radii needs at least two points");
  for (std::size_t i = 0; i < d_.y.size(); ++i)
    if (!std::isfinite(d_.y[i]) || !std::isfinite(d_.dr[i]) || (i > 0 && !(d_.y[i] > d_.y[i - 1])))
      throw Error(ErrorKind::configuration, "a difference of radii needs finite numbers and increasing shifts");
  s_.assign(d_.y.size(), 0.0);
  for (std::size_t i = 1; i < s_.size(); ++i)
    s_[i] = s_[i - 1] + 0.5 * (d_.dr[i] + d_.dr[i - 1]) * (d_.y[i] - d_.y[i - 1]);

  const std::vector<Zero> all = zeros(d_);
  const auto nearest = [](const Zero& z) { return std::clamp(0.0, z.low, z.high); };
  const Zero* chosen = nullptr;
  for (const Zero& z : all) {
    if (chosen == nullptr || std::fabs(nearest(z)) < std::fabs(nearest(*chosen))) chosen = &z;
    if (z.rising && (!equilibrium_ || std::fabs(nearest(z)) < std::fabs(*equilibrium_))) equilibrium_ = nearest(z);
  }
  if (!equilibrium_) {
    const auto [least, most] = ranges::minmax_element(d_.dr);
    no_equilibrium_ =
        fmt::format("no equilibrium: the radii differ by {:.3g} to {:.3g} mm at all shifts from {:.3g} to {:.3g} mm",
                    kMilli * *least, kMilli * *most, kMilli * d_.y.front(), kMilli * d_.y.back());
    return;
  }
  reference_ = nearest(*chosen);
  between_two_ = !chosen->rising;
  // energies count from the reference, so that small motion loses no digits
  const double zero = potential(reference_);
  for (double& s : s_) s -= zero;
  lowest_energy_ = potential(reference_);
  crest_.resize(s_.size());
  const std::size_t k = line().piece(reference_);
  for (std::size_t i = k + 1; i < s_.size(); ++i)
    crest_[i] = std::max(s_[i], i == k + 1 ? lowest_energy_ : crest_[i - 1]);
  for (std::size_t i = k + 1; i-- > 0;) crest_[i] = std::max(s_[i], i == k ? lowest_energy_ : crest_[i + 1]);
  highest_energy_ = std::min(crest_.front(), crest_.back());
}

double KinematicMotion::at(double y) const { return y >= d_.y.front() && y <= d_.y.back() ? line().at(y) : kNaN; }

double KinematicMotion::potential(double y) const {
  const std::size_t i = line().piece(y);
  return s_[i] + line().integral(i, y);
}

/// Where motion with this energy turns: the first shift from the reference beyond which S is greater.
double KinematicMotion::turning_point(double energy, bool right) const {
  const std::size_t k = line().piece(reference_);
  // S is a parabola in the interval, and passes the energy there once, seen from the reference.
  const auto root_in = [&](std::size_t i, double from) {
    const double curve = line().slope(i), t = from - d_.y[i];
    const double rise = (right ? 1.0 : -1.0) * (d_.dr[i] + curve * t),
                 left_over = std::max(0.0, energy - s_[i] - line().integral(i, from));
    const double root = std::sqrt(std::max(0.0, rise * rise + 2.0 * curve * left_over));
    const double length = right ? d_.y[i + 1] - from : from - d_.y[i];
    double way = rise >= 0.0 ? 2.0 * left_over / (rise + root) : (root - rise) / curve;
    if (!(way >= 0.0)) way = 0.0;  // 0 / 0: on a flat stretch
    way = std::min(way, length);
    return right ? from + way : from - way;
  };
  if (right) {
    const auto i = static_cast<std::size_t>(
        std::upper_bound(crest_.begin() + static_cast<std::ptrdiff_t>(k) + 1, crest_.end(), energy) - crest_.begin());
    if (i == crest_.size()) return d_.y.back();
    return root_in(i - 1, std::max(d_.y[i - 1], reference_));
  }
  const auto i = static_cast<std::size_t>(
      std::upper_bound(crest_.rend() - static_cast<std::ptrdiff_t>(k) - 1, crest_.rend(), energy) - crest_.rbegin());
  if (i == crest_.size()) return d_.y.front();
  const std::size_t j = crest_.size() - 1 - i;  // first point to the left with more
  return root_in(j, std::min(d_.y[j + 1], reference_));
}

/// The integral of 1 / sqrt(energy - S) over a part h of an interval, on which S is a parabola, from the roots of that
/// difference at both ends: in closed form, well conditioned for straight, bent up and bent down ones.
double KinematicMotion::passage(std::size_t i, double h, double root_from, double root_to) const {
  if (!(h > 0.0)) return 0.0;
  const double slope = line().slope(i), root_sum = root_from + root_to;
  const double bend = std::sqrt(0.5 * std::fabs(slope));
  if (!(root_sum > 0.0)) return slope > 0.0 ? kPi / bend : kInfinity;
  const double x = h * bend / root_sum;
  constexpr double kStraight = 1e-4;
  double factor = 1.0;
  if (x < kStraight)
    factor -= std::copysign(x * x / 3.0, slope);
  else if (slope > 0.0)
    factor = std::atan(x) / x;
  else
    factor = x < 1.0 ? std::atanh(x) / x : kInfinity;
  return 2.0 * h / root_sum * factor;
}

double KinematicMotion::greatest_amplitude() const {
  if (!equilibrium_) return 0.0;
  return 0.5 * (turning_point(highest_energy_, true) - turning_point(highest_energy_, false));
}

Conicity KinematicMotion::conicity(double amplitude) const {
  Conicity out{amplitude, kNaN, kNaN, kNaN, {}};
  if (!equilibrium_) {
    out.reason = no_equilibrium_;
    return out;
  }
  const auto half_width = [&](double energy) {
    out.low = turning_point(energy, false);
    out.high = turning_point(energy, true);
    return 0.5 * (out.high - out.low);
  };
  const auto refuse = [&](std::string why) {
    out.low = out.high = kNaN;
    out.reason = std::move(why);
    return out;
  };
  double low = lowest_energy_, high = highest_energy_;
  const double least = half_width(low), most = half_width(high);
  if (amplitude > most * (1.0 + 1e-12)) return refuse("beyond the shifts that are known");
  if (amplitude <= least) {
    if (between_two_)
      return refuse(fmt::format("two equilibria: below {:.3g} mm there is no motion about the middle", kMilli * least));
    out.tan_gamma = 0.0;  // the radii do not differ so far
    out.low = reference_ - amplitude, out.high = reference_ + amplitude;
    return out;
  }
  for (int n = 0; n < 200 && high > low; ++n) {
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    const double half = half_width(middle);
    constexpr double kSameAmplitude = 1e-14;  // [m]
    if (std::fabs(half - amplitude) < kSameAmplitude) {
      high = middle;
      break;
    }
    (half < amplitude ? low : high) = middle;
  }
  const double energy = high, reached = half_width(energy);
  // Motion that would turn on a crest jumps to what lies beyond it.
  constexpr double kSame = 1e-6;
  if (reached > amplitude * (1.0 + kSame) + 1e-9)
    return refuse("no motion of that amplitude: it would pass a crest between two equilibria");
  // The difference energy - S is 0 at the turning points; beside them it is summed up from there, without cancellation.
  std::size_t first = line().piece(out.low), last = line().piece(out.high);
  if (last > first && d_.y[last] >= out.high) --last;
  const auto root = [](double value) { return std::sqrt(std::max(0.0, value)); };
  const auto beside = [&](double from, double to) { return root(0.5 * std::fabs((to - from) * (at(from) + at(to)))); };
  double sum = 0.0;
  if (first == last) {
    sum = passage(first, out.high - out.low, 0.0, 0.0);
  } else {
    double before = beside(out.low, d_.y[first + 1]);
    sum = passage(first, d_.y[first + 1] - out.low, 0.0, before);
    for (std::size_t i = first + 1; i < last; ++i) {
      const double after = i + 1 == last ? beside(d_.y[last], out.high) : root(energy - s_[i + 1]);
      sum += passage(i, d_.y[i + 1] - d_.y[i], before, after);
      before = after;
    }
    sum += passage(last, out.high - d_.y[last], last == first + 1 ? before : beside(d_.y[last], out.high), 0.0);
  }
  out.tan_gamma = kPi / sum * (kPi / sum);
  return out;
}

double KinematicMotion::harmonic_conicity(double amplitude) const {
  constexpr int kPoints = 256;  // half a period, from -a to a
  const auto mean = [&](double middle, double* first) {
    double sum = 0.0, harmonic = 0.0;
    for (int k = 0; k < kPoints; ++k) {
      const double s = -std::cos(kPi * (k + 0.5) / kPoints), dr = at(middle + amplitude * s);
      sum += dr;
      harmonic += dr * s;
    }
    if (first != nullptr) *first = harmonic / kPoints;
    return sum / kPoints;
  };
  if (!equilibrium_ || !(amplitude > 0.0)) return kNaN;
  // The mean grows with the middle where dr does: bracket, then bisection.
  const double low = d_.y.front() + amplitude, high = d_.y.back() - amplitude;
  if (!(low <= high) || !(mean(low, nullptr) <= 0.0) || !(mean(high, nullptr) >= 0.0)) return kNaN;
  constexpr double kMiddle = 1e-8;  // [m]
  constexpr int kHalvings = 100;
  const auto falls = [&](double middle) { return mean(middle, nullptr) < 0.0; };
  double first = 0.0;
  mean(bisect(low, high, falls, kHalvings, kMiddle).middle(), &first);
  return first / amplitude;
}

double wavelength(double tan_gamma, double contact_distance, double radius) {
  return 2.0 * kPi * std::sqrt(contact_distance * radius / (2.0 * tan_gamma));
}

}  // namespace treadmark::geometry
