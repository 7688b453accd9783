// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/profiles/write_profile.hpp"

#include <gtest/gtest.h>

#include <random>

#include "samples.hpp"

namespace treadmark::io {
namespace {

using testing::columns;
using testing::parse;
using testing::rail_points;
using testing::TemporaryFolder;
using testing::wheel_points;

/// Points with all digits that a double has.
Profile rough(Profile p) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> noise(-1e-5, 1e-5);
  for (std::size_t i = 0; i < p.y.size(); ++i) p.y[i] += noise(random), p.z[i] += noise(random);
  // what a reader can give: metres from a number of mm
  for (std::vector<double>* values : {&p.y, &p.z})
    for (double& v : *values) v = (v * 1e3) * 1e-3;
  return p;
}

/// The points as they stand in the file.
Profile read_as_written(const std::filesystem::path& file, Body body) {
  ProfileOptions options;
  options.placement = ProfileOptions::Placement::as_in_file;
  options.smoothing = {};
  return read_profile(file, body, options);
}

TEST(WriteProfile, TheSamePointsComeBack) {
  const TemporaryFolder folder;
  const Profile rail = rough(parse(columns(rail_points()), Body::rail));
  const Profile wheel = rough(parse(columns(wheel_points()), Body::wheel));
  for (const char* name : {"a.prr", "a.ban", "a.csv", "b.prw", "b.whl", "b.csv"}) {
    SCOPED_TRACE(name);
    const Profile& p = name[0] == 'a' ? rail : wheel;
    const auto file = folder.path() / name;
    write_profile(file, p);
    const Profile again = read_as_written(file, p.body);
    EXPECT_EQ(again.y, p.y);
    EXPECT_EQ(again.z, p.z);
  }
}

TEST(WriteProfile, DerivativesAreFurtherColumns) {
  const TemporaryFolder folder;
  const Profile wheel = parse(columns(wheel_points()), Body::wheel);
  ProfileDerivatives d;
  for (std::size_t i = 0; i < wheel.y.size(); ++i) {
    d.s.push_back(0.001 * static_cast<double>(i));
    d.inclination.push_back(0.05);
    d.curvature.push_back(3.0);
  }
  for (const char* name : {"a.csv", "a.whl"}) {
    write_profile(folder.path() / name, wheel, &d);
    EXPECT_EQ(read_as_written(folder.path() / name, Body::wheel).y, wheel.y) << name;
  }
  std::ifstream csv(folder.path() / "a.csv");
  std::string line;
  std::getline(csv, line);
  EXPECT_EQ(line, "y [mm],z [mm],s [mm],inclination [rad],curvature [1/m]");
  std::getline(csv, line);
  EXPECT_EQ(line.substr(line.find(',', line.find(',') + 1)), ",0,0.05,3");
  EXPECT_THROW(write_profile(folder.path() / "a.prw", wheel, &d), Error);
}

TEST(WriteProfile, RefusesOtherBodiesAndWhatWouldBeReadOtherwise) {
  const TemporaryFolder folder;
  const Profile wheel = parse(columns(wheel_points()), Body::wheel);
  EXPECT_THROW(write_profile(folder.path() / "a.prr", wheel), Error);
  EXPECT_THROW(write_profile(folder.path() / "a.ply", wheel), Error);
  Profile bowl = parse(columns(rail_points()), Body::rail);
  for (double& z : bowl.z) z = -z;
  EXPECT_THROW(write_profile(folder.path() / "a.csv", bowl), Error);  // a reader would turn it over
  EXPECT_FALSE(std::filesystem::exists(folder.path() / "a.csv"));
  EXPECT_NO_THROW(write_profile(folder.path() / "a.prr", bowl));
  EXPECT_EQ(read_as_written(folder.path() / "a.prr", Body::rail).z, bowl.z);
}

}  // namespace
}  // namespace treadmark::io
