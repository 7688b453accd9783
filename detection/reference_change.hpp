// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "treadmark/detection/contact_patch.hpp"
#include "treadmark/detection/gap_field.hpp"
#include "treadmark/detection/interpenetration.hpp"

namespace treadmark::detection {

/// A ReferenceChange while it is gathered from what a patch was found from: x, y and inclination are means over it,
/// with a weight that follows from the gap.
class ReferenceSum {
 public:
  using Three = std::array<double, 3>;  ///< of x, y and the inclination

  ReferenceSum(const ContactPatch& patch, PenetrationWeight weight) : patch_(patch), weight_(weight) {}

  /// Whether a region with its reference there is part of the patch.
  bool holds(double x, double y) const;
  /// A region on a grid.
  void add(const GapField& field, double wheel_dz, const Region& region);

  /// Something with this integral of its weight, at values of x, y and inclination.
  void count(double weight, const Three& values);
  /// The derivatives by that weight.
  Three by_weight(const Three& values) const;
  double total() const { return patch_.weight; }
  void add_rail(const Vec2& at_T, const Three& by) { change_.rail.push_back({at_T, by}); }
  void add_wheel(const Vec2& at_T, const Three& by) { change_.wheel.push_back({at_T, by}); }
  /// By the slope along a direction in the plane z = 0 of T, as that of two heights beside each other.
  static void add_slope(std::vector<ReferenceChange::Place>& places, const Vec2& at_T, const Vec2& along,
                        const Three& by);
  void add_rail_slope(const Vec2& at_T, const Three& by) { add_slope(change_.rail, at_T, Vec2::UnitY(), by); }
  void add_wheel_slope(const Vec2& at_T, const Three& by) { add_slope(change_.wheel, at_T, Vec2::UnitX(), by); }

  /// Nothing where what was gathered has another reference than the patch: something else moves it too. closeness [m],
  /// [rad].
  std::optional<ReferenceChange> take(double closeness) &&;

 private:
  const ContactPatch& patch_;
  PenetrationWeight weight_;
  double sum_ = 0.0;
  Three sums_ = {};
  ReferenceChange change_;
};

}  // namespace treadmark::detection
