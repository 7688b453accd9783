// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>
#include <string>
#include <vector>

#include "treadmark/model/shape/defects.hpp"

namespace treadmark::testing {

/// Defects with formulas of their own, written from docs/defects.md: dz(x, y) of a rail, dr(theta, y) of a wheel.
struct NamedDefects {
  std::string name;
  Body body;
  Defects defects;
  std::function<double(double, double)> offset;
  double u_min, u_max, y_min, y_max;  ///< where it is worth looking
  double kink = 1e300;                ///< size of second derivatives that tells a kink from the rest
};

inline constexpr double kTestRadius = 0.46;

inline double fade(double e, double width) {
  if (width == 0.0) return 1.0;
  return std::fabs(e) < 0.5 * width ? std::pow(std::cos(std::numbers::pi * e / width), 2) : 0.0;
}
inline double turn(double theta) { return std::remainder(theta, 2.0 * std::numbers::pi); }

/// All shapes that are offsets, one of each kind and some that meet.
inline std::vector<NamedDefects> offset_defects() {
  constexpr double kPi = std::numbers::pi, R = kTestRadius;
  std::vector<NamedDefects> all;

  const WheelFlat rounded{WheelFlat::Shape::rounded, 0.06, 0.8e-3, 3.13, 0.004, 0.05};
  const auto rounded_offset = [=](double t, double y) {
    return -0.8e-3 * fade(R * turn(t - 3.13), 0.06) * fade(y - 0.004, 0.05);
  };
  all.push_back({"rounded_flat", Body::wheel, {.flats = {rounded}}, rounded_offset, 3.0, 3.3, -0.03, 0.04});

  const WheelFlat fresh{WheelFlat::Shape::fresh, 0.04, 0.0, -0.005, 0.0, 0.0};
  const auto fresh_offset = [=](double t, double) {
    const double x = std::fabs(turn(t + 0.005));
    return x < std::asin(0.02 / R) ? -(R - std::sqrt(R * R - 0.02 * 0.02) / std::cos(x)) : 0.0;
  };
  all.push_back({"fresh_flat", Body::wheel, {.flats = {fresh}}, fresh_offset, -0.08, 0.06, -0.03, 0.04});

  const WheelFlat round_edges{WheelFlat::Shape::fresh, 0.04, 0.0, -0.005, 0.004, 0.05, 0.1};
  const auto round_edges_offset = [=](double t, double y) {
    const double chord = std::sqrt(R * R - 0.02 * 0.02), slope = 0.02 / chord;
    const double w = slope * slope / (2.0 * (1.0 / 0.1 - 1.0 / R)), H = R - chord / std::cos(turn(t + 0.005));
    return -fade(y - 0.004, 0.05) * (H >= w ? H : H > -w ? (H + w) * (H + w) / (4.0 * w) : 0.0);
  };
  all.push_back({"fresh_flat_with_round_edges",
                 Body::wheel,
                 {.flats = {round_edges}},
                 round_edges_offset,
                 -0.08,
                 0.06,
                 -0.03,
                 0.04});

  Polygonization polygon{{{7, 0.1e-3, 0.3}, {20, -0.02e-3, -1.0}}, 0.002, 0.06};
  const auto polygon_offset = [=](double t, double y) {
    return (0.1e-3 * std::cos(7 * t - 0.3) - 0.02e-3 * std::cos(20 * t + 1.0)) * fade(y - 0.002, 0.06);
  };
  all.push_back({"polygon", Body::wheel, {.polygonizations = {polygon}}, polygon_offset, -4.0, 4.0, -0.04, 0.04});
  all.push_back({"polygon_and_flats",
                 Body::wheel,
                 {.flats = {rounded, fresh}, .polygonizations = {polygon}},
                 [=](double t, double y) { return polygon_offset(t, y) + rounded_offset(t, y) + fresh_offset(t, y); },
                 -3.3,
                 3.3,
                 -0.03,
                 0.04});

  Squat squat{.length = 0.04, .width = 0.025, .depth = 0.3e-3, .x_center = 0.01, .y_center = -0.005};
  squat.second_depth = 0.5e-3;
  squat.second_width = 0.03;
  squat.second_distance = 0.03;
  squat.second_y_offset = 0.002;
  const auto squat_offset = [=](double x, double y) {
    return 0.3e-3 * fade(x - 0.01, 0.04) * fade(y + 0.005, 0.025) +
           0.5e-3 * fade(x + 0.02, 0.04) * fade(y + 0.003, 0.03);
  };
  all.push_back({"squat", Body::rail, {.squats = {squat}}, squat_offset, -0.05, 0.04, -0.025, 0.02});

  Corrugation waves{{{0.05, 0.04e-3, 0.5}, {0.03, -0.02e-3, 0.0}}, -0.12, 0.15, 0.06, 0.003, 0.06};
  const auto waves_offset = [=](double x, double y) {
    if (x <= -0.12 || x >= 0.15) return 0.0;
    const double in = std::clamp((x + 0.12) / 0.06, 0.0, 1.0), out = std::clamp((0.15 - x) / 0.06, 0.0, 1.0);
    const double run = std::pow(std::sin(0.5 * kPi * in), 2) * std::pow(std::sin(0.5 * kPi * out), 2);
    return run * fade(y - 0.003, 0.06) *
           (0.04e-3 * std::cos(2 * kPi * (x + 0.12) / 0.05 - 0.5) - 0.02e-3 * std::cos(2 * kPi * (x + 0.12) / 0.03));
  };
  all.push_back({"corrugation", Body::rail, {.corrugations = {waves}}, waves_offset, -0.15, 0.18, -0.03, 0.04});

  for (const int side : {-1, 1}) {
    GaugeCornerCollapse collapse{0.3, 2e-3, 0.015, 0.02, side * 0.012, side};
    const auto offset = [=](double x, double y) {
      const double t = std::clamp((side * y - 0.012) / 0.015, 0.0, 1.0);
      return 2e-3 * fade(x - 0.02, 0.3) * std::pow(std::sin(0.5 * kPi * t), 2);
    };
    all.push_back({side < 0 ? "collapse_left" : "collapse_right",
                   Body::rail,
                   {.gauge_corner_collapses = {collapse}},
                   offset,
                   -0.15,
                   0.2,
                   -0.035,
                   0.035});
  }
  Spall spall{.length = 0.12, .width = 0.06, .depth = 0.4e-3, .edge = 8e-3, .x_center = -0.01, .y_center = 0.004};
  const auto spall_offset = [=](double x, double y) {
    const auto window = [](double e, double half) {
      return std::pow(std::sin(0.5 * kPi * std::clamp((half - std::fabs(e)) / 8e-3, 0.0, 1.0)), 2);
    };
    return 0.4e-3 * window(x + 0.01, 0.06) * window(y - 0.004, 0.03);
  };
  all.push_back({"spall", Body::rail, {.spalls = {spall}}, spall_offset, -0.09, 0.07, -0.035, 0.04});
  const WheelSpall chip{
      .length = 0.05, .width = 0.04, .depth = 0.6e-3, .edge = 7e-3, .theta_center = -3.12, .y_center = 0.003};
  const auto chip_offset = [=](double t, double y) {
    const auto window = [](double e, double half) {
      return std::pow(std::sin(0.5 * kPi * std::clamp((half - std::fabs(e)) / 7e-3, 0.0, 1.0)), 2);
    };
    return -0.6e-3 * window(R * turn(t + 3.12), 0.025) * window(y - 0.003, 0.02);
  };
  all.push_back({"wheel_spall", Body::wheel, {.wheel_spalls = {chip}}, chip_offset, -3.25, -3.0, -0.03, 0.035});
  all.push_back(
      {"wheel_spall_a_turn_later", Body::wheel, {.wheel_spalls = {chip}}, chip_offset, 3.0, 3.3, -0.03, 0.035});
  all.push_back({"squat_on_corrugation",
                 Body::rail,
                 {.squats = {squat}, .corrugations = {waves}},
                 [=](double x, double y) { return squat_offset(x, y) + waves_offset(x, y); },
                 -0.15,
                 0.18,
                 -0.03,
                 0.04});
  return all;
}

/// A flat, a polygon, a squat or a corrugation of any size within what rails and wheels have.
inline NamedDefects random_defect(std::mt19937& random) {
  constexpr double kPi = std::numbers::pi, R = kTestRadius;
  const auto between = [&](double a, double b) { return std::uniform_real_distribution<double>(a, b)(random); };
  const double length = between(0.02, 0.1), width = between(0.02, 0.08), depth = between(0.05e-3, 1e-3);
  const double u0 = between(-3.0, 3.0), y0 = between(-0.02, 0.02);
  switch (random() % 4) {
    case 0:
      return {"flat",
              Body::wheel,
              {.flats = {{WheelFlat::Shape::rounded, length, depth, u0, y0, width}}},
              [=](double t, double y) { return -depth * fade(R * turn(t - u0), length) * fade(y - y0, width); },
              u0 - length / R,
              u0 + length / R,
              y0 - width,
              y0 + width};
    case 1: {
      const int order = 1 + static_cast<int>(random() % 30);
      return {"polygon",
              Body::wheel,
              {.polygonizations = {{{{order, 0.1 * depth, u0}}, y0, width}}},
              [=](double t, double y) { return 0.1 * depth * std::cos(order * t - u0) * fade(y - y0, width); },
              -4.0,
              4.0,
              y0 - width,
              y0 + width};
    }
    case 2: {
      const Squat squat{.length = length, .width = width, .depth = depth, .x_center = u0, .y_center = y0};
      return {"squat",
              Body::rail,
              {.squats = {squat}},
              [=](double x, double y) { return depth * fade(x - u0, length) * fade(y - y0, width); },
              u0 - length,
              u0 + length,
              y0 - width,
              y0 + width};
    }
    default: {
      const double wave = between(0.02, 0.1), phase = between(-3.0, 3.0), ramp = 0.5 * length;
      return {"corrugation",
              Body::rail,
              {.corrugations = {{{{wave, 0.1 * depth, phase}}, u0, u0 + 3.0 * length, ramp, y0, width}}},
              [=](double x, double y) {
                const double in = std::clamp((x - u0) / ramp, 0.0, 1.0);
                const double out = std::clamp((u0 + 3.0 * length - x) / ramp, 0.0, 1.0);
                return std::pow(std::sin(0.5 * kPi * in) * std::sin(0.5 * kPi * out), 2) * fade(y - y0, width) * 0.1 *
                       depth * std::cos(2.0 * kPi * (x - u0) / wave - phase);
              },
              u0 - length,
              u0 + 4.0 * length,
              y0 - width,
              y0 + width};
    }
  }
}

}  // namespace treadmark::testing
