// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/geometry/wheelset_on_track.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/roots.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::geometry {
namespace {

constexpr std::size_t kStride = 2;  // samples of the wheel that are looked at first
constexpr double kApart = 2e-3;     // on the wheel, of contacts that are two [m]
constexpr double kSlack = 0.1e-3;   // by which first samples may miss a sharp minimum [m]
constexpr double kSteep = 0.7;      // no tread is as steep on its field side [rad]

/// Hermite's cubic between two samples.
struct Hermite {
  double a, b, c, d;
  Hermite(double z0, double z1, double m0, double m1)
      : a(z0), b(m0), c(3.0 * (z1 - z0) - 2.0 * m0 - m1), d(m0 + m1 - 2.0 * (z1 - z0)) {}
  double value(double u) const { return a + u * (b + u * (c + u * d)); }
  double slope(double u) const { return b + u * (2.0 * c + 3.0 * u * d); }
};

}  // namespace

bool Position::sound() const {
  const auto real = [](const Touch& t) {
    return t.end == ProfileEnd::none && !t.climbed && !t.slipping && std::isfinite(t.gap);
  };
  return real(right) && real(left);
}

WheelsetOnTrack::WheelsetOnTrack(const SideInput& right, const SideInput& left, double nominal_radius, Roll roll,
                                 double yaw)
    : sides_{Side{right, 0.0, 0.0, {}, {}, {}, {}}, Side{left, 0.0, 0.0, {}, {}, {}, {}}},
      nominal_radius_(nominal_radius),
      roll_(roll),
      yaw_(yaw),
      symmetric_(right == left) {
  for (Side& side : sides_) {
    if (!side.input.wheel || !side.input.rail || side.input.wheel->body() != Body::wheel ||
        side.input.rail->body() != Body::rail)
      throw Error(ErrorKind::configuration, "a wheelset on a track needs two sections of wheels and two of rails");
    side.z_top = rail_top(*side.input.rail, 0.0).z_top;
    side.climb_y = wheel_marks(*side.input.wheel).climb_y;
    const Section& w = *side.input.wheel;
    const std::size_t n = w.size();
    side.y.resize(n), side.z.resize(n), side.dy.assign(n, 1.0), side.dz = w.slope();
    // The outline of the turned wheel, seen along the track: of each circle the point whose normal has no part along x.
    const double sin_yaw = std::sin(yaw), cos_yaw = std::cos(yaw), tan_yaw = std::tan(yaw);
    for (std::size_t i = 0; i < n; ++i) {
      const double sin_theta = -w.slope()[i] * tan_yaw, cos_theta = std::sqrt(1.0 - sin_theta * sin_theta);
      side.y[i] = (side.input.wheel_y + w.y(i)) * cos_yaw + w.z()[i] * sin_theta * sin_yaw;
      side.z[i] = w.z()[i] * cos_theta - nominal_radius;
    }
    if (yaw == 0.0) continue;
    for (std::size_t i = 0; i < n; ++i) {
      const std::size_t a = i > 0 ? i - 1 : i, b = std::min(i + 1, n - 1);
      const double length = static_cast<double>(b - a) * w.step();
      side.dy[i] = (side.y[b] - side.y[a]) / length;
      side.dz[i] = (side.z[b] - side.z[a]) / length;
    }
  }
}

void WheelsetOnTrack::outline(const Side& side, double s, std::array<double, 4>& out) {
  const Section& w = *side.input.wheel;
  const double t = std::clamp((s - w.first()) / w.step(), 0.0, static_cast<double>(w.size() - 1));
  const std::size_t i = std::min(to_whole<std::size_t>(t), w.size() - 2);
  const double u = t - static_cast<double>(i), h = w.step();
  const Hermite y(side.y[i], side.y[i + 1], h * side.dy[i], h * side.dy[i + 1]);
  const Hermite z(side.z[i], side.z[i + 1], h * side.dz[i], h * side.dz[i + 1]);
  out = {y.value(u), z.value(u), y.slope(u) / h, z.slope(u) / h};
}

