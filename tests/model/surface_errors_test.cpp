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

/// With motions, a field of each station and one of all.
SurfaceErrors with_all_sources() {
  SurfaceErrors out = sample(40, 3);
  out.motions = {{ErrorSource::lateral, 0.123456789e-3, -2e-6, 1.5e-4}, {ErrorSource::scanner, 1e-4, 0.0, 0.0}};
  out.fields = {{ErrorSource::holes, 4e-3, std::vector(3, std::vector<double>(40, 2.5e-6))},
                {ErrorSource::registration, 20e-3, {std::vector<double>(40, 1e-6)}}};
  return out;
}

TEST(SurfaceErrors, LinesHoldTheirSources) {
  const SurfaceErrors errors = with_all_sources();
  const std::vector<std::string> lines = to_lines(errors);
  const auto back = errors_of_lines(lines);
  ASSERT_NE(back, nullptr);
  ASSERT_EQ(back->motions.size(), 2u);
  EXPECT_EQ(back->motions[1].source, ErrorSource::scanner);
  EXPECT_NEAR(back->motions[0].y, errors.motions[0].y, 1e-9);
  EXPECT_DOUBLE_EQ(back->motions[0].z, -2e-6);
  EXPECT_DOUBLE_EQ(back->motions[0].roll, 1.5e-4);
  ASSERT_EQ(back->fields.size(), 2u);
  EXPECT_EQ(name_of(back->fields[0].source), "filled holes");
  EXPECT_EQ(back->fields[0].sigma.size(), 3u);
  EXPECT_NEAR(back->fields[0].at(2)[39], 2.5e-6, 0.51e-8);
  EXPECT_NEAR(back->fields[1].at(2)[0], 1e-6, 0.51e-8) << "one curve is that of all stations";
  EXPECT_EQ(to_lines(*back), lines);
  for (std::size_t k = 1; k < lines.size(); ++k) {
    std::vector<std::string> fewer = lines;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(k));
    EXPECT_THROW(errors_of_lines(fewer), Error) << "without line " << k;
  }
  for (const char* wrong :
       {"surface-errors 2 2 1 1 0 0 0 1 0 0 0 0 9 0 0 0", "surface-errors 2 2 1 0 1 0 0 1 0 0 0 0 4 0 1 5 5",
        "surface-errors 2 2 1 0 1 0 0 1 0 0 0 0 4 0.004 2 5 5 5 5", "surface-errors 2 2 1 101 0 0 0 1 0 0 0 0"})
    EXPECT_THROW(errors_of_lines(std::vector<std::string>{wrong}), Error) << wrong;
  EXPECT_NE(errors_of_lines(std::vector<std::string>{"surface-errors 2 2 1 1 1 0 0 1 0 0 0 0 0 0 0 0 4 0.004 1 5 5"}),
            nullptr);
}

TEST(SurfaceErrors, MayBeSharedFartherThanASectionIsWide) {
  SurfaceErrors errors = with_all_sources();
  errors.fields.back().length = 25.0;
  EXPECT_EQ(errors_of_lines(to_lines(errors))->fields.back().length, 25.0);
}

TEST(SurfaceErrors, SourcesChangeWithTheCoordinates) {
  const SurfaceErrors errors = with_all_sources(), mirrored = changed(errors, 2.0, true, false, Stations::along),
                      wheel = changed(errors, 1.0, false, true, Stations::round);
  EXPECT_EQ(mirrored.motions[0].y, -2.0 * errors.motions[0].y);
  EXPECT_EQ(mirrored.motions[0].z, 2.0 * errors.motions[0].z);
  EXPECT_EQ(mirrored.motions[0].roll, -errors.motions[0].roll);
  EXPECT_EQ(mirrored.fields[0].length, 2.0 * errors.fields[0].length);
  EXPECT_EQ(mirrored.fields[0].sigma[1][0], 2.0 * errors.fields[0].sigma[1][39]);
  EXPECT_EQ(wheel.motions[0].z, errors.motions[0].z) << "of a wheel it is that of the radius";
  EXPECT_EQ(wheel.motions[0].roll, errors.motions[0].roll);
}

TEST(SurfaceErrors, DeviationsAddUp) {
  SurfaceErrors errors = sample(2, 2);
  errors.draws = {{3e-6, 0.0}, {-3e-6, 0.0}};
  errors.y = {0.02, 0.0}, errors.z = {0.0, 0.0};
  errors.motions = {{ErrorSource::tilt, 0.0, 0.0, 2e-4}};
  errors.fields = {{ErrorSource::smoothing, 4e-3, {{12e-6, 0.0}}}};
  const std::size_t near[] = {0, 1};
  EXPECT_NEAR(deviation_at(errors, 0, near, 0.0), 1e-6 * std::sqrt(9.0 + 16.0 + 144.0), 1e-12);
  EXPECT_EQ(deviation_at(errors, 1, near, 0.0), 0.0) << "the section turns about its origin";
  errors.motions = {{ErrorSource::lateral, 1e-4, 0.0, 0.0}};
  errors.fields.clear();
  EXPECT_NEAR(deviation_at(errors, 1, near, 0.1), 1e-4 * std::sin(0.1), 1e-12) << "a slope goes along";
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
