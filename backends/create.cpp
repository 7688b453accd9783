// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/create.hpp"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/standard_profiles.hpp"
#include "treadmark/backends/natural_kind.hpp"
#include "treadmark/backends/offset/make.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/model/shape/body_name.hpp"

namespace treadmark {
namespace {

void require_same_body(Body shape, Body wanted, std::string_view what) {
  if (shape != wanted)
    throw Error(ErrorKind::configuration,
                fmt::format("{} belongs to a {}, not to a {}", what, body_name(shape), body_name(wanted)));
}

void check(const SurfaceSpec& spec) {
  if (spec.body == Body::wheel && !(spec.nominal_radius > 0.0))
    throw Error(ErrorKind::configuration, "a wheel needs a positive nominal radius");
  if (spec.body == Body::wheel && spec.roller_radius != 0.0)
    throw Error(ErrorKind::configuration, "a roller takes the place of a rail, a wheel cannot be one");
  if (spec.roller_radius != 0.0 && std::holds_alternative<SplineSurface>(spec.shape))
    throw Error(ErrorKind::configuration, "a surface given by its splines cannot become a roller", {},
                "use a profile, slices or triangles");
  if (spec.roller_radius != 0.0 && std::holds_alternative<SolidShape>(spec.shape))
    throw Error(ErrorKind::configuration, "a surface made of solids cannot become a roller", {},
                "use a profile, slices or triangles");
  check_body(spec.defects, spec.body);
  if (const auto* points = std::get_if<Profile>(&spec.shape))
    require_same_body(points->body, spec.body, fmt::format("the profile '{}'", points->name));
  if (const auto* slices = std::get_if<SliceSet>(&spec.shape))
    require_same_body(slices->body, spec.body, fmt::format("the slices '{}'", slices->name));
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape))
    require_same_body(analytic::standard_profile_body(standard->name), spec.body,
                      fmt::format("the standard profile {}", standard->name));
}

}  // namespace

std::shared_ptr<const NaturalKind> plain_kind() {
  static const auto plain = std::make_shared<const NaturalKind>();
  return plain;
}

std::span<const std::string_view> standard_profile_names() { return analytic::standard_profile_names(); }

NaturalSurface create_natural(SurfaceSpec spec) {
  check(spec);
  if (spec.roller_radius < 0.0) return create_ring(std::move(spec));
  if (spec.roller_radius != 0.0) return create_roller(std::move(spec));
  NaturalSurface natural;
  natural.surface = natural_backend(spec).make_natural(spec, natural.note);
  natural.spec = std::move(spec);
  return natural;
}

NaturalSurface read_offset_surface(const std::filesystem::path& file) {
  offset::OffsetFile content = offset::read_vdb(file);
  check(content.base);
  NaturalSurface natural;
  natural.surface = offset::make_offset_surface(make_natural(content.base), content.offsets,
                                                offset::Interpolation::bicubic, "offset");
  natural.note = content.remark;
  // what lies below is known, but not what was added: it is resampled from the surface
  natural.spec.body = content.base.body;
  natural.spec.nominal_radius = content.base.nominal_radius;
  natural.spec.errors = content.base.errors;
  natural.spec.doubts = content.base.doubts;
  natural.spec.shape = SliceSet{};
  return natural;
}

RepresentedSurface represent(const NaturalSurface& natural, const Representation& wanted) {
  return natural.kind->represent(natural, wanted);
}

void refuse_idle_resolution(const SourcePosition& where) {
  throw Error(ErrorKind::configuration, "a resolution does nothing here: the surface is taken as it is, not sampled",
              where, "name a backend that samples it, or leave the resolution out");
}

SurfaceDifference fit_error(const NaturalSurface& natural, const RepresentedSurface& represented) {
  return natural.kind->fit_error(natural, represented);
}

std::shared_ptr<const Surface> create_surface(const SurfaceSpec& spec, std::string_view backend) {
  return represent(create_natural(spec), {std::string(backend), 0.0, {}}).surface;
}

TriangleMesh to_triangles(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) {
  return natural.kind->to_triangles(natural, wanted, sampled);
}

SliceSet to_slices(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) {
  return natural.kind->to_slices(natural, wanted, sampled);
}

std::vector<SplineSurface> to_splines(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) {
  return natural.kind->to_splines(natural, wanted, sampled);
}

void write_offsets(const std::filesystem::path& file, const NaturalSurface& natural, const Representation& wanted,
                   Sampled* sampled, const SurfaceSpec* base, const std::string& notes) {
  natural.kind->write_offsets(file, natural, wanted, sampled, base, notes);
}

}  // namespace treadmark
