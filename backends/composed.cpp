// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/backends/analytic/defects/moving_section.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/assembly/limited_surface.hpp"
#include "treadmark/backends/assembly/outermost_surface.hpp"
#include "treadmark/backends/assembly/placed_surface.hpp"
#include "treadmark/backends/assembly/ring.hpp"
#include "treadmark/backends/assembly/roller.hpp"
#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/natural_kind.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/stopwatch.hpp"

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

Pose shifted(const Vec3& offset) { return {offset, Mat3::Identity()}; }

std::shared_ptr<const Surface> placed(std::shared_ptr<const Surface> surface, const Vec3& offset) {
  return offset.isZero(0.0) ? surface : assembly::place_surface(std::move(surface), shifted(offset));
}

[[noreturn]] void refuse_splines() {
  throw Error(ErrorKind::configuration, "files of splines hold rails and wheels, not rollers", {},
              "write slices or triangles");
}

[[noreturn]] void refuse_offsets() {
  throw Error(ErrorKind::configuration, "files of offsets hold rails and wheels, not rollers", {},
              "write slices or triangles");
}

class RollerKind final : public NaturalKind {
 public:
  RollerKind(NaturalSurface wheel, double radius) : wheel_(std::move(wheel)), radius_(radius) {}

  RepresentedSurface represent(const NaturalSurface& roller, const Representation& wanted) const override {
    RepresentedSurface out = treadmark::represent(wheel_, of_wheel(wanted));
    if (!out.resampled) {
      out.surface = roller.surface;
      out.region = wanted.region;
      return out;
    }
    out.surface = assembly::turn_over(out.surface, radius_);
    out.region = roller_region(out.region, radius_);
    return out;
  }

  SurfaceDifference fit_error(const NaturalSurface&, const RepresentedSurface& represented) const override {
    RepresentedSurface wheel = represented;
    wheel.surface = assembly::turn_over(represented.surface, radius_);
    wheel.region = {represented.region.u_min / radius_, represented.region.u_max / radius_, -represented.region.y_max,
                    -represented.region.y_min};
    SurfaceDifference d = treadmark::fit_error(wheel_, wheel);
    d.worst_u *= radius_;
    d.worst_y *= -1.0;
    return d;
  }

  TriangleMesh to_triangles(const NaturalSurface&, const Representation& wanted, Sampled* sampled) const override {
    TriangleMesh wheel = treadmark::to_triangles(wheel_, of_wheel(wanted), sampled);
    turn_back(sampled);
    return assembly::roller_triangles(std::move(wheel), radius_);
  }

  SliceSet to_slices(const NaturalSurface&, const Representation& wanted, Sampled* sampled) const override {
    const SliceSet wheel = treadmark::to_slices(wheel_, of_wheel(wanted), sampled);
    turn_back(sampled);
    return assembly::roller_slices(wheel, radius_);
  }

  std::vector<SplineSurface> to_splines(const NaturalSurface&, const Representation&, Sampled*) const override {
    refuse_splines();
  }

  void write_offsets(const std::filesystem::path&, const NaturalSurface&, const Representation&, Sampled*,
                     const SurfaceSpec*, const std::string&) const override {
    refuse_offsets();
  }

 private:
  Representation of_wheel(const Representation& wanted) const {
    return {wanted.backend, wanted.resolution, wheel_region(wanted.region, radius_)};
  }
  void turn_back(Sampled* sampled) const {
    if (sampled != nullptr) sampled->region = roller_region(sampled->region, radius_);
  }

  NaturalSurface wheel_;  ///< that the roller is when turned over, in the wheel's own frame
  double radius_;
};

/// Slices of a rail go on for ever, those of a ring end.
std::shared_ptr<const Surface> slice_ring(SliceSet slices) {
  const double first = slices.u.front(), last = slices.u.back();
  return assembly::limit_along(make_natural({Body::rail, 0.0, std::move(slices), {}}), first, last);
}

class RingKind final : public NaturalKind {
 public:
  /// The backend of slices goes through sections at the joints of a formula; everything else is sampled from the ring.
  RepresentedSurface represent(const NaturalSurface& ring, const Representation& wanted) const override {
    const bool slices = wanted.backend == natural_backend({Body::rail, 0.0, SliceSet{}, {}}).name;
    const double step = wanted.resolution > 0.0 ? wanted.resolution : kResampleStep;
    if (!slices || !is_formula(ring.spec)) {
      RepresentedSurface sampled = treadmark::represent(as_rail(ring), wanted);
      if (sampled.resampled)
        sampled.surface = assembly::limit_along(std::move(sampled.surface), sampled.region.u_min, sampled.region.u_max);
      return sampled;
    }
    RepresentedSurface out;
    const double start = used_seconds();
    out.resampled = true;
    out.resolution = step;
    out.surface = slice_ring(assembly::ring_slices(*sampled_formula(ring.spec, step), ring.spec.roller_radius));
    const Box3 box = out.surface->bounds();
    out.region = wanted.region;
    out.region.u_min = std::max(out.region.u_min, box.min.x());
    out.region.u_max = std::min(out.region.u_max, box.max.x());
    out.build_seconds = used_seconds() - start;
    return out;
  }

  TriangleMesh to_triangles(const NaturalSurface& ring, const Representation& wanted, Sampled* sampled) const override {
    return treadmark::to_triangles(as_rail(ring), wanted, sampled);
  }

