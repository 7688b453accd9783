// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What scatter of scans leaves uncertain of results on imported surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <memory>
#include <string>
#include <vector>

#include "treadmark/app/cases/noise_of_results.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/app/import/scan_surface.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/files/surface_errors.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
namespace fs = std::filesystem;

constexpr double kScannedRadius = 0.46;

io::RunResult run_text(const std::string& text, const fs::path& folder) {
  return run_cases(io::parse_case_text(text, folder / "case.toml"));
}

/// A wheel and a rail by their keys, at positions [mm].
std::string case_text(const std::string& wheel, const std::string& rail, const std::string& y_mm,
                      const std::string& more = {}) {
  return fmt::format(
      "[wheel]\n{}\n[rail]\n{}\n[track]\ncant = \"1:40\"\ngauge_mm = 1435\n[wheelset]\nnominal_radius_mm = 460\n"
      "vertical_force_N = 80e3\nvelocity_m_s = 20\nrolling = \"nominal\"\n[discretisation]\ndx_mm = 0.5\nds_mm = "
      "0.5\n{}[[cases]]\nwheelset.y_mm = {}\n",
      wheel, rail, more, y_mm);
}

std::vector<Vec2> wheel_points() {
  const NaturalSurface wheel = create_natural({Body::wheel, kScannedRadius, StandardProfile{"S1002"}, {}});
  std::vector<double> y, h;
  for (double at = 50e-3; at >= -28e-3; at -= 0.2e-3) y.push_back(at);
  h.resize(y.size());
  HeightsOut out;
  out.z = h;
  section_heights(*wheel.surface, Body::wheel, 0.0, y, out);
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < y.size(); ++k) points.emplace_back(y[k], h[k] - kScannedRadius);
  return points;
}

// Draws of a known form, against the contact that is solved with the surface so changed.
TEST(NoiseOfScans, OfPressureIsWhatRipplesMakeOfIt) {
  const testing::SampleInput input;
  const std::vector<Vec2> points = wheel_points();
  constexpr int kPhases = 8;
  const auto ripple = [](double s, int phase, double length) {
    return 0.3e-6 * std::cos(2.0 * kPi * (s / length + static_cast<double>(phase) / kPhases));
  };
  for (const double length : {20e-3, 30e-3, 45e-3}) {
    auto errors = std::make_shared<SurfaceErrors>();
    for (const Vec2& p : points) errors->y.push_back(p.x()), errors->z.push_back(p.y());
    const std::vector<double> s = arc_lengths(*errors);
    const auto solved = [&](int phase, double amplitude) {
      std::ofstream file(input.folder() / "wheel.csv");
      for (std::size_t i = 0; i < points.size(); ++i)
        file << fmt::format("{:.9f}, {:.9f}\n", 1e3 * points[i].x(),
                            1e3 * (points[i].y() - amplitude * ripple(s[i], phase, length)));
      file.close();
      return run_text(case_text("shape.file = \"wheel.csv\"\nshape.smoothing = \"none\"", "shape.standard = \"60E1\"",
                                "[-2, 0, 3]"),
                      input.folder());
    };
    io::RunResult base = solved(0, 0.0);
    ASSERT_EQ(base.cases.size(), 3u);
    std::vector<double> squares(3, 0.0);
    for (int phase = 0; phase < kPhases; ++phase) {
      errors->u.push_back(0.1 * phase);
      std::vector<double>& draw = errors->draws.emplace_back();
      for (const double at : s) draw.push_back(ripple(at, phase, length));
      const io::RunResult moved = solved(phase, 1.0);
      for (std::size_t k = 0; k < 3; ++k)
        squares[k] += std::pow(moved.cases[k].patches.at(0).pmax - base.cases[k].patches.at(0).pmax, 2) / kPhases;
    }
    NaturalSurface rail = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}}),
                   wheel = create_natural({Body::wheel, kScannedRadius, StandardProfile{"S1002"}, {}});
    EXPECT_FALSE(NoiseOfResults(rail, wheel).any());
    wheel.spec.errors = errors;
    const NoiseOfResults noise(rail, wheel);
    ASSERT_TRUE(noise.any());
    const io::CaseFile cases = io::parse_case_text(
        case_text("shape.standard = \"S1002\"", "shape.standard = \"60E1\"", "[-2, 0, 3]"), input.folder() / "c.toml");
    for (std::size_t k = 0; k < 3; ++k) {
      noise.add(std::get<io::WheelRailCase>(cases.cases[k].content), base.cases[k]);
      const io::PatchResult& patch = base.cases[k].patches.at(0);
      ASSERT_TRUE(patch.noise);
      const double truth = std::sqrt(squares[k]);
      constexpr double kRows = 2.0;  // what the contact of rows leaves open
      EXPECT_GT(patch.noise->pmax, truth / kRows) << length << ' ' << k;
      EXPECT_LT(patch.noise->pmax, truth * kRows) << length << ' ' << k;
      const bool told = ranges::any_of(base.cases[k].remarks, [](const Remark& remark) {
        return remark.kind == RemarkKind::noisy_profile && remark.text.find("the wheel, a scan") != std::string::npos;
      });
      EXPECT_EQ(told, patch.noise->pmax > 0.025 * patch.pmax);
    }
  }
}

