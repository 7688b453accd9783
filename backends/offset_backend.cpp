// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/offset_backend.hpp"

#include <utility>
#include <variant>

#include <fmt/format.h>

#include "treadmark/backends/builtin.hpp"
#include "treadmark/backends/following_base.hpp"
#include "treadmark/backends/undamaged_base.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

/// An offset that ends makes splines ring for some voxels: let it end outside.
double beyond(const Resampling& r) {
  constexpr double kBeyond = 8.0;
  return kBeyond * r.resolution() / (r.spec().body == Body::wheel ? r.spec().nominal_radius : 1.0);
}

std::shared_ptr<const Surface> as_offset(Resampling& r, offset::Interpolation interpolation, std::string backend) {
  std::shared_ptr<const Surface> base;
  offset::OffsetSample sample;
  const std::string note = r.note();
  try {
    const UndamagedBase undamaged = undamaged_base(r);
    base = undamaged.surface;
    sample = offsets_over(r, *base, undamaged.region_uy);
  } catch (const Error& one_section) {
    if (r.spec().body != Body::rail || one_section.kind() != ErrorKind::input_data) throw;
    r.set_note(note);
    // one section lies not below all of the rail: let the base follow it
    try {
      base = following_base(r);
      sample = offsets_over(r, *base, {r.region().u_min, r.region().u_max, r.region().y_min, r.region().y_max});
    } catch (const Error&) {
      throw one_section;
    }
  }
  return offset::make_offset_surface(std::move(base), sample.offsets, interpolation, std::move(backend));
}

Backend offset_row(std::string name, const std::string& how, double order, offset::Interpolation interpolation) {
  const auto resample = [interpolation, name](Resampling& r) { return as_offset(r, interpolation, name); };
  return {std::move(name), "base plus sparse offsets, interpolated " + how, order, true, resample};
}

}  // namespace

offset::OffsetSample offsets_over(Resampling& r, const Surface& base, Rectangle region_uy) {
  const SurfaceSpec& spec = r.spec();
  const char* body = spec.body == Body::wheel ? "wheel" : "rail";
  offset::OffsetSettings settings;
  settings.du = settings.dy = r.resolution();
  settings.region_uy = region_uy;
  settings.region_uy.x_min -= beyond(r);
  settings.region_uy.x_max += beyond(r);
  auto sample = offset::sample_offsets(r.surface(), base, spec.body, spec.nominal_radius, settings);
  constexpr double kMostContinued = 0.02;
  if (sample.gaps > 0)
    throw Error(ErrorKind::input_data,
                fmt::format("offsets cannot represent this {}: it has no surface at {} sections between others", body,
                            sample.gaps),
                {}, "use the backend 'mesh' for surfaces with gaps");
  if (static_cast<double>(sample.continued) > kMostContinued * static_cast<double>(sample.nodes))
    throw Error(ErrorKind::input_data,
                fmt::format("offsets cannot represent this {}: {} of {} nodes over the base have no surface", body,
                            sample.continued, sample.nodes),
                {}, "use the backend 'mesh' or 'spline' for surfaces with gaps");
  if (sample.continued > 0)
    r.add_note(fmt::format("{} nodes at the ends of the profile continue their neighbours. ", sample.continued));
  r.add_note(fmt::format("{} active voxels, {:.3g} MB. ", sample.active,
                         1e-6 * static_cast<double>(offset::memory_bytes(*sample.offsets))));
  return sample;
}

std::vector<Backend> offset_backends() {
  using offset::Interpolation;
  Backend bilinear = offset_row("offset-bilinear", "linearly", 2.0, Interpolation::bilinear);
  bilinear.creases = Creases::cells;
  return {offset_row("offset", "by cubic B-splines", 4.0, Interpolation::bicubic),
          offset_row("offset-quadratic", "by quadratic B-splines", 3.0, Interpolation::quadratic), bilinear};
}

}  // namespace treadmark
