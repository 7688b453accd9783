// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/make.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "treadmark/backends/levelset/level_set_surface.hpp"
#include "treadmark/backends/levelset/solids.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::levelset {

namespace {

constexpr double kDefaultVoxel = 0.5e-3;  ///< [m]

std::shared_ptr<const Surface> surface_of(TriangleDistances distances, Body body, std::string backend) {
  DistanceField field(std::move(distances.grid), distances.rim);
  return std::make_shared<const LevelSetSurface>(std::move(field), body == Body::wheel ? Facing::down : Facing::up,
                                                 std::move(backend));
}

/// Files in another unit than they are said to be in show in their size.
void check_size(const Surface& surface, Body body, double nominal_radius, const std::string& name) {
  constexpr double kLeast = 0.5, kMost = 1.5, kWidestRail = 1.0;
  const Box3 box = surface.bounds();
  const char* advice = "is the factor from the units of the file to mm right? (scale_to_mm)";
  if (body == Body::wheel) {
    const double reach = std::max({-box.min.z(), box.max.z(), -box.min.x(), box.max.x()});
    if (!(reach > kLeast * nominal_radius && reach < kMost * nominal_radius))
      throw Error(ErrorKind::input_data,
                  fmt::format("'{}' reaches {:.6g} mm from the axle, the nominal radius is {:.6g} mm", name,
                              1e3 * reach, 1e3 * nominal_radius),
                  {}, advice);
    return;
  }
  const Vec3 size = box.max - box.min;
  if (!(std::max(size.y(), size.z()) < kWidestRail))
    throw Error(ErrorKind::input_data,
                fmt::format("'{}' is {:.4g} m wide and {:.4g} m high, which no rail is (at most {:g} m)", name,
                            size.y(), size.z(), kWidestRail),
                {}, advice);
}

}  // namespace

std::shared_ptr<const Surface> make_level_set_surface(const TriangleMesh& mesh, Body body, double voxel,
                                                      std::string backend) {
  if (!(voxel > 0.0) || !std::isfinite(voxel))
    throw Error(ErrorKind::configuration, "the voxel of a level set must be positive");
  return surface_of(distances_of(mesh, voxel, body), body, std::move(backend));
}

std::shared_ptr<const Surface> make_level_set_surface(const SolidShape& shape, Body body, double nominal_radius,
                                                      std::string backend) {
  TriangleDistances distances = distances_of(shape, kDefaultVoxel, body);
  const std::string name = distances.grid.name;
  auto surface = surface_of(std::move(distances), body, std::move(backend));
  check_size(*surface, body, nominal_radius, name);
  return surface;
}

}  // namespace treadmark::levelset
