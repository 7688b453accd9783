// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measured/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include <Eigen/Dense>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::measured {
namespace {

constexpr double kBeyondRest = 15e-3;  ///< what reaches so far beyond the tread is a flange [m]
constexpr double kTapeToBack = 70e-3;  ///< from the back of the flange to the tape line [m]
constexpr double kBelowTip = 5e-3;     ///< the back of a flange begins there [m]
constexpr double kStep = 0.25e-3;      ///< of an envelope [m]

/// The line along which most of an envelope lies, level or sloped as in a tilted frame: least median of squares
/// (Rousseeuw 1984), which half of the section may miss.
struct Rest {
  double height = 0.0, slope = 0.0;  ///< at the first place; per step
  double at(std::size_t i) const { return height + slope * static_cast<double>(i); }
};

/// What reaches beyond the rest: widest run, its middle, how far it reaches, and the same of another one beside it.
struct Flange {
  Rest rest;
  double width = 0.0, middle = 0.0, reach = 0.0, second_width = 0.0, second_middle = 0.0;
};

/// The outer side of a section: over y at equal steps the greatest of sign * z, NaN where nothing was measured. The
/// upright faces at both ends are left out.
struct Envelope {
  double first = 0.0;
  std::vector<double> height;
  mutable std::optional<Flange> flange;  ///< once it was looked for

