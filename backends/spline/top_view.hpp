// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/backends/spline/profile_spline.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::spline {

/// The part of a profile that the other body can see along z: for every y the branch of least z of a rail, of greatest
/// z of a wheel. Immutable; refers to the spline, which must live longer.
class TopView {
 public:
  /// y runs from y_min to y_max; the branch has y(s) monotonic on [s_min, s_max].
  struct Section {
    double y_min, y_max;
    double s_min, s_max;
    bool increasing;
  };

  /// Errors: Error(numerical) for a profile that is upright all over.
  TopView(const ProfileSpline& profile, Body body);

  /// Sections with increasing y; neighbours may leave a gap only where there is no curve.
  const std::vector<Section>& sections() const { return sections_; }
  double y_min() const { return sections_.front().y_min; }
  double y_max() const { return sections_.back().y_max; }
  /// Arc length of the visible point at y [m]; quiet NaN where there is none.
  double s_at(double y) const;

 private:
  const ProfileSpline* profile_;
  std::vector<Section> sections_;
};

}  // namespace treadmark::spline
