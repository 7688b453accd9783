// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// A measured wheel with noise on its flange back beside a guard rail in the rail's section: the pressure of the tread
// contact, or a failure by name.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <string>
#include <vector>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/sample_input.hpp"

namespace treadmark::app {
namespace {

constexpr double kRadius = 0.46, kGuardFace = -77.0;  // [m], [mm]

/// (y, z) [mm] of a standard profile, y increasing.
std::vector<Vec2> standard(const char* name, Body body, double y_min, double y_max) {
  const double step = 0.25, radius = body == Body::wheel ? kRadius : 0.0;
  const int n = static_cast<int>((y_max - y_min) / step) + 1;
  std::vector<double> z(static_cast<std::size_t>(n));
  const auto surface = analytic::make_standard_surface({name}, body, radius);
  surface->heights({Pose{}, {0.0, kMillimetre * y_min, 1.0, kMillimetre * step, 1, n}}, {z, {}, {}});
  std::vector<Vec2> out;
  for (int i = 0; i < n; ++i)
    if (const double height = z[static_cast<std::size_t>(i)]; !std::isnan(height))
      out.emplace_back(y_min + i * step, kMilli * (height - radius));
  return out;
}

std::string text_of(const std::vector<Vec2>& points) {
  std::string text;
  for (const Vec2& p : points) text += fmt::format("{:.4f} {:.4f}\n", p.x(), p.y());
  return text;
}

std::string rail_with_guard() {
  std::vector<Vec2> points;
  for (double y = kGuardFace - 30.0; y < kGuardFace - 2.5; y += 0.5) points.emplace_back(y, 2.0);
  for (double a = 0.0; a < 0.5 * kPi; a += 0.1)
    points.emplace_back(kGuardFace - 2.5 + 2.5 * std::sin(a), 4.5 - 2.5 * std::cos(a));
  for (double z = 5.0; z < 42.0; z += 0.5) points.emplace_back(kGuardFace, z);
  for (double y = kGuardFace + 0.5; y < -42.0; y += 0.5) points.emplace_back(y, 42.0);
  const std::vector<Vec2> head = standard("60E1", Body::rail, -35.5, 35.5);
  points.insert(points.end(), head.begin(), head.end());
  return text_of(points);
}

/// From the field side to the flange and up its back.
std::string wheel_with_back(double noise) {
  std::vector<Vec2> points = standard("S1002", Body::wheel, -69.75, 59.75);
  std::vector<Vec2> out(points.rbegin(), points.rend());
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 1.0);
  for (double z = out.back().y() - 0.5; z > -18.0; z -= 0.25) out.emplace_back(-70.0 + noise * normal(random), z);
  return text_of(out);
}

io::CaseResult solved(double noise, double y_mm) {
  const treadmark::testing::SampleInput input;
  input.write("rail.txt", rail_with_guard());
  input.write("wheel.txt", wheel_with_back(noise));
  input.write("case.inp", fmt::format(R"(
  1 MODULE
 1203100    C-P-B-T-N-F-S
 0022033    V-L-D-C-M-Z-E
 0001321    H-G-I-A-O-W-R
    999     100    30    1     1e-5
  0.300   0.300
  0.280   0.280   82000.  82000.
  0.400   0.400   1.000   90d   8.0   4.0
   -1.0   753.5     0.0   0.0
  'rail.txt'     0   1.0   0.0   -1
     0.0    0.0   0.000   0.0   0.0   0.000
  1360.0  -70.0   460.0
  'wheel.txt'   0   1.0   0.0   -1
  0.0  {}  90000. 0.000  0.000   0.0
 10000. 0.0  0.0    0.0    0.0    -21.73

 0 MODULE
)",
                                      y_mm));
  return run_cases(io::read_any_case(input.inp(), {})).cases.at(0);
}

double largest_pressure(const io::CaseResult& c) {
  double most = 0.0;
  for (const io::PatchResult& p : c.patches) most = std::max(most, p.pmax);
  return most;
}

TEST(GuardRail, NoiseOnTheFlangeBackLeavesThePressureOrFailsByName) {
  constexpr double kNoise_mm = 0.05, kFarFromGuard_mm = -3.0;
  int sound = 0;
  for (const double y : {0.0, kFarFromGuard_mm, -3.4, -3.6, -3.8, -4.0, -4.4}) {
    const io::CaseResult clean = solved(0.0, y), noisy = solved(kNoise_mm, y);
    for (const io::CaseResult* c : {&clean, &noisy})
      if (c->status == Status::ok && !any_grave(c->remarks)) {
        EXPECT_LT(largest_pressure(*c), 2.5e9) << y;
      } else {
        EXPECT_FALSE(c->message.empty() && c->remarks.empty()) << y;
      }
    if (clean.status != Status::ok || noisy.status != Status::ok) continue;
    if (any_grave(clean.remarks) || any_grave(noisy.remarks)) continue;
    ++sound;
    // The noise lies on the flange back alone: the tread contact does not know of it.
    EXPECT_NEAR(largest_pressure(noisy), largest_pressure(clean), 1e-3 * largest_pressure(clean)) << y;
  }
  EXPECT_GE(sound, 2);
  EXPECT_EQ(solved(kNoise_mm, kFarFromGuard_mm).status, Status::ok);
}

}  // namespace
}  // namespace treadmark::app