  double y(std::size_t i) const { return first + kStep * static_cast<double>(i); }
};

Envelope envelope(const SectionPoints& p, double sign) {
  constexpr double kFace = 1e-3;
  Envelope e;
  const auto [low, high] = std::minmax_element(p.y.begin(), p.y.end());
  const double margin = std::min(kFace, 0.05 * (*high - *low));
  e.first = *low + margin;
  const double width = *high - *low - 2.0 * margin;
  e.height.assign(to_whole<std::size_t>(std::max(0.0, width) / kStep) + 1, kNaN);
  const auto last = static_cast<double>(e.height.size() - 1);
  for (std::size_t i = 1; i < p.y.size(); ++i) {
    double y0 = p.y[i - 1], y1 = p.y[i], z0 = sign * p.z[i - 1], z1 = sign * p.z[i];
    if (y0 > y1) std::swap(y0, y1), std::swap(z0, z1);
    const double from = std::ceil((y0 - e.first) / kStep), to = std::floor((y1 - e.first) / kStep);
    for (double k = std::max(from, 0.0); k <= std::min(to, last); ++k) {
      const double t = y1 > y0 ? (e.first + kStep * k - y0) / (y1 - y0) : 0.0;
      double& height = e.height[static_cast<std::size_t>(k)];
      height = std::fmax(height, z0 + t * (z1 - z0));
    }
  }
  return e;
}

double quantile(std::vector<double> values, double share) {
  std::erase_if(values, [](double v) { return std::isnan(v); });
  if (values.empty()) return kNaN;
  const auto at = values.begin() + to_whole<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

Rest rest_of(const Envelope& e) {
  constexpr std::size_t kSamples = 64;
  constexpr int kSlopes = 40;  // to each side of level
  constexpr double kSteepest = 0.2;
  struct Sample {
    double place, height, rest;
  };
  std::vector<Sample> samples;
  for (std::size_t k = 0; k < kSamples && !e.height.empty(); ++k)
    if (const std::size_t i = k * (e.height.size() - 1) / (kSamples - 1); !std::isnan(e.height[i]))
      if (const auto place = static_cast<double>(i); samples.empty() || samples.back().place != place)
        samples.push_back({place, e.height[i], 0.0});
  if (samples.empty()) return {};
  const std::size_t half = samples.size() / 2;
  std::array<std::pair<double, Rest>, 2 * kSlopes + 1> narrowest;  // of each slope
  for (int k = -kSlopes; k <= kSlopes; ++k) {
    const double slope = kStep * kSteepest * k / kSlopes;
    for (Sample& sample : samples) sample.rest = sample.height - slope * sample.place;
    // as slopes grow, two samples change their order once
    for (std::size_t i = 1; i < samples.size(); ++i)
      for (std::size_t j = i; j > 0 && samples[j].rest < samples[j - 1].rest; --j)
        std::swap(samples[j], samples[j - 1]);
    auto& [width, rest] = narrowest[static_cast<std::size_t>(k + kSlopes)];
    width = kInfinity;
    for (std::size_t i = 0; i + half < samples.size(); ++i)
      if (const double between = samples[i + half].rest - samples[i].rest; between < width)
        width = between, rest = {0.5 * (samples[i].rest + samples[i + half].rest), slope};
  }
  std::pair<double, Rest> best = narrowest[kSlopes];  // of equal ones the most level
  for (int k = 1; k <= kSlopes; ++k)
    for (const int sign : {1, -1})
      if (const auto& other = narrowest[static_cast<std::size_t>(kSlopes + sign * k)]; other.first < best.first)
        best = other;
  return best.second;
}

/// Of the places that belong (Theil 1950, Sen 1968); nothing where they are less than `least` wide.
template <class Belongs>
std::optional<Trend> trend_of(const Envelope& e, double least, Belongs belongs) {
  std::vector<std::size_t> at;
  for (std::size_t i = 0; i < e.height.size(); ++i)
    if (!std::isnan(e.height[i]) && belongs(i)) at.push_back(i);
  if (at.size() < 4 || kStep * static_cast<double>(at.back() - at.front()) < least) return std::nullopt;
  const std::size_t half = at.size() / 2;
  std::vector<double> slopes;
  for (std::size_t k = 0; k + half < at.size(); ++k)
    slopes.push_back((e.height[at[k + half]] - e.height[at[k]]) / (kStep * static_cast<double>(at[k + half] - at[k])));
  Trend trend{quantile(slopes, 0.5), 0.0};
  for (double& s : slopes) s = std::fabs(s - trend.slope);
  trend.spread = quantile(std::move(slopes), 0.5);
  return trend;
}

const Flange& flange_of(const Envelope& e) {
  if (e.flange) return *e.flange;
  Flange& f = e.flange.emplace();
  const Rest& rest = f.rest = rest_of(e);
  std::size_t from = e.height.size();
  const auto close = [&](std::size_t to) {
    const double width = kStep * static_cast<double>(to - from), middle = 0.5 * (e.y(from) + e.y(to - 1));
    if (width > f.width) {
      f.second_width = f.width, f.second_middle = f.middle;
      f.width = width, f.middle = middle;
    } else if (width > f.second_width) {
      f.second_width = width, f.second_middle = middle;
    }
    from = e.height.size();
  };
  for (std::size_t i = 0; i < e.height.size(); ++i) {
    const double over = e.height[i] - rest.at(i);
    if (over > f.reach) f.reach = over;
    if (over > kBeyondRest && from == e.height.size()) from = i;
    if (!(over > kBeyondRest) && from < e.height.size()) close(i);
  }
  if (from < e.height.size()) close(e.height.size());
  return f;
}

/// Straight line through the envelope: how much it rises over its width.
double rise_of(const Envelope& e) {
  double n = 0.0, sy = 0.0, sz = 0.0, syy = 0.0, syz = 0.0;
  for (std::size_t i = 0; i < e.height.size(); ++i) {
    if (std::isnan(e.height[i])) continue;
    const double y = e.y(i) - e.first;
    n += 1.0, sy += y, sz += e.height[i], syy += y * y, syz += y * e.height[i];
  }
  const double square = n * syy - sy * sy;
  return square > 0.0 ? (n * syz - sy * sz) / square * kStep * static_cast<double>(e.height.size()) : 0.0;
}

Readings wheel_z(const Envelope& down, const Envelope& up) {
  constexpr double kLeastWidth = 3e-3;
  const Flange &as_it_is = flange_of(down), &turned = flange_of(up);
  if (std::max(as_it_is.width, turned.width) >= kLeastWidth) {
    const Flange& best = turned.width > as_it_is.width ? turned : as_it_is;
    return {kMilli * as_it_is.width, kMilli * turned.width,
            fmt::format("a flange that reaches {:.1f} mm beyond the tread, {:.1f} mm wide there", kMilli * best.reach,
                        kMilli * best.width),
            true};
  }
  if (std::max(as_it_is.reach, turned.reach) >= kBeyondRest)
    return {
        as_it_is.reach, turned.reach,
        fmt::format("an end that reaches {:.1f} mm beyond the tread", kMilli * std::max(as_it_is.reach, turned.reach)),
        true};
  // no flange: a tread tapers off to the field side
  const double rise = rise_of(down);
  return {kMilli * std::max(0.0, -rise), kMilli * std::max(0.0, rise),
          fmt::format("no flange; the tread {} by {:.2f} mm to the field side", rise > 0.0 ? "grows" : "tapers off",
                      kMilli * std::fabs(rise)),
          false};
}

/// How far both ends of an envelope lie beyond the rest.
struct Ends {
  double first = 0.0, last = 0.0;
  double mean() const { return 0.5 * (first + last); }
};

Ends ends_of(const Envelope& e) {
  constexpr std::size_t kEnd = 5;  // steps
  const double middle = quantile(e.height, 0.5);
  const auto mean = [&](std::size_t from) {
    double sum = 0.0, n = 0.0;
    for (std::size_t i = from; i < std::min(from + kEnd, e.height.size()); ++i)
      if (!std::isnan(e.height[i])) sum += e.height[i], n += 1.0;
    return n > 0.0 ? sum / n - middle : 0.0;
  };
  return {mean(0), mean(e.height.size() - std::min(kEnd, e.height.size()))};
}

/// Curvature of a parabola through the points, over its standard deviation.
double bend_of(const Envelope& e) {
  const double middle = e.y(e.height.size() / 2),
               half = std::max(0.5 * kStep * static_cast<double>(e.height.size()), kStep);
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  double squares = 0.0, count = 0.0;
  for (std::size_t i = 0; i < e.height.size(); ++i) {
    if (std::isnan(e.height[i])) continue;
    const double t = (e.y(i) - middle) / half;
    const Eigen::Vector3d row(1.0, t, t * t);
    normal += row * row.transpose();
    right += row * e.height[i];
    squares += e.height[i] * e.height[i];
    count += 1.0;
  }
  constexpr double kFewest = 5.0, kLeast = 1e-9;  // kLeast: of exact parabolas [m]
  if (!(count > kFewest)) return 0.0;
  const Eigen::Matrix3d inverse = normal.inverse();
  const Eigen::Vector3d c = inverse * right;
  const double variance = std::max(0.0, squares - c.dot(right)) / (count - 3.0) * inverse(2, 2);
  return c[2] / std::max(std::sqrt(std::max(0.0, variance)), kLeast);
}

Readings rail_z(const Envelope& down, const Envelope& up) {
  constexpr double kSides = 3e-3, kGrooved = 15e-3;
  // sides that fall away, seen from above and, were it turned over, from below
  const Ends above = ends_of(up), below = ends_of(down);
  const double as_it_is = -above.mean(), turned = -below.mean();
  const double top = quantile(up.height, 1.0), bottom = quantile(up.height, 0.0);
  const Ends& better = turned > as_it_is ? below : above;
  const bool one_rises = std::max(better.first, better.last) > kSides, grooved = top - bottom > kGrooved;
  if (std::max(as_it_is, turned) > kSides && !(one_rises && grooved))
    return {kMilli * std::max(0.0, as_it_is), kMilli * std::max(0.0, turned),
            fmt::format("sides that fall {:.1f} mm below the head", kMilli * std::max(as_it_is, turned)), true};
  // beside a groove, where one end is a keeper or check rail, of whatever height, or the head was not measured to its
  // side: more of the section is up on the rims than down in the groove. Each less half of the other: two fifths more
  // are sure.
  if (grooved) {
    const auto width = [&](auto&& belongs) {
      return kStep * static_cast<double>(ranges::count_if(up.height, belongs));
    };
    const double middle = 0.5 * (top + bottom), high = width([&](double h) { return h > middle; }),
                 low = width([&](double h) { return h < middle; });
    return {kMilli * std::max(0.0, high - 0.5 * low), kMilli * std::max(0.0, low - 0.5 * high),
            fmt::format("{:.1f} mm of it near its top and {:.1f} mm near its bottom", kMilli * high, kMilli * low),
            true};
  }
  const double bend = bend_of(up);
  return {std::max(0.0, -bend), std::max(0.0, bend),
          fmt::format("a crown whose curvature is {:.2g} times its standard deviation", std::fabs(bend)), true};
}

/// On which side the flange is: as_it_is on that of small y.
Readings wheel_y(const Envelope& e, bool& second) {
  constexpr double kLeastWidth = 3e-3, kAsWide = 0.5;
  const Flange& f = flange_of(e);
  const double middle = e.y(e.height.size() / 2);
  second = f.second_width > kLeastWidth && f.second_width > kAsWide * f.width &&
           (f.middle < middle) != (f.second_middle < middle);
  if (second) return {1.0, 1.0, "a flange on both sides", true};
  if (f.width >= kLeastWidth)
    return {f.middle < middle ? kMilli * f.width : 0.0, f.middle < middle ? 0.0 : kMilli * f.width,
            fmt::format("the flange at y = {:.1f} mm", kMilli * f.middle), true};
  return {0.0, 0.0, "no flange", false};
}

void negate(std::vector<double>& values) {
  for (double& v : values) v = -v;
}

void shift(std::vector<double>& values, double by) {
  for (double& v : values) v += by;
}

/// Least squares line x = a + b t; its slope.
double slope_of(const std::vector<double>& t, const std::vector<double>& x) {
  double mt = 0.0, mx = 0.0, tt = 0.0, tx = 0.0;
  const auto n = static_cast<double>(t.size());
  for (std::size_t i = 0; i < t.size(); ++i) mt += t[i] / n, mx += x[i] / n;
  for (std::size_t i = 0; i < t.size(); ++i) tt += (t[i] - mt) * (t[i] - mt), tx += (t[i] - mt) * (x[i] - mx);
  return tt > 0.0 ? tx / tt : 0.0;
}

double extent_of(const std::vector<double>& values) {
  const auto [low, high] = ranges::minmax(values);
  return high - low;
}

/// Least squares parabola x = c0 + c1 u + c2 u^2 through five points or more, u = (t - middle) / half.
struct Parabola {
  Eigen::Vector3d c;
  double middle, half;
};

Parabola parabola(const std::vector<double>& t, const std::vector<double>& x) {
  const auto [from, to] = std::minmax_element(t.begin(), t.end());
  Parabola out{Eigen::Vector3d::Zero(), 0.5 * (*from + *to), std::max(0.5 * (*to - *from), 1e-9)};
  Eigen::Matrix3d normal = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < t.size(); ++i) {
    const double u = (t[i] - out.middle) / out.half;
    const Eigen::Vector3d row(1.0, u, u * u);
    normal += row * row.transpose();
    right += row * (x[i] - x.front());
  }
  out.c = normal.ldlt().solve(right);
  out.c[0] += x.front();
  return out;
}

/// The least x of a parabola x(t) through the points, in their range; `otherwise` for fewer than five.
double least_of_parabola(const std::vector<double>& t, const std::vector<double>& x, double otherwise) {
  if (t.size() < 5) return otherwise;
  const Eigen::Vector3d c = parabola(t, x).c;
  const auto at = [&](double u) { return c[0] + u * (c[1] + u * c[2]); };
  double best = std::min(at(-1.0), at(1.0));
  if (const double u = c[2] > 0.0 ? -0.5 * c[1] / c[2] : 2.0; std::fabs(u) < 1.0) best = at(u);
  return best;
}

/// The back of the flange: its straight part, or where little of that was measured the place where the section behind
/// its tip runs upright and reaches farthest.
void find_back(const SectionPoints& p, std::size_t tip, WheelMarks& marks) {
  constexpr double kLeastChord = 2e-3, kUpright = 10.0 * kPi / 180.0;
  // the end of the section on the side of small y, whichever way it runs
  const bool back_first = p.y.front() < p.y.back();
  const auto at = [&](std::size_t k) { return back_first ? k : p.y.size() - 1 - k; };
  const std::size_t count = back_first ? tip : p.y.size() - 1 - tip;
  std::vector<double> y, z;
  for (std::size_t k = 0; k < count; ++k)
    if (p.z[tip] - p.z[at(k)] > kBelowTip && p.y[at(k)] < p.y[tip]) y.push_back(p.y[at(k)]), z.push_back(p.z[at(k)]);
  if (y.size() < 2) return;
  if ((marks.straight = straight_back(y, z, p.z[tip]))) {
    marks.back_y = marks.straight->y;
    return;
  }
  double apart = 0.0;
  for (std::size_t i = 1; i < y.size(); ++i)
    apart += std::hypot(y[i] - y[i - 1], z[i] - z[i - 1]) / static_cast<double>(y.size() - 1);
  const double chord = std::max(kLeastChord, 2.2 * apart);
  const double least = *std::min_element(y.begin(), y.end());
  const auto farthest = static_cast<std::size_t>(std::min_element(y.begin(), y.end()) - y.begin());
  std::vector<double> near_y, near_z;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (std::fabs(z[i] - z[farthest]) <= chord) near_y.push_back(y[i]), near_z.push_back(z[i]);
  if (near_y.size() < 2 || std::fabs(std::atan(slope_of(near_z, near_y))) > kUpright) return;
  marks.back_y = least_of_parabola(near_z, near_y, least);
}

/// Of the line through the lowest points of both halves of a section.
double tips_lean(const SectionPoints& p) {
  const auto [low, high] = ranges::minmax(p.y);
  std::array<std::size_t, 2> tip{p.y.size(), p.y.size()};
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    std::size_t& of = tip[p.y[i] > 0.5 * (low + high)];
    if (of == p.y.size() || p.z[i] > p.z[of]) of = i;
  }
  return std::atan2(p.z[tip[1]] - p.z[tip[0]], p.y[tip[1]] - p.y[tip[0]]);
}

