// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/geometry/section.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/roots.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/rail_head.hpp"

namespace treadmark::geometry {
namespace {

constexpr double kFarthest = 0.2;       // from the origin, where a surface has no ends [m]
constexpr double kTapeToFace = 10e-3;   // the flange's thickness is measured so far below the tape line [m]
constexpr double kLeastFlange = 15e-3;  // what hangs lower than that is a flange [m]

/// Samples along y of a plane with axes parallel to those of the section wanted.
Section sampled(const Surface& surface, const Pose& X_SP, Body body) {
  const Box3 box = surface.bounds();
  double low = kInfinity, high = -kInfinity;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 p{(corner & 1) != 0 ? box.max.x() : box.min.x(), (corner & 2) != 0 ? box.max.y() : box.min.y(),
                 (corner & 4) != 0 ? box.max.z() : box.min.z()};
    // x is left out: it may be infinite, and turning about x does not use it
    const double y = body == Body::wheel ? p.y()
                                         : X_SP.rotation(1, 1) * (p.y() - X_SP.origin.y()) +
                                               X_SP.rotation(2, 1) * (p.z() - X_SP.origin.z());
    low = std::min(low, y);
    high = std::max(high, y);
  }
  if (!(high - low < 2.0 * kFarthest)) low = std::max(low, -kFarthest), high = std::min(high, kFarthest);
  const auto first = to_whole<long>(std::floor(low / kSectionStep)),
             last = to_whole<long>(std::ceil(high / kSectionStep));
  const int count = static_cast<int>(std::max(last - first + 1, 2L));
  std::vector<double> z(static_cast<std::size_t>(count)), slope(z.size());
  HeightsOut out;
  out.z = z;
  out.dzdy = slope;
  surface.heights({X_SP, {0.0, static_cast<double>(first) * kSectionStep, kSectionStep, kSectionStep, 1, count}}, out);
  std::size_t from = 0, to = z.size();
  while (from < to && std::isnan(z[from])) ++from;
  while (to > from && std::isnan(z[to - 1])) --to;
  if (to - from < 2)
    throw Error(ErrorKind::input_data,
                fmt::format("the {} has no surface there", body == Body::wheel ? "wheel" : "rail"));
  const auto cut = [&](const std::vector<double>& v) {
    return std::vector<double>(v.begin() + static_cast<std::ptrdiff_t>(from),
                               v.begin() + static_cast<std::ptrdiff_t>(to));
  };
  return {body, static_cast<double>(first + static_cast<long>(from)) * kSectionStep, kSectionStep, cut(z), cut(slope)};
}

/// Where a quantity of the samples passes a value between samples i and i + 1, of which the first is beyond it.
template <class Value>
double between(const Section& s, std::size_t i, Value value) {
  constexpr int kHalvings = 50;
  return bisect(
             s.y(i), s.y(i + 1), [&](double y) { return value(s.at(y)); }, kHalvings)
      .middle();
}

}  // namespace

Section::Section(Body body, double first, double step, std::vector<double> z, std::vector<double> slope)
    : body_(body),
      first_(first),
      step_(step),
      per_step_(1.0 / step),
      last_index_(static_cast<double>(z.size()) - 1.0),
      z_(std::move(z)),
      slope_(std::move(slope)) {
  if (z_.size() < 2 || slope_.size() != z_.size() || !(step > 0.0) || !std::isfinite(first))
    throw Error(ErrorKind::configuration, "a section needs at least two samples with slopes and a positive step");
}

Section Section::shifted(double dy) const { return Section(body_, first_ + dy, step_, z_, slope_); }

Section Section::raised(double dz) const {
  Section out = *this;
  for (double& z : out.z_) z += dz;
  return out;
}

SectionPoint Section::at(double y) const {
  const double t = (y - first_) * per_step_;
  if (!(t >= 0.0) || t > last_index_) return {kNaN, kNaN, kNaN};
  const std::size_t i = t < last_index_ ? to_whole<std::size_t>(t) : z_.size() - 2;
  const double u = t - static_cast<double>(i);
  const double z0 = z_[i], z1 = z_[i + 1], m0 = step_ * slope_[i], m1 = step_ * slope_[i + 1], d = z1 - z0;
  SectionPoint p;
  const double c2 = 3.0 * d - 2.0 * m0 - m1, c3 = m0 + m1 - 2.0 * d;
  p.z = z0 + u * (m0 + u * (c2 + u * c3));
  p.slope = (m0 + u * (2.0 * c2 + 3.0 * u * c3)) * per_step_;
  // over three steps: what the samples of points with noise say of less is not the shape
  const std::size_t from = i > 0 ? i - 1 : i, to = std::min(i + 2, z_.size() - 1);
  const double length = static_cast<double>(to - from) * step_;
  const double bend = (slope_[to] - slope_[from]) / length, c = 1.0 / std::sqrt(1.0 + p.slope * p.slope);
  p.curvature = (body_ == Body::rail ? bend : -bend) * c * c * c;
  return p;
}

Section wheel_section(const Surface& wheel, double pitch) {
  return sampled(wheel, {Vec3::Zero(), rotation_y(-pitch)}, Body::wheel);
}

Section rail_section(const Surface& rail, double cant, double x) {
  return sampled(rail, {{x, 0.0, 0.0}, rotation_x(cant)}, Body::rail);
}

