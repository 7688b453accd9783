// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/contact_program/write_mat.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "treadmark/core/error.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/io/results/text_reader.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

using ::testing::DoubleNear;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;

constexpr double kDigits = 1e-12;

void expect_row(const std::vector<double>& row, std::vector<double> expected, std::size_t columns) {
  expected.resize(columns, 0.0);
  ASSERT_EQ(row.size(), columns);
  for (std::size_t k = 0; k < columns; ++k) EXPECT_NEAR(row[k], expected[k], kDigits * std::abs(expected[k])) << k;
}

io::MatFileHead sample_head() {
  io::MatFileHead head;
  head.time = 1.5;
  head.s_ws = 0.16;
  head.pitch_ws = -0.4363;
  head.rail_y = 0.7613;
  head.rail_z = 1e-4;
  head.rail_roll = -0.025;
  head.wheel_x = 1e-5;
  head.wheel_y = 0.75;
  head.wheel_z = 3.729e-4;
  head.wheel_roll = 0.01;
  head.wheel_yaw = 0.02;
  head.wheel_radius = 0.46;
  head.configuration = 1;
  head.discretisation = 2;
  head.tangential = 3;
  head.patches = 2;
  head.patch = 2;
  head.material = {82e9, 70e9, 0.28, 0.31};
  return head;
}

TEST(WriteMat, HeadLinesHaveTheNamesAndUnitsOfTheLayout) {
  const io::RunResult run = testing::sample_run();
  const io::PatchResult& patch = run.cases[0].patches[1];
  const testing::NumberText text = testing::read_numbers(io::patch_to_mat(sample_head(), patch, false));
  ASSERT_EQ(text.names.size(), 7u);
  ASSERT_EQ(text.rows.size(), 6u + static_cast<std::size_t>(patch.ncon));
  EXPECT_THAT(text.names[0],
              ElementsAre("TIM", "S_WS", "TH_WS", "Y_R", "Z_R", "ROLL_R", "RNOM_ROL", "-", "-", "-", "FMT"));
  EXPECT_THAT(text.names[1], ElementsAre("X_W", "Y_W", "Z_W", "ROLL_W", "YAW_W", "RNOM_WHL"));
  EXPECT_THAT(text.names[2], ElementsAre("X_CP(R)", "Y_CP(R)", "Z_CP(R)", "DELT_CP(R)", "X_CP(W)", "Y_CP(W)", "Z_CP(W)",
                                         "NPATCH", "IPATCH", "SPINXO", "SPINYO"));
  EXPECT_THAT(text.names[3], ElementsAre("MX", "MY", "XL", "YL", "DX", "DY", "CHI", "DQ", "C1", "D", "YNOM_WHL"));
  EXPECT_THAT(text.names[4], ElementsAre("T", "M", "GG1", "GG2", "POISS1", "POISS2"));
  EXPECT_THAT(text.names[5], ElementsAre("L", "H", "VELOC", "FSTAT", "FKIN"));
  EXPECT_THAT(text.names[6], ElementsAre("I", "IGS", "H", "MU", "PN", "PX", "PY", "UN", "UX", "UY", "SREL"));
  expect_row(text.rows[0], {1.5, 160.0, -0.4363, 761.3, 0.1, -0.025, 0, 0, 0, 0, 2510}, 11);
  expect_row(text.rows[1], {0.01, 750.0, 0.3729, 0.01, 0.02, 460.0}, 11);
  expect_row(text.rows[2], {0.2, 1.891, 0.006, -0.3137 + 0.025, 0.3, 9.3304, -0.3448, 2, 2, 0, 0}, 11);
  expect_row(text.rows[3], {24, 20, -5, -5, 10.0 / 24, 0.5, 0, 0.4, 1, 2, 750.0}, 11);
  expect_row(text.rows[4], {3, 0, 82000, 70000, 0.28, 0.31}, 11);
  expect_row(text.rows[5], {0, 0, 1999.58, 0.3, 0.3}, 11);
}