/// Of the tread at y = 0: mean of what was measured within a millimetre beside it, sloped out.
std::optional<double> tape_height(const SectionPoints& p) {
  constexpr double kNear = 2e-3;
  std::vector<double> y, z;
  for (std::size_t i = 0; i < p.y.size(); ++i)
    if (std::fabs(p.y[i]) <= kNear) y.push_back(p.y[i]), z.push_back(p.z[i]);
  if (y.size() >= 5) {
    const auto [c, middle, half] = parabola(y, z);
    const double u = -middle / half;
    return c[0] + u * (c[1] + u * c[2]);
  }
  for (std::size_t i = 1; i < p.y.size(); ++i)
    if ((p.y[i - 1] <= 0.0) != (p.y[i] <= 0.0)) {
      const double t = p.y[i - 1] / (p.y[i - 1] - p.y[i]);
      return p.z[i - 1] + t * (p.z[i] - p.z[i - 1]);
    }
  return std::nullopt;
}

void find_marks(const SectionPoints& p, const Envelope& e, WheelMarks& marks) {
  constexpr double kOfTread = 5e-3, kLeastTread = 30e-3;
  const Flange& f = flange_of(e);
  marks.tape_z = tape_height(p);
  marks.tread =
      trend_of(e, kLeastTread, [&](std::size_t i) { return std::fabs(e.height[i] - f.rest.at(i)) < kOfTread; });
  if (f.width <= 0.0) return;
  const auto tip = static_cast<std::size_t>(std::max_element(p.z.begin(), p.z.end()) - p.z.begin());
  marks.tip_y = p.y[tip], marks.tip_z = p.z[tip];
  constexpr double kBeyond = 1e-3, kFace = 10e-3;
  const auto [low, high] = std::minmax_element(p.y.begin(), p.y.end());
  marks.tip_seen = p.y[tip] - *low > kBeyond && *high - p.y[tip] > kBeyond;
  marks.face_y.reset();
  for (std::size_t i = 1; marks.tape_z && i < p.y.size(); ++i) {
    const double a = p.z[i - 1] - *marks.tape_z - kFace, b = p.z[i] - *marks.tape_z - kFace;
    const double y = a != b ? p.y[i - 1] + a / (a - b) * (p.y[i] - p.y[i - 1]) : p.y[i];
    if ((a > 0.0) != (b > 0.0) && y > p.y[tip] && (!marks.face_y || y > *marks.face_y)) marks.face_y = y;
  }
  find_back(p, tip, marks);
}

