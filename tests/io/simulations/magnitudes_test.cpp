// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/settings/magnitudes.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <span>
#include <string>
#include <vector>

#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/io/simulations/study_keys.hpp"
#include "treadmark/io/simulations/vehicle_keys.hpp"
#include "treadmark/tests/io/simulations/samples.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::io {
namespace {

using ::testing::HasSubstr;

constexpr double kInf = std::numeric_limits<double>::infinity();

/// All keys that hold numbers, also those of tables and lists within.
void collect(std::span<const KeyInfo> keys, std::vector<KeyInfo>& numbers) {
  for (const KeyInfo& key : keys) {
    collect(key.elements, numbers);
    if (key.type == KeyType::number || key.type == KeyType::number_list || key.type == KeyType::triple)
      numbers.push_back(key);
  }
}

bool taken(const KeyInfo& key, double number) {
  CaseValue value{{"file.toml", 3, 4}, number};
  if (key.type != KeyType::number) {
    std::vector<CaseValue> list{value, value, value};
    value = {{"file.toml", 3, 4}, std::move(list)};
  }
  try {
    check_value(key, value);
    return true;
  } catch (const Error& e) {
    EXPECT_EQ(e.where().line, 3) << key.path;
    EXPECT_EQ(e.where().column, 4) << key.path;
    EXPECT_THAT(e.message(), HasSubstr(key.path));
    return false;
  }
}

TEST(Magnitudes, EveryNumberOfEveryFileHasLimits) {
  std::vector<KeyInfo> numbers;
  for (const TableKeys* tables : {&vehicle_tables(), &track_tables(), &simulation_keys().infos, &study_keys().infos})
    collect(*tables, numbers);
  for (const CaseKey& key : case_keys()) collect(std::span(&key.info, 1), numbers);
  ASSERT_GT(numbers.size(), 150u);
  for (const KeyInfo& key : numbers) {
    for (const double absurd : {kInf, -kInf, std::numeric_limits<double>::quiet_NaN(), 1e16, -1e16, 1e300})
      EXPECT_FALSE(taken(key, absurd)) << key.path << " = " << absurd;
    if (key.above == 0.0) {
      EXPECT_FALSE(taken(key, 1e-16)) << key.path;
    }
    // What limits the key itself is not wider than what limits its unit.
    for (const std::optional<double>& limit : {key.at_least, key.at_most})
      if (limit) {
        EXPECT_TRUE(taken(key, *limit)) << key.path << " = " << *limit;
      }
  }
}

TEST(Magnitudes, AreThoseOfTheLongestEnding) {
  EXPECT_EQ(magnitudes_of("bodies.axle.mass_kg").greatest, 1e9);
  EXPECT_EQ(magnitudes_of("springs.a.stiffness_N_per_m").greatest, 1e15);
  EXPECT_EQ(magnitudes_of("springs.a.rotational_stiffness_N_m_per_rad").greatest, 1e15);
  EXPECT_EQ(magnitudes_of("simulation.speed_m_s").greatest, 1e9);
  EXPECT_EQ(magnitudes_of("wheelset.s_mm").least, 1e-9);
  EXPECT_EQ(magnitudes_of("scale_mass").greatest, 1e15);
}

TEST(Magnitudes, AreDocumented) { treadmark::testing::expect_in_document("case-file.md", magnitude_table()); }

class HugeSimulations : public ::testing::Test {
 protected:
  /// What is wrong with the sample where these lines stand for its speed and distance, line 6 and after.
  std::string refusal(const std::string& lines, const std::string& vehicle = samples::kVehicle) const {
    folder_.write("vehicle.toml", vehicle);
    folder_.write("track.toml", samples::kTrack);
    const std::string text = samples::with(samples::kSimulation, "speed_m_s = 20\ndistance_m = 3\n", lines);
    return samples::error_of([&] { parse_simulation_text(text, folder_.path() / "huge.toml", {}); });
  }

 private:
  treadmark::testing::TemporaryFolder folder_;
};

TEST_F(HugeSimulations, StepsAndLinesAreCountedBeforeTheyAreMade) {
  const std::string speed = "speed_m_s = 20\n";
  EXPECT_EQ(refusal(speed + "distance_m = 10\n"), "no error");
  EXPECT_THAT(refusal(speed + "distance_m = 2e6\n"),
              AllOf(HasSubstr("huge.toml:7:"), HasSubstr("at least 4e+09 steps, more than 1e+09"),
                    HasSubstr("allow longer steps")));
  EXPECT_THAT(refusal(speed + "distance_m = 1\nmax_step_us = 1e-5\nmin_step_us = 1e-6\n"), HasSubstr("5e+09 steps"));
  EXPECT_THAT(refusal(speed + "duration_s = 1000\n"),
              AllOf(HasSubstr("huge.toml:7:"), HasSubstr("4e+07 lines"), HasSubstr("output_every_mm")));
  EXPECT_EQ(refusal(speed + "duration_s = 1000\noutput_every_mm = 10\n"), "no error");
  EXPECT_THAT(refusal(speed + "distance_m = 1e300\n"), HasSubstr("beyond the greatest magnitude that is taken, 1e+09"));
}

TEST_F(HugeSimulations, NumbersOfTheVehicleHaveLimits) {
  const auto changed = [&](const std::string& from, const std::string& to) {
    return refusal("speed_m_s = 20\ndistance_m = 1\n", samples::with(samples::kVehicle, from, to));
  };
  EXPECT_THAT(changed("mass_kg = 9000", "mass_kg = 1e10"),
              AllOf(HasSubstr("vehicle.toml:6:"), HasSubstr("bodies.mass.mass_kg = 1e+10 is beyond"),
                    HasSubstr("the unit that the name of the key ends with")));
  EXPECT_THAT(changed("mass_kg = 9000", "mass_kg = 1e-10"), HasSubstr("below the least that is taken, 1e-09"));
  EXPECT_THAT(changed("30e6, 4e6", "30e6, 4e16"), HasSubstr("beyond the greatest magnitude"));
  EXPECT_THAT(changed("at_m = [[0, -1, -0.46]", "at_m = [[0, -1, -1e10]"), HasSubstr("beyond the greatest magnitude"));
  EXPECT_THAT(changed("displacement_mm = [25, 30]", "displacement_mm = [25, 1e13]"), HasSubstr("beyond the greatest"));
}

}  // namespace
}  // namespace treadmark::io
