// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/track_receptance.hpp"

#include <cmath>

#include <fmt/format.h>
#include <Eigen/LU>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/vehicle/multibody.hpp"

namespace treadmark::vehicle {

std::vector<std::complex<double>> receptance(const TrackModel& track, Freedom direction,
                                             std::span<const double> frequency) {
  using Complex = std::complex<double>;
  if (direction != Freedom::y && direction != Freedom::z)
    throw Error(ErrorKind::configuration, "receptances of tracks are lateral or vertical");
  // A wheelset that nothing connects with the track below it.
  VehicleModel above;
  BodySpec wheelset;
  wheelset.name = "wheelset of no consequence";
  wheelset.mass = 1.0;
  wheelset.free[static_cast<std::size_t>(Freedom::z)] = true;
  above.bodies = {wheelset};
  above.wheelsets = {{wheelset.name, 1.0}};
  const Multibody system = assemble(above, track, 1.0, 0.0);

  const int left = system.wheelsets.front().left_rail;
  const Eigen::Index own = 1, n = system.size() - own;
  Vector force = Vector::Zero(n);
  if (left >= 0) {
    const double y = system.rails[static_cast<std::size_t>(left)].centre.y();
    const auto map = pair_map(system, 0, wheelrail::Side::left, Vec3(0.0, y, 0.0));
    force = map.row(direction == Freedom::y ? 6 : 7).tail(n).transpose();
  }
  std::vector<Complex> result;
  for (const double f : frequency) {
    if (force.isZero(0.0)) {
      result.emplace_back(0.0);
      continue;
    }
    const double w = 2.0 * kPi * f;
    Eigen::MatrixXcd dynamic = system.stiffness.bottomRightCorner(n, n).cast<Complex>() +
                               Complex(0.0, w) * system.damping.bottomRightCorner(n, n).cast<Complex>();
    dynamic.diagonal() -= (w * w * system.mass.tail(n)).cast<Complex>();
    const Eigen::VectorXcd q = dynamic.partialPivLu().solve(force.cast<Complex>());
    const Complex value = (force.cast<Complex>().transpose() * q).value();
    if (!std::isfinite(value.real()) || !std::isfinite(value.imag()))
      throw Error(ErrorKind::numerical, fmt::format("the track has no receptance at {:.6g} Hz", f), {},
                  "nothing damps it");
    result.push_back(value);
  }
  return result;
}

}  // namespace treadmark::vehicle
