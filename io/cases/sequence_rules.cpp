// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <algorithm>
#include <cmath>

#include "treadmark/core/pose.hpp"
#include "treadmark/io/cases/shared_rules.hpp"

namespace treadmark::io {

namespace {

bool continues(HistoryUse h) { return h == HistoryUse::keep_going || h == HistoryUse::same_instant; }

/// Steps equal, origins a whole number of steps apart.
bool same_raster(double a0, double a_step, double b0, double b_step) {
  constexpr double kTolerance = 1e-3;  // of a step
  const double steps = (b0 - a0) / a_step;
  return std::abs(b_step - a_step) < kTolerance * a_step && std::abs(steps - std::round(steps)) < kTolerance;
}

bool same_grid(const BasicCase& a, const BasicCase& b) {
  // The grid of Hertzian geometry is not known before it is solved.
  const bool known = a.dx > 0.0 && a.dy > 0.0 && b.dx > 0.0 && b.dy > 0.0;
  return !known || (same_raster(a.x0, a.dx, b.x0, b.dx) && same_raster(a.y0, a.dy, b.y0, b.dy));
}

/// Grids of a wheel on a rail line up by themselves.
bool same_grid(const WheelRailCase& a, const WheelRailCase& b) {
  constexpr double kTolerance = 1e-4;
  const auto same = [](double p, double q) { return std::abs(p - q) <= kTolerance * p; };
  return same(a.discretisation.dx, b.discretisation.dx) && same(a.discretisation.ds, b.discretisation.ds);
}

template <class Content>
bool keeps_grid(const Case& previous, const Case& next) {
  const auto *a = std::get_if<Content>(&previous.content), *b = std::get_if<Content>(&next.content);
  return a == nullptr || b == nullptr || !continues(b->history) || !goes_on(b->regime) || same_grid(*a, *b);
}

}  // namespace

std::vector<Contradiction> contradictions(const Case& previous, const Case& next) {
  RuleList rules;
  rules.refuse_if(!keeps_grid<BasicCase>(previous, next), CaseSetting::grid,
                  "a case that continues the previous one needs elements of the same size, moved by whole elements",
                  "start anew (P = 2 in .inp, case.history = \"start\" in .toml)");
  rules.refuse_if(!keeps_grid<WheelRailCase>(previous, next), CaseSetting::grid,
                  "a case that continues the previous one needs elements of the same size",
                  "start anew (P = 2 in .inp, case.history = \"start\" in .toml)");
  const auto *a = std::get_if<WheelRailCase>(&previous.content), *b = std::get_if<WheelRailCase>(&next.content);
  if (a != nullptr && b != nullptr && continues(b->history) && goes_on(b->regime))
    rules.refuse_if(a->reference_surface != b->reference_surface || a->side != b->side ||
                        a->roller.has_value() != b->roller.has_value(),
                    CaseSetting::grid,
                    "a case that continues the previous one must be on the same side, on track or roller as before, "
                    "with the same kind of reference surface",
                    "start anew (P = 2 in .inp, case.history = \"start\" in .toml)");
  return std::move(rules.found);
}

std::optional<RolledStep> rolled_step(const Case& previous, const Case& next) {
  const auto *a = std::get_if<WheelRailCase>(&previous.content), *b = std::get_if<WheelRailCase>(&next.content);
  if (a == nullptr || b == nullptr || b->history != HistoryUse::keep_going || b->regime != Regime::transient)
    return std::nullopt;
  const SixMotion &from = a->state.position, &to = b->state.position;
  RolledStep step;
  step.rolled = b->discretisation.dq_relative * b->discretisation.dx;
  step.longest = 2.0 * b->discretisation.dx;
  const double along = b->roller ? 0.0 : std::abs(to.x - from.x);
  step.moved = std::max(along, b->wheelset.nominal_radius * std::abs(wrap_angle(to.pitch - from.pitch)));
  return step;
}

std::string RolledStep::complaint() const {
  constexpr double kSame = 0.1;  // creep, and radii other than the nominal one
  if (too_long())
    return fmt::format(
        "wheel or rail move {:.4g} mm through the contact since the previous case, more than two elements ({:.4g} mm): "
        "the "
        "history does not reach that far",
        moved * 1e3, longest * 1e3);
  if (moved > 0.0 && std::abs(moved - rolled) > kSame * rolled)
    return fmt::format(
        "wheel or rail move {:.4g} mm through the contact since the previous case, but a rolling step is {:.4g} mm",
        moved * 1e3, rolled * 1e3);
  return {};
}

}  // namespace treadmark::io
