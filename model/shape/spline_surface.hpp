// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/pose.hpp"

namespace treadmark {

/// Of tensor splines, and of hierarchical ones.
inline constexpr int kHighestDegree = 25, kHighestHierarchicalDegree = 3;

/// The B-splines of one parameter: as many functions as there are knots, less degree and 1.
struct SplineKnots {
  int degree = 0;             ///< of the polynomials between knots
  std::vector<double> knots;  ///< not decreasing; functions begin at knot degree and end as many before the last

  /// How many there are.
  std::size_t functions() const {
    const auto least = static_cast<std::size_t>(degree) + 1;
    return knots.size() > least ? knots.size() - least : 0;
  }
  /// Where their pieces join, from the first to the last parameter, each once.
  std::vector<double> breaks() const;
  /// Once continuously differentiable inside.
  bool smooth() const;
};

/// What is wrong with knots.
struct KnotFault {
  std::string what;
  std::optional<std::size_t> knot = {};  ///< at which it shows, counted from 0
};
/// None for a degree from 1 to the highest and knots that are finite, do not decrease, leave an interval, and are
/// repeated at most degree times inside and degree + 1 times at the ends.
std::optional<KnotFault> fault_of(const SplineKnots& knots, int highest_degree);

/// A part of the parameters that is divided: intervals between different knots of a level, upper ones not included.
struct SplineBox {
  int level = 0;                        ///< to which it is divided
  std::array<int, 2> lower{}, upper{};  ///< corners
  int line = 0;                         ///< in its file, for messages; 0 = unknown
};

/// A surface given by its splines: x, y and z of the surface's frame [m] over two parameters of any kind. More than one
/// level: hierarchical B-splines (Giannelli, Juettler and Speleers 2012). Functions are counted level by level, along
/// the first parameter fastest.
struct SplineSurface {
  std::string name;                                ///< "Geometry 0", for messages
  SourcePosition where;                            ///< in its file
  std::vector<std::array<SplineKnots, 2>> levels;  ///< coarsest first; each holds the knots of the one before
  std::vector<SplineBox> boxes;                    ///< of levels above 0; where some overlap the finest counts
  bool hierarchical = false;                       ///< also with one level
  bool truncated = true;                           ///< of a hierarchical one: its functions sum to 1
  std::vector<Vec3> points;                        ///< [m] one a function
  std::vector<double> weights;                     ///< positive, one a point; empty: all 1. Not of hierarchical ones
};

/// Errors: Error(input_data) that names the surface for knots with a fault, what is not finite, weights that are not
/// positive, and of a tensor spline for other numbers of points or weights than it has functions. Boxes are not looked
/// at.
void check(const SplineSurface& surface);

/// A point and its derivatives by the first parameter s and the second one t [m].
struct SplineJet {
  Vec3 p = Vec3::Zero();    ///< the point
  Vec3 ps = Vec3::Zero();   ///< by s
  Vec3 pt = Vec3::Zero();   ///< by t
  Vec3 pst = Vec3::Zero();  ///< by both
};
/// Of a tensor spline; parameters are clamped to the surface (de Boor 1978; Piegl and Tiller 1997).
SplineJet evaluate(const SplineSurface& tensor, double s, double t);
/// Of its polynomials, or rational functions, over the intervals between knots that hold inside.
SplineJet evaluate(const SplineSurface& tensor, const Vec2& at, const Vec2& inside);

/// Two sides of surfaces that are said to meet. Sides: 1, 2 the least and the greatest first parameter, 3, 4 the same
/// of the second one.
struct SplineInterface {
  std::size_t first = 0, second = 0;    ///< places in a list of surfaces
  int first_side = 1, second_side = 1;  ///< 1 to 4
  SourcePosition where;                 ///< in its file
  bool reversed = false;                ///< parameters along the two sides grow against each other
};

}  // namespace treadmark
