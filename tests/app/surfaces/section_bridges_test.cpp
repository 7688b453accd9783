// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/surfaces/section_bridges.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/surfaces/surface_check.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/profiles/write_slices.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

/// A round head, 20 sections 10 mm apart; from the eleventh on a wing lies beside it, 60 mm wide and lower than a
/// flange.
SliceSet head_and_wing() {
  SliceSet s;
  for (int i = 0; i < 20; ++i) {
    Profile p;
    if (i >= 10)
      for (double y = -95e-3; y < -36e-3; y += 0.5e-3) p.y.push_back(y), p.z.push_back(40e-3);
    for (double y = -35e-3; y <= 35.1e-3; y += 0.5e-3) p.y.push_back(y), p.z.push_back(y * y / (2.0 * 0.3));
    s.profiles.push_back(std::move(p));
    s.u.push_back(0.01 * i);
  }
  return s;
}

TEST(SectionBridges, WhereAPartBegins) {
  SliceSet s = head_and_wing();
  const std::vector<SectionBridge> found = section_bridges(s);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].first, 9u);
  EXPECT_TRUE(found[0].begins);
  EXPECT_DOUBLE_EQ(found[0].u_from, 0.09);
  EXPECT_NEAR(found[0].from.x(), -35e-3, 1e-9);
  EXPECT_NEAR(found[0].to.x(), -95e-3, 1e-9);
  EXPECT_THAT(to_text(found[0]), HasSubstr("slices 10 and 11 (x = 90 and 100 mm) begin at y = -35"));
  s.features.assign(20, {0.0, 1.0});
  EXPECT_TRUE(section_bridges(s).empty()) << "features say what corresponds";
}

// A wing that moves aside by 1:4 begins elsewhere in every section.
TEST(SectionBridges, WhatMovesAsideIsNone) {
  SliceSet s = head_and_wing();
  s.profiles.erase(s.profiles.begin(), s.profiles.begin() + 10);
  s.u.resize(10);
  for (std::size_t i = 0; i < 10; ++i)
    for (double& y : s.profiles[i].y) y += 2.5e-3 * static_cast<double>(i);
  EXPECT_TRUE(section_bridges(s).empty());
}

TEST(SectionBridges, CheckSaysThemAndContactThereIsDoubted) {
  const testing::TemporaryFolder folder;
  const std::filesystem::path rail = folder.path() / "rail.slcs";
  io::write_slices(rail, head_and_wing());
  EXPECT_THAT(check_surface(rail, Body::rail).judgement.notes, Contains(HasSubstr("slices 10 and 11")));
  const std::filesystem::path file = folder.path() / "case.toml";
  io::CaseFile cases =
      io::parse_case_text("[wheel]\nshape.standard = \"S1002\"\n[rail]\nshape.file = \"" + rail.string() +
                              "\"\n[track]\nrail_y_mm = 750\n[wheelset]\nvertical_force_N = 50e3\nvelocity_m_s = "
                              "2\nvpitch_rad_s = -4.3478\n[discretisation]\ndx_mm = 1\nds_mm = "
                              "1\n[[cases]]\nwheelset.s_mm = [10, 95, 180]\n",
                          file);
  const io::RunResult run = run_cases(cases);
  ASSERT_EQ(run.cases.size(), 3u);
  const auto doubted = [&](std::size_t i) {
    return ranges::any_of(run.cases[i].remarks, [](const Remark& r) { return r.kind == RemarkKind::between_sections; });
  };
  EXPECT_EQ(run.cases[0].status, Status::ok) << run.cases[0].message;
  EXPECT_FALSE(doubted(0));
  EXPECT_TRUE(doubted(1));
  EXPECT_THAT(run.cases[1].message, HasSubstr("mm of the rail, has no meaning"));
  EXPECT_TRUE(doubted(2)) << "the flange meets the strip 87 mm behind";
}

}  // namespace
}  // namespace treadmark::app
