// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/read_limits.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/simulations/simulation_keys.hpp"
#include "treadmark/tests/support/refusal.hpp"

namespace treadmark::io {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

const std::string kLimits = R"(edition = "made up 2026, table 1"

[[limits]]
quantity = "Y_qst"
section = "curve"
from_radius_m = 250
to_radius_m = 600
value = 30e3
by_curvature = 10.5e6

[[limits]]
quantity = "Q"
vehicle = "freight"
above_speed_km_h = 90
value = 90e3
by_load = 0.5
)";

RunningLimits parse(const std::string& good = "", const std::string& other = "") {
  std::string text = kLimits;
  text.replace(text.find(good), good.size(), other);
  return parse_limits_text(text, "limits.toml");
}

TEST(LimitFiles, AreRead) {
  const RunningLimits limits = parse();
  EXPECT_EQ(limits.edition, "made up 2026, table 1");
  EXPECT_FALSE(limits.verified);
  ASSERT_EQ(limits.limits.size(), 2u);
  const RunningLimit &curve = limits.limits[0], &wagon = limits.limits[1];
  EXPECT_EQ(curve.quantity, "Y_qst");
  EXPECT_EQ(curve.section, SectionKind::curve);
  EXPECT_FALSE(curve.vehicle);
  EXPECT_EQ(curve.from_radius, 250.0);
  EXPECT_EQ(curve.to_radius, 600.0);
  EXPECT_EQ(curve.constant, 30e3);
  EXPECT_EQ(curve.by_curvature, 10.5e6);
  EXPECT_EQ(wagon.vehicle, VehicleKind::freight);
  EXPECT_FALSE(wagon.section);
  EXPECT_FALSE(wagon.to_radius);
  EXPECT_DOUBLE_EQ(wagon.above_speed, 25.0);
  EXPECT_EQ(wagon.by_load, 0.5);
  EXPECT_EQ(wagon.where.line, 11);
  EXPECT_TRUE(parse("\n\n[[limits]]", "\nverified = true\n[[limits]]").verified);
}

TEST(LimitFiles, BadOnesAreRefusedWhereTheyStand) {
  const auto error = [](const std::string& good, const std::string& other) {
    return treadmark::testing::refusal_of([&] { parse(good, other); }, ErrorKind::configuration);
  };
  EXPECT_THAT(error("edition = \"made up 2026, table 1\"", ""), HasSubstr("edition"));
  EXPECT_THAT(error("made up 2026, table 1", ""),
              AllOf(HasSubstr("limits.toml:1:"), HasSubstr("edition must not be empty")));
  EXPECT_THAT(error("section = \"curve\"", "section = \"bend\""),
              AllOf(HasSubstr("limits.toml:5:"), HasSubstr("curve")));
  EXPECT_THAT(error("from_radius_m", "from_radius"), HasSubstr("did you mean 'limits.from_radius_m'?"));
  EXPECT_THAT(error("to_radius_m = 600", "to_radius_m = 250"), HasSubstr("no radius lies from 250 to 250 m"));
  EXPECT_THAT(error("from_radius_m = 250", "from_radius_m = -1"), HasSubstr("from_radius_m"));
  EXPECT_THAT(error("value = 30e3\nby_curvature = 10.5e6\n", ""), HasSubstr("the limit of Y_qst is nowhere positive"));
  EXPECT_THAT(error("value = 30e3", "value = \"30 kN\""), HasSubstr("limits.toml:8:"));
  EXPECT_THAT(error("quantity = \"Q\"\n", ""), HasSubstr("quantity"));
  EXPECT_THAT(error(kLimits.substr(kLimits.find("\n[[")), ""), HasSubstr("limits"));
}

TEST(LimitFiles, TheExampleIsRead) {
  const RunningLimits limits = read_limits_file(std::string(TREADMARK_SOURCE_DIR) + "/examples/limits/by-radius.toml");
  EXPECT_FALSE(limits.verified);
  LimitInput in;
  in.section = SectionKind::curve;
  in.radius = 1000.0;
  EXPECT_NEAR(limit_of(limits, "Y_qst", in), 40.5e3, 1e-6);
  EXPECT_EQ(nlohmann::json::parse(limits_file_schema()).at("required"), nlohmann::json({"edition", "limits"}));
}

TEST(LimitFiles, TheirTableOfKeysIsUpToDate) {
  EXPECT_THAT(read_text(std::string(TREADMARK_SOURCE_DIR) + "/docs/assessment.md"), HasSubstr(limits_key_table()));
}

}  // namespace
}  // namespace treadmark::io
