// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/fit/level_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "treadmark/core/kernel.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/scans/fit/point_sums.hpp"

namespace treadmark::scans {
namespace {

// Rows of intervals four apart share no function, so that every fourth can be summed at once and the order of sums is
// fixed.
constexpr std::size_t kColours = 4;
constexpr float kClip = 4.0f;         // standard deviations
constexpr std::size_t kStencil = 49;  // functions that overlap with one: 7 x 7

struct Geometry {
  std::size_t cells_a, cells_s;  // of the points, in one interval

  Geometry(const BandPoints& points, const SplineLevel& level)
      : cells_a(points.rows / level.intervals_a), cells_s(points.columns / level.intervals_s) {}
};

IntervalPoints points_of(const BandPoints& points, const SplineLevel& level, const Geometry& g, std::size_t ia,
                         std::size_t is) {
  return {points.a.data(),
          points.s.data(),
          points.begin.data() + ia * g.cells_a * points.columns + is * g.cells_s,
          g.cells_a,
          g.cells_s,
          points.columns,
          level.knot_a * static_cast<double>(ia),
          level.knot_s * static_cast<double>(is),
          1.0 / level.knot_a,
          1.0 / level.knot_s};
}

template <class Body>
void by_colours(const SplineLevel& level, const Body& body) {
  for (std::size_t colour = 0; colour < kColours; ++colour) {
    const std::size_t count = (level.intervals_a + kColours - 1 - colour) / kColours;
    parallel_for(count, [&](std::size_t k) { body(colour + kColours * k); });
  }
}

/// Normal equations of the active functions; row f holds its products with the functions around it.
class NormalEquations {
 public:
  NormalEquations(const BandPoints& points, std::span<const float> residual, std::span<const float> weight,
                  std::span<const float> ridge, const SplineLevel& level)
      : level_(level), number_(level.size(), -1) {
    for (std::size_t f = 0; f < level.size(); ++f)
      if (level.active[f] != 0) {
        number_[f] = static_cast<std::int32_t>(functions_.size());
        functions_.push_back(static_cast<std::uint32_t>(f));
      }
    matrix_.assign(kStencil * functions_.size(), 0.0f);
    rhs_.assign(functions_.size(), 0.0);
    const Geometry g(points, level);
    by_colours(level, [&](std::size_t ia) {
      for (std::size_t is = 0; is < level.intervals_s; ++is) {
        if (!touches_active(ia, is)) continue;
        std::array<double, 16> right{};
        std::array<double, 256> total{};
        fastest_kernel<PointSums>().products(points_of(points, level, g, ia, is), residual.data(), weight.data(),
                                             total.data(), right.data());
        scatter(ia, is, total, right);
      }
    });
    double trace = 0.0;
    for (std::size_t f = 0; f < functions_.size(); ++f) trace += matrix_[kStencil * f + kStencil / 2];
    constexpr double kLeastRidge = 1e-5;
    const auto least =
        static_cast<float>(kLeastRidge * trace / static_cast<double>(std::max<std::size_t>(functions_.size(), 1)));
    for (std::size_t f = 0; f < functions_.size(); ++f)
      matrix_[kStencil * f + kStencil / 2] +=
          std::max(ridge.empty() ? 0.0f : ridge[functions_[f]], ridge.empty() ? least : 1e-3f * least);
  }

  LevelSolution solve(std::vector<double>& x) const {
    const std::size_t n = functions_.size();
    x.assign(n, 0.0);
    std::vector<double> r = rhs_, z(n), p(n), q(n);
    LevelSolution out;
    const auto precondition = [&] {
      for (std::size_t f = 0; f < n; ++f) {
        const double diagonal = matrix_[kStencil * f + kStencil / 2];
        z[f] = diagonal > 0.0 ? r[f] / diagonal : 0.0;
      }
    };
    precondition();
    p = z;
    double rz = dot(r, z);
    const double start = std::sqrt(dot(r, r));
    constexpr double kEnough = 1e-7;
    constexpr int kMost = 400;
    while (out.iterations < kMost && start > 0.0 && rz > 0.0) {
      apply(p, q);
      const double pq = dot(p, q);
      if (!(pq > 0.0)) break;
      const double step = rz / pq;
      for (std::size_t f = 0; f < n; ++f) {
        x[f] += step * p[f];
        r[f] -= step * q[f];
      }
      ++out.iterations;
      out.reduction = std::sqrt(dot(r, r)) / start;
      if (out.reduction < kEnough) break;
      precondition();
      const double next = dot(r, z);
      const double keep = next / rz;
      rz = next;
      for (std::size_t f = 0; f < n; ++f) p[f] = z[f] + keep * p[f];
    }
    return out;
  }

  std::span<const std::uint32_t> functions() const { return functions_; }

  bool touches_active(std::size_t ia, std::size_t is) const {
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        if (level_.active[level_.function_a(ia, i) * level_.functions_s() + is + k] != 0) return true;
    return false;
  }

