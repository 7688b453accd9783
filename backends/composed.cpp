// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/composed.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>
#include <variant>

#include "treadmark/backends/analytic/moving_section.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/assembly/limited_surface.hpp"
#include "treadmark/backends/assembly/outermost_surface.hpp"
#include "treadmark/backends/assembly/placed_surface.hpp"
#include "treadmark/backends/assembly/ring.hpp"
#include "treadmark/backends/assembly/roller.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

/// Turned over: the arc length of a roller becomes an angle; points that a straight rail would have within x are inside
/// too.
Region wheel_region(const Region& roller, double radius) {
  constexpr double kSteep = 0.9;
  const auto angle = [radius](double x) {
    const double u = x / radius;
    return std::fabs(u) < kSteep ? std::asin(u) : u;
  };
  Region out{angle(roller.u_min), angle(roller.u_max), -roller.y_max, -roller.y_min};
  return out;
}

Region roller_region(const Region& wheel, double radius) {
  return {radius * wheel.u_min, radius * wheel.u_max, -wheel.y_max, -wheel.y_min};
}

Representation wanted_of_wheel(const NaturalSurface& roller, const Representation& wanted) {
  return {wanted.backend, wanted.resolution, wheel_region(wanted.region, roller.spec.roller_radius)};
}

Pose shifted(const Vec3& offset) { return {offset, Mat3::Identity()}; }

std::shared_ptr<const Surface> placed(std::shared_ptr<const Surface> surface, const Vec3& offset) {
  return offset.isZero(0.0) ? surface : assembly::place_surface(std::move(surface), shifted(offset));
}

void turn_back(Sampled* sampled, double radius) {
  if (sampled != nullptr) sampled->region = roller_region(sampled->region, radius);
}

/// Slices of a rail go on for ever, those of a ring end.
std::shared_ptr<const Surface> slice_ring(SliceSet slices) {
  const double first = slices.u.front(), last = slices.u.back();
  return assembly::limit_along(create_natural({Body::rail, 0.0, std::move(slices), {}}).surface, first, last);
}

}  // namespace

NaturalSurface create_roller(SurfaceSpec spec) {
  const double radius = spec.roller_radius;
  NaturalSurface wheel = create_natural(assembly::wheel_of_roller(spec));
  if (!spec.defects.empty()) {
    wheel.surface = assembly::add_roller_defects(wheel.surface, spec.defects, radius);
    wheel.spec.shape = SliceSet{};  // known no longer: resampled from the surface
  }
  NaturalSurface natural{std::move(spec), assembly::turn_over(wheel.surface, radius), wheel.note};
  natural.wheel_of_roller = std::make_shared<const NaturalSurface>(std::move(wheel));
  return natural;
}

RepresentedSurface represent_roller(const NaturalSurface& roller, const Representation& wanted) {
  RepresentedSurface out = represent(*roller.wheel_of_roller, wanted_of_wheel(roller, wanted));
  if (!out.resampled) {
    out.surface = roller.surface;
    out.region = wanted.region;
    return out;
  }
  out.surface = assembly::turn_over(out.surface, roller.spec.roller_radius);
  out.region = roller_region(out.region, roller.spec.roller_radius);
  return out;
}

SurfaceDifference roller_fit_error(const NaturalSurface& roller, const RepresentedSurface& represented) {
  const double radius = roller.spec.roller_radius;
  RepresentedSurface wheel = represented;
  wheel.surface = assembly::turn_over(represented.surface, radius);
  wheel.region = {represented.region.u_min / radius, represented.region.u_max / radius, -represented.region.y_max,
                  -represented.region.y_min};
  SurfaceDifference d = fit_error(*roller.wheel_of_roller, wheel);
  d.worst_u *= radius;
  d.worst_y *= -1.0;
  return d;
}

TriangleMesh roller_triangles(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) {
  TriangleMesh wheel = to_triangles(*natural.wheel_of_roller, wanted_of_wheel(natural, wanted), sampled);
  turn_back(sampled, natural.spec.roller_radius);
  return assembly::roller_triangles(std::move(wheel), natural.spec.roller_radius);
}

SliceSet roller_slices(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) {
  const SliceSet wheel = to_slices(*natural.wheel_of_roller, wanted_of_wheel(natural, wanted), sampled);
  turn_back(sampled, natural.spec.roller_radius);
  return assembly::roller_slices(wheel, natural.spec.roller_radius);
}

bool is_ring(const NaturalSurface& natural) { return natural.spec.roller_radius < 0.0 && natural.parts.empty(); }

NaturalSurface create_ring(SurfaceSpec spec) {
  const double radius = spec.roller_radius;
  if (!spec.defects.empty() || std::holds_alternative<SliceSet>(spec.shape))
    throw Error(ErrorKind::configuration, "a ring that a wheel runs in (negative radius) has one profile all round", {},
                "use triangles for a ring that is worn or damaged unevenly");
  NaturalSurface natural;
  if (const auto* mesh = std::get_if<TriangleMesh>(&spec.shape)) {
    assembly::ring_half_length(radius, 0.0);
    natural = create_natural({Body::rail, 0.0, assembly::lower_part(*mesh, radius), {}});
  } else if (const auto* points = std::get_if<Profile>(&spec.shape)) {
    natural.surface = slice_ring(assembly::ring_slices(*points, radius));
  } else {
    const auto* chain = std::get_if<ArcChain>(&spec.shape);
    natural.surface = assembly::make_ring_surface(chain != nullptr ? *chain : analytic::rail_60e1_chain(), radius);
  }
  natural.spec = std::move(spec);
  return natural;
}

