// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "treadmark/core/error.hpp"
#include "treadmark/io/results/summary.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/io/results/write_vtk.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"

namespace treadmark {
namespace {

using nlohmann::json;

/// A patch of a sequence in time on a rail that gives way, in conformal contact.
io::RunResult rich_run() {
  io::RunResult run = testing::sample_run();
  io::CaseResult& c = run.cases[0];
  const io::Loads loads{{{1, 2, 3}, {0.1, 0.2, 0.3}},
                        {{4, 5, 6}, {0.4, 0.5, 0.6}},
                        {{7, 8, 9}, {0.7, 0.8, 0.9}},
                        {{10, 11, 12}, {1, 1.1, 1.2}}};
  c.loads = loads;
  c.rail_deflection = Vec2(-1.5e-3, 2e-4);
  c.roller = {-0.5, 12.0};
  io::PatchResult& p = c.patches[0];
  p.loads = loads;
  p.id = 7;
  p.came_from = {3, 5};
  p.local = {100.0, 20.0, -30.0};
  p.reference_x = 2e-3;
  p.reference_s = -1e-3;
  p.x_wheelset = 1e-3;
  p.angle_wheel = 0.25;
  p.fields.row_angle.assign(static_cast<std::size_t>(p.fields.grid.ny), 0.1);
  p.fields.extra_slip_x.assign(p.fields.grid.size(), 1e-3);
  return run;
}

TEST(SequenceResults, JsonNamesUnitsAndFitsTheSchema) {
  const json document = json::parse(io::to_json(rich_run()));
  const json schema = json::parse(io::result_schema());
  EXPECT_EQ(testing::first_violation(document, schema, schema), "");
  const json &c = document["cases"][0], &p = c["patches"][0], &other = c["patches"][1];
  EXPECT_EQ(c["loads"]["track"]["fz_N"], 3.0);
  EXPECT_EQ(c["loads"]["wheel"]["mx_Nmm"], 1000.0);
  EXPECT_EQ(p["loads"]["wheelset"]["fx_N"], 7.0);
  EXPECT_EQ(p["loads"]["rail"]["mz_Nmm"], 600.0);
  EXPECT_EQ(c["rail_deflection"]["y_mm"], -1.5);
  EXPECT_EQ(c["roller"]["nominal_radius_mm"], -500.0);
  EXPECT_EQ(p["id"], 7);
  EXPECT_EQ(p["came_from"], json::parse("[3, 5]"));
  EXPECT_EQ(p["reference"]["x_ws_mm"], 1.0);
  EXPECT_EQ(p["reference"]["angle_wheel_rad"], 0.25);
  EXPECT_EQ(p["grid"]["reference_x_mm"], 2.0);
  EXPECT_EQ(p["grid"]["reference_s_mm"], -1.0);
  EXPECT_EQ(p["grid"]["row_angle_rad"].size(), 20u);
  EXPECT_EQ(p["fs_tilde_N"], -30.0);
  for (const char* absent : {"id", "loads", "fn_tilde_N"}) EXPECT_FALSE(other.contains(absent)) << absent;
  EXPECT_FALSE(document["cases"][1].contains("rail_deflection"));
}

TEST(SequenceResults, AttributesHoldThem) {
  const io::RunResult run = rich_run();
  const auto value = [](const std::vector<io::Attribute>& list, const std::string& name) -> io::Attribute::Value {
    for (const io::Attribute& one : list)
      if (one.name == name) return one.value;
    return "absent";
  };
  const auto c = io::attributes_of(run.cases[0]), p = io::attributes_of(run.cases[0].patches[0]),
             other = io::attributes_of(run.cases[0].patches[1]);
  EXPECT_EQ(std::get<Vec3>(value(c, "load_moment_rail")), Vec3(0.4, 0.5, 0.6));
  EXPECT_EQ(std::get<double>(value(c, "rail_deflection_y")), -1.5e-3);
  EXPECT_EQ(std::get<double>(value(c, "roller_pitch_rate")), 12.0);
  EXPECT_EQ(std::get<Vec3>(value(p, "load_force_wheel")), Vec3(10, 11, 12));
  EXPECT_EQ(std::get<std::string>(value(p, "id")), "7");
  EXPECT_THAT(std::get<std::vector<std::string>>(value(p, "came_from")), ::testing::ElementsAre("3", "5"));
  EXPECT_EQ(std::get<Vec3>(value(p, "local_forces_x_s_n")), Vec3(20.0, -30.0, 100.0));
  EXPECT_EQ(std::get<std::string>(value(other, "load_force_wheel")), "absent");
}

TEST(SequenceResults, SummarySaysWhatWasFound) {
  const std::string text = io::summary(rich_run().cases[0]);
  EXPECT_THAT(text, ::testing::ContainsRegex("wheelset pitch rate +\\[rad/s\\] +-4.0819\n"));
  EXPECT_THAT(text, ::testing::ContainsRegex("rail deflection y, z +\\[mm\\] +-1.5000 +0.2000\n"));
}

TEST(RowEdges, OfAPlaneAreEquallySpaced) {
  io::PatchFields fields;
  fields.grid = {0.0, 1e-3, 1e-3, 0.5e-3, 3, 4};
  const auto edges = io::row_edges(fields, 0.0);
  ASSERT_EQ(edges.size(), 5u);
  for (std::size_t i = 0; i < 5; ++i)
    EXPECT_NEAR((edges[i] - Vec2(0.75e-3 + 0.5e-3 * static_cast<double>(i), 0.0)).norm(), 0.0, 1e-15);
}

/// Rows of a circle of radius R that touches the plane at the reference: their edges lie on that circle.
TEST(RowEdges, OfACircleLieOnIt) {
  constexpr double kRadius = 10e-3, kReference = 0.7e-3;
  constexpr int kRows = 400;
  io::PatchFields fields;
  fields.grid = {0.0, -4e-3, 1e-3, 8e-3 / kRows, 1, kRows};
  for (int iy = 0; iy < kRows; ++iy) fields.row_angle.push_back((fields.grid.y(iy) - kReference) / kRadius);
  const auto edges = io::row_edges(fields, kReference);
  ASSERT_EQ(edges.size(), kRows + 1u);
  const Vec2 middle(kReference, kRadius);
  for (std::size_t i = 0; i < edges.size(); ++i) {
    EXPECT_NEAR((edges[i] - middle).norm(), kRadius, 1e-7) << i;
    const double angle = (fields.grid.y0 + (static_cast<double>(i) - 0.5) * fields.grid.dy - kReference) / kRadius;
    EXPECT_NEAR((edges[i] - (middle + kRadius * Vec2(std::sin(angle), -std::cos(angle)))).norm(), 0.0, 1e-6) << i;
  }
}

TEST(SequenceResults, InclinationsMustMatchTheRows) {
  io::RunResult run = rich_run();
  EXPECT_NO_THROW(io::patch_to_vts(run.cases[0].patches[0], 1, 1));
  run.cases[0].patches[0].fields.row_angle.pop_back();
  EXPECT_THROW(io::patch_to_vts(run.cases[0].patches[0], 1, 1), Error);
}

}  // namespace
}  // namespace treadmark