RailTop rail_top(const Section& rail, double gauge_height) {
  constexpr double kSteep = 5.0;     // an end as steep as that is the side of the head, seen from above
  constexpr double kReached = 5e-5;  // of points that end at the gauge height [m]
  constexpr double kOfHead = 10e-3;  // depth that tells the head from a keeper beside a groove [m]
  const std::vector<double>& z = rail.z();
  std::vector<double> y(z.size());
  for (std::size_t i = 0; i < y.size(); ++i) y[i] = rail.y(i);
  RailTop out{kNaN, kNaN, kNaN};
  // finer around the least sample
  const auto finer = [&](std::size_t top) {
    out.z_top = z[top], out.y_top = y[top];
    const double s = rail.slope()[top];
    const std::size_t next = s > 0.0 ? top - std::min<std::size_t>(top, 1) : std::min(top + 1, z.size() - 1);
    if (next == top || !std::isfinite(z[next])) return out.z_top;
    const double at = between(rail, std::min(top, next), [](const SectionPoint& p) { return p.slope < 0.0; });
    if (rail.at(at).z < out.z_top) out.z_top = rail.at(at).z, out.y_top = at;
    return out.z_top;
  };
  const std::optional<RailHead> head = head_of_rail(y, z, std::max(gauge_height, kOfHead), false, finer);
  if (!head) return out;
  for (std::size_t i = head->first; i <= head->top; ++i) {
    if (!(z[i] - out.z_top <= gauge_height)) continue;
    const bool inside = i > 0 && std::isfinite(z[i - 1]);
    if (inside)
      out.y_gauge = between(rail, i - 1, [&](const SectionPoint& p) { return p.z - out.z_top > gauge_height; });
    else if (z[i] - out.z_top >= gauge_height - kReached || rail.slope()[i] < -kSteep)
      out.y_gauge = rail.y(i);
    break;
  }
  return out;
}

WheelMarks wheel_marks(const Section& wheel) {
  WheelMarks out{kNaN, kNaN, wheel.at(0.0).z, kNaN, kNaN};
  const std::vector<double>& z = wheel.z();
  std::size_t tip = z.size();
  for (std::size_t i = 0; i < z.size() && wheel.y(i) < 0.0; ++i)
    if (std::isfinite(z[i]) && (tip == z.size() || z[i] > z[tip])) tip = i;
  const double tread =
      std::isnan(out.tape_z)
          ? *ranges::min_element(z, [](double a, double b) { return a < b || (std::isnan(b) && !std::isnan(a)); })
          : out.tape_z;
  if (tip == z.size() || z[tip] - tread < kLeastFlange) return out;
  out.tip_y = wheel.y(tip);
  out.tip_z = z[tip];
  for (std::size_t i = tip; i < z.size() && wheel.y(i) < 0.0; ++i) {
    out.climb_y = wheel.y(i);
    if (wheel.slope()[i] < -1.0) break;
  }
  for (std::size_t i = tip; i + 1 < z.size() && wheel.y(i) < 0.0; ++i) {
    const auto lower = [&](const SectionPoint& p) { return p.z - out.tape_z > kTapeToFace; };
    if (!(z[i] - out.tape_z > kTapeToFace) || !(z[i + 1] - out.tape_z <= kTapeToFace)) continue;
    out.face_y = between(wheel, i, lower);
    break;
  }
  return out;
}

std::string wrong_body(const Section& section) {
  const std::vector<double>& z = section.z();
  constexpr double kHead = 35e-3;     // what is seen of a section that far below its top is its head [m]
  constexpr double kWidest = 120e-3;  // no head is as wide, not even with a groove [m]
  if (section.body() == Body::rail) {
    const RailTop top = rail_top(section, 0.0);
    std::size_t from = z.size(), to = 0;
    for (std::size_t i = 0; i < z.size(); ++i)
      if (z[i] - top.z_top <= kHead) from = std::min(from, i), to = i;
    if (to > from && static_cast<double>(to - from) * section.step() > kWidest)
      return fmt::format(
          "it is {:.0f} mm wide within {:.0f} mm below its top, as wheels are and no head of a rail is, not even with "
          "a groove",
          kMilli * static_cast<double>(to - from) * section.step(), kMilli * kHead);
    return {};
  }
  constexpr double kFieldSide = 20e-3;  // [m]
  const double tape = section.at(0.0).z;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (section.y(i) > kFieldSide && z[i] - tape > kLeastFlange)
      return "its flange lies at y > 0, where the field side of a right wheel belongs";
  // as a wheel, a head of a rail is a hump that falls on both sides
  constexpr double kFall = 10e-3, kWidestHead = 90e-3;
  const double width = section.last() - section.first();
  if (width > kWidestHead) return {};
  double greatest = -kInfinity, y = 0.0;
  for (std::size_t i = 0; i < z.size(); ++i)
    if (z[i] > greatest) greatest = z[i], y = section.y(i);
  if (greatest - z.front() > kFall && greatest - z.back() > kFall && y - section.first() > 0.3 * width &&
      section.last() - y > 0.3 * width)
    return fmt::format("it is a hump {:.0f} mm wide that falls on both sides, as heads of rails do", kMilli * width);
  return {};
}

}  // namespace treadmark::geometry