double WheelsetOnTrack::gap_at(const Side& side, double s, double y, double sin_roll, double cos_roll,
                               double* slope) const {
  std::array<double, 4> w;
  outline(side, s, w);
  const SectionPoint rail = side.input.rail->at(y + w[0] * cos_roll - w[1] * sin_roll - side.input.rail_y);
  if (slope != nullptr) *slope = rail.slope * (w[2] * cos_roll - w[3] * sin_roll) - (w[2] * sin_roll + w[3] * cos_roll);
  return rail.z - side.z_top - (w[0] * sin_roll + w[1] * cos_roll);
}

/// The minimum beside a sample that is lower than its neighbours; NaN where it certainly lies above `enough`.
WheelsetOnTrack::Minimum WheelsetOnTrack::refined(const Side& side, std::size_t i, double y, double sin_roll,
                                                  double cos_roll, double enough) const {
  const Section& w = *side.input.wheel;
  const auto gap = [&](double s, double* slope = nullptr) { return gap_at(side, s, y, sin_roll, cos_roll, slope); };
  // Towards a place beyond the rail's section: the last one over it.
  const auto last_over = [&](double inside, double outside) {
    constexpr int kHalvings = 40;
    return bisect(
               inside, outside, [&](double s) { return std::isfinite(gap(s)); }, kHalvings)
        .low;
  };
  const double reach = static_cast<double>(kStride) * w.step();
  double middle = w.y(i);
  Minimum m{kNaN, kNaN, ProfileEnd::none};
  constexpr int kMostWindows = 6;  // wiggles of measured profiles may hide a minimum from the samples
  for (int window = 0; window < kMostWindows; ++window) {
    double a = std::max(middle - reach, w.first()), b = std::min(middle + reach, w.last());
    double slope_a = kNaN, slope_b = kNaN, gap_a = gap(a, &slope_a), gap_b = gap(b, &slope_b);
    const bool rail_ends_a = !std::isfinite(gap_a), rail_ends_b = !std::isfinite(gap_b);
    if (rail_ends_a) a = last_over(middle, a), gap_a = gap(a, &slope_a);
    if (rail_ends_b) b = last_over(middle, b), gap_b = gap(b, &slope_b);
    if (!std::isfinite(gap_a) || !std::isfinite(gap_b)) return m;
    const double low = a, high = b;
    if (slope_a < 0.0 && slope_b > 0.0) {
      // A lower bound from both tangents saves most searches.
      const double cross = (gap_b - gap_a - slope_b * (b - a)) / (slope_a - slope_b);
      if (gap_a + slope_a * cross > enough + 1e-6) return m;
      int kept = 0;
      for (int k = 0; k < 60 && b - a > 1e-12; ++k) {
        // regula falsi with Illinois' halving, bisection now and then for kinks
        const double s = k % 4 == 3 ? 0.5 * (a + b) : (a * slope_b - b * slope_a) / (slope_b - slope_a);
        double f = 0.0;
        gap(s, &f);
        if (f == 0.0 || !std::isfinite(f)) {
          a = b = s;
        } else if (f < 0.0) {
          a = s, slope_a = f;
          if (kept == -1) slope_b *= 0.5;
          kept = -1;
        } else {
          b = s, slope_b = f;
          if (kept == 1) slope_a *= 0.5;
          kept = 1;
        }
      }
    } else {
      // needs no slopes
      const Bracketed least = golden_section(a, b, 1e-10, [&](double s) { return gap(s); });
      a = least.low, b = least.high;
    }
    m.s = 0.5 * (a + b);
    m.gap = gap(m.s);
    constexpr double kAtEnd = 1e-9;  // [m]
    const bool at_low = m.s - low < kAtEnd, at_high = high - m.s < kAtEnd;
    if (!at_low && !at_high) return m;
    if (at_low ? rail_ends_a : rail_ends_b)
      m.end = at_low ? ProfileEnd::rail_gauge : ProfileEnd::rail_field;
    else if (at_low ? low <= w.first() : high >= w.last())
      m.end = at_low ? ProfileEnd::wheel_flange : ProfileEnd::wheel_field;
    if (m.end != ProfileEnd::none) return m;
    middle = m.s;  // it falls beyond the window
  }
  return m;
}