 private:
  static double dot(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t k = 0; k < a.size(); ++k) sum += a[k] * b[k];
    return sum;
  }

  void scatter(std::size_t ia, std::size_t is, const std::array<double, 256>& total,
               const std::array<double, 16>& right) {
    std::array<std::int32_t, 16> at;
    for (std::size_t i = 0; i < 4; ++i)
      for (std::size_t k = 0; k < 4; ++k)
        at[4 * i + k] = number_[level_.function_a(ia, i) * level_.functions_s() + is + k];
    for (std::size_t m = 0; m < 16; ++m) {
      if (at[m] < 0) continue;
      rhs_[static_cast<std::size_t>(at[m])] += right[m];
      for (std::size_t n = 0; n < 16; ++n) {
        if (at[n] < 0) continue;
        const std::size_t high = std::max(m, n), low = std::min(m, n);
        const std::size_t place = (n / 4 + 3 - m / 4) * 7 + (n % 4 + 3 - m % 4);
        matrix_[kStencil * static_cast<std::size_t>(at[m]) + place] += static_cast<float>(total[16 * high + low]);
      }
    }
  }

  void apply(const std::vector<double>& x, std::vector<double>& y) const {
    const auto across = static_cast<std::ptrdiff_t>(level_.functions_s()),
               along = static_cast<std::ptrdiff_t>(level_.functions_a());
    constexpr std::size_t kBlock = 2048;
    parallel_for((functions_.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
      for (std::size_t f = kBlock * block; f < std::min(functions_.size(), kBlock * (block + 1)); ++f) {
        const auto ja = static_cast<std::ptrdiff_t>(functions_[f]) / across,
                   js = static_cast<std::ptrdiff_t>(functions_[f]) % across;
        const float* row = matrix_.data() + kStencil * f;
        double sum = 0.0;
        for (std::ptrdiff_t da = -3; da <= 3; ++da) {
          std::ptrdiff_t ka = ja + da;
          if (ka < 0 || ka >= along) {
            if (!level_.closed) continue;
            ka = (ka + 2 * along) % along;
          }
          const std::ptrdiff_t from = std::max<std::ptrdiff_t>(-3, -js),
                               to = std::min<std::ptrdiff_t>(3, across - 1 - js);
          for (std::ptrdiff_t ds = from; ds <= to; ++ds)
            if (const std::int32_t other = number_[static_cast<std::size_t>(ka * across + js + ds)]; other >= 0)
              sum += row[(da + 3) * 7 + ds + 3] * x[static_cast<std::size_t>(other)];
        }
        y[f] = sum;
      }
    });
  }

  const SplineLevel& level_;
  std::vector<std::int32_t> number_;
  std::vector<std::uint32_t> functions_;
  std::vector<float> matrix_;
  std::vector<double> rhs_;
};

}  // namespace

FunctionSums sum_functions(const BandPoints& points, std::span<const float> residual, std::span<const float> weight,
                           const SplineLevel& level) {
  FunctionSums out;
  for (auto* sums : {&out.wbr, &out.wbb, &out.points}) sums->assign(level.size(), 0.0);
  const Geometry g(points, level);
  by_colours(level, [&](std::size_t ia) {
    for (std::size_t is = 0; is < level.intervals_s; ++is) {
      std::array<double, 16> wbr{}, wbb{}, b_sum{};
      // what outliers are left must not call for functions
      fastest_kernel<PointSums>().functions(points_of(points, level, g, ia, is), residual.data(), weight.data(), kClip,
                                            wbr.data(), wbb.data(), b_sum.data());
      for (std::size_t m = 0; m < 16; ++m) {
        const std::size_t f = level.function_a(ia, m / 4) * level.functions_s() + is + m % 4;
        out.wbr[f] += wbr[m];
        out.wbb[f] += wbb[m];
        out.points[f] += b_sum[m];
      }
    }
  });
  return out;
}

LevelSolution fit_level(const BandPoints& points, std::span<float> residual, std::span<const float> weight,
                        std::span<const float> ridge, SplineLevel& level) {
  const NormalEquations equations(points, residual, weight, ridge, level);
  std::vector<double> x;
  const LevelSolution out = equations.solve(x);
  level.coefficient.assign(level.size(), 0.0f);
  const auto functions = equations.functions();
  for (std::size_t f = 0; f < functions.size(); ++f) level.coefficient[functions[f]] = static_cast<float>(x[f]);
  const Geometry g(points, level);
  parallel_for(level.intervals_a, [&](std::size_t ia) {
    for (std::size_t is = 0; is < level.intervals_s; ++is) {
      if (!equations.touches_active(ia, is)) continue;
      std::array<double, 16> c;
      for (std::size_t m = 0; m < 16; ++m)
        c[m] = level.coefficient[level.function_a(ia, m / 4) * level.functions_s() + is + m % 4];
      fastest_kernel<PointSums>().subtract(points_of(points, level, g, ia, is), c.data(), residual.data());
    }
  });
  return out;
}

}  // namespace treadmark::scans
