// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <variant>

#include "treadmark/backends/analytic/defects/defects.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/backends/builtin.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark {
namespace {

std::shared_ptr<const Surface> formula_surface(const SurfaceSpec& spec, const std::vector<WheelFlat>& flats) {
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape))
    return analytic::make_standard_surface(*standard, spec.body, spec.nominal_radius, flats);
  const auto& chain = std::get<ArcChain>(spec.shape);
  return spec.body == Body::wheel ? analytic::make_revolved_surface(chain, spec.nominal_radius, flats)
                                  : analytic::make_prismatic_surface(chain);
}

std::shared_ptr<const Surface> natural_formula(const SurfaceSpec& spec, std::string&) {
  if (flats_only(spec)) return formula_surface(spec, spec.defects.flats);
  return analytic::add_defects(formula_surface(spec, {}), spec.defects, spec.body, spec.nominal_radius);
}

}  // namespace

bool is_formula(const SurfaceSpec& spec) {
  return std::holds_alternative<StandardProfile>(spec.shape) || std::holds_alternative<ArcChain>(spec.shape);
}

bool flats_only(const SurfaceSpec& spec) {
  Defects others = spec.defects;
  others.flats.clear();
  return spec.body == Body::wheel && is_formula(spec) && others.empty();
}

std::optional<Profile> sampled_formula(const SurfaceSpec& spec, double step) {
  if (const auto* chain = std::get_if<ArcChain>(&spec.shape)) return analytic::sample_profile(*chain, spec.body, step);
  if (const auto* standard = std::get_if<StandardProfile>(&spec.shape))
    return analytic::sample_profile(*standard, step);
  return std::nullopt;
}

std::vector<Backend> analytic_backends() {
  Backend row{"analytic", "formulas: standard profiles, chains of arcs, defects", kInfinity};
  row.needs = "a formula, not measured points, slices, triangles or offsets";
  row.advice = "use the backend 'spline', or a standard profile or arc chain";
  row.natural_for = is_formula;
  row.make_natural = natural_formula;
  return {row};
}

}  // namespace treadmark
