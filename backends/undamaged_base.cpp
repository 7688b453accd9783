// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/undamaged_base.hpp"

#include <algorithm>
#include <cmath>
#include <variant>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/builtin.hpp"

namespace treadmark {
namespace {

/// Without damage there is nothing to sample: keep to the damaged part and some steps round it.
void narrow(Rectangle& r, const Resampling& resampling) {
  constexpr double kMargin = 4.0;
  const SurfaceSpec& spec = resampling.spec();
  const auto damaged = analytic::defect_region(spec.defects, spec.nominal_radius);
  const double across = kMargin * resampling.resolution();
  const double along = across / (spec.body == Body::wheel ? spec.nominal_radius : 1.0);
  if (!damaged) {
    if (!std::isfinite(r.x_min) || !std::isfinite(r.x_max)) r.x_min = 0.0, r.x_max = along;
    r.x_max = std::min(r.x_max, r.x_min + along);
    return;
  }
  // a wheel's angles may be given on any turn: only the whole turn is safe to narrow
  if (spec.body == Body::rail || !(r.x_max - r.x_min < 6.2)) {
    r.x_min = std::max(r.x_min, damaged->x_min - along);
    r.x_max = std::min(r.x_max, damaged->x_max + along);
  }
  r.y_min = std::max(r.y_min, damaged->y_min - across);
  r.y_max = std::min(r.y_max, damaged->y_max + across);
  r.x_max = std::max(r.x_max, r.x_min + along);
  r.y_max = std::max(r.y_max, r.y_min + across);
}

}  // namespace

UndamagedBase undamaged_base(Resampling& resampling, const SurfaceSpec* given) {
  const SurfaceSpec& spec = resampling.spec();
  const bool known = given == nullptr && (is_formula(spec) || std::holds_alternative<Profile>(spec.shape));
  UndamagedBase base;
  base.spec.body = spec.body;
  base.spec.nominal_radius = spec.nominal_radius;
  if (given != nullptr)
    base.spec = *given;
  else if (known)
    base.spec.shape = spec.shape;
  else
    base.spec.shape = resampling.median_section();
  SurfaceSpec section = base.spec;
  section.defects = {};
  base.surface = make_natural(section);
  resampling.limit_rail();
  const Region& region = resampling.region();
  base.region_uy = {region.u_min, region.u_max, region.y_min, region.y_max};
  if (known) narrow(base.region_uy, resampling);
  return base;
}

}  // namespace treadmark
