// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/contact_search.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/detection/closest_gap.hpp"
#include "treadmark/detection/region_extent.hpp"

namespace treadmark::detection {
namespace {

constexpr double kMaxSearchPoints = 4e7;

// The first grid may miss a shallow region between its points: its minima below this are looked at more closely.
double grazing_gap(const Grid2& g) {
  constexpr double kSharpestRadius = 0.005;  // lateral curvature radius of the sharpest corner that matters [m]
  constexpr double kWheelRadius = 0.25;
  return g.dy * g.dy / (8.0 * kSharpestRadius) + g.dx * g.dx / (8.0 * kWheelRadius);
}

Grid2 refined_grid(const Grid2& g, const Region& r, const SearchSettings& s) {
  const double margin_x = g.dx, margin_y = g.dy;
  const double x_min = g.x(r.ix_min) - margin_x, x_max = g.x(r.ix_max) + margin_x;
  const double y_min = g.y(r.iy_min) - margin_y, y_max = g.y(r.iy_max) + margin_y;
  const auto points = [&](double length, double finest) {
    const double wanted =
        finest > 0.0 ? std::min<double>(s.refined_points, std::ceil(length / finest)) : s.refined_points;
    return std::max(9, to_whole<int>(wanted) + 1);
  };
  Grid2 f;
  f.nx = points(x_max - x_min, s.refined_dx);
  f.ny = points(y_max - y_min, s.refined_dy);
  f.x0 = x_min;
  f.y0 = y_min;
  f.dx = (x_max - x_min) / (f.nx - 1);
  f.dy = (y_max - y_min) / (f.ny - 1);
  return f;
}

ContactPatch to_patch(const GapField& field, double wheel_dz, const Region& r, bool interpolate_ends, bool at_deepest) {
  const Grid2& g = field.grid();
  ContactPatch p;
  p.extent.box = interpolate_ends ? crossing_extent(field, wheel_dz, r)
                                  : Rectangle{g.x(r.ix_min), g.x(r.ix_max), g.y(r.iy_min), g.y(r.iy_max)};
  p.extent.z_at_y_min = rail_height_near(field, r.ix_deepest, p.extent.box.y_min);
  p.extent.z_at_y_max = rail_height_near(field, r.ix_deepest, p.extent.box.y_max);
  p.deepest_T = {g.x(r.ix_deepest), g.y(r.iy_deepest), field.rail_z(r.ix_deepest, r.iy_deepest)};
  p.x = at_deepest ? p.deepest_T.x() : r.x;
  p.y = at_deepest ? p.deepest_T.y() : r.y;
  p.inclination = r.inclination;
  p.extent.x = p.x, p.extent.y = p.y;
  p.weight = r.weight;
  p.least_gap = r.least_gap;
  p.parts = {p.extent};
  return p;
}

bool overlap(const Rectangle& a, const Rectangle& b) {
  return a.x_min <= b.x_max && b.x_min <= a.x_max && a.y_min <= b.y_max && b.y_min <= a.y_max;
}

}  // namespace

ContactSearch::ContactSearch(const BodyPair& bodies, const SearchSettings& settings)
    : bodies_(bodies), settings_(settings) {
  const Grid2& g = settings.grid_T;
  const double points = static_cast<double>(g.nx) * static_cast<double>(g.ny);
  if (g.nx < 2 || g.ny < 2 || points > kMaxSearchPoints)
    throw Error(ErrorKind::configuration,
                "the contact search would need " + std::to_string(g.nx) + " x " + std::to_string(g.ny) + " points", {},
                "use larger element sizes dx, ds");
  if ((settings.method == SearchMethod::locus && !settings.locus_rows &&
       (settings.facets || !ContactLocus::applies(bodies))) ||
      (settings.locus_rows && !bodies.wheel->constant_profile()))
    throw Error(ErrorKind::configuration, "the contact locus needs a prismatic rail along the track and a round wheel",
                {}, "use the grid method");
  if (settings.locus_rows) {
    reference_locus_.emplace(bodies, *settings.locus_rows);
    if (!ContactLocus::applies(bodies) && settings.locus_rows->roller_radius == 0.0) {
      gap_.emplace(bodies, g, std::nullopt, false);
      locus_check_.emplace(bodies, settings.locus_rows->nominal_radius);
      if (locus_check_->is_wrong_at_first(*reference_locus_, settings.weight, *gap_)) {
        reference_locus_.reset();
        settings_.method = SearchMethod::pruned_grid;
      }
    }
  } else if (settings.method == SearchMethod::locus ||
             (settings.method == SearchMethod::automatic && !settings.facets && settings.refine &&
              ContactLocus::applies_over(bodies, g))) {
    locus_.emplace(bodies, g);
  } else {
    if (settings_.method == SearchMethod::automatic) settings_.method = SearchMethod::pruned_grid;
    gap_.emplace(bodies, g, settings.facets, settings_.method == SearchMethod::full_grid);
  }
}

double ContactSearch::least_gap() {
  if (reference_locus_) return reference_locus_->least();
  return locus_ ? locus_->least() : gap_->least();
}

double ContactSearch::look_below() const {
  return std::max({0.0, settings_.rules.near_miss, settings_.refine ? grazing_gap(settings_.grid_T) : 0.0});
}

std::optional<ReferenceChange> ContactSearch::reference_change(double wheel_dz, const ContactPatch& patch) {
  constexpr double kRounding = 1e-9, kLocusOnGrid = 2e-4;  // [m], [rad]
  const SearchSettings& s = settings_;
  if (reference_locus_ || !s.refine || s.reference_at_deepest) return std::nullopt;
  ReferenceSum sum(patch, s.weight);
  if (!locus_) {
    on_grid(wheel_dz, look_below(), &sum);
    return std::move(sum).take(kRounding);
  }
  if (bodies_.rail->constant_profile() && bodies_.wheel->constant_profile()) {
    locus_->at(wheel_dz, look_below(), s.rules.near_miss, s.weight, false, &sum);
    return std::move(sum).take(kRounding);
  }
  // what may change beside the one line on which a locus looks counts where it is
  const Rectangle& box = patch.extent.box;
  const int n = std::max(9, s.refined_points);
  const double dx = (box.x_max - box.x_min) / (n - 3), dy = (box.y_max - box.y_min) / (n - 3);
  if (!(dx > 0.0 && dy > 0.0)) return std::nullopt;
  const GapField field = gap_field(bodies_, {box.x_min - dx, box.y_min - dy, dx, dy, n, n});
  for (const Region& region : find_regions(field, wheel_dz, s.weight, 0.0))
    if (!region.near_miss() && sum.holds(region.x, region.y)) sum.add(field, wheel_dz, region);
  return std::move(sum).take(kLocusOnGrid);
}

SearchResult ContactSearch::at(double wheel_dz) {
  const SearchSettings& s = settings_;
  if (reference_locus_) {
    ContactLocus::Found found = reference_locus_->at(wheel_dz, s.rules.near_miss, s.weight, s.reference_at_deepest);
    if (!locus_check_ || !locus_check_->is_wrong(wheel_dz, found.patches, *gap_))
      return found_on_locus(std::move(found));
  }
  if (locus_ && std::isnan(locus_->least())) return {{}, locus_->least(), locus_->least()};
  if (locus_)
    return found_on_locus(locus_->at(wheel_dz, look_below(), s.rules.near_miss, s.weight, s.reference_at_deepest));
  // Where the bodies touch, this finds the least gap as well.
  gap_->reveal(look_below() + wheel_dz);
  return on_grid(wheel_dz, look_below());
}

SearchResult ContactSearch::found_on_locus(ContactLocus::Found found) const {
  return {combine_patches(std::move(found.patches), found.near_misses, settings_.rules), found.least_gap,
          found.closest};
}

SearchResult ContactSearch::on_grid(double wheel_dz, double look_below, ReferenceSum* sum) {
  const SearchSettings& s = settings_;
  SearchResult result;
  result.least_gap = result.closest = gap_->least() - wheel_dz;
  if (std::isnan(result.least_gap)) return result;
  double closest = std::numeric_limits<double>::infinity();

  std::vector<ContactPatch> patches, near_misses;
  for (const Region& region :
       find_regions(gap_->field(), wheel_dz, s.refine ? std::nullopt : std::optional(s.weight), look_below)) {
    if (!s.refine) {
      // Guard rows give heights too.
      gap_->reveal(
          {region.ix_min, region.iy_min, region.ix_max - region.ix_min + 1, region.iy_max - region.iy_min + 1});
      (region.near_miss() ? near_misses : patches)
          .push_back(to_patch(gap_->field(), wheel_dz, region, false, s.reference_at_deepest));
      continue;
    }
    const GapField& fine = refined(region);
    for (const Region& part : find_regions(fine, wheel_dz, s.weight, s.rules.near_miss)) {
      const ContactPatch patch = to_patch(fine, wheel_dz, part, !part.near_miss(), s.reference_at_deepest);
      result.least_gap = std::min(result.least_gap, patch.least_gap);
      closest = std::min(closest, vertex(fine, part.ix_deepest, part.iy_deepest) - wheel_dz);
      // Margins of neighbouring fine grids overlap: a region seen twice counts once.
      auto& list = part.near_miss() ? near_misses : patches;
      const bool known = std::any_of(list.begin(), list.end(), [&](const ContactPatch& other) {
        return overlap(other.extent.box, patch.extent.box);
      });
      if (known) continue;
      list.push_back(patch);
      if (sum != nullptr && !part.near_miss() && sum->holds(part.x, part.y)) sum->add(fine, wheel_dz, part);
    }
  }
  result.patches = combine_patches(std::move(patches), near_misses, s.rules);
  // Close to the loss of contact and beyond it nothing but the gap is wanted, and that exactly.
  constexpr double kShallow = 5e-6;
  result.closest = !s.refine ? result.least_gap : closest < -kShallow ? closest : closest_on_grid() - wheel_dz;
  return result;
}

double ContactSearch::closest_on_grid() {
  if (closest_) return *closest_;
  const double least = gap_->least(), look_below = grazing_gap(settings_.grid_T);
  gap_->reveal(least + look_below);
  closest_ = least;
  for (const Region& region : find_regions(gap_->field(), least, std::nullopt, look_below)) {
    const GapField fine = gap_field(bodies_, refined_grid(settings_.grid_T, region, settings_));
    for (const Region& part : find_regions(fine, least, std::nullopt, look_below))
      closest_ = std::min(*closest_, closest_about(bodies_, fine, part.ix_deepest, part.iy_deepest));
  }
  return *closest_;
}

const GapField& ContactSearch::refined(const Region& region) {
  const Grid2 grid = refined_grid(settings_.grid_T, region, settings_);
  for (const auto& made : refined_)
    if (made->grid == grid) return made->field;
  constexpr std::size_t kKept = 8;
  if (refined_.size() >= kKept) refined_.erase(refined_.begin());
  refined_.push_back(std::make_unique<Refined>(Refined{grid, gap_field(bodies_, grid)}));
  return refined_.back()->field;
}

SearchResult search_contact(const BodyPair& bodies, const SearchSettings& settings) {
  return ContactSearch(bodies, settings).at(0.0);
}

}  // namespace treadmark::detection
