// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/subsurface/half_space_body.hpp"
#include "treadmark/solvers/kalker/subsurface/loaded_corners.hpp"

namespace treadmark::kalker {

namespace {

using LoadPotentials = std::array<Potentials, kSurfaceLoads>;

LoadPotentials summed_potentials(const std::vector<LoadedCorner>& corners, const Vec3& point, double depth,
                                 double least) {
  LoadPotentials sums{};
  for (const LoadedCorner& corner : corners) {
    const Potentials values = corner_potentials(point.x() - corner.x, point.y() - corner.y, depth, least);
    for (std::size_t k = 0; k < kSurfaceLoads; ++k)
      for (std::size_t i = 0; i < kPotentialCount; ++i) sums[k][i] += corner.weight[k] * values[i];
  }
  return sums;
}

SubsurfacePoint stress_at(const std::vector<LoadedCorner>& corners, const Material& material, const Vec3& point,
                          double least) {
  const HalfSpaceBody body = body_at(material, point.z());
  const double depth = body.depth(point.z());
  const LoadPotentials potentials = summed_potentials(corners, point, depth, least);
  FieldParts parts{};
  for (std::size_t k = 0; k < kSurfaceLoads; ++k) {
    const auto load = static_cast<SurfaceLoad>(k);
    const FieldParts field = half_space_field(load, potentials[k], depth, body.poisson);
    for (std::size_t i = 0; i < kFieldPartCount; ++i) parts[i] += body.traction_sign(load) * field[i];
  }
  return subsurface_point(body, point, parts);
}

}  // namespace

std::vector<SubsurfacePoint> subsurface_stress(const SurfaceTractions& tractions, const Material& material,
                                               std::span<const Vec3> points) {
  check_tractions(tractions);
  for (const Vec3& point : points)
    if (!point.allFinite())
      throw Error(ErrorKind::configuration, "stresses below the surface: a point has a coordinate that is not finite");
  const std::vector<LoadedCorner> corners = loaded_corners(tractions);
  const double least = least_distance(tractions.grid);
  std::vector<SubsurfacePoint> results(points.size());
  parallel_for(points.size(), [&](std::size_t i) { results[i] = stress_at(corners, material, points[i], least); });
  return results;
}

std::vector<Vec3> block_of_points(std::span<const double> x, std::span<const double> y, std::span<const double> z) {
  std::vector<Vec3> points;
  points.reserve(x.size() * y.size() * z.size());
  for (const double pz : z)
    for (const double py : y)
      for (const double px : x) points.emplace_back(px, py, pz);
  return points;
}

}  // namespace treadmark::kalker
