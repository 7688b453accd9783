// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/backends/conformance/shapes.hpp"
#include "treadmark/backends/displacement/offset_field.hpp"

namespace treadmark::testing {

/// amount/4 (1 + cos(2 pi u/length_u)) (1 + cos(2 pi y/length_y)) about a middle; u may be periodic with 2 pi.
class BumpField : public displacement::OffsetField {
 public:
  double amount, u0, y0, length_u, length_y;
  bool periodic;
  BumpField(double amount_, double u0_, double y0_, double length_u_, double length_y_, bool periodic_)
      : amount(amount_), u0(u0_), y0(y0_), length_u(length_u_), length_y(length_y_), periodic(periodic_) {}

  displacement::OffsetJet jet(double u, double y) const override {
    double a = u - u0, b = y - y0;
    if (periodic) a = std::remainder(a, 2.0 * std::numbers::pi);
    displacement::OffsetJet j;
    if (std::fabs(a) >= 0.5 * length_u || std::fabs(b) >= 0.5 * length_y) return j;
    const double k = 2.0 * std::numbers::pi / length_u, l = 2.0 * std::numbers::pi / length_y;
    const double p = 1.0 + std::cos(k * a), p1 = -k * std::sin(k * a), p2 = -k * k * std::cos(k * a);
    const double q = 1.0 + std::cos(l * b), q1 = -l * std::sin(l * b), q2 = -l * l * std::cos(l * b);
    const double c = 0.25 * amount;
    return {c * p * q, c * p1 * q, c * p * q1, c * p2 * q, c * p1 * q1, c * p * q2};
  }
  displacement::OffsetRange range(const Rectangle& uy) const override {
    const bool apart_y = uy.y_min > y0 + 0.5 * length_y || uy.y_max < y0 - 0.5 * length_y;
    double a = uy.x_min - u0, b = uy.x_max - u0;
    if (periodic) {
      const double turns = 2.0 * std::numbers::pi * std::round(0.5 * (a + b) / (2.0 * std::numbers::pi));
      a -= turns, b -= turns;
    }
    const bool apart_u =
        (a > 0.5 * length_u || b < -0.5 * length_u) &&
        !(periodic && (b > 2.0 * std::numbers::pi - 0.5 * length_u || a < -2.0 * std::numbers::pi + 0.5 * length_u));
    if (apart_y || apart_u) return {};
    const double pi = std::numbers::pi;
    return {std::min(0.0, amount), std::max(0.0, amount), std::fabs(amount) * pi / length_u,
            std::fabs(amount) * pi / length_y};
  }
  std::size_t memory_bytes() const override { return sizeof(*this); }
};

/// The same number everywhere.
class ConstantField : public displacement::OffsetField {
 public:
  explicit ConstantField(double value) : value_(value) {}
  displacement::OffsetJet jet(double, double) const override { return {value_, 0, 0, 0, 0, 0}; }
  displacement::OffsetRange range(const Rectangle&) const override { return {value_, value_, 0, 0}; }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  double value_;
};

struct Fields {
  std::vector<double> z, dzdx, dzdy;
};

inline Fields evaluate(const Surface& surface, const Pose& X, const Grid2& grid) {
  Fields f;
  f.z.assign(grid.size(), 0.0);
  f.dzdx = f.dzdy = f.z;
  surface.heights({X, grid}, {f.z, f.dzdx, f.dzdy});
  return f;
}

inline Pose pose(const Vec3& origin, double roll, double yaw, double pitch) {
  return {origin, rotation({roll, yaw, pitch})};
}

using conformance::rail_planes;
using conformance::wheel_planes;

inline bool same(double a, double b, double tolerance) {
  return (std::isnan(a) && std::isnan(b)) || std::fabs(a - b) <= tolerance;
}

}  // namespace treadmark::testing
