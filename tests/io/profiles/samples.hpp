// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/io/profiles/read_profile.hpp"
#include "treadmark/tests/support/refusal.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {

/// Tolerance of numbers read [m or rad]: texts have few decimals, and their conversion adds rounding only.
inline constexpr double kRound = 1e-12;

struct Point {
  double y, z;
};

/// Head of a rail [mm], z down, increasing y: a parabola of radius 300 mm at the top.
inline std::vector<Point> rail_points() {
  std::vector<Point> points;
  for (int i = -18; i <= 18; ++i) points.push_back({2.0 * i, 4.0 * i * i / 600.0});
  return points;
}

/// A cone 1:20 with a flange [mm], z down, decreasing y.
inline std::vector<Point> wheel_points() {
  std::vector<Point> points;
  for (int i = 60; i >= -68; i -= 2) {
    const double y = i;
    points.push_back({y, -y / 20.0 + 28.0 * std::exp(-std::pow((y + 56.0) / 8.0, 2))});
  }
  return points;
}

/// A wheel [mm], z down: cone 1:20, a flange with a back at y = -70.
inline std::vector<Point> wheel(double step = 0.5) {
  std::vector<Point> points;
  for (double y = 60.0; y > -40.0; y -= step) points.push_back({y, -y / 20.0});
  for (double z = 2.0 + step; z < 20.0; z += step) points.push_back({-40.0 - (z - 2.0) / 3.0, z});
  for (double a = 0.0; a <= 180.0; a += 3.0)
    points.push_back({-58.0 + 12.0 * std::cos(a * M_PI / 180.0), 20.0 + 8.0 * std::sin(a * M_PI / 180.0)});
  for (double z = 20.0 - step; z > 5.0; z -= step) points.push_back({-70.0, z});
  return points;
}

inline std::string columns(const std::vector<Point>& points) {
  std::string text;
  for (const Point& p : points) text += std::to_string(p.y) + "  " + std::to_string(p.z) + "\n";
  return text;
}

/// A Simpack file in mm with further lines for its spline section.
inline std::string simpack(Body body, const std::vector<Point>& points, const std::string& keys = "") {
  return std::string("header.begin\n  version = 1\n  type = ") + (body == Body::rail ? "0" : "1") +
         "\nheader.end\nspline.begin\n  units.len.f = 1000.\n" + keys + "point.begin\n" + columns(points) +
         "point.end\nspline.end\n";
}

inline Profile parse(const std::string& text, Body body, const io::ProfileOptions& options = {},
                     io::ProfileFormat format = io::ProfileFormat::two_column) {
  return io::parse_profile(text, "sample", format, body, options);
}

/// Checks the place and a part of the message of an error.
#define TREADMARK_EXPECT_ERROR(call, part, line_, column_)                                      \
  do {                                                                                          \
    const treadmark::Error caught = treadmark::testing::error_thrown_by([&] { (void)(call); }); \
    EXPECT_NE(std::string(caught.what()).find(part), std::string::npos) << caught.what();       \
    EXPECT_EQ(caught.where().line, line_) << caught.what();                                     \
    EXPECT_EQ(caught.where().column, column_) << caught.what();                                 \
    EXPECT_EQ(caught.kind(), treadmark::ErrorKind::input_data) << caught.what();                \
  } while (false)

}  // namespace treadmark::testing
