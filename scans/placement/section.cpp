// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/placement/section.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::scans {
namespace {

constexpr double kStep = 0.25e-3;  // between nodes of the curve [m]

/// Second derivatives of the natural cubic spline through f at increasing t (de Boor 1978).
std::vector<double> second_derivatives(std::span<const double> t, std::span<const double> f) {
  const std::size_t n = t.size();
  std::vector<double> diagonal(n, 1.0), right(n, 0.0), out(n, 0.0);
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const double left = t[i] - t[i - 1], next = t[i + 1] - t[i];
    const double rhs = 6.0 * ((f[i + 1] - f[i]) / next - (f[i] - f[i - 1]) / left);
    const double factor = i > 1 ? left / diagonal[i - 1] : 0.0;
    diagonal[i] = 2.0 * (left + next) - factor * (i > 1 ? left : 0.0);
    right[i] = rhs - factor * (i > 1 ? right[i - 1] : 0.0);
  }
  for (std::size_t i = n - 1; i-- > 1;) out[i] = (right[i] - (t[i + 1] - t[i]) * out[i + 1]) / diagonal[i];
  return out;
}

struct Value {
  double f, d1, d2;
};

Value spline(double a, double b, double dda, double ddb, double h, double x) {
  const double p = (h - x) / h, q = x / h;
  return {p * a + q * b + h * h / 6.0 * ((p * p * p - p) * dda + (q * q * q - q) * ddb),
          (b - a) / h + h / 6.0 * ((1.0 - 3.0 * p * p) * dda + (3.0 * q * q - 1.0) * ddb), p * dda + q * ddb};
}

}  // namespace

Section::Section(std::span<const Vec2> points) {
  if (points.size() < 4) throw Error(ErrorKind::input_data, "a section needs at least four points");
  std::vector<double> t(points.size(), 0.0), y(points.size()), v(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    y[i] = points[i].x();
    v[i] = points[i].y();
    if (i > 0) {
      if (!(y[i] > y[i - 1])) throw Error(ErrorKind::input_data, "the points of a section must run with increasing y");
      t[i] = t[i - 1] + (points[i] - points[i - 1]).norm();
    }
  }
  const std::vector<double> ddy = second_derivatives(t, y), ddv = second_derivatives(t, v);
  // arc length by Gauss (2 points, 4 parts of every interval); nodes at even lengths by inverse interpolation
  constexpr int kParts = 4;
  std::vector<double> arc{0.0}, at{0.0};
  std::vector<std::size_t> interval{0};
  for (std::size_t i = 1; i < t.size(); ++i) {
    const double h = t[i] - t[i - 1], part = h / kParts;
    for (int k = 0; k < kParts; ++k) {
      double length = 0.0;
      for (const double g : {-0.5773502691896257, 0.5773502691896257}) {
        const double x = part * (k + 0.5 + 0.5 * g);
        length += 0.5 * part *
                  std::hypot(spline(y[i - 1], y[i], ddy[i - 1], ddy[i], h, x).d1,
                             spline(v[i - 1], v[i], ddv[i - 1], ddv[i], h, x).d1);
      }
      arc.push_back(arc.back() + length);
      at.push_back(t[i - 1] + part * (k + 1));
      interval.push_back(i - 1);
    }
  }
  length_ = arc.back();
  const auto steps = to_whole<std::size_t>(std::max(4.0, std::ceil(length_ / kStep)));
  step_ = length_ / static_cast<double>(steps);
  std::vector<double> s(steps + 1);
  std::size_t k = 1;
  for (std::size_t i = 0; i <= steps; ++i) {
    s[i] = step_ * static_cast<double>(i);
    while (k + 1 < arc.size() && arc[k] < s[i]) ++k;
    const double share = std::clamp((s[i] - arc[k - 1]) / (arc[k] - arc[k - 1]), 0.0, 1.0);
    const std::size_t j = interval[k];
    const double x = at[k - 1] + share * (at[k] - at[k - 1]) - t[j], h = t[j + 1] - t[j];
    y_.push_back(spline(y[j], y[j + 1], ddy[j], ddy[j + 1], h, x).f);
    v_.push_back(spline(v[j], v[j + 1], ddv[j], ddv[j + 1], h, x).f);
  }
  ddy_ = second_derivatives(s, y_);
  ddv_ = second_derivatives(s, v_);
}