class Reader {
 public:
  Reader(SectionPoints& points, const Words& words) : p_(points), w_(words) {}

  Understanding understand() {
    if (p_.y.size() < 2) return std::move(u_);
    turn_z();
    turn_y();
    if (p_.body == Body::rail) {
      constexpr double kTop = 6e-3;  // without sides
      double top = -kInfinity;
      for (const double h : up_.height)
        if (h > top) top = h;
      u_.head = trend_of(up_, kLeastHead, [&](std::size_t i) { return up_.height[i] > top - kTop; });
      if (u_.head) u_.head->slope *= -1.0;
    } else {
      find_marks(p_, down_, u_.wheel);
      if (w_.place || w_.z_is_radius) place_wheel();
      note_burr();
      judge_place();
    }
    return std::move(u_);
  }

 private:
  void doubt(const char* name, std::string text) { u_.doubts.push_back({name, std::move(text)}); }

  void look() { down_ = envelope(p_, 1.0), up_ = envelope(p_, -1.0); }
  void mirror_y() {
    negate(p_.y);
    look();
    u_.mirrored_y = true;
  }

  void turn_z() {
    // radii grow outwards, which is down where a wheel stands on its rail
    const Turn said = w_.z_is_radius ? Turn::no : w_.mirror_z;
    if (said == Turn::yes) negate(p_.z);
    look();
    u_.z = p_.body == Body::wheel ? wheel_z(down_, up_) : rail_z(down_, up_);
    u_.mirrored_z = said == Turn::yes;
    const bool wrong = u_.z.is_turned();
    if (said == Turn::decide && wrong && u_.z.marked) {
      negate(p_.z);
      std::swap(down_, up_);
      u_.mirrored_z = true;
      if (!u_.z.sure())
        doubt("upside_down", fmt::format("which way z points is not sure: mirrored in z it shows {} (evidence {:.3g} "
                                         "against {:.3g}): set mirror_z = \"yes\" or \"no\"",
                                         u_.z.evidence, u_.z.turned, u_.z.as_it_is));
    } else if (wrong && u_.z.marked) {
      doubt("upside_down", fmt::format("z seems to point up, mirrored in z it shows {}: set mirror_z = \"{}\"",
                                       u_.z.evidence, said == Turn::yes ? "no" : "yes"));
    } else if (said == Turn::decide && w_.place && u_.z.turned > kRise && p_.y.size() >= kFewest) {
      doubt("upside_down",
            fmt::format(
                "nothing shows for certain which way y and z point: {}, as if z pointed up or the field side were "
                "on the side of small y; taken as in the file: set mirror_z or mirror_y",
                u_.z.evidence));
    } else if (said == Turn::decide && !u_.z.sure() && has_evidence()) {
      doubt("upside_down", fmt::format("which way z points is not sure: as in the file it shows {} (evidence {:.3g} "
                                       "against {:.3g}): set mirror_z = \"yes\" or \"no\"",
                                       u_.z.evidence, u_.z.as_it_is, u_.z.turned));
    } else if (said == Turn::decide && w_.place && !u_.z.marked && p_.y.size() >= kFewest) {
      u_.taken_as_it_is = true;
      u_.notes.push_back(
          "no flange is in the section, which alone would show which way y and z point: taken as in the file, y to the "
          "field side and z down; set mirror_y or mirror_z where that is wrong");
    }
  }