NaturalSurface rail_of_ring(const NaturalSurface& ring) {
  NaturalSurface rail{{}, ring.surface, ring.note};
  rail.spec.shape = SliceSet{};
  return rail;
}

/// Splines go through sections at the joints of a formula; everything else is sampled from the ring.
RepresentedSurface represent_ring(const NaturalSurface& ring, const Representation& wanted) {
  const auto* chain = std::get_if<ArcChain>(&ring.spec.shape);
  const auto* standard = std::get_if<StandardProfile>(&ring.spec.shape);
  if (wanted.backend != "spline" || (chain == nullptr && standard == nullptr)) {
    RepresentedSurface sampled = represent(rail_of_ring(ring), wanted);
    if (sampled.resampled)
      sampled.surface = assembly::limit_along(std::move(sampled.surface), sampled.region.u_min, sampled.region.u_max);
    return sampled;
  }
  RepresentedSurface out;
  const auto start = std::chrono::steady_clock::now();
  out.resampled = true;
  out.resolution = wanted.resolution > 0.0 ? wanted.resolution : kResampleStep;
  const Profile profile = chain != nullptr ? analytic::sample_profile(*chain, Body::rail, out.resolution)
                                           : analytic::sample_profile(*standard, out.resolution);
  out.surface = slice_ring(assembly::ring_slices(profile, ring.spec.roller_radius));
  const Box3 box = out.surface->bounds();
  out.region = wanted.region;
  out.region.u_min = std::max(out.region.u_min, box.min.x());
  out.region.u_max = std::min(out.region.u_max, box.max.x());
  out.build_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  return out;
}

RepresentedSurface represent_parts(const NaturalSurface& whole, const Representation& wanted) {
  RepresentedSurface out;
  out.region = wanted.region;
  std::vector<std::shared_ptr<const Surface>> surfaces;
  for (const SurfacePart& part : whole.parts) {
    const bool rail = whole.spec.body == Body::rail;
    Representation own{part.backend.empty() ? wanted.backend : part.backend,
                       part.resolution > 0.0 ? part.resolution : wanted.resolution, wanted.region};
    const double along = rail ? part.offset.x() : 0.0;
    own.region.u_min -= along;
    own.region.u_max -= along;
    own.region.y_min -= part.offset.y();
    own.region.y_max -= part.offset.y();
    const RepresentedSurface r = represent(*part.natural, own);
    surfaces.push_back(placed(r.surface, part.offset));
    out.note += r.note;
    out.build_seconds += r.build_seconds;
    if (!r.resampled) continue;
    out.resampled = true;
    out.resolution = std::max(out.resolution, r.resolution);
    out.region.u_min = std::max(out.region.u_min, r.region.u_min + along);
    out.region.u_max = std::min(out.region.u_max, r.region.u_max + along);
  }
  out.surface = out.resampled ? assembly::outermost_of(std::move(surfaces)) : whole.surface;
  return out;
}

NaturalSurface join_surfaces(std::vector<SurfacePart> parts) {
  NaturalSurface natural;
  std::vector<std::shared_ptr<const Surface>> surfaces;
  for (const SurfacePart& part : parts) {
    if (part.natural == nullptr) throw Error(ErrorKind::configuration, "a part of a body has no surface");
    const SurfaceSpec &spec = part.natural->spec, &first = parts.front().natural->spec;
    if (spec.body != first.body || spec.nominal_radius != first.nominal_radius ||
        spec.roller_radius != first.roller_radius)
      throw Error(ErrorKind::configuration, "the parts of a body must be of one kind and radius");
    if ((spec.body == Body::wheel || spec.roller_radius != 0.0) && (part.offset.x() != 0.0 || part.offset.z() != 0.0))
      throw Error(ErrorKind::configuration, "parts of a wheel or roller must keep to its axle", {},
                  "offset them along y only");
    surfaces.push_back(placed(part.natural->surface, part.offset));
    natural.note += part.natural->note;
  }
  natural.surface = assembly::outermost_of(std::move(surfaces));
  natural.spec.body = parts.front().natural->spec.body;
  natural.spec.nominal_radius = parts.front().natural->spec.nominal_radius;
  natural.spec.shape = SliceSet{};  // several: resampled from the surface
  natural.parts = std::move(parts);
  return natural;
}

SliceSet move_section(const SurfaceSpec& section, const MovingSection& motion) {
  if (const auto* points = std::get_if<Profile>(&section.shape))
    return analytic::moving_section_slices(*points, motion);
  if (const auto* chain = std::get_if<ArcChain>(&section.shape))
    return analytic::moving_section_slices(analytic::sample_profile(*chain, section.body, kResampleStep), motion);
  if (const auto* standard = std::get_if<StandardProfile>(&section.shape))
    return analytic::moving_section_slices(analytic::sample_profile(*standard, kResampleStep), motion);
  throw Error(ErrorKind::configuration, "only one section can move along the track, not slices or triangles");
}

}  // namespace treadmark
