// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/analytic/standard_profiles.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::analytic {

namespace {

constexpr double kMm = 1e-3;

/// Circle z = z_c + side sqrt(R^2 - (y - y_c)^2) over [from, to] (all mm), started from y_start.
ArcGraph circle_mm(double from, double to, double y_c, double z_c, double radius, int side, double y_start) {
  const double d = (y_start - y_c) / radius;
  ArcGraph arc;
  arc.x_min = from * kMm;
  arc.x_max = to * kMm;
  arc.x0 = y_start * kMm;
  arc.k = -side / (radius * kMm);
  arc.s0 = -side * d;
  arc.c0 = std::sqrt((1.0 - d) * (1.0 + d));
  arc.h0 = (z_c + side * radius * arc.c0) * kMm;
  return arc;
}

/// Line z = a + b y over [from, to] (mm).
ArcGraph line_mm(double from, double to, double a, double b) {
  ArcGraph line;
  line.x_min = from * kMm;
  line.x_max = to * kMm;
  line.x0 = from * kMm;
  line.h0 = (a + b * from) * kMm;
  line.s0 = b / std::hypot(1.0, b);
  line.c0 = 1.0 / std::hypot(1.0, b);
  return line;
}

/// Polynomial with coefficients of powers of y in mm.
PolynomialGraph powers_mm(double from, double to, const std::vector<double>& coefficients) {
  PolynomialGraph p = PolynomialGraph::from_powers(from, to, coefficients);
  p.x_min *= kMm;
  p.x_max *= kMm;
  p.middle *= kMm;
  p.half *= kMm;
  for (double& c : p.c) c *= kMm;
  return p;
}

}  // namespace

GraphCurve s1002_curve() {
  constexpr double kH = -62.764705882, kG = -49.662510381, kF = -39.764473993, kE = -38.426669071, kD = -35.0,
                   kC = -26.0, kB = 32.15796;
  GraphCurve curve;
  curve.append(circle_mm(-70.0, kH, -49.5, 9.519259302, 20.5, +1, kH));
  curve.append(circle_mm(kH, kG, -55.0, 16.0, 12.0, +1, -55.0));
  curve.append(circle_mm(kG, kF, -58.558326413, 8.834924130, 20.0, +1, kG));
  curve.append(line_mm(kF, kE, -93.576667419, -2.747477419));
  curve.append(circle_mm(kE, kD, -26.210665, 16.446, 13.0, -1, kD));
  curve.append(powers_mm(kD, kC,
                         {-4.320221063e3, -1.038384026e3, -1.065501873e2, -6.051367875, -2.054332446e-1,
                          -4.169739389e-3, -4.687195829e-5, -2.252755540e-7}));
  curve.append(powers_mm(kC, kB,
                         {0.0, -3.358537058e-2, 1.565681624e-3, -2.810427944e-5, 5.844240864e-8, -1.562379023e-8,
                          5.309217349e-15, -5.957839843e-12, 2.646656573e-13}));
  curve.append(line_mm(kB, 60.0, 1.364323640, -0.066666667));
  return curve;
}

ArcChain rail_60e1_chain() {
  // Half widths where R300 and R80 end; R13 ends at the inclination of the 1:20 side (EN 13674-1).
  constexpr double kHalf300 = 10.228e-3, kHalf80 = 26.0265e-3;
  constexpr double kR300 = 0.300, kR80 = 0.080, kR13 = 0.013, kR3 = 0.003;
  const double a300 = std::asin(kHalf300 / kR300);
  const double a80 = std::asin(std::sin(a300) + (kHalf80 - kHalf300) / kR80);
  const double side = std::atan(20.0);
  const double y13 = kHalf80 + kR13 * (std::sin(side) - std::sin(a80));
  const double z13 = kR300 * (1.0 - std::cos(a300)) + kR80 * (std::cos(a300) - std::cos(a80)) +
                     kR13 * (std::cos(a80) - std::cos(side));
  // The side meets the lower line of the head, 2.75:1 through 51 mm below the crown; the R3 fillet takes its tangent
  // length.
  const double corner_z = (0.051 - (y13 - z13 / 20.0) / 2.75) / (1.0 + 1.0 / (20.0 * 2.75));
  const double turn = std::numbers::pi - std::atan(1.0 / 2.75) - side;
  const double side_length = (corner_z - z13) / std::sin(side) - kR3 * std::tan(0.5 * turn);

  ArcChain chain;
  chain.start_angle = -side;
  chain.start_y = -(y13 + side_length * std::cos(side));
  chain.start_z = z13 + side_length * std::sin(side);
  chain.segments = {{side_length, 0.0},
                    {kR13 * (side - a80), 1.0 / kR13},
                    {kR80 * (a80 - a300), 1.0 / kR80},
                    {kR300 * 2.0 * a300, 1.0 / kR300},
                    {kR80 * (a80 - a300), 1.0 / kR80},
                    {kR13 * (side - a80), 1.0 / kR13},
                    {side_length, 0.0}};
  return chain;
}

std::span<const std::string_view> standard_profile_names() {
  static constexpr std::array<std::string_view, 2> kNames{"60E1", "S1002"};
  return kNames;
}

Body standard_profile_body(std::string_view name) {
  if (name == "S1002") return Body::wheel;
  if (name == "60E1") return Body::rail;
  throw Error(ErrorKind::configuration, "unknown standard profile '" + std::string(name) + "'", {},
              "known: 60E1, S1002");
}

}  // namespace treadmark::analytic