  /// A sketch of fewer points or a piece of a tread shows nothing, and is taken as it is.
  static constexpr std::size_t kFewest = 10;
  static constexpr double kRise = 1.0;  ///< of a tread that speaks for the other sense [mm]
  static constexpr double kLeastHead = 20e-3;
  bool has_evidence() const { return p_.y.size() >= kFewest && u_.z.marked; }

  void turn_y() {
    if (w_.mirror_y == Turn::yes) mirror_y();
    if (p_.body == Body::rail) return;
    u_.y = wheel_y(down_, u_.wheel.second_flange);
    if (u_.wheel.second_flange) u_.wheel.tips_lean = tips_lean(p_);
    if (!u_.y.is_turned()) return;
    if (w_.mirror_y == Turn::decide && w_.place) {
      mirror_y();
      u_.notes.push_back(
          fmt::format("{}, on the side of great y as that of a left wheel: y was mirrored", u_.y.evidence));
      return;
    }
    doubt("flange_side", fmt::format("{}, on the side of great y, as that of a left wheel: set mirror_y = {}",
                                     u_.y.evidence, u_.mirrored_y ? "false" : "true"));
  }

  void move(double dy, double dz) {
    shift(p_.y, dy), shift(p_.z, dz);
    u_.shift_y += dy, u_.shift_z += dz;
    down_ = envelope(p_, 1.0);
    find_marks(p_, down_, u_.wheel);
  }

