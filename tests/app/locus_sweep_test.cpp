// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Along crossings and wing rails a yawed wheel stands where it stands by the grid, whatever flanks its locus meets, or
// the search says that its locus passed over contact.
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

#include <fmt/format.h>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/support/shared_data.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

constexpr int kPositions = 40;

struct Along {
  std::string slices, scale;
  double from, to;  ///< positions of the wheelset [mm]
};

/// search: the reference program's digit D, 2 by the locus, 5 by its grid. wheel: a file.
io::RunResult run(const std::filesystem::path& wheel, const Along& rail, int search) {
  std::string text;
  for (int k = 0; k < kPositions; ++k)
    text += fmt::format(R"(
  1 MODULE
 1203100   C-P-B-T-N-F-S
 00{0}2033    V-L-D-C-M-Z-E
 0001321    H-G-I-A-O-W-R
  999 100 30 1 1e-6
 0.5 0.5
 0.28 0.28 82000.0 82000.0
 0.8 0.4 1.0 43.0d 11.0 4.7
 -1.0 750.0 0.0 0.0
 '{1}' 0 {2} 0.0 -1
 0.0 0.0 0.0 0.0 0.0 0.0
 1360.0 -70.0 460.0
 '{3}' 0 1.0 0.0 -1
 {4} 0.8 12000.0 0.002 -0.0046 -0.0016
 350.0 -0.9 0.0 0.0 0.0028 -0.7563

)",
                        search, rail.slices, rail.scale, wheel.string(),
                        rail.from + (rail.to - rail.from) * k / (kPositions - 1));
  const treadmark::testing::TemporaryFolder folder;
  return run_cases(io::read_any_case(folder.write("sweep.inp", text + "  0 MODULE\n"), {}));
}

bool says_incomplete(const io::CaseResult& c) {
  return ranges::any_of(c.remarks, [](const Remark& r) {
    return r.kind == RemarkKind::locus_incomplete || r.kind == RemarkKind::contact_overlooked;
  });
}

TEST(LocusSweep, StandsWhereTheGridSays) {
  TREADMARK_REQUIRE_SHARED();
  const std::filesystem::path profiles = *shared / "data/contact_testbank/profiles";
  for (const Along& rail : {Along{profiles / "wing_rail.slcs", "1.0", 100.0, 190.0},
                            {profiles / "uk_interrupt_v2.slcs", "1000.0", 20.0, 150.0},
                            {profiles / "cross_nose.slcs", "1.0", -60.0, 100.0}}) {
    const std::filesystem::path wheel = profiles / "MBench_S1002_v3.prw";
    const io::RunResult locus = run(wheel, rail, 2), grid = run(wheel, rail, 5);
    ASSERT_EQ(locus.cases.size(), grid.cases.size());
    for (std::size_t k = 0; k < grid.cases.size(); ++k) {
      EXPECT_EQ(locus.cases[k].status == Status::no_contact, grid.cases[k].status == Status::no_contact);
      EXPECT_NEAR(locus.cases[k].z, grid.cases[k].z, 2e-5) << rail.slices << ' ' << k;
    }
  }
}

/// Sections without features, between which parts of the crossing begin and end in the air.
std::string without_features(const std::filesystem::path& slices) {
  std::ifstream in(slices);
  std::string text = "0.0 1000.0\n20\n0 0 0\n1\n";
  for (std::string line; std::getline(in, line);)
    if (const auto name = line.find('\''); name != std::string::npos && !line.starts_with('%'))
      text += line.substr(0, name + 1) + (slices.parent_path() / line.substr(name + 1)).string() + '\n';
  return text;
}

TEST(LocusSweep, OnSectionsWithoutFeaturesEveryPositionIsRightOrNamed) {
  TREADMARK_REQUIRE_SHARED();
  const std::filesystem::path profiles = *shared / "data/contact_testbank/profiles",
                              wheel = profiles / "MBench_S1002_v3.prw";
  const treadmark::testing::TemporaryFolder folder;
  const Along rail{folder.write("crossing.slcs", without_features(profiles / "uk_interrupt_v2.slcs")), "1000.0", 0.0,
                   170.0};
  const io::RunResult locus = run(wheel, rail, 2), grid = run(wheel, rail, 5);
  ASSERT_EQ(locus.cases.size(), grid.cases.size());
  int named = 0;
  for (std::size_t k = 0; k < grid.cases.size(); ++k) {
    const io::CaseResult &a = locus.cases[k], &b = grid.cases[k];
    named += says_incomplete(a);
    const bool vouched_for = a.status == Status::ok && !any_grave(a.remarks) && !says_incomplete(a);
    if (vouched_for) {
      EXPECT_NEAR(a.z, b.z, 2e-5) << k;
    }
  }
  EXPECT_GT(named, 0);
}

}  // namespace
}  // namespace treadmark::app
