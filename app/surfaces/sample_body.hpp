// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <memory>
#include <vector>

#include "treadmark/core/surface.hpp"
#include "treadmark/io/results/result_model.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::app {

/// A wheel or rail as an analysis used it.
struct UsedBody {
  Body body = Body::rail;
  std::shared_ptr<const Surface> surface;  ///< null: none is sampled
  std::shared_ptr<const Surface> beyond;   ///< its shape outside of low ... high, and where it has nothing; may be null
  bool constant = false;                   ///< all its sections are alike
  double radius = 0.0;                     ///< of a wheel; of a roller in place of a rail, < 0: a ring; 0: a rail [m]
  double low = -std::numeric_limits<double>::infinity(),
         high = std::numeric_limits<double>::infinity();  ///< stations of surface
};

/// Station at which a point lies (body axes): angle of a wheel or roller [rad], x of a rail [m].
double station_of(const UsedBody& body, const Vec3& point_B);

/// Samples a body for pictures. Wheels and rollers all round, every 2 degrees and about every millimetre within 60 mm
/// of contacts; rails 150 mm beyond the contacts, every 1.5 mm within 60 mm of them and every 20 mm elsewhere, finer
/// where that makes few points, 25 mm where all sections are alike; across, about 120 points in equal steps of arc
/// length over what a wheel can touch. Coarser than that where it would make more than 60000 points. Points are rounded
/// to 2^-30 m, deviations to 2^-33 m: files get much smaller. Deviations: height over the median of all sections,
/// weighted by their share of the length, times the cosine of that section's inclination; positive where there is more
/// material. Left out for constant bodies, rings, and rails that deviate by more than 5 mm. contacts: stations, not
/// empty. Parallel; the result does not depend on the number of threads. Errors: Error(configuration) where there is no
/// surface at the contacts; those of the surface.
io::SampledSurface sample_body(const UsedBody& body, const std::vector<double>& contacts);

}  // namespace treadmark::app
