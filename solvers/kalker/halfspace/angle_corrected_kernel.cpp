// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/angle_corrected_kernel.hpp"

#include <cmath>
#include <numeric>
#include <utility>

#include "treadmark/core/error.hpp"

namespace treadmark::kalker {

namespace {

InfluenceBlock with_rotated_loads(const InfluenceBlock& a, double c, double s) {
  return {.xx = a.xx,
          .xy = a.xy * c + a.xn * s,
          .xn = a.xn * c - a.xy * s,
          .yx = a.yx,
          .yy = a.yy * c + a.yn * s,
          .yn = a.yn * c - a.yy * s,
          .nx = a.nx,
          .ny = a.ny * c + a.nn * s,
          .nn = a.nn * c - a.ny * s};
}

InfluenceBlock with_rotated_displacements(const InfluenceBlock& a, double c, double s) {
  return {.xx = a.xx,
          .xy = a.xy,
          .xn = a.xn,
          .yx = a.yx * c - a.nx * s,
          .yy = a.yy * c - a.ny * s,
          .yn = a.yn * c - a.nn * s,
          .nx = a.yx * s + a.nx * c,
          .ny = a.yy * s + a.ny * c,
          .nn = a.yn * s + a.nn * c};
}

}  // namespace

AngleFactors::AngleFactors(double alpha)
    : c(std::cos(alpha)), s(std::sin(alpha)), half_c(std::cos(0.5 * alpha)), half_s(std::sin(0.5 * alpha)) {}

InfluenceBlock corrected_for_angle(const InfluenceBlock& a, const AngleFactors& alpha, AngleCorrection correction) {
  switch (correction) {
    case AngleCorrection::rotated_loads:
      return with_rotated_loads(a, alpha.c, alpha.s);
    case AngleCorrection::rotated_loads_but_xn: {
      InfluenceBlock block = with_rotated_loads(a, alpha.c, alpha.s);
      block.xn = a.xn;
      return block;
    }
    case AngleCorrection::rotated_displacements:
      return with_rotated_displacements(a, alpha.c, alpha.s);
    case AngleCorrection::half_and_half:
      break;
  }
  return with_rotated_displacements(with_rotated_loads(a, alpha.half_c, alpha.half_s), alpha.half_c, alpha.half_s);
}

InfluenceBlock corrected_for_angle(const InfluenceBlock& a, double alpha, AngleCorrection correction) {
  return corrected_for_angle(a, AngleFactors(alpha), correction);
}

AngleCorrectedKernel::AngleCorrectedKernel(std::shared_ptr<const InfluenceKernel> half_space, double curvature,
                                           AngleCorrection correction)
    : half_space_(std::move(half_space)), curvature_(curvature), correction_(correction) {
  if (!half_space_) throw Error(ErrorKind::configuration, "coefficients to correct for angles are missing");
}

InfluenceBlock AngleCorrectedKernel::at(double X, double Y) const {
  return corrected_for_angle(half_space_->at(X, Y), -curvature_ * Y, correction_);
}

double regression_slope(std::span<const double> position, std::span<const double> value) {
  if (position.size() != value.size())
    throw Error(ErrorKind::configuration,
                std::to_string(position.size()) + " positions have " + std::to_string(value.size()) + " inclinations");
  const double count = static_cast<double>(position.size());
  const double mean_position = std::accumulate(position.begin(), position.end(), 0.0) / count;
  const double mean_value = std::accumulate(value.begin(), value.end(), 0.0) / count;
  double spread = 0.0, product = 0.0;
  for (std::size_t i = 0; i < position.size(); ++i) {
    spread += (position[i] - mean_position) * (position[i] - mean_position);
    product += (position[i] - mean_position) * (value[i] - mean_value);
  }
  const double slope = product / spread;
  if (!std::isfinite(slope))
    throw Error(ErrorKind::configuration, "no straight line through the inclinations of the surface", {},
                "give finite inclinations at two or more positions");
  return slope;
}

}  // namespace treadmark::kalker
