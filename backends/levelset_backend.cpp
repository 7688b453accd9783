// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <variant>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/levelset/make.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark {
namespace {

constexpr const char* kName = "level-set";

bool is_solids(const SurfaceSpec& spec) { return std::holds_alternative<SolidShape>(spec.shape); }

std::shared_ptr<const Surface> natural_level_set(const SurfaceSpec& spec, std::string&) {
  auto surface =
      levelset::make_level_set_surface(std::get<SolidShape>(spec.shape), spec.body, spec.nominal_radius, kName);
  return analytic::add_defects(std::move(surface), spec.defects, spec.body, spec.nominal_radius);
}

/// What of the triangles lies in the region or near it; the rest would only take memory.
TriangleMesh near_region(TriangleMesh mesh, Body body, const Region& region, double margin) {
  const auto outside = [&](const std::array<std::uint32_t, 3>& corners) {
    Vec3 low = mesh.vertices[corners[0]], high = low;
    for (const std::uint32_t v : corners) low = low.cwiseMin(mesh.vertices[v]), high = high.cwiseMax(mesh.vertices[v]);
    if (low.y() > region.y_max + margin || high.y() < region.y_min - margin) return true;
    if (body == Body::rail) return low.x() > region.u_max + margin || high.x() < region.u_min - margin;
    const double half = 0.5 * (region.u_max - region.u_min);
    if (!std::isfinite(half)) return false;
    const Vec3 middle = 0.5 * (low + high);
    const double radius = std::hypot(middle.x(), middle.z()), size = margin + 0.5 * (high - low).norm();
    if (!(size < radius)) return false;
    const double reach = half + std::asin(size / radius);
    return std::fabs(wrap_angle(std::atan2(middle.x(), middle.z()) - 0.5 * (region.u_min + region.u_max))) > reach;
  };
  std::erase_if(mesh.triangles, outside);
  return mesh;
}

std::shared_ptr<const Surface> as_level_set(Resampling& r) {
  constexpr double kMargin = 8.0;  // voxels: a band ends outside of what is looked at
  const SurfaceSpec& spec = r.spec();
  const double voxel = r.resolution();
  const auto* given = std::get_if<TriangleMesh>(&spec.shape);
  // samples are heights, which have no undercuts: triangles that are given are taken as they are
  const bool as_given = given != nullptr && spec.defects.empty() && spec.roller_radius == 0.0;
  const TriangleMesh mesh = as_given ? near_region(*given, spec.body, r.region(), kMargin * voxel) : r.triangles();
  r.set_resolution(voxel);
  return levelset::make_level_set_surface(mesh, spec.body, voxel, kName);
}

}  // namespace

std::vector<Backend> levelset_backends() {
  Backend row{kName, "signed distances in a narrow band, interpolated by quadratic B-splines", 3.0, false,
              as_level_set};
  row.part = "openvdb";
  row.natural_for = is_solids;
  row.make_natural = natural_level_set;
  return {row};
}

}  // namespace treadmark
