// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/backends/analytic/sample.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/model/remarks.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

/// Exact points of a standard profile, which tell nothing of the curve between them.
namespace treadmark::testing {
namespace {

struct CoarseAnswer {
  double pmax = 0.0, noise = 0.0;  ///< [Pa]
  bool has_noise = false, doubted = false;
};

CoarseAnswer coarse_run(const std::filesystem::path& folder, const std::string& wheel, const std::string& rail) {
  const std::string text = fmt::format(
      "wheel.{}\nrail.{}\n[track]\ncant = \"1:40\"\ngauge_mm = 1435\n[wheelset]\nnominal_radius_mm = 460\n"
      "vertical_force_N = 100e3\nvelocity_m_s = 20\nrolling = \"free\"\n[discretisation]\ndx_mm = 0.5\nds_mm = 0.5\n",
      wheel, rail);
  const io::RunResult result = app::run_cases(io::parse_case_text(text, (folder / "case.toml").string()));
  CoarseAnswer out;
  const io::CaseResult& c = result.cases.at(0);
  EXPECT_EQ(c.status, Status::ok) << c.message;
  out.doubted = any_grave(c.remarks);
  for (const io::PatchResult& patch : c.patches) {
    out.pmax = std::max(out.pmax, patch.pmax);
    out.has_noise = out.has_noise || patch.noise.has_value();
    if (patch.noise) out.noise = std::max(out.noise, patch.noise->pmax);
  }
  return out;
}

/// Points of the arcs, at most a fiftieth of a millimetre beside equal steps [mm], from a part of a step on.
std::string every(double step, double part, const char* name) {
  const Profile fine = analytic::sample_profile(StandardProfile{name}, 0.02e-3);
  std::string text;
  double s = 0.0, next = part * step;
  for (std::size_t i = 0; i < fine.y.size(); ++i) {
    if (i > 0) s += 1e3 * std::hypot(fine.y[i] - fine.y[i - 1], fine.z[i] - fine.z[i - 1]);
    if (s < next) continue;
    text += fmt::format("{:.9f} {:.9f}\n", 1e3 * fine.y[i], 1e3 * fine.z[i]);
    next += step;
  }
  return text;
}

constexpr const char *kWheel = "shape.standard = \"S1002\"", *kRail = "shape.standard = \"60E1\"";

TEST(CoarsePoints, OfARailArePressuresWithinTheirNoiseAndDoubtedWhereItIsLarge) {
  const TemporaryFolder folder;
  const double right = coarse_run(folder.path(), kWheel, kRail).pmax;
  constexpr double kUndoubted = 0.05;  // two standard deviations that are not
  for (const double step : {1.0, 1.5, 2.0, 3.0})
    for (const double part : {0.0, 0.5}) {
      const auto file = folder.write("rail.txt", every(step, part, "60E1"));
      const CoarseAnswer found = coarse_run(folder.path(), kWheel, fmt::format("shape.file = \"{}\"", file.string()));
      const double off = std::fabs(found.pmax - right);
      EXPECT_TRUE(found.has_noise) << step << ' ' << part;
      EXPECT_TRUE(found.doubted || off < kUndoubted * right) << step << ' ' << part << ": " << 1e-6 * found.pmax;
      EXPECT_LT(off, 4.0 * found.noise + 0.01 * right) << step << ' ' << part << ": " << 1e-6 * found.pmax;
    }
}

TEST(CoarsePoints, ThatAreDenseOrOfASmoothWheelRaiseNoDoubt) {
  const TemporaryFolder folder;
  const double right = coarse_run(folder.path(), kWheel, kRail).pmax;
  for (const double step : {0.25, 0.5}) {
    const auto rail = folder.write("rail.txt", every(step, 0.3, "60E1"));
    const CoarseAnswer found = coarse_run(folder.path(), kWheel, fmt::format("shape.file = \"{}\"", rail.string()));
    EXPECT_NEAR(found.pmax, right, 0.02 * right) << step;
    EXPECT_FALSE(found.doubted) << step;
    EXPECT_FALSE(found.has_noise) << step;
  }
  for (const double step : {0.5, 1.0}) {
    const auto wheel = folder.write("wheel.txt", every(step, 0.3, "S1002"));
    const CoarseAnswer found = coarse_run(folder.path(), fmt::format("shape.file = \"{}\"", wheel.string()), kRail);
    EXPECT_NEAR(found.pmax, right, 0.04 * step * right) << step;
    EXPECT_FALSE(found.doubted) << step;
  }
}

}  // namespace
}  // namespace treadmark::testing