class ImportedNoise : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return input.folder() / name; }

  io::ImportReport import(const std::string& shape, Body body, std::size_t points, double noise,
                          const std::string& output, const io::ImportSettings& settings = {}) const {
    ScanRequest scan;
    scan.surface.body = body;
    scan.scanner.points = points;
    scan.scanner.noise = noise;
    scan.scanner.seed = 7;
    if (body == Body::rail) scan.range_x = std::pair{-0.2, 0.2};
    scan_surface(path(shape), path("cloud.ply"), scan);
    ImportRequest request;
    request.scans = {path("cloud.ply")};
    request.outputs = {path(output)};
    request.settings = settings;
    request.settings.placement.nominal_radius_mm = body == Body::wheel ? 1e3 * kScannedRadius : 0.0;
    return import_scan(request);
  }

  testing::SampleInput input;
};

TEST_F(ImportedNoise, EveryFileKeepsItThatHasRoomForIt) {
  input.write("truth.toml", case_text("shape.standard = \"S1002\"", "shape.standard = \"60E1\"", "0"));
  const io::ImportReport report = import("truth.toml", Body::rail, 60000, 30e-6, "found.slcs");
  ASSERT_TRUE(report.errors);
  EXPECT_GT(report.errors->rms, 0.05e-6);
  EXPECT_LT(report.errors->rms, 15e-6);
  const auto errors = io::read_surface_errors(path("found.slcs"));
  ASSERT_NE(errors, nullptr);
  EXPECT_NEAR(size_of(*errors).rms, report.errors->rms, 0.01e-6);
  const std::vector<std::string> lines = to_lines(*errors);
  ConvertSettings how;
  how.body = Body::rail;
  how.resolution = 2e-3;
  how.tolerance = 50e-6;
  std::vector<std::string> files{"found.ply", "found.obj", "found.off"};
  if (has_part("openvdb")) files.emplace_back("found.vdb");
  for (const std::string& file : files) {
    convert_surface(path("found.slcs"), path(file), how);
    convert_surface(path(file), path("again.slcs"), how);
    const auto again = io::read_surface_errors(path("again.slcs"));
    ASSERT_NE(again, nullptr) << file;
    EXPECT_EQ(to_lines(*again), lines) << file;
  }
  EXPECT_THAT(convert_surface(path("found.slcs"), path("found.stl"), how).written.note, HasSubstr("has no place"));
  EXPECT_EQ(io::read_surface_errors(path("found.stl")), nullptr);
  // the check sum covers the lines, and lines that it does not cover are damaged ones
  const std::string text = testing::content_of(path("found.slcs"));
  const std::size_t at = text.find("surface-errors", text.find("SHA-256 of the slices"));
  ASSERT_NE(at, std::string::npos);
  std::string other = text;
  other[at + 40] = other[at + 40] == '1' ? '2' : '1';
  input.write("found.slcs", other);
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{path("found.slcs"), {}};
  EXPECT_THROW(read_surface(source, Body::rail, 0.0), Error);
  // switched off there is none
  io::ImportSettings off;
  off.fit.errors = false;
  EXPECT_FALSE(import("truth.toml", Body::rail, 60000, 30e-6, "found.slcs", off).errors);
  EXPECT_EQ(io::read_surface_errors(path("found.slcs")), nullptr);
}

