// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/pose.hpp"

namespace treadmark::detection {

/// A plane curve through points: natural cubic splines of both coordinates over the length of the chords (Ahlberg,
/// Nilson, Walsh 1967).
class NaturalCurve {
 public:
  /// Two points or more, no two neighbours the same.
  explicit NaturalCurve(std::vector<Vec2> points);

  /// The least second coordinate over a value of the first one; NaN where there is none.
  double least_over(double first) const;

 private:
  Vec2 at(std::size_t segment, double f) const;

  std::vector<Vec2> points_, bends_;  ///< bends: second derivatives
  std::vector<double> chords_;
};

}  // namespace treadmark::detection
