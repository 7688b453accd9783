// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/shape/surface_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/core/random.hpp"

namespace treadmark {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// Draws of 3 um, uniform to both sides.
SurfaceErrors sample(std::size_t places, std::size_t draws) {
  SurfaceErrors out;
  Random random(5);
  for (std::size_t i = 0; i < places; ++i) {
    out.y.push_back(0.03 - 0.5e-3 * static_cast<double>(i));
    out.z.push_back(-0.01 + 0.1e-3 * static_cast<double>(i));
  }
  for (std::size_t k = 0; k < draws; ++k) {
    out.u.push_back(6.0 * random.uniform() - 3.0);
    std::vector<double>& draw = out.draws.emplace_back();
    for (std::size_t i = 0; i < places; ++i) draw.push_back(6e-6 * (random.uniform() - 0.5));
  }
  return out;
}

TEST(SurfaceErrors, LinesHoldThem) {
  for (const auto& [places, draws] : {std::pair{2u, 1u}, std::pair{50u, 7u}, std::pair{271u, 64u}}) {
    const SurfaceErrors errors = sample(places, draws);
    std::vector<std::string> lines = to_lines(errors);
    for (const std::string& line : lines) EXPECT_LE(line.size(), 200u);
    lines.insert(lines.begin(), "from wheel.ply");
    lines.push_back("another comment with numbers 1 2 3");
    const auto back = errors_of_lines(lines);
    ASSERT_NE(back, nullptr);
    ASSERT_EQ(back->y.size(), places);
    ASSERT_EQ(back->draws.size(), draws);
    for (std::size_t i = 0; i < places; ++i) {
      EXPECT_NEAR(back->y[i], errors.y[i], 0.51e-7);
      EXPECT_NEAR(back->z[i], errors.z[i], 0.51e-7);
    }
    for (std::size_t k = 0; k < draws; ++k) {
      EXPECT_NEAR(back->u[k], errors.u[k], 0.51e-6);
      for (std::size_t i = 0; i < places; ++i) EXPECT_NEAR(back->draws[k][i], errors.draws[k][i], 0.51e-8);
    }
    EXPECT_EQ(to_lines(*back), to_lines(errors)) << "told again they are the same";
  }
}

TEST(SurfaceErrors, OtherLinesAreNone) {
  EXPECT_EQ(errors_of_lines({}), nullptr);
  const std::vector<std::string> lines{"from wheel.ply", " surface-errors 1", "surface errors 1 2 3"};
  EXPECT_EQ(errors_of_lines(lines), nullptr);
}

TEST(SurfaceErrors, DamagedLinesAreRefused) {
  const std::vector<std::string> whole = to_lines(sample(40, 3));
  ASSERT_GT(whole.size(), 4u);
  const auto refused = [](const std::vector<std::string>& lines) {
    try {
      errors_of_lines(lines);
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::input_data);
      EXPECT_THAT(error.message(), HasSubstr("surface-errors"));
      EXPECT_THAT(error.advice(), HasSubstr("remove all of these lines"));
      return true;
    }
    return false;
  };
  for (std::size_t k = 1; k < whole.size(); ++k) {
    std::vector<std::string> lines = whole;
    lines.erase(lines.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_TRUE(refused(lines)) << "without line " << k;
    lines = whole;
    lines[k].back() = 'x';
    EXPECT_TRUE(refused(lines)) << "a letter in line " << k;
    lines = whole;
    lines[k] += " 7";
    EXPECT_TRUE(refused(lines)) << "one number more in line " << k;
  }
  for (const char* line :
       {"surface-errors 2 2 1 0 0 1 0 0 0 0", "surface-errors 1 1 1 0 0 0 0", "surface-errors 1 2 0 0 0 1 0",
        "surface-errors 1 1e300 1 0 0", "surface-errors 1 -2 1 0 0", "surface-errors 1 2.5 1 0 0 1 0 0 0 0",
        "surface-errors 1 2 1 0 0 nan 0 0 0 0", "surface-errors 1 2 1 0 0 inf 0 0 0 0",
        "surface-errors 1 2 1 0 0 1e9 0 0 0 0", "surface-errors 1 2 1 0 0 1 0 0 0 1e30", "surface-errors x",
        "surface-errors 1", "surface-errors 1 18446744073709551615 18446744073709551615 0"})
    EXPECT_TRUE(refused({line})) << line;
  EXPECT_FALSE(refused({"surface-errors 1 2 1 0 0 1 0 0 0 0"}));
  EXPECT_FALSE(refused({"surface-errors 1 2 1 0 0 1 0 -12500.5 0 0"})) << "12.5 km along a rail";
}

TEST(SurfaceErrors, NearestStationsAlsoRoundAWheel) {
  SurfaceErrors errors = sample(2, 5);
  errors.u = {-3.0, -1.0, 0.5, 2.0, 3.1};
  EXPECT_THAT(nearest_draws(errors, 3.0, 3, 2.0 * std::numbers::pi), ElementsAre(4u, 0u, 3u));
  EXPECT_THAT(nearest_draws(errors, 3.0, 3, 0.0), ElementsAre(4u, 3u, 2u));
  EXPECT_EQ(nearest_draws(errors, 0.0, 9, 0.0).size(), 5u);
}

TEST(SurfaceErrors, ChangeWithTheCoordinates) {
  SurfaceErrors errors = sample(3, 1);
  errors.u = {0.25};
  const SurfaceErrors rail = changed(errors, 2.0, true, true, Stations::along),
                      wheel = changed(errors, 1.0, false, true, Stations::round),
                      slices = changed(errors, 2.0, false, true, Stations::kept);
  EXPECT_EQ(rail.y[0], -2.0 * errors.y[2]) << "still in the order of a profile's points";
  EXPECT_EQ(rail.z[0], -2.0 * errors.z[2]);
  EXPECT_EQ(rail.draws[0][0], 2.0 * errors.draws[0][2]);
  EXPECT_EQ(rail.u[0], 0.5);
  EXPECT_EQ(wheel.z, errors.z) << "z of a wheel is a radius";
  EXPECT_DOUBLE_EQ(wheel.u[0], std::numbers::pi - 0.25);
  EXPECT_EQ(slices.y[0], 2.0 * errors.y[0]);
  EXPECT_EQ(slices.z[0], -2.0 * errors.z[0]);
  EXPECT_EQ(slices.draws[0][0], 2.0 * errors.draws[0][0]);
  EXPECT_EQ(slices.u[0], 0.25) << "stations of slices have no unit that a factor could change";
}

TEST(SurfaceErrors, Size) {
  SurfaceErrors errors = sample(2, 2);
  errors.draws = {{1e-6, -3e-6}, {1e-6, 1e-6}};
  EXPECT_DOUBLE_EQ(size_of(errors).rms, std::sqrt(3.0) * 1e-6);
  EXPECT_EQ(size_of(errors).largest, 3e-6);
}

}  // namespace
}  // namespace treadmark
