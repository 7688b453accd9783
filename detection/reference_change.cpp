// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/reference_change.hpp"

#include <cmath>
#include <utility>

namespace treadmark::detection {

bool ReferenceSum::holds(double x, double y) const {
  const Rectangle& box = patch_.extent.box;
  return x >= box.x_min && x <= box.x_max && y >= box.y_min && y <= box.y_max;
}

void ReferenceSum::count(double weight, const Three& values) {
  sum_ += weight;
  for (std::size_t k = 0; k < values.size(); ++k) sums_[k] += weight * values[k];
}

ReferenceSum::Three ReferenceSum::by_weight(const Three& values) const {
  return {(values[0] - patch_.x) / total(), (values[1] - patch_.y) / total(),
          (values[2] - patch_.inclination) / total()};
}

void ReferenceSum::add_slope(std::vector<ReferenceChange::Place>& places, const Vec2& at_T, const Vec2& along,
                             const Three& by) {
  constexpr double kBeside = 1e-6;  // [m]
  for (const double side : {kBeside, -kBeside}) {
    const double per = 0.5 / side;
    places.push_back({at_T + side * along, {per * by[0], per * by[1], per * by[2]}});
  }
}

void ReferenceSum::add(const GapField& field, double wheel_dz, const Region& region) {
  const Grid2& g = field.grid();
  const double area = g.cell_area();
  for (int iy = region.iy_min; iy <= region.iy_max; ++iy)
    for (int ix = region.ix_min; ix <= region.ix_max; ++ix) {
      const double gap = field.gap(ix, iy) - wheel_dz;
      if (!(gap < 0.0)) continue;
      const bool squared = weight_ == PenetrationWeight::squared;
      const double weight = area * (squared ? gap * gap : -gap), by_gap = area * (squared ? 2.0 * gap : -1.0);
      const double slope = field.rail_slope(ix, iy);
      const Vec2 at(g.x(ix), g.y(iy));
      const Three values{at.x(), at.y(), std::atan(slope)};
      count(weight, values);
      Three by = by_weight(values);
      for (double& one : by) one *= by_gap;
      add_rail(at, by);
      add_rail_slope(at, {0.0, 0.0, weight / (total() * (1.0 + slope * slope))});
      for (double& one : by) one = -one;
      add_wheel(at, by);
    }
}

std::optional<ReferenceChange> ReferenceSum::take(double closeness) && {
  const Three reference{patch_.x, patch_.y, patch_.inclination};
  for (std::size_t k = 0; k < reference.size(); ++k)
    if (!(std::abs(sums_[k] / sum_ - reference[k]) <= closeness)) return std::nullopt;
  return std::move(change_);
}

}  // namespace treadmark::detection
