// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

#include "treadmark/backends/analytic/arc_graph.hpp"
#include "treadmark/backends/analytic/fast_trig.hpp"

namespace treadmark::analytic {

/// Bounds of a function over an interval and of the size of its derivative. Conservative.
struct FunctionRange {
  double low = 0.0, high = 0.0;
  double max_d = 0.0;
};

/// Values and slopes are also computed many at a time, up to kMany: `many` of each function.
inline constexpr std::size_t kMany = 64;
using Many = std::array<double, kMany>;

/// Least and greatest cosine over phases from a to b >= a.
inline FunctionRange cosine_range(double a, double b) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  FunctionRange r{std::min(std::cos(a), std::cos(b)), std::max(std::cos(a), std::cos(b)), 0.0};
  const auto passes = [a, b](double phase) { return std::ceil((a - phase) / kTurn) * kTurn + phase <= b; };
  if (passes(0.0)) r.high = 1.0;
  if (passes(0.5 * kTurn)) r.low = -1.0;
  r.max_d = std::max(std::fabs(std::sin(a)), std::fabs(std::sin(b)));
  if (passes(0.25 * kTurn) || passes(0.75 * kTurn)) r.max_d = 1.0;
  return r;
}

/// 1/2 (1 + cos(pi e/half)) for |e| < half about a centre, else 0; half = 0: 1 everywhere.
struct CosineBump {
  double center = 0.0, half = 0.0;

  bool everywhere() const { return half == 0.0; }
  double begin() const { return center - half; }
  double end() const { return center + half; }
  Jet jet(double x) const {
    if (half == 0.0) return {1.0, 0.0, 0.0};
    const double e = x - center;
    if (std::fabs(e) >= half) return {};
    const double k = std::numbers::pi / half, c = std::cos(k * e);
    return {0.5 * (1.0 + c), -0.5 * k * std::sin(k * e), -0.5 * k * k * c};
  }
  void many(const double* x, std::size_t n, Many& h, Many& dh) const {
    if (half == 0.0) {
      std::fill_n(h.begin(), n, 1.0);
      std::fill_n(dh.begin(), n, 0.0);
      return;
    }
    Many phase, s, c;
    const double k = std::numbers::pi / half;
    for (std::size_t i = 0; i < n; ++i) phase[i] = k * (x[i] - center);
    sin_cos_many(phase.data(), n, s.data(), c.data());
    for (std::size_t i = 0; i < n; ++i) {
      const bool inside = !(std::fabs(x[i] - center) >= half);
      h[i] = inside ? 0.5 * (1.0 + c[i]) : 0.0;
      dh[i] = inside ? -0.5 * k * s[i] : 0.0;
    }
  }
  FunctionRange range(double a, double b) const {
    if (half == 0.0) return {1.0, 1.0, 0.0};
    const double k = std::numbers::pi / half;
    a = std::clamp(a - center, -half, half);
    b = std::clamp(b - center, -half, half);
    if (a == b && half - std::fabs(a) <= 0.0) return {};
    const FunctionRange c = cosine_range(k * a, k * b);
    return {std::max(0.0, 0.5 * (1.0 + c.low)), 0.5 * (1.0 + c.high), 0.5 * k * c.max_d};
  }
};

/// 0 up to start, 1/2 (1 - cos(pi t)) over a distance, then 1. length < 0: the same towards -x.
struct CosineStep {
  double start = 0.0, length = 1.0;

  Jet jet(double x) const {
    const double t = (x - start) / length;
    if (t <= 0.0) return {};
    if (t >= 1.0) return {1.0, 0.0, 0.0};
    const double k = std::numbers::pi / length, c = std::cos(k * (x - start));
    return {0.5 * (1.0 - c), 0.5 * k * std::sin(k * (x - start)), 0.5 * k * k * c};
  }
  void many(const double* x, std::size_t n, Many& h, Many& dh) const {
    Many phase, s, c;
    const double per_length = 1.0 / length, k = std::numbers::pi * per_length;
    for (std::size_t i = 0; i < n; ++i) phase[i] = std::numbers::pi * std::clamp((x[i] - start) * per_length, 0.0, 1.0);
    sin_cos_many(phase.data(), n, s.data(), c.data());
    for (std::size_t i = 0; i < n; ++i) {
      const bool inside = phase[i] > 0.0 && phase[i] < std::numbers::pi;
      h[i] = 0.5 * (1.0 - c[i]);
      dh[i] = inside ? 0.5 * k * s[i] : 0.0;
    }
  }
  FunctionRange range(double a, double b) const {
    const double p = std::clamp((a - start) / length, 0.0, 1.0), q = std::clamp((b - start) / length, 0.0, 1.0);
    const double low = std::min(p, q), high = std::max(p, q);
    const FunctionRange c = cosine_range(std::numbers::pi * low, std::numbers::pi * high);
    return {std::max(0.0, 0.5 * (1.0 - c.high)), 0.5 * (1.0 - c.low),
            0.5 * std::numbers::pi / std::fabs(length) * c.max_d};
  }
};

