// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>

namespace treadmark::wheelrail {

/// Two positions between which a residual changes its sign, and guesses kept between them.
class Bracket {
 public:
  /// value: what belongs to the residual at x, to be told of a jump.
  void add(double x, double residual, double value);
  bool closed() const;
  /// From where the residual is negative to where it is positive.
  double width() const { return x_high_ - x_low_; }
  double value_below() const { return value_low_; }
  double value_above() const { return value_high_; }
  /// The guess if it lies inside, else the middle. Guesses may close in from one side; where they do not halve the
  /// bracket for a while they give way to the middle. Of a closed bracket.
  double safeguarded(double guess);

 private:
  double x_low_ = -std::numeric_limits<double>::infinity(), value_low_ = 0.0;
  double x_high_ = std::numeric_limits<double>::infinity(), value_high_ = 0.0;
  double last_width_ = std::numeric_limits<double>::infinity();
  int slow_ = 0;
};

}  // namespace treadmark::wheelrail