TEST(WriteMat, ElementsReadBack) {
  const io::RunResult run = testing::sample_run();
  const io::PatchFields& f = run.cases[0].patches[1].fields;
  for (const bool all : {false, true}) {
    const testing::NumberText text = testing::read_numbers(io::patch_to_mat({}, run.cases[0].patches[1], all));
    std::size_t line = 6;
    for (std::size_t i = 0; i < f.state.size(); ++i) {
      if (!all && f.state[i] == 0) continue;
      ASSERT_LT(line, text.rows.size());
      const std::vector<double>& row = text.rows[line++];
      const std::vector<double> expected{static_cast<double>(i + 1),
                                         static_cast<double>(f.state[i]),
                                         f.gap[i] * 1e3,
                                         f.friction[i],
                                         f.pressure[i] * 1e-6,
                                         f.traction_x[i] * 1e-6,
                                         f.traction_s[i] * 1e-6,
                                         f.displacement_n[i] * 1e3,
                                         f.displacement_x[i] * 1e3,
                                         f.displacement_s[i] * 1e3,
                                         std::abs(f.slip_x[i])};
      ASSERT_EQ(row.size(), expected.size());
      for (std::size_t k = 0; k < row.size(); ++k) {
        if (std::isnan(expected[k]))
          EXPECT_TRUE(std::isnan(row[k]));
        else
          EXPECT_NEAR(row[k], expected[k], kDigits * std::abs(expected[k])) << i << ", column " << k;
      }
    }
    EXPECT_EQ(line, text.rows.size());
  }
}

TEST(WriteMat, LayersAndTemperaturesAddColumnsToAllLines) {
  io::PatchResult patch = testing::ball_patch(6, 5, 1e9);
  patch.shift = true;
  const std::size_t n = patch.fields.grid.size();
  patch.fields.plastic_x.assign(n, 2e-6);
  patch.fields.plastic_s.assign(n, -3e-6);
  patch.fields.yield_stress.assign(n, 4e7);
  patch.fields.temperature_1.assign(n, 75.5);
  patch.fields.temperature_2.assign(n, 90.25);
  io::MatFileHead head;
  head.material_model = 4;
  head.layer_shear_modulus = 6e9;
  head.layer_thickness = 2e-5;
  head.material.layer_yield = 3e7;
  head.material.layer_hardening = 5e12;
  head.friction.kind = FrictionLaw::Kind::linear;
  head.friction_law = 2;
  head.friction.half_velocity_1 = 0.5;
  const testing::NumberText text = testing::read_numbers(io::patch_to_mat(head, patch, false));
  EXPECT_THAT(text.names[6], ElementsAre("I", "IGS", "H", "MU", "PN", "PX", "PY", "UN", "UX", "UY", "SHFT", "TAUCRT",
                                         "UPLSX", "UPLSY", "TEMP1", "TEMP2"));
  for (const auto& row : text.rows) EXPECT_EQ(row.size(), 16u);
  EXPECT_EQ(text.rows[0].back(), 2510.0);
  expect_row(text.rows[4], {0, 4, 82000, 82000, 0.28, 0.28, 6000, 0.02, 30, 5000}, 16);
  expect_row(text.rows[5], {2, 0, 0, 0.3, 0, 500, 0, 0, 0.001, 10}, 16);
  EXPECT_THAT(std::vector<double>(text.rows[6].begin() + 11, text.rows[6].end()),
              ElementsAre(40.0, 0.002, -0.003, 75.5, 90.25));
  EXPECT_NEAR(text.rows[6][10], 0.1, kDigits) << "a slip of 1e-4 m in a shift";
}

TEST(WriteMat, TheFileAppearsWholeOrNotAtAll) {
  const testing::TemporaryFolder folder;
  const auto path = folder.path() / io::case_file_name("flat", 1, 2, "mat");
  EXPECT_EQ(path.filename(), "flat.0001b.mat");
  io::PatchResult patch = testing::ball_patch(6, 5, 1e9);
  io::write_mat(path, {}, patch, true);
  const std::string before = testing::read_text(path);
  EXPECT_EQ(before, io::patch_to_mat({}, patch, true));
  patch.fields.friction.pop_back();
  EXPECT_THROW(io::write_mat(path, {}, patch, true), Error);
  EXPECT_EQ(testing::read_text(path), before);
  EXPECT_EQ(folder.count_files(), 1u);
  EXPECT_EQ(io::case_file_name("a.b", 123, 0, "subs"), "a.b.0123.subs");
  EXPECT_THROW(io::case_file_name("a", 1, 27, "mat"), Error);
}

}  // namespace
}  // namespace treadmark
