// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::mesh {

/// A value with its first derivatives by x and y.
struct Jet1 {
  double v = 0.0, x = 0.0, y = 0.0;
  Jet1() = default;
  Jet1(double value) : v(value) {}
  Jet1(double value, double dx, double dy) : v(value), x(dx), y(dy) {}

  friend Jet1 operator+(const Jet1& a, const Jet1& b) { return {a.v + b.v, a.x + b.x, a.y + b.y}; }
  friend Jet1 operator-(const Jet1& a, const Jet1& b) { return {a.v - b.v, a.x - b.x, a.y - b.y}; }
  friend Jet1 operator*(const Jet1& a, const Jet1& b) {
    return {a.v * b.v, a.x * b.v + a.v * b.x, a.y * b.v + a.v * b.y};
  }
  friend Jet1 operator/(const Jet1& a, const Jet1& b) {
    const double q = a.v / b.v;
    return {q, (a.x - q * b.x) / b.v, (a.y - q * b.y) / b.v};
  }
};

/// A value with its first and second derivatives by x and y.
struct Jet2 {
  double v = 0.0, x = 0.0, y = 0.0, xx = 0.0, xy = 0.0, yy = 0.0;
  Jet2() = default;
  Jet2(double value) : v(value) {}
  Jet2(double value, double dx, double dy) : v(value), x(dx), y(dy) {}
  Jet2(double value, double dx, double dy, double dxx, double dxy, double dyy)
      : v(value), x(dx), y(dy), xx(dxx), xy(dxy), yy(dyy) {}

  friend Jet2 operator+(const Jet2& a, const Jet2& b) {
    return {a.v + b.v, a.x + b.x, a.y + b.y, a.xx + b.xx, a.xy + b.xy, a.yy + b.yy};
  }
  friend Jet2 operator-(const Jet2& a, const Jet2& b) {
    return {a.v - b.v, a.x - b.x, a.y - b.y, a.xx - b.xx, a.xy - b.xy, a.yy - b.yy};
  }
  friend Jet2 operator*(const Jet2& a, const Jet2& b) {
    return {a.v * b.v,
            a.x * b.v + a.v * b.x,
            a.y * b.v + a.v * b.y,
            a.xx * b.v + 2.0 * a.x * b.x + a.v * b.xx,
            a.xy * b.v + a.x * b.y + a.y * b.x + a.v * b.xy,
            a.yy * b.v + 2.0 * a.y * b.y + a.v * b.yy};
  }
  friend Jet2 operator/(const Jet2& a, const Jet2& b) {
    // from a = q b, differentiated once and twice
    const double q = a.v / b.v, qx = (a.x - q * b.x) / b.v, qy = (a.y - q * b.y) / b.v;
    return {q,
            qx,
            qy,
            (a.xx - 2.0 * qx * b.x - q * b.xx) / b.v,
            (a.xy - qx * b.y - qy * b.x - q * b.xy) / b.v,
            (a.yy - 2.0 * qy * b.y - q * b.yy) / b.v};
  }
};

inline double value_of(double a) { return a; }
inline double value_of(const Jet1& a) { return a.v; }
inline double value_of(const Jet2& a) { return a.v; }

}  // namespace treadmark::mesh