  SliceSet to_slices(const NaturalSurface& ring, const Representation& wanted, Sampled* sampled) const override {
    return treadmark::to_slices(as_rail(ring), wanted, sampled);
  }

  std::vector<SplineSurface> to_splines(const NaturalSurface&, const Representation&, Sampled*) const override {
    refuse_splines();
  }

  void write_offsets(const std::filesystem::path&, const NaturalSurface&, const Representation&, Sampled*,
                     const SurfaceSpec*, const std::string&) const override {
    refuse_offsets();
  }

 private:
  /// A rail that changes along the track, of unknown origin: sampled from its surface.
  static NaturalSurface as_rail(const NaturalSurface& ring) {
    NaturalSurface rail{{}, ring.surface, ring.note};
    rail.spec.shape = SliceSet{};
    return rail;
  }
};

class PartsKind final : public NaturalKind {
 public:
  explicit PartsKind(std::vector<SurfacePart> parts) : parts_(std::move(parts)) {}

  RepresentedSurface represent(const NaturalSurface& whole, const Representation& wanted) const override {
    RepresentedSurface out;
    out.region = wanted.region;
    std::vector<std::shared_ptr<const Surface>> surfaces;
    std::vector<RepresentedSurface> represented(parts_.size());
    parallel_for(parts_.size(), [&](std::size_t i) {
      represented[i] = treadmark::represent(*parts_[i].natural, own(parts_[i], wanted));
    });
    surfaces.reserve(parts_.size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      const SurfacePart& part = parts_[i];
      const RepresentedSurface& r = represented[i];
      const double along = along_of(part);
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

  std::vector<SplineSurface> to_splines(const NaturalSurface&, const Representation& wanted,
                                        Sampled* sampled) const override {
    std::vector<SplineSurface> out;
    if (sampled != nullptr) *sampled = {0.0, wanted.region, {}};
    for (const SurfacePart& part : parts_) {
      Sampled of_part;
      for (SplineSurface& splines : treadmark::to_splines(*part.natural, own(part, wanted), &of_part)) {
        for (Vec3& p : splines.points) p += part.offset;
        out.push_back(std::move(splines));
      }
      if (sampled == nullptr) continue;
      sampled->resolution = std::max(sampled->resolution, of_part.resolution);
      sampled->note += of_part.note;
    }
    return out;
  }

 private:
  double along_of(const SurfacePart& part) const {
    return part.natural->spec.body == Body::rail ? part.offset.x() : 0.0;
  }
  /// What is wanted of the whole, of a part.
  Representation own(const SurfacePart& part, const Representation& wanted) const {
    Representation out{part.backend.empty() ? wanted.backend : part.backend, part.resolution, wanted.region};
    const bool sampled = !out.backend.empty() && backend_of(out.backend).resample;
    if (out.resolution == 0.0 && sampled) out.resolution = wanted.resolution;
    out.region.u_min -= along_of(part);
    out.region.u_max -= along_of(part);
    out.region.y_min -= part.offset.y();
    out.region.y_max -= part.offset.y();
    return out;
  }

  std::vector<SurfacePart> parts_;
};

}  // namespace

NaturalSurface create_roller(SurfaceSpec spec) {
  const double radius = spec.roller_radius;
  NaturalSurface wheel = create_natural(assembly::wheel_of_roller(spec));
  if (!spec.defects.empty()) {
    wheel.surface = assembly::add_roller_defects(wheel.surface, spec.defects, radius);
    wheel.spec.shape = SliceSet{};  // known no longer: resampled from the surface
  }
  NaturalSurface natural{std::move(spec), assembly::turn_over(wheel.surface, radius), wheel.note};
  natural.kind = std::make_shared<const RollerKind>(std::move(wheel), radius);
  return natural;
}

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
    natural.surface = assembly::make_ring_surface(
        chain != nullptr ? *chain
                         : std::get<ArcChain>(analytic::standard_curve(std::get<StandardProfile>(spec.shape).name)),
        radius);
  }
  natural.kind = std::make_shared<const RingKind>();
  natural.spec = std::move(spec);
  return natural;
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
    add_doubts(natural.spec.doubts, spec.doubts);
  }
  const auto uncertain =
      ranges::count_if(parts, [](const SurfacePart& part) { return part.natural->spec.errors != nullptr; });
  if (uncertain > 0)
    natural.note +=
        fmt::format("what scatter of their scans leaves uncertain of {} of its {} parts is not counted in results. ",
                    uncertain, parts.size());
  natural.surface = assembly::outermost_of(std::move(surfaces));
  natural.spec.body = parts.front().natural->spec.body;
  natural.spec.nominal_radius = parts.front().natural->spec.nominal_radius;
  natural.spec.shape = SliceSet{};  // several: resampled from the surface
  natural.kind = std::make_shared<const PartsKind>(std::move(parts));
  return natural;
}

SliceSet move_section(const SurfaceSpec& section, const MovingSection& motion) {
  if (const auto* points = std::get_if<Profile>(&section.shape))
    return analytic::moving_section_slices(*points, motion);
  if (const auto formula = sampled_formula(section, kResampleStep))
    return analytic::moving_section_slices(*formula, motion);
  throw Error(ErrorKind::configuration, "only one section can move along the track, not slices or triangles");
}

}  // namespace treadmark