  void place_wheel() {
    constexpr double kSameY = 0.5e-3, kSameZ = 5e-3;
    WheelMarks& m = u_.wheel;
    bool moved = false;
    if (w_.place && m.back_y && !m.second_flange && std::fabs(*m.back_y + kTapeToBack) > kSameY) {
      const double back = *m.back_y;
      move(-kTapeToBack - back, 0.0);
      moved = true;
      u_.notes.push_back(
          fmt::format("y counts from elsewhere: the back of the flange is at y = {:.2f} mm, so y = 0 was "
                      "put on the tape line, 70 mm from it",
                      kMilli * back));
    }
    if (!m.tape_z) return;
    const double tape = *m.tape_z;
    if (w_.z_is_radius)
      u_.notes.push_back(
          fmt::format("the column of radii has {:.3f} mm at the tape line, where z = 0 was put", kMilli * tape));
    else if (std::fabs(tape) > kSameZ)
      u_.notes.push_back(
          fmt::format("z counts from elsewhere: the tread lies at z = {:.2f} mm at the tape line, where "
                      "z = 0 was put: the nominal radius is that of the tape line",
                      kMilli * tape));
    else if (!moved)
      return;
    if (tape != 0.0) move(0.0, -tape);
  }

  void note_burr() {
    constexpr double kBurr = 0.3e-3;
    if (const auto& back = u_.wheel.straight; back && back->beyond > kBurr)
      u_.notes.push_back(fmt::format(
          "something stands {:.2f} mm out of the back of the flange, as a burr does: the back is its straight part, "
          "{:.0f} mm long",
          kMilli * back->beyond, kMilli * back->length));
  }