Section::Point Section::at(double s) const {
  const double place = std::clamp(s / step_, 0.0, static_cast<double>(y_.size() - 1));
  const std::size_t i = std::min(to_whole<std::size_t>(place), y_.size() - 2);
  const double x = s - step_ * static_cast<double>(i);
  Value y, v;
  if (x < 0.0 || x > step_) {  // straight on beyond the ends
    const double end = x < 0.0 ? 0.0 : step_;
    y = spline(y_[i], y_[i + 1], ddy_[i], ddy_[i + 1], step_, end);
    v = spline(v_[i], v_[i + 1], ddv_[i], ddv_[i + 1], step_, end);
    y = {y.f + (x - end) * y.d1, y.d1, 0.0};
    v = {v.f + (x - end) * v.d1, v.d1, 0.0};
  } else {
    y = spline(y_[i], y_[i + 1], ddy_[i], ddy_[i + 1], step_, x);
    v = spline(v_[i], v_[i + 1], ddv_[i], ddv_[i + 1], step_, x);
  }
  const double speed = std::sqrt(y.d1 * y.d1 + v.d1 * v.d1);  // about 1
  return {{y.f, v.f}, Vec2(-v.d1, y.d1) / speed, -(y.d1 * v.d2 - v.d1 * y.d2) / (speed * speed * speed)};
}

double Section::s_at(double y) const {
  const auto above = std::lower_bound(y_.begin(), y_.end(), y);
  if (above == y_.begin()) return 0.0;
  if (above == y_.end()) return length_;
  const auto i = static_cast<std::size_t>(above - y_.begin()) - 1;
  const double h = y_[i + 1] - y_[i];
  double x = step_ * (y - y_[i]) / h;
  for (int k = 0; k < 2; ++k) {
    const Value value = spline(y_[i], y_[i + 1], ddy_[i], ddy_[i + 1], step_, x);
    x = std::clamp(x - (value.f - y) / value.d1, 0.0, step_);
  }
  return step_ * static_cast<double>(i) + x;
}

std::optional<Section::Foot> Section::foot(const Vec2& point, double farthest) const {
  double s = s_at(point.x());
  Point here = at(s);
  const double off = std::fabs(point.y() - here.position.y());
  // straight above the foot unless the curve is steep and the point off it
  constexpr double kFar = 0.2e-3;
  if (off > kFar) {
    const double reach = std::min(off, farthest) + 1e-3;
    const auto last = static_cast<double>(y_.size() - 1);
    const auto low = to_whole<std::size_t>(s_at(point.x() - reach) / step_, 0.0, last);
    const auto high = to_whole<std::size_t>(s_at(point.x() + reach) / step_, 0.0, last);
    double least = 1e300;
    for (std::size_t i = low; i <= high; i += 4) {
      const double square = (point - Vec2(y_[i], v_[i])).squaredNorm();
      if (square < least) {
        least = square;
        s = step_ * static_cast<double>(i);
      }
    }
    here = at(s);
  }
  double along = 0.0;
  for (int round = 0; round < 12; ++round) {
    const Vec2 apart = point - here.position;
    along = apart.dot(Vec2(here.normal.y(), -here.normal.x()));
    const double bend = 1.0 + here.curvature * apart.dot(here.normal);
    const double move = std::clamp(along / std::max(bend, 0.3), -5e-3, 5e-3);
    if (std::fabs(move) < 1e-10) break;
    s += move;
    if (s < -2e-3 || s > length_ + 2e-3) return std::nullopt;
    here = at(s);
  }
  if (s < 0.0 || s > length_ || std::fabs(along) > 1e-6) return std::nullopt;
  const double distance = (point - here.position).dot(here.normal);
  if (!(std::fabs(distance) < farthest)) return std::nullopt;
  return Foot{s, distance};
}

}  // namespace treadmark::scans