struct Trial {
  const char* name;
  Body body;
  std::string keys;  ///< of the shape
  std::string y_mm;
  std::size_t points = 0;
  std::string sections = "auto";
};

/// Contacts on imported scans against those on the shapes that were scanned: what is stated covers the difference, and
/// what is far off is doubted.
TEST_F(ImportedNoise, CoversWhatResultsAreOff) {
  {
    std::ofstream file(path("hollow.csv"));  // 4 mm deep, 50 mm wide, smooth
    for (const Vec2& p : wheel_points()) {
      const double x = p.x() / 25e-3;
      const double worn = std::fabs(x) < 1.0 ? 4e-3 * std::pow(std::cos(0.5 * kPi * x), 4) : 0.0;
      file << fmt::format("{:.9f}, {:.9f}\n", 1e3 * p.x(), 1e3 * (p.y() - worn));
    }
  }
  const std::string new_wheel = "shape.standard = \"S1002\"", new_rail = "shape.standard = \"60E1\"";
  const Trial trials[] = {
      {"new wheel", Body::wheel, new_wheel, "[-3, 0, 3, 5.5]", 600000},
      {"hollow wheel", Body::wheel, "shape.file = \"hollow.csv\"\nshape.smoothing = \"none\"", "[-3, 0, 3, 5.5]",
       600000},
      {"squat", Body::rail, new_rail + "\n[[rail.squats]]\nlength_mm = 40\nwidth_mm = 30\ndepth_mm = 0.4", "[-3, 0, 3]",
       150000},
      {"lines of a wheel", Body::wheel, new_wheel, "[-3, 0, 3, 5.5]", 30000, "keep"}};
  int compared = 0, covered = 0;
  for (const Trial& trial : trials) {
    const bool wheel = trial.body == Body::wheel;
    const auto text = [&](const std::string& keys) {
      return case_text(wheel ? keys : new_wheel, wheel ? new_rail : keys, trial.y_mm);
    };
    input.write("truth.toml", text(trial.keys));
    const io::RunResult truth = run_text(text(trial.keys), input.folder());
    for (const double noise : {10e-6, 30e-6, 50e-6}) {
      const std::string file = wheel ? "found.slcw" : "found.slcs";
      io::ImportSettings settings;
      settings.fit.sections = trial.sections;
      import("truth.toml", trial.body, trial.points, noise, file, settings);
      const io::RunResult found = run_text(text("shape.file = \"" + file + "\""), input.folder());
      ASSERT_EQ(found.cases.size(), truth.cases.size());
      for (std::size_t k = 0; k < truth.cases.size(); ++k)
        for (const io::PatchResult& meant : truth.cases[k].patches) {
          constexpr double kSmall = 0.3, kNear = 3e-3;  // of the wheel's force; [m]
          if (meant.fn < kSmall * 80e3) continue;
          const std::vector<io::PatchResult>& patches = found.cases[k].patches;
          const auto patch = ranges::min_element(
              patches, {}, [&](const io::PatchResult& p) { return std::fabs(p.y_tr - meant.y_tr); });
          const bool doubted = any_grave(found.cases[k].remarks);
          if (patch == patches.end() || std::fabs(patch->y_tr - meant.y_tr) > kNear) {
            EXPECT_TRUE(doubted) << trial.name << ' ' << noise << ": no contact at y = " << meant.y_tr;
            continue;
          }
          const double off = patch->pmax - meant.pmax, sigma = patch->noise ? patch->noise->pmax : 0.0;
          constexpr double kSame = 0.01, kFar = 0.05;
          ++compared;
          covered += std::fabs(off) <= std::max(2.5 * sigma, kSame * meant.pmax) ? 1 : 0;
          const std::string where =
              fmt::format("{}, {} um, case {}, y = {:.1f} mm: {:.1f} MPa, truly {:.1f}, sigma {:.1f}", trial.name,
                          1e6 * noise, k + 1, 1e3 * meant.y_tr, 1e-6 * patch->pmax, 1e-6 * meant.pmax, 1e-6 * sigma);
          EXPECT_TRUE(doubted || std::fabs(off) < kFar * meant.pmax) << where;
        }
    }
  }
  EXPECT_GE(compared, 25);
  EXPECT_GE(covered, compared * 4 / 5) << compared;
}

}  // namespace
}  // namespace treadmark::app