  void judge_place() {
    constexpr double kTipNew = -55e-3, kTipOff = 2e-3, kLowest = 20e-3, kHighest = 42e-3;
    const WheelMarks& m = u_.wheel;
    if (!w_.place || m.second_flange || !m.tip_y) return;
    const double height = *m.tip_z - m.tape_z.value_or(0.0);
    if (m.tape_z && ((m.tip_seen && height < kLowest) || height > kHighest))
      doubt("flange_height",
            fmt::format("the flange is {:.1f} mm high, 26 to 36 mm are usual: are the unit and the sense of z right{}?",
                        kMilli * height, w_.z_is_radius ? " (radii, no diameters)" : ""));
    if (m.back_y || u_.y.is_turned()) return;
    constexpr double kThinnest = 20e-3, kThickest = 36e-3;  // of flanges
    const double thickness = m.face_y ? *m.face_y + kTapeToBack : kNaN;
    if (m.tip_seen ? std::fabs(*m.tip_y - kTipNew) > kTipOff : thickness < kThinnest || thickness > kThickest)
      doubt(
          "tape_line",
          fmt::format("y = 0 seems not to be the tape line: the {} of the flange is at y = {:.1f} mm, where {} mm are "
                      "usual, and the back of the flange is not in the section: measure it too, or shift y",
                      m.tip_seen ? "tip" : "face", kMilli * (m.tip_seen ? *m.tip_y : *m.face_y),
                      m.tip_seen ? "-55" : "-50 to -34"));
  }

  SectionPoints& p_;
  const Words& w_;
  Understanding u_;
  Envelope down_, up_;  ///< of the points as they are
};

}  // namespace

bool Readings::sure() const {
  constexpr double kTimes = 3.0;
  return std::max(as_it_is, turned) >= kTimes * std::min(as_it_is, turned);
}

std::optional<FlangeBack> straight_back(std::span<const double> y, std::span<const double> z, double tip_z) {
  constexpr double kFillet = 18.5e-3;  // below the tip of EN 13715 it ends
  constexpr double kSeen = 40e-3, kLeast = 6e-3, kNear = 0.15e-3, kNearest = 0.02e-3, kDeviations = 3.0;
  constexpr std::size_t kFewest = 6;
  constexpr int kRounds = 8;
  // seen from behind: how far out over the depth below the fillet
  SectionPoints out{Body::wheel, {}, {}};
  double beyond = 0.0;
  for (std::size_t i = 0; i < y.size(); ++i)
    if (const double depth = tip_z - z[i] - kFillet; depth >= 0.0 && depth <= kSeen)
      out.y.push_back(depth), out.z.push_back(-y[i]);
  if (out.y.size() < kFewest || extent_of(out.y) < kLeast) return std::nullopt;
  // most of it lies along a line, whatever stands out of it or falls back
  const Envelope e = envelope(out, 1.0);
  const Rest rest = rest_of(e);
  double slope = rest.slope / kStep, at_fillet = rest.height - slope * e.first, near = kNear;
  std::vector<double> t, x;
  for (int round = 0; round < kRounds; ++round) {
    t.clear(), x.clear();
    for (std::size_t i = 0; i < out.y.size(); ++i)
      if (std::fabs(out.z[i] - at_fillet - slope * out.y[i]) < near) t.push_back(out.y[i]), x.push_back(out.z[i]);
    if (t.size() < kFewest || 2 * t.size() < out.y.size() || extent_of(t) < kLeast) return std::nullopt;
    slope = slope_of(t, x);
    const auto n = static_cast<double>(t.size());
    double sum = 0.0, squares = 0.0;
    for (std::size_t i = 0; i < t.size(); ++i) sum += x[i] - slope * t[i];
    at_fillet = sum / n;
    for (std::size_t i = 0; i < t.size(); ++i) squares += std::pow(x[i] - slope * t[i] - at_fillet, 2);
    near = std::clamp(kDeviations * std::sqrt(squares / n), kNearest, near);  // the foot of a burr is outside
  }
  for (std::size_t i = 0; i < y.size(); ++i)
    if (const double depth = tip_z - z[i] - kFillet; depth > kBelowTip - kFillet && depth <= kSeen)
      beyond = std::max(beyond, -y[i] - at_fillet - slope * depth);
  const auto count = static_cast<double>(t.size());
  double middle = 0.0, squares = 0.0;
  for (const double depth : t) middle += depth / count;
  for (const double depth : t) squares += (depth - middle) * (depth - middle);
  return FlangeBack{-at_fillet, -std::atan(slope), extent_of(t), beyond,
                    std::sqrt(1.0 / count + middle * middle / squares)};
}

