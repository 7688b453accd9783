// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <cmath>
#include <cstdio>

#include "treadmark/core/pose.hpp"
#include "treadmark/core/report.hpp"
#include "treadmark/io/results/summary.hpp"

/// A program outside the project: a quarter turn about the axle, and the summary of an empty case.
int main() {
  const double quarter = std::acos(0.0);
  const treadmark::Pose X_AB{{1.0, 2.0, 3.0}, treadmark::rotation_y(quarter)};
  const treadmark::Vec3 p_A = X_AB.apply({0.0, 0.0, 0.5});  // z turns to x
  if ((p_A - treadmark::Vec3(1.5, 2.0, 3.0)).norm() > 1e-15) return 1;

  treadmark::io::CaseResult result;
  result.number = 7;
  result.status = treadmark::Status::no_contact;
  if (treadmark::io::summary(result).rfind("case 7: no_contact", 0) != 0) return 2;
  std::puts("the installed package works");
  return 0;
}
