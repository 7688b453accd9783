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
  double below() const { return x_low_; }
  double above() const { return x_high_; }
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

/// Finds where a residual that mostly grows with x vanishes, step by step: steps of growing length until there is one
/// value of either sign, then secants inside the bracket, bisection where they do not halve it.
class RootSearch {
 public:
  enum class State {
    search,
    found,    ///< |residual| <= tolerance
    jump,     ///< the residual changes its sign between neighbouring numbers
    nowhere,  ///< no change of sign within reach
  };

  struct Settings {
    double tolerance = 0.0;   ///< on the residual
    double first_step = 0.0;  ///< > 0
    double reach = 0.0;       ///< farthest distance from the first x
    double resolution = 0.0;  ///< values of x closer than this are the same
  };
  explicit RootSearch(const Settings& settings);

  /// Takes the residual at x; next() is then what to try.
  State add(double x, double residual);
  double next() const { return next_; }
  /// Residuals on both sides of a jump.
  double residual_below() const { return bracket_.value_below(); }
  double residual_above() const { return bracket_.value_above(); }

 private:
  double outside(double x, double residual);

  Settings settings_;
  int count_ = 0;
  double next_ = 0.0, step_ = 0.0, start_ = 0.0;
  double x_last_ = 0.0, f_last_ = 0.0;
  Bracket bracket_;
};

}  // namespace treadmark::wheelrail
