// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

namespace treadmark::kalker {

inline constexpr double kPoisson = 0.28, kDifference = 0.11;  ///< Poisson's ratio, K of dissimilar bodies

inline constexpr std::array<std::pair<const char*, double InfluenceBlock::*>, 9> kAllCoefficients{
    {{"xx", &InfluenceBlock::xx},
     {"xy", &InfluenceBlock::xy},
     {"xn", &InfluenceBlock::xn},
     {"yx", &InfluenceBlock::yx},
     {"yy", &InfluenceBlock::yy},
     {"yn", &InfluenceBlock::yn},
     {"nx", &InfluenceBlock::nx},
     {"ny", &InfluenceBlock::ny},
     {"nn", &InfluenceBlock::nn}}};

/// Displacement differences times G by unit forces on two half-spaces (Boussinesq, Cerruti; Johnson 1985
/// sec. 3.2, 3.6).
inline InfluenceBlock point_solution(double x, double y, double poisson, double difference) {
  const double r = std::hypot(x, y), factor = std::numbers::inv_pi / r;
  InfluenceBlock u;
  u.nn = factor * (1.0 - poisson);
  u.xx = factor * (1.0 - poisson + poisson * x * x / (r * r));
  u.yy = factor * (1.0 - poisson + poisson * y * y / (r * r));
  u.xy = u.yx = factor * poisson * x * y / (r * r);
  u.nx = factor * difference * x / r;
  u.ny = factor * difference * y / r;
  u.xn = -u.nx;
  u.yn = -u.ny;
  return u;
}

/// sum += factor * block
inline void add(InfluenceBlock& sum, double factor, const InfluenceBlock& block) {
  for (const auto& [name, c] : kAllCoefficients) sum.*c += factor * (block.*c);
}

/// f(x, y, weight of the node) summed over the rectangle by a five-point Gauss rule on panels x panels squares.
template <class Function>
void for_gauss_nodes(double x1, double x2, double y1, double y2, int panels, const Function& f) {
  constexpr std::array<double, 5> node{-0.9061798459386640, -0.5384693101056831, 0.0, 0.5384693101056831,
                                       0.9061798459386640};
  constexpr std::array<double, 5> weight{0.2369268850561891, 0.4786286704993665, 0.5688888888888889, 0.4786286704993665,
                                         0.2369268850561891};
  const double hx = (x2 - x1) / panels, hy = (y2 - y1) / panels;
  for (int ix = 0; ix < panels; ++ix)
    for (int iy = 0; iy < panels; ++iy)
      for (std::size_t kx = 0; kx < 5; ++kx)
        for (std::size_t ky = 0; ky < 5; ++ky)
          f(x1 + hx * (ix + 0.5 + 0.5 * node[kx]), y1 + hy * (iy + 0.5 + 0.5 * node[ky]),
            0.25 * hx * hy * weight[kx] * weight[ky]);
}

}  // namespace treadmark::kalker