/// 0 outside of [start, end], 1 inside but for cosine ramps at both ends. 2 ramp <= end - start.
struct CosineWindow {
  double start = 0.0, end = 1.0, ramp = 0.1;

  Jet jet(double x) const {
    return x < 0.5 * (start + end) ? CosineStep{start, ramp}.jet(x) : CosineStep{end, -ramp}.jet(x);
  }
  void many(const double* x, std::size_t n, Many& h, Many& dh) const {
    Many from_end, sign;
    const double middle = 0.5 * (start + end);
    for (std::size_t i = 0; i < n; ++i) {
      sign[i] = x[i] < middle ? 1.0 : -1.0;
      from_end[i] = x[i] < middle ? x[i] - start : end - x[i];
    }
    CosineStep{0.0, ramp}.many(from_end.data(), n, h, dh);
    for (std::size_t i = 0; i < n; ++i) dh[i] *= sign[i];
  }
  FunctionRange range(double a, double b) const {
    const FunctionRange in = CosineStep{start, ramp}.range(a, b), out = CosineStep{end, -ramp}.range(a, b);
    return {std::min(in.low, out.low), std::min(in.high, out.high), std::max(in.max_d, out.max_d)};
  }
};

/// Sum of amplitude cos(wave_number (x - origin) - phase).
struct WaveSum {
  struct Wave {
    double wave_number = 0.0, amplitude = 0.0, phase = 0.0;
  };
  double origin = 0.0;
  std::vector<Wave> waves;

  Jet jet(double x) const {
    Jet sum;
    for (const Wave& w : waves) {
      const double p = w.wave_number * (x - origin) - w.phase, c = w.amplitude * std::cos(p);
      sum.h += c;
      sum.dh -= w.wave_number * w.amplitude * std::sin(p);
      sum.ddh -= w.wave_number * w.wave_number * c;
    }
    return sum;
  }
  void many(const double* x, std::size_t n, Many& h, Many& dh) const {
    Many phase, s, c;
    std::fill_n(h.begin(), n, 0.0);
    std::fill_n(dh.begin(), n, 0.0);
    for (const Wave& w : waves) {
      for (std::size_t i = 0; i < n; ++i) phase[i] = w.wave_number * (x[i] - origin) - w.phase;
      sin_cos_many(phase.data(), n, s.data(), c.data());
      const double slope = w.wave_number * w.amplitude;
      for (std::size_t i = 0; i < n; ++i) h[i] += w.amplitude * c[i], dh[i] -= slope * s[i];
    }
  }
  FunctionRange range(double a, double b) const {
    FunctionRange sum;
    for (const Wave& w : waves) {
      const FunctionRange c =
          cosine_range(w.wave_number * (a - origin) - w.phase, w.wave_number * (b - origin) - w.phase);
      sum.low += std::min(w.amplitude * c.low, w.amplitude * c.high);
      sum.high += std::max(w.amplitude * c.low, w.amplitude * c.high);
      sum.max_d += std::fabs(w.amplitude) * w.wave_number * c.max_d;
    }
    return sum;
  }
};

/// Product of two functions of the same variable.
template <class First, class Second>
struct FunctionProduct {
  First first;
  Second second;

  Jet jet(double x) const {
    const Jet b = second.jet(x);
    if (b.h == 0.0 && b.dh == 0.0 && b.ddh == 0.0) return {};
    const Jet a = first.jet(x);
    return {a.h * b.h, a.dh * b.h + a.h * b.dh, a.ddh * b.h + 2.0 * a.dh * b.dh + a.h * b.ddh};
  }
  void many(const double* x, std::size_t n, Many& h, Many& dh) const {
    Many b, db;
    first.many(x, n, h, dh);
    second.many(x, n, b, db);
    for (std::size_t i = 0; i < n; ++i) {
      dh[i] = dh[i] * b[i] + h[i] * db[i];
      h[i] *= b[i];
    }
  }
  FunctionRange range(double x_min, double x_max) const {
    const FunctionRange a = first.range(x_min, x_max), b = second.range(x_min, x_max);
    const auto size = [](const FunctionRange& r) { return std::max(std::fabs(r.low), std::fabs(r.high)); };
    const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
    return {low, high, a.max_d * size(b) + size(a) * b.max_d};
  }
};

}  // namespace treadmark::analytic
