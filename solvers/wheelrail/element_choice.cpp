// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/element_choice.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/kalker/contact_span.hpp"

namespace treadmark::wheelrail {
namespace {

/// Aimed at, since contact is measured on elements of the size before.
constexpr double kAimedAcross = 1.1 * kLeastAcross;
/// Across an interpenetration, of which contact takes a half to seven tenths (Hertz).
constexpr double kFirstAcross = 16.0;
/// An interpenetration that has grown by more is looked at anew.
constexpr double kGrown = 2.0;
/// Where surfaces vary along the track, no element passes over what they hold between two of this size.
constexpr double kLongestOnVarying = 0.5e-3;
/// How often elements are chosen in one balance of forces.
constexpr int kMostRounds = 3;

double rounded_down(double size) {
  constexpr double kUnit = 1e-4, kRounding = 1.0 + 1e-9;
  const double octave = kUnit * std::exp2(std::floor(std::log2(size * kRounding / kUnit)));
  for (const double step : {1.6, 1.25})
    if (step * octave <= size * kRounding) return step * octave;
  return octave;
}

/// What the highest element may stand out by; what it is to stand out by then.
constexpr double kSharp = 0.1, kAimedSharp = 0.04;

/// A side of elements on which a peak that is too sharp on those of the side `now` is not.
double for_peak(double side, double sharpness, double now, double extent) {
  constexpr double kMostAtOnce = 4.0;
  if (sharpness <= kSharp) return side;
  const double wanted = now / std::min(kMostAtOnce, std::sqrt(sharpness / kAimedSharp));
  return std::min(side, rounded_down(std::max({wanted, extent / kMostAcross, kShortestElement})));
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.x_min <= b.x_max && b.x_min <= a.x_max && a.y_min <= b.y_max && b.y_min <= a.y_max;
}

bool grown(const Rectangle& now, const Rectangle& before) {
  return now.x_max - now.x_min > kGrown * (before.x_max - before.x_min) ||
         now.y_max - now.y_min > kGrown * (before.y_max - before.y_min);
}

bool in_time(const Problem& p) {
  return p.damping || p.regime == kalker::Regime::transient || p.regime == kalker::Regime::shift;
}

/// Whether the height is sought by the normal problem itself, with nothing left to a later instant but start values.
/// Coefficients of a table belong to elements of one size.
bool under_load(const Problem& p) {
  return height_sought(p) && !in_time(p) && p.normal_model == kalker::NormalModel::full &&
         p.reference_surface == ReferenceSurface::plane && p.influence.kind != kalker::InfluenceSettings::Kind::table;
}

}  // namespace

bool height_sought(const Problem& p) {
  return p.vertical_force || (p.rail_springs && p.rail_springs->stiffness_z > 0.0);
}

bool chooses_elements(const Problem& p) {
  const Discretisation& d = p.discretisation;
  return (d.choose_dx || d.choose_ds) && !in_time(p) && d.search == Discretisation::SearchGrid::refined;
}

ElementSize elements_for(double length, double width, double longest) {
  double dx = length / kAimedAcross, ds = width / kAimedAcross;
  const auto limit = [](double side, double extent, double most) {
    return std::min(side, std::max(most, extent / kMostAcross));
  };
  dx = limit(dx, length, std::min(longest, kLongestElement * ds));
  ds = limit(ds, width, std::min(longest, kLongestElement * dx));
  return {rounded_down(std::max(dx, kShortestElement)), rounded_down(std::max(ds, kShortestElement))};
}

ElementChoice::ElementChoice(const Geometry& geometry, const Problem& problem, bool known)
    : given_(problem.discretisation),
      active_(chooses_elements(problem)),
      rough_(!active_ && !known && under_load(problem)),
      longest_(geometry.constant_profiles() ? kInfinity : kLongestOnVarying) {}

ElementSize ElementChoice::told(ElementSize size) const {
  if (!given_.choose_dx) size.dx = given_.dx;
  if (!given_.choose_ds) size.ds = given_.ds;
  return size;
}

ElementSize ElementChoice::first(double length, double width) const {
  const double dx = length / kFirstAcross, ds = width / kFirstAcross;
  if (active_) return told({std::max(dx, kShortestElement), std::max(ds, kShortestElement)});
  const auto whole = [](double side, double given) { return given * std::max(1.0, std::floor(side / given)); };
  return {whole(dx, given_.dx), whole(ds, given_.ds)};
}

void ElementChoice::expect(std::span<const detection::ContactPatch> regions) {
  constexpr double kWorthIt = 3.0;  // as many elements as few ones
  for (const detection::ContactPatch& region : regions) {
    if (!rough_) return;
    const Rectangle& box = region.extent.box;
    const ElementSize size = first(box.x_max - box.x_min, (box.y_max - box.y_min) / std::cos(region.inclination));
    rough_ = size.dx * size.ds >= kWorthIt * given_.dx * given_.ds;
  }
}

void ElementChoice::begin_balance() {
  rounds_ = std::min(rounds_, 1);
  few_stay_ = false;
}

ElementSize ElementChoice::of(const detection::ContactPatch& region, double angle) {
  if (!active_ && !rough_) return {given_.dx, given_.ds};
  const Rectangle& box = region.extent.box;
  const bool final_choice = rounds_ >= kMostRounds;
  ElementSize least{kInfinity, kInfinity};
  for (const Kept& one : kept_)
    if (overlap(box, one.box) && ((final_choice && one.chosen) || !grown(box, one.box)))
      least = {std::min(least.dx, one.size.dx), std::min(least.ds, one.size.ds)};
  if (least.dx < kInfinity) return least;
  std::erase_if(kept_, [&](const Kept& one) { return overlap(box, one.box); });
  const double length = box.x_max - box.x_min, width = (box.y_max - box.y_min) / std::cos(angle);
  kept_.push_back({box, first(length, width)});
  return kept_.back().size;
}

bool ElementChoice::coarse(const PatchSolution& patch) const {
  const kalker::ContactSpan span = kalker::contact_span(patch.grid, patch.contact.pressure);
  return (given_.choose_dx && span.nx < kLeastAcross) || (given_.choose_ds && span.ny < kLeastAcross);
}

bool ElementChoice::only_looked_at(const PatchSolution& patch) const {
  return coarse(patch) && ranges::any_of(kept_, [&](const Kept& one) {
           return !one.chosen && overlap(patch.region.extent.box, one.box);
         });
}

bool ElementChoice::learn(std::span<const PatchSolution* const> patches) {
  if (std::exchange(rough_, false)) {
    kept_.clear();
    return true;
  }
  if (!active_) return false;
  if (rounds_ >= kMostRounds) {
    few_stay_ = ranges::any_of(patches, [&](const PatchSolution* patch) { return only_looked_at(*patch); });
    return false;
  }
  few_stay_ = false;
  if (patches.empty()) return false;
  std::vector<Kept> chosen;
  bool changed = false;
  for (const PatchSolution* patch : patches) {
    const kalker::ContactSpan span = kalker::contact_span(patch->grid, patch->contact.pressure);
    ElementSize size{patch->grid.dx, patch->grid.dy};
    const bool few = coarse(*patch);
    const kalker::PeakSharpness peak = kalker::peak_sharpness(patch->grid, patch->contact.pressure);
    const bool sharp = (given_.choose_dx && peak.x > kSharp) || (given_.choose_ds && peak.y > kSharp);
    if (rounds_ == 0 || few || sharp) {
      if (rounds_ == 0 || few) size = elements_for(span.length, span.width, longest_);
      // a peak within the patch, as at the edge of a profile that bends away
      size.dx = for_peak(size.dx, peak.x, patch->grid.dx, span.length);
      size.ds = for_peak(size.ds, peak.y, patch->grid.dy, span.width);
      size = told(size);
      // Of a contact that is measured no better by smaller elements, as at an edge, they shrink for ever.
      changed = changed || rounds_ == 0 || size.dx < patch->grid.dx || size.ds < patch->grid.dy;
    }
    chosen.push_back({patch->region.extent.box, size, true});
  }
  ++rounds_;
  if (changed) kept_ = std::move(chosen);
  return changed;
}

}  // namespace treadmark::wheelrail
