// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/model/profile.hpp"

namespace treadmark {

/// A tensor-product B-spline surface in the surface frame, rational if it has weights. u runs along the track or with
/// the angle round a wheel, v with y.
struct TensorSpline {
  Body body = Body::rail;
  std::string name;  ///< where it comes from, for messages
  int degree_u = 3, degree_v = 3;
  std::vector<double> knots_u, knots_v;  ///< each as often as its multiplicity: one more than poles and degree together
  std::vector<Vec3> poles;               ///< [m], index = iv + poles in v * iu
  std::vector<double> weights;           ///< of the poles, positive; empty: all are 1

  std::size_t poles_u() const { return knots_u.size() - static_cast<std::size_t>(degree_u) - 1; }
  std::size_t poles_v() const { return knots_v.size() - static_cast<std::size_t>(degree_v) - 1; }
};

/// Errors: Error(input_data) for what is no such surface: degrees below 1 or above kHighestDegree, numbers of knots,
/// poles and weights that do not fit each other, knots that decrease or break the surface apart, numbers that are not
/// finite, weights that are not positive.
void check(const TensorSpline& spline);
inline constexpr int kHighestDegree = 25;

/// Point and first derivatives; parameters are clamped to the surface (de Boor 1978; Piegl and Tiller 1997).
struct TensorJet {
  Vec3 p = Vec3::Zero(), pu = Vec3::Zero(), pv = Vec3::Zero(), puv = Vec3::Zero();
};
TensorJet evaluate(const TensorSpline& spline, double u, double v);

/// Where its pieces join, from its first to its last parameter, each once.
std::vector<double> breaks_of(const std::vector<double>& knots, int degree);

/// The piece of a spline whose knots are given between two breaks that follow each other: index of its first pole.
std::size_t first_pole(const std::vector<double>& knots, int degree, double from);

/// Turned so that u runs along the body and v with y; their numbers may change their sign and place.
TensorSpline along_body(TensorSpline spline);

}  // namespace treadmark
