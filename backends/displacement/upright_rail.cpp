// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/upright_rail.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/parallel.hpp"

namespace treadmark::displacement {

namespace {
/// Inclination that moves no point by more than rounding.
constexpr double kUpright = 1e-15;
}  // namespace

bool is_upright_rail(Body body, const Pose& X_SP) {
  return body == Body::rail && std::fabs(X_SP.rotation(0, 2)) <= kUpright && std::fabs(X_SP.rotation(1, 2)) <= kUpright;
}

void UprightRail::add_many(const double* x, const double* y, std::size_t n, const HeightsOut& out,
                           std::size_t at) const {
  double u[kMany], v[kMany], d[kMany], d_u[kMany], d_v[kMany];
  const Mat3& R = X_.rotation;
  const double ox = X_.origin.x(), oy = X_.origin.y(), xx = R(0, 0), xy = R(0, 1), yx = R(1, 0), yy = R(1, 1),
               up = R(2, 2);
  for (std::size_t i = 0; i < n; ++i) {
    u[i] = ox + xx * x[i] + xy * y[i];
    v[i] = oy + yx * x[i] + yy * y[i];
  }
  const bool slopes = !out.dzdx.empty() || !out.dzdy.empty();
  field_.evaluate({u, n}, {v, n}, {d, n}, slopes ? std::span<double>(d_u, n) : std::span<double>(),
                  slopes ? std::span<double>(d_v, n) : std::span<double>());
  if (!out.z.empty())
    for (std::size_t i = 0; i < n; ++i) out.z[at + i] += up * d[i];
  if (!out.dzdx.empty())
    for (std::size_t i = 0; i < n; ++i) out.dzdx[at + i] += up * (xx * d_u[i] + yx * d_v[i]);
  if (!out.dzdy.empty())
    for (std::size_t i = 0; i < n; ++i) out.dzdy[at + i] += up * (xy * d_u[i] + yy * d_v[i]);
}

void UprightRail::add(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const Grid2& g = plane_grid.grid;
  const auto row = [&](int iy) {
    double x[kMany], y[kMany];
    std::fill_n(y, kMany, g.y(iy));
    for (int begin = 0; begin < g.nx; begin += static_cast<int>(kMany)) {
      const int n = std::min(static_cast<int>(kMany), g.nx - begin);
      for (int i = 0; i < n; ++i) x[i] = g.x(begin + i);
      add_many(x, y, static_cast<std::size_t>(n), out, g.index(begin, iy));
    }
  };
  if (g.nx == 1) {  // one call for the whole line
    double x[kMany], y[kMany];
    std::fill_n(x, kMany, g.x(0));
    for (int begin = 0; begin < g.ny; begin += static_cast<int>(kMany)) {
      const int n = std::min(static_cast<int>(kMany), g.ny - begin);
      for (int i = 0; i < n; ++i) y[i] = g.y(begin + i);
      add_many(x, y, static_cast<std::size_t>(n), out, g.index(0, begin));
    }
    return;
  }
  constexpr std::size_t kWorthThreads = 8192;
  constexpr int kRows = 16;
  const auto band = [&](std::size_t which) {
    const int first = static_cast<int>(which) * kRows;
    for (int iy = first; iy < std::min(first + kRows, g.ny); ++iy) row(iy);
  };
  const std::size_t bands = static_cast<std::size_t>((g.ny + kRows - 1) / kRows);
  if (g.size() < kWorthThreads)
    for (std::size_t b = 0; b < bands; ++b) band(b);
  else
    parallel_for(bands, band);
}

void UprightRail::add(std::span<const Vec2> points_P, const HeightsOut& out) const {
  double x[kMany], y[kMany];
  for (std::size_t begin = 0; begin < points_P.size(); begin += kMany) {
    const std::size_t n = std::min(kMany, points_P.size() - begin);
    for (std::size_t i = 0; i < n; ++i) x[i] = points_P[begin + i].x(), y[i] = points_P[begin + i].y();
    add_many(x, y, n, out, begin);
  }
}

bool UprightRail::undisturbed(const Rectangle& r) const {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Rectangle uy{kInfinity, -kInfinity, kInfinity, -kInfinity};
  for (int k = 0; k < 4; ++k) {
    const Vec3 q = X_.apply({k & 1 ? r.x_max : r.x_min, k & 2 ? r.y_max : r.y_min, 0.0});
    uy = {std::min(uy.x_min, q.x()), std::max(uy.x_max, q.x()), std::min(uy.y_min, q.y()), std::max(uy.y_max, q.y())};
  }
  constexpr double kRounding = 1e-12;
  return field_.range({uy.x_min - kRounding, uy.x_max + kRounding, uy.y_min - kRounding, uy.y_max + kRounding}).zero();
}

}  // namespace treadmark::displacement