void WheelsetOnTrack::minima(const Side& side, double y, double roll, double within, std::vector<Minimum>& out) const {
  out.clear();
  const Section& w = *side.input.wheel;
  const Section& rail = *side.input.rail;
  const double sin_roll = std::sin(roll), cos_roll = std::cos(roll), shift = y - side.input.rail_y;
  // Samples over the rail. y grows with s nearly one to one, so a little more is looked at.
  constexpr double kMore = 6e-3;
  const double low = rail.first() - shift - side.input.wheel_y - kMore,
               high = rail.last() - shift - side.input.wheel_y + kMore;
  const auto index = [&](double s) {
    const double t = (s - w.first()) / w.step();
    return to_whole<std::size_t>(t, 0.0, static_cast<double>(w.size() - 1));
  };
  const std::size_t from = index(low) / kStride * kStride, to = std::min(index(high) + kStride, w.size() - 1);

  struct Candidate {
    std::size_t i;
    double gap;
  };
  thread_local std::vector<Candidate> candidates;
  candidates.clear();
  thread_local std::vector<double> gaps;
  std::size_t first = from;  // sample of the first gap
  if (roll == 0.0 && yaw_ == 0.0 && w.step() == rail.step()) {
    // Both sections have their samples side by side: all gaps at once.
    const double t = (shift + side.y[from] - rail.first()) / rail.step();
    const auto whole = to_whole<std::ptrdiff_t>(std::floor(t));
    const double u = t - static_cast<double>(whole);
    const auto wheel_from = static_cast<std::ptrdiff_t>(from), rail_last = static_cast<std::ptrdiff_t>(rail.size()) - 2;
    const std::ptrdiff_t k_from = std::max<std::ptrdiff_t>(0, -whole),
                         k_to = std::min(static_cast<std::ptrdiff_t>(to) - wheel_from, rail_last - whole);
    if (k_to < k_from) return;
    first = static_cast<std::size_t>(wheel_from + k_from);
    const double* const r = rail.z().data() + whole + k_from;
    const double* const z = side.z.data() + first;
    gaps.resize(static_cast<std::size_t>(k_to - k_from) / kStride + 1);
    for (std::size_t k = 0; k < gaps.size(); ++k)
      gaps[k] = r[kStride * k] + u * (r[kStride * k + 1] - r[kStride * k]) - z[kStride * k];
  } else {
    gaps.clear();
    for (std::size_t i = from; i <= to; i += kStride) {
      const double yi = side.y[i], zi = side.z[i];
      gaps.push_back(rail.height(shift + yi * cos_roll - zi * sin_roll) - (yi * sin_roll + zi * cos_roll));
    }
  }
  // A sample is a minimum where no neighbour is lower; ends count.
  double least = kInfinity;
  for (std::size_t k = 0; k < gaps.size(); ++k) {
    const double here = gaps[k];
    if ((k > 0 && gaps[k - 1] < here) || (k + 1 < gaps.size() && gaps[k + 1] < here) || !std::isfinite(here)) continue;
    candidates.push_back({first + kStride * k, here});
    least = std::min(least, here);
  }
  if (candidates.empty()) return;
  const double z_top = side.z_top;
  ranges::sort(candidates, {}, &Candidate::gap);

  double best = kInfinity;
  for (const Candidate& c : candidates) {
    if (c.gap - z_top > std::min(best, least - z_top) + within + kSlack) break;
    const Minimum m = refined(side, c.i, y, sin_roll, cos_roll, best + within);
    if (!std::isfinite(m.gap)) continue;
    best = std::min(best, m.gap);
    out.push_back(m);
  }
  ranges::sort(out, {}, &Minimum::gap);
  while (!out.empty() && out.back().gap > out.front().gap + within) out.pop_back();
}

WheelsetOnTrack::Minimum WheelsetOnTrack::least(const Side& side, double y, double roll) const {
  thread_local std::vector<Minimum> found;
  minima(side, y, roll, 0.0, found);
  return found.empty() ? Minimum{kNaN, kNaN, ProfileEnd::none} : found.front();
}

Touch WheelsetOnTrack::touch(const Side& side, const Minimum& at, double y, double roll) const {
  Touch t;
  t.gap = at.gap;
  t.end = at.end;
  t.wheel_y = at.s;
  if (!std::isfinite(at.gap)) {
    t.rail_y = t.track_y = t.track_z = t.radius = t.angle = t.wheel_curvature = t.rail_curvature = kNaN;
    return t;
  }
  std::array<double, 4> w;
  outline(side, at.s, w);
  const double across = y + w[0] * std::cos(roll) - w[1] * std::sin(roll) - side.input.rail_y;
  const SectionPoint rail = side.input.rail->at(across), wheel = side.input.wheel->at(at.s);
  const double c = std::cos(side.input.rail_cant), s = std::sin(side.input.rail_cant);
  t.rail_y = c * across - s * rail.z;  // turned back
  t.track_y = across + side.input.rail_y;
  t.track_z = rail.z - side.z_top;
  t.radius = wheel.z;
  t.angle = -std::atan(rail.slope);
  t.wheel_curvature = wheel.curvature;
  t.rail_curvature = rail.curvature;
  t.climbed = at.s < side.climb_y;
  t.slipping = at.s > 0.0 && t.angle > kSteep;
  return t;
}

