// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/natural_kind.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/backends/offset_backend.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/backends/sampling/difference.hpp"
#include "treadmark/backends/undamaged_base.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/stopwatch.hpp"

namespace treadmark {
namespace {

/// Formulas need no samples where they are asked for as formulas, splines none where points are given.
bool is_natural(const NaturalSurface& natural, const Representation& wanted) {
  if (wanted.backend.empty()) return true;
  const Backend& backend = backend_of(wanted.backend);
  if (natural.surface->backend() != wanted.backend) return false;
  return !backend.resample || !(wanted.resolution > 0.0);
}

}  // namespace

RepresentedSurface NaturalKind::represent(const NaturalSurface& natural, const Representation& wanted) const {
  const double start = used_seconds();
  RepresentedSurface out;
  out.region = wanted.region;
  if (is_natural(natural, wanted)) {
    out.surface = natural.surface;
    out.note = natural.note;
    return out;
  }
  Resampling resampling(natural, wanted);
  const Backend& backend = backend_of(wanted.backend);
  if (!backend.resample)
    throw Error(ErrorKind::configuration, fmt::format("the backend '{}' needs {}", backend.name, backend.needs), {},
                backend.advice);
  out.surface = backend.resample(resampling);
  if (out.surface == nullptr)
    throw Error(ErrorKind::configuration, fmt::format("the backend '{}' made no surface", backend.name));
  out.resampled = true;
  const Sampled sampled = resampling.sampled();
  out.resolution = sampled.resolution;
  out.region = sampled.region;
  out.note = sampled.note;
  out.build_seconds = used_seconds() - start;
  return out;
}

SurfaceDifference NaturalKind::fit_error(const NaturalSurface& natural, const RepresentedSurface& represented) const {
  sampling::DifferenceSettings settings;
  settings.region = represented.region;
  if (natural.spec.body == Body::rail && !std::isfinite(natural.surface->bounds().max.x())) {
    if (!std::isfinite(settings.region.u_min)) settings.region.u_min = -kDefaultHalfLength;
    if (!std::isfinite(settings.region.u_max)) settings.region.u_max = kDefaultHalfLength;
  }
  // of a part of a wheel, by its box
  if (const Box3 box = natural.surface->bounds(); natural.spec.body == Body::wheel && box.min.z() > 0.0) {
    const auto angle = [&](double x, bool outer) { return std::atan2(x, outer ? box.min.z() : box.max.z()); };
    settings.region.u_min = std::max(settings.region.u_min, angle(box.min.x(), box.min.x() < 0.0));
    settings.region.u_max = std::min(settings.region.u_max, angle(box.max.x(), box.max.x() > 0.0));
  }
  return sampling::difference(*natural.surface, *represented.surface, natural.spec.body, natural.spec.nominal_radius,
                              settings);
}

TriangleMesh NaturalKind::to_triangles(const NaturalSurface& natural, const Representation& wanted,
                                       Sampled* sampled) const {
  Resampling resampling(natural, wanted);
  TriangleMesh mesh = resampling.triangles();
  if (sampled != nullptr) *sampled = resampling.sampled();
  return mesh;
}

SliceSet NaturalKind::to_slices(const NaturalSurface& natural, const Representation& wanted, Sampled* sampled) const {
  Resampling resampling(natural, wanted);
  SliceSet slices = resampling.slices();
  if (sampled != nullptr) *sampled = resampling.sampled();
  return slices;
}

const SplineSurface* given_splines(const NaturalSurface& natural, const Representation& wanted) {
  const auto* given = std::get_if<SplineSurface>(&natural.spec.shape);
  const Region& r = wanted.region;
  const bool all_of_it =
      !std::isfinite(r.u_min) && !std::isfinite(r.u_max) && !std::isfinite(r.y_min) && !std::isfinite(r.y_max);
  const bool as_it_is = natural.spec.defects.empty() && !(wanted.resolution > 0.0) && is_natural(natural, wanted);
  return all_of_it && as_it_is ? given : nullptr;
}

std::vector<SplineSurface> NaturalKind::to_splines(const NaturalSurface& natural, const Representation& wanted,
                                                   Sampled* sampled) const {
  if (const SplineSurface* given = given_splines(natural, wanted)) {
    if (sampled != nullptr) *sampled = {0.0, wanted.region, natural.note};
    return {*given};
  }
  const Backend& backend = backend_of(wanted.backend.empty() ? "nurbs" : wanted.backend);
  if (!backend.tell_splines)
    throw Error(ErrorKind::configuration, fmt::format("the backend '{}' has no splines to write", backend.name), {},
                "nurbs, thb and thb-quadratic have");
  Resampling resampling(natural, wanted);
  std::vector<SplineSurface> out{backend.tell_splines(resampling)};
  if (sampled != nullptr) *sampled = resampling.sampled();
  return out;
}

void NaturalKind::write_offsets(const std::filesystem::path& file, const NaturalSurface& natural,
                                const Representation& wanted, Sampled* sampled, const SurfaceSpec* base,
                                const std::string& notes) const {
  Resampling resampling(natural, wanted);
  UndamagedBase below = undamaged_base(resampling, base);
  offset::OffsetFile content;
  content.offsets = offsets_over(resampling, *below.surface, below.region_uy).offsets;
  content.base = std::move(below.spec);
  content.base.errors = natural.spec.errors;
  content.base.doubts = natural.spec.doubts;
  content.notes = notes;
  if (sampled != nullptr) *sampled = resampling.sampled();
  offset::write_vdb(file, content);
}

}  // namespace treadmark
