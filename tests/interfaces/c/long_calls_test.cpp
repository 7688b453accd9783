// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Calls that last: progress, giving up, scans.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <string>
#include <vector>

#include "treadmark/tests/interfaces/c/owned.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

/// What a host does with progress.
struct Told {
  std::vector<std::string> parts;
  std::size_t last = 0, total = 0;
  std::size_t give_up_after = 1000000;

  explicit Told(std::size_t most = 1000000) : give_up_after(most) {
    tm_set_progress(
        [](void* user, std::size_t finished, std::size_t all, const char* what) {
          Told& told = *static_cast<Told*>(user);
          told.parts.emplace_back(what);
          told.last = finished, told.total = all;
          return told.parts.size() >= told.give_up_after ? 1 : 0;
        },
        this);
  }
  ~Told() { tm_set_progress(nullptr, nullptr); }
  Told(const Told&) = delete;
  Told& operator=(const Told&) = delete;
};

/// Three positions, of which the last one has no contact.
std::string three_cases(const TemporaryFolder& folder) {
  const std::string file = (folder.path() / "three.toml").string();
  std::ofstream(file) << kText << "[[cases]]\nwheelset.y_mm = 0.0\n[[cases]]\nwheelset.y_mm = 1.0\n"
                      << "[[cases]]\nwheelset.z_mm = -20.0\n";
  return file;
}

TEST(CLongCalls, TellHowFarTheyAreAndHowTheyEnded) {
  const TemporaryFolder folder;
  const Told told;
  char* json = nullptr;
  EXPECT_EQ(tm_run(three_cases(folder).c_str(), nullptr, 0, &json), TM_NO_CONTACT) << tm_message();
  ASSERT_NE(json, nullptr);
  EXPECT_THAT(json, HasSubstr("no_contact"));
  tm_text_free(json);
  EXPECT_EQ(told.parts.size(), 3u);
  EXPECT_EQ(told.last, 3u);
  EXPECT_EQ(told.total, 3u);
}

TEST(CLongCalls, EndWhereTheCallerGivesUp) {
  const TemporaryFolder folder;
  const std::string file = three_cases(folder);
  char* json = nullptr;
  {
    const Told told(1);
    ASSERT_EQ(tm_set_threads(1), TM_OK);
    EXPECT_EQ(tm_run(file.c_str(), nullptr, 0, &json), TM_CANCELLED);
    EXPECT_EQ(tm_set_threads(0), TM_OK);
    EXPECT_EQ(json, nullptr);
    EXPECT_EQ(told.parts.size(), 1u);
  }
  const int flag = 1;
  tm_set_cancel_flag(&flag);
  EXPECT_EQ(tm_run(file.c_str(), nullptr, 0, &json), TM_CANCELLED);
  tm_set_cancel_flag(nullptr);
  EXPECT_EQ(json, nullptr);
}

TEST(CLongCalls, AScanBecomesTheSurfaceThatWasScanned) {
  TREADMARK_NEEDS("scans");
  const CaseOf given = case_of(kText);
  tm_surface* made = nullptr;
  ASSERT_EQ(tm_surface_of_case(given.get(), TM_RAIL, &made), TM_OK) << tm_message();
  const SurfaceOf rail(made);
  // points [mm] of the head along 60 mm of rail
  std::vector<double> x, y;
  for (int i = 0; i < 60; ++i)
    for (int k = -68; k <= 68; ++k) x.push_back(1e-3 * i), y.push_back(0.5e-3 * k);
  std::vector<double> z(x.size());
  ASSERT_EQ(tm_surface_heights(rail.get(), nullptr, nullptr, x.data(), y.data(), x.size(), z.data(), nullptr, nullptr),
            TM_OK);
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "rail.xyz").string();
  {
    std::ofstream out(file);
    for (std::size_t i = 0; i < x.size(); ++i)
      if (!std::isnan(z[i])) out << 1e3 * x[i] << ' ' << 1e3 * y[i] << ' ' << -1e3 * z[i] << '\n';  // up
  }
  const char *files[] = {file.c_str()}, *settings[] = {"scan.unit=mm", "placement.up=[0, 0, 1]",
                                                       "placement.forward=[1, 0, 0]", "placement.zero=scan"};
  const Told told;
  char* audit = nullptr;
  ASSERT_EQ(tm_surface_from_scan(files, 1, TM_RAIL, settings, 4, &audit, &made), TM_OK) << tm_message();
  const SurfaceOf scanned(made);
  EXPECT_THAT(audit, HasSubstr("points_read"));
  tm_text_free(audit);
  EXPECT_GT(told.parts.size(), 3u);
  EXPECT_STREQ(tm_surface_backend(scanned.get()), "spline");
  // where it lies in the section is the import's to find: the form is compared, over the top of the head
  std::vector<double> top_y, top_x, of_rail, of_scan;
  for (int k = -20; k <= 20; ++k) top_y.push_back(1e-3 * k), top_x.push_back(0.0);
  of_rail.resize(top_y.size());
  of_scan.resize(top_y.size());
  for (auto [s, out] : {std::pair{rail.get(), &of_rail}, std::pair{scanned.get(), &of_scan}})
    ASSERT_EQ(tm_surface_heights(s, nullptr, nullptr, top_x.data(), top_y.data(), top_y.size(), out->data(), nullptr,
                                 nullptr),
              TM_OK);
  constexpr double kPlaced = 20e-6;
  for (std::size_t i = 0; i < top_y.size(); ++i) EXPECT_NEAR(of_scan[i], of_rail[i], kPlaced) << top_y[i];

  const Told impatient(2);
  EXPECT_EQ(tm_surface_from_scan(files, 1, TM_RAIL, settings, 4, &audit, &made), TM_CANCELLED);
  EXPECT_EQ(made, nullptr);
  EXPECT_EQ(audit, nullptr);
}

}  // namespace
}  // namespace treadmark::testing