Position WheelsetOnTrack::at(double y, const Position* start) const {
  Position p;
  p.y = y;
  const Side &right = sides_[0], &left = sides_[1];
  // The left side is looked at as the mirror image: there shift and roll have the other sign.
  Minimum r, l;
  const auto difference = [&](double roll) {
    r = least(right, y, roll);
    l = least(left, -y, -roll);
    return r.gap - l.gap;
  };
  if (roll_ == Roll::none) {
    difference(0.0);
  } else {
    // The right gap falls with the roll, the left one grows: one root, in a bracket round the rigid estimate.
    const double base = right.input.wheel_y + left.input.wheel_y;
    double a = start != nullptr && std::isfinite(start->roll) ? start->roll : 0.0, fa = difference(a), b = a, fb = fa;
    constexpr double kNoDifference = 1e-13;  // [m]
    if (std::isfinite(fa) && std::fabs(fa) > kNoDifference) {
      double step = fa / base;
      for (int k = 0; k < 30 && fa * fb > 0.0; ++k) {
        a = b, fa = fb;
        b += 1.05 * step + std::copysign(1e-9, step);
        fb = difference(b);
        step = fb / base;
      }
      int kept = 0;
      for (int k = 0; k < 100 && std::isfinite(fb) && std::fabs(fb) > kNoDifference && std::fabs(a - b) > 1e-15; ++k) {
        const double c = (a * fb - b * fa) / (fb - fa), fc = difference(c);
        if (fc * fb < 0.0) {
          a = b, fa = fb, kept = 0;
        } else {
          fa *= kept == 1 ? 0.5 : 1.0;
          kept = 1;
        }
        b = c, fb = fc;
      }
    }
    p.roll = b;
  }
  p.right = touch(right, r, y, p.roll);
  p.left = touch(left, l, -y, -p.roll);
  p.z = 0.5 * (p.right.gap + p.left.gap);
  return p;
}

std::vector<Touch> WheelsetOnTrack::further_touches(const Position& position, bool right, double within) const {
  const double sign = right ? 1.0 : -1.0;
  const Side& side = sides_[right ? 0 : 1];
  std::vector<Minimum> found;
  minima(side, sign * position.y, sign * position.roll, within, found);
  std::vector<Touch> out;
  std::vector<double> taken;
  for (const Minimum& m : found) {
    const bool apart = ranges::all_of(taken, [&](double s) { return std::fabs(s - m.s) > kApart; });
    if (!apart || m.end != ProfileEnd::none) continue;
    taken.push_back(m.s);
    if (taken.size() == 1) continue;
    out.push_back(touch(side, m, sign * position.y, sign * position.roll));
    out.back().gap = m.gap - found.front().gap;
  }
  return out;
}

ForceLine force_line(const Position& p, bool right) {
  const Touch& t = right ? p.right : p.left;
  const double sign = right ? 1.0 : -1.0;
  return {sign * t.track_y - p.y, t.track_z - p.z, -sign * std::sin(t.angle), -std::cos(t.angle)};
}

Balance WheelsetOnTrack::balance(const Position& p) const {
  const ForceLine r = force_line(p, true), l = force_line(p, false);
  // weight 1 down, in the middle of the axle: above the point at rail level, turned with the roll
  const double weight_moment = nominal_radius_ * std::sin(p.roll);
  const double determinant = r.n_z * l.moment() - l.n_z * r.moment();
  Balance out{};
  out.right = (-1.0 * l.moment() + l.n_z * weight_moment) / determinant;
  out.left = (-weight_moment * r.n_z + r.moment()) / determinant;
  out.holding = -(out.right * r.n_y + out.left * l.n_y);
  return out;
}

}  // namespace treadmark::geometry