RailOutline outline_of_rail(const SectionPoints& p) {
  constexpr double kLow = 90e-3, kHigh = 300e-3;  // of rails; a file in um that is read as mm is no rail
  constexpr double kEnd = 15e-3, kShoulder = 30e-3, kDeep = 10e-3, kInwards = 1e-3, kClosed = 5e-3;
  constexpr double kLeastHead = 40e-3, kWidestHead = 120e-3, kWidestWeb = 45e-3, kWebFrom = 0.55, kWebTo = 0.75;
  constexpr double kNoGroove = 100e-3, kBelowGroove = 55e-3;  // EN 14811: heads 113 mm wide, grooves 47 mm deep
  const std::size_t n = p.y.size();
  if (p.body != Body::rail || n < 20) return {};
  const auto ends = std::minmax_element(p.z.begin(), p.z.end());
  const double low = *ends.first, high = *ends.second, height = high - low;
  if (height < kLow || height > kHigh) return {};
  // of what is so deep below the end that has the least z (sign 1) or the greatest
  struct Span {
    double left = kInfinity, right = -kInfinity;
    double width() const { return right - left; }
    double middle() const { return 0.5 * (left + right); }
  };
  const auto span = [&](double sign, double from, double to) {
    Span out;
    for (std::size_t i = 0; i < n; ++i)
      if (const double depth = sign > 0.0 ? p.z[i] - low : high - p.z[i]; depth >= from && depth < to)
        out.left = std::min(out.left, p.y[i]), out.right = std::max(out.right, p.y[i]);
    return out;
  };
  // the foot is wider than the head, and a web without a foot is narrower
  const double first = span(1.0, 0.0, kEnd).width(), last = span(-1.0, 0.0, kEnd).width();
  const bool has_foot = std::min(first, last) >= kLeastHead;
  double sign = (first <= last) == has_foot ? 1.0 : -1.0;
  const auto has_head = [&] {
    const double head = span(sign, 0.0, kShoulder).width();
    return head >= kLeastHead && head <= kWidestHead &&
           span(sign, kWebFrom * height, kWebTo * height).width() <= kWidestWeb;
  };
  if (!has_head()) {  // of a foot that was measured in part
    sign = -sign;
    if (!has_head()) return {};  // the rim of a wheel is as wide below as above
  }
  const double middle = span(sign, 0.0, kShoulder).middle();
  const auto depth = [&](std::size_t i) { return sign * p.z[i] - (sign > 0.0 ? low : -high); };
  const bool closed = std::hypot(p.y.front() - p.y.back(), p.z.front() - p.z.back()) < kClosed;
  std::size_t top = 0;
  for (std::size_t i = 1; i < n; ++i)
    if (depth(i) < depth(top)) top = i;
  const double turns_in = span(sign, 0.0, kShoulder).width() > kNoGroove ? kBelowGroove : kDeep;
  // to both sides until the outline turns in under the head
  const auto reach = [&](std::size_t step) {
    std::size_t count = 0, best = 0;
    double farthest = 0.0;
    for (std::size_t i = top; count + 1 < n;) {
      if (!closed && (step == 1 ? i + 1 == n : i == 0)) break;
      i = (i + step) % n;
      ++count;
      const double out = std::fabs(p.y[i] - middle);
      if (depth(i) > turns_in && out < farthest - kInwards) return best;
      if (out >= farthest || depth(i) <= kDeep) best = count;
      farthest = std::max(farthest, out);
    }
    return best;
  };
  const std::size_t after = reach(1), before = reach(n - 1);
  RailOutline out;
  for (std::size_t k = 0; k <= before + after && k < n; ++k) out.head.push_back((top + n - before + k) % n);
  std::size_t start = 0;
  if (closed)
    for (std::size_t i = 0; i < n; ++i)
      if (height - depth(i) < kEnd &&
          (height - depth(start) >= kEnd || std::fabs(p.y[i] - middle) < std::fabs(p.y[start] - middle)))
        start = i;
  for (std::size_t k = 0; k < n; ++k) out.whole.push_back((start + k) % n);
  return out;
}

Understanding understand(SectionPoints& points, const Words& words) { return Reader(points, words).understand(); }

}  // namespace treadmark::measured
