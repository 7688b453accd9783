// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// What scatter of scans leaves uncertain of results on imported surfaces.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/app/cases/noise_of_results.hpp"
#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/import/import_scan.hpp"
#include "treadmark/app/import/scan_surface.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/app/surfaces/surface_check.hpp"
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
                      const std::string& elements = "dx_mm = 0.5\nds_mm = 0.5\n") {
  return fmt::format(
      "[wheel]\n{}\n[rail]\n{}\n[track]\ncant = \"1:40\"\ngauge_mm = 1435\n[wheelset]\nnominal_radius_mm = 460\n"
      "vertical_force_N = 80e3\nvelocity_m_s = 20\nrolling = \"nominal\"\n[discretisation]\n{}[[cases]]\n"
      "wheelset.y_mm = {}\n",
      wheel, rail, elements, y_mm);
}

/// S1002 from its field side down to y [m].
std::vector<Vec2> wheel_points(double last) {
  const NaturalSurface wheel = create_natural({Body::wheel, kScannedRadius, StandardProfile{"S1002"}, {}});
  std::vector<double> y, h;
  for (double at = 59e-3; at >= last; at -= 0.2e-3) y.push_back(at);
  h.resize(y.size());
  HeightsOut out;
  out.z = h;
  section_heights(*wheel.surface, Body::wheel, 0.0, y, out);
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < y.size(); ++k) points.emplace_back(y[k], h[k] - kScannedRadius);
  return points;
}

/// What noise is told of.
struct Found {
  double pmax = 0.0, area = 0.0, fn = 0.0, approach = 0.0;
  Vec3 place = Vec3::Zero();  ///< of the middle of pressures, in track axes

  explicit Found(const io::PatchResult& patch)
      : pmax(patch.pmax), area(patch.ncon * patch.fields.grid.cell_area()), fn(patch.fn), approach(patch.approach) {
    const Grid2& grid = patch.fields.grid;
    double sum = 0.0;
    for (int iy = 0; iy < grid.ny; ++iy)
      for (int ix = 0; ix < grid.nx; ++ix) {
        const double p = patch.fields.pressure[grid.index(ix, iy)];
        sum += p, place += p * patch.fields.X_TC.apply({grid.x(ix), grid.y(iy), 0.0});
      }
    place /= sum;
  }
};

/// A wheel whose sections are points, against the same with waves across it at eight phases: each is a surface of its
/// own that is searched for contact anew. On the tread, on its shoulder and near the flange's root.
TEST(NoiseOfScans, IsWhatWavesMakeOfResults) {
  const testing::SampleInput input;
  const std::vector<Vec2> points = wheel_points(-66e-3);
  constexpr std::size_t kPhases = 8, kPlaces = 3;
  constexpr double kSteepness = 0.2e-3;  // amplitude over wavelength
  auto blank = std::make_shared<SurfaceErrors>();
  for (const Vec2& p : points) blank->y.push_back(p.x()), blank->z.push_back(p.y());
  const std::vector<double> s = arc_lengths(*blank);
  const std::string positions[] = {"0", "3", "6"}, fine = "dx_mm = 0.4\nds_mm = 0.25\n",
                    of_wheel =
                        "shape.file = \"wheel.csv\"\nshape.smoothing = \"none\"\nshape.placement = "
                        "\"as_in_file\"";
  // at their load, and at the height where the wheel without waves has it
  std::array<std::string, kPlaces> given_z;
  const auto text = [&](std::size_t place, bool by_force) {
    std::string out = case_text(of_wheel, "shape.standard = \"60E1\"", positions[place], fine);
    const std::string load = "vertical_force_N = 80e3\n";
    if (!by_force) out.erase(out.find(load), load.size()), out += given_z[place];
    return out;
  };
  const auto write = [&](const std::vector<double>* off) {
    std::ofstream file(input.folder() / "wheel.csv");
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 along = points[std::min(i + 1, points.size() - 1)] - points[i > 0 ? i - 1 : 0];
      const Vec2 out = Vec2(along.y(), -along.x()).normalized();  // points run towards the flange
      const Vec2 p = points[i] - (off != nullptr ? (*off)[i] : 0.0) * out;
      file << fmt::format("{:.9f}, {:.9f}\n", 1e3 * p.x(), 1e3 * p.y());
    }
  };
  const NaturalSurface rail = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  NaturalSurface wheel = create_natural({Body::wheel, kScannedRadius, StandardProfile{"S1002"}, {}});
  EXPECT_FALSE(NoiseOfResults(rail, wheel).any());

  write(nullptr);
  std::vector<io::CaseResult> base;  // of a place by force, by height
  for (std::size_t place = 0; place < kPlaces; ++place)
    for (const bool by_force : {true, false}) {
      io::RunResult run = run_text(text(place, by_force), input.folder());
      ASSERT_EQ(run.cases.size(), 1u);
      ASSERT_EQ(run.cases.front().patches.size(), 1u);
      EXPECT_FALSE(run.cases.front().patches.front().noise);
      given_z[place] = fmt::format("wheelset.z_mm = {:.9f}\n", 1e3 * run.cases.front().z);
      base.push_back(std::move(run.cases.front()));
    }
  for (const double length : {5e-3, 10e-3, 20e-3, 45e-3}) {
    auto errors = std::make_shared<SurfaceErrors>(*blank);
    std::vector<io::PatchResult::Noise> squares(base.size());
    for (std::size_t phase = 0; phase < kPhases; ++phase) {
      errors->u.push_back(0.1 * static_cast<double>(phase));
      std::vector<double>& draw = errors->draws.emplace_back();
      for (const double at : s)
        draw.push_back(kSteepness * length *
                       std::cos(2.0 * kPi * (at / length + static_cast<double>(phase) / kPhases)));
      write(&draw);
      for (std::size_t k = 0; k < base.size(); ++k) {
        const io::RunResult run = run_text(text(k / 2, k % 2 == 0), input.folder());
        const io::PatchResult& patch = base[k].patches.front();
        const Found before(patch), now(run.cases.at(0).patches.at(0));
        const auto add = [&](double& to, double change) { to += change * change / kPhases; };
        add(squares[k].pmax, now.pmax - before.pmax);
        add(squares[k].area, now.area - before.area);
        add(squares[k].fn, now.fn - before.fn);
        add(squares[k].place, (now.place - before.place).dot(patch.fields.X_TC.rotation.col(1)));
        add(squares[k].approach, now.approach - before.approach);
      }
    }
    wheel.spec.errors = errors;
    const NoiseOfResults noise(rail, wheel);
    ASSERT_TRUE(noise.any());
    for (std::size_t k = 0; k < base.size(); ++k) {
      const bool by_force = k % 2 == 0;
      io::CaseResult result = base[k];
      const io::CaseFile file = io::parse_case_text(text(k / 2, by_force), input.folder() / "case.toml");
      noise.add(std::get<io::WheelRailCase>(file.cases.front().content), result);
      const io::PatchResult& patch = result.patches.front();
      const std::string where = fmt::format("waves of {} mm, case at y = {} mm by {}", 1e3 * length, positions[k / 2],
                                            by_force ? "force" : "height");
      ASSERT_TRUE(patch.noise) << where;
      const Found value(patch);
      // elements that lie elsewhere, and contact planes that turn, change as much without any waves
      constexpr double kNear = 0.25, kOfNumber = 0.003, kOfArea = 0.01, kOfPlace = 0.01e-3;
      const auto expect = [&](double stated, double square, double least, const char* what) {
        EXPECT_NEAR(stated, std::sqrt(square), kNear * std::sqrt(square) + least) << what << ", " << where;
      };
      expect(patch.noise->pmax, squares[k].pmax, kOfNumber * value.pmax, "pmax");
      expect(patch.noise->area, squares[k].area, kOfArea * value.area, "area");
      expect(patch.noise->place, squares[k].place, kOfPlace, "place");
      expect(patch.noise->approach, squares[k].approach, kOfNumber * value.approach, "approach");
      if (by_force)
        EXPECT_EQ(patch.noise->fn, 0.0) << where;
      else
        expect(patch.noise->fn, squares[k].fn, kOfNumber * value.fn, "fn");
      const bool told = ranges::any_of(result.remarks, [](const Remark& remark) {
        return remark.kind == RemarkKind::noisy_profile && remark.text.find("the wheel, a scan") != std::string::npos;
      });
      EXPECT_EQ(told, patch.noise->pmax > 0.025 * patch.pmax) << where;
    }
  }
}

TEST(NoiseOfScans, IsTheSameOnTheLeft) {
  const testing::SampleInput input;
  auto errors = std::make_shared<SurfaceErrors>();
  for (const Vec2& p : wheel_points(-66e-3)) errors->y.push_back(p.x()), errors->z.push_back(p.y());
  for (int phase = 0; phase < 4; ++phase) {
    errors->u.push_back(phase);
    std::vector<double>& draw = errors->draws.emplace_back();
    // steeper towards the flange, so that its side counts
    for (const double at : arc_lengths(*errors))
      draw.push_back(1e-6 * std::exp(at / 10e-3 - 8.0) * std::cos(2.0 * kPi * (at / 8e-3 + 0.25 * phase)));
  }
  const NaturalSurface rail = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  NaturalSurface wheel = create_natural({Body::wheel, kScannedRadius, StandardProfile{"S1002"}, {}});
  wheel.spec.errors = errors;
  std::vector<io::PatchResult> sides;
  for (const auto& [y_mm, more] : {std::pair{"3", ""}, std::pair{"-3", "case.side = \"left\"\n"}}) {
    const std::string text =
        case_text("shape.standard = \"S1002\"", "shape.standard = \"60E1\"", y_mm) + std::string(more);
    const io::CaseFile file = io::parse_case_text(text, input.folder() / "case.toml");
    io::CaseResult result = run_cases(file).cases.at(0);
    NoiseOfResults(rail, wheel).add(std::get<io::WheelRailCase>(file.cases.at(0).content), result);
    ASSERT_EQ(result.patches.size(), 1u);
    ASSERT_TRUE(result.patches.front().noise);
    sides.push_back(std::move(result.patches.front()));
  }
  ASSERT_LT(sides[0].y_tr * sides[1].y_tr, 0.0);
  constexpr double kSame = 1e-6;
  EXPECT_GT(sides[0].noise->pmax, 1e-3 * sides[0].pmax);
  EXPECT_NEAR(sides[1].noise->pmax / sides[0].noise->pmax, 1.0, kSame);
  EXPECT_NEAR(sides[1].noise->place / sides[0].noise->place, 1.0, kSame);
}

struct Trial {
  const char* name;
  Body body;
  std::string keys;  ///< of the shape
  std::string y_mm;
  std::size_t points = 0;
  std::string sections = "auto";
};

class ImportedNoise : public ::testing::Test {
 protected:
  fs::path path(const std::string& name) const { return input.folder() / name; }

  io::ImportReport import(const std::string& shape, Body body, std::size_t points, double noise,
                          const std::string& output, const io::ImportSettings& settings = {},
                          std::uint64_t seed = 7) const {
    ScanRequest scan;
    scan.surface.body = body;
    scan.scanner.points = points;
    scan.scanner.noise = noise;
    scan.scanner.seed = seed;
    if (body == Body::rail) scan.range_x = std::pair{-0.2, 0.2};
    scan_surface(path(shape), path("cloud.ply"), scan);
    ImportRequest request;
    request.scans = {path("cloud.ply")};
    request.outputs = {path(output)};
    request.settings = settings;
    request.settings.placement.nominal_radius_mm = body == Body::wheel ? 1e3 * kScannedRadius : 0.0;
    return import_scan(request);
  }

  /// A wheel that is hollow by 4 mm over 50 mm, smoothly, down to y [m]; its flange has its tip at -55 mm.
  void write_hollow(const std::string& name, double last) const {
    std::ofstream file(path(name));
    for (const Vec2& p : wheel_points(last)) {
      const double x = p.x() / 25e-3;
      const double worn = std::fabs(x) < 1.0 ? 4e-3 * std::pow(std::cos(0.5 * kPi * x), 4) : 0.0;
      file << fmt::format("{:.9f}, {:.9f}\n", 1e3 * p.x(), 1e3 * (p.y() - worn));
    }
  }

  /// Contacts on imported scans against those on the shapes that were scanned: what is stated covers the difference,
  /// and what is far off is doubted.
  void compare(const std::vector<Trial>& trials, int least) const;

  testing::SampleInput input;
};

TEST_F(ImportedNoise, TreadsWithoutTheirFlangeAreDoubted) {
  for (const double last : {-28e-3, -66e-3}) {
    write_hollow("hollow.csv", last);
    input.write("truth.toml",
                case_text("shape.file = \"hollow.csv\"\nshape.smoothing = \"none\"", "shape.standard = \"60E1\"", "0"));
    io::ImportSettings settings;
    settings.fit.errors = false;
    const io::ImportReport report = import("truth.toml", Body::wheel, 60000, 20e-6, "found.slcw", settings);
    const bool doubted = ranges::any_of(report.warnings, [](const std::string& warning) {
      return warning.starts_with("no_flange: ") && warning.find("not scanned") != std::string::npos;
    });
    EXPECT_EQ(doubted, last > -55e-3) << ::testing::PrintToString(report.warnings);
    // the scan lies in the frame of the wheel
    if (!doubted) {
      EXPECT_NEAR(report.X_CS.origin.y(), 0.0, 0.1e-3);
    }
  }
}

/// What an import doubts is told by all that use the surface, whatever file it was written to or came through.
TEST_F(ImportedNoise, DoubtsGoWithTheSurface) {
  // the top of a rail, without its sides
  const NaturalSurface whole = create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}});
  std::vector<double> y, z;
  for (double at = -26e-3; at < 26.1e-3; at += 0.2e-3) y.push_back(at);
  z.resize(y.size());
  HeightsOut out;
  out.z = z;
  section_heights(*whole.surface, Body::rail, 0.0, y, out);
  std::string top;
  for (std::size_t k = 0; k < y.size(); ++k) top += fmt::format("{:.9f}, {:.9f}\n", 1e3 * y[k], 1e3 * z[k]);
  input.write("top.csv", top);
  const auto text = [](const std::string& rail) {
    return "[wheel]\nshape.standard = \"S1002\"\n[rail]\n" + rail +
           "\n[track]\nrail_y_mm = 753\n[wheelset]\nvertical_force_N = 80e3\nvelocity_m_s = 20\nrolling = "
           "\"nominal\"\n[discretisation]\ndx_mm = 2\nds_mm = 2\n";
  };
  input.write("truth.toml", text("shape.file = \"top.csv\"\nshape.smoothing = \"none\""));
  ScanRequest scan;
  scan.surface.body = Body::rail;
  scan.scanner.points = 30000;
  scan.scanner.noise = 20e-6;
  scan.scanner.seed = 7;
  scan.range_x = std::pair{-0.1, 0.1};
  scan_surface(path("truth.toml"), path("cloud.ply"), scan);
  std::vector<std::string> files{"found.slcs", "found.ply", "found.stl", "found.obj", "found.off"};
  if (has_part("openvdb")) files.emplace_back("found.vdb");
  ImportRequest request;
  request.scans = {path("cloud.ply")};
  for (const std::string& file : files) request.outputs.push_back(path(file));
  request.settings.fit.errors = false;
  const io::ImportReport report = import_scan(request);
  const auto told = [](const std::string& words) { return words.find("no_sides: ") != std::string::npos; };
  ASSERT_EQ(ranges::count_if(report.warnings, told), 1) << ::testing::PrintToString(report.warnings);

  ConvertSettings how;
  how.body = Body::rail;
  how.resolution = 2e-3;
  how.tolerance = 1e-3;
  for (const std::string& file : files) {
    SCOPED_TRACE(file);
    // where contacts are solved
    const io::CaseFile run = io::parse_case_text(text("shape.file = \"" + file + "\""), input.folder() / "case.toml");
    const io::CaseResult result = run_cases(run).cases.at(0);
    EXPECT_EQ(ranges::count_if(result.remarks,
                               [&](const Remark& r) { return r.kind == RemarkKind::profile_doubtful && told(r.text); }),
              1)
        << result.message;
    // simulations and comparisons
    const auto& pair = std::get<io::WheelRailCase>(run.cases.front().content);
    EXPECT_EQ(ranges::count_if(source_doubts(pair.rail, Body::rail, {}), told), 1);
    EXPECT_EQ(ranges::count_if(import_doubts(run), told), 1);
    // what `check` shows
    const CheckedProfile checked = check_surface(path(file), Body::rail);
    EXPECT_EQ(ranges::count(checked.judgement.remarks, "no_sides", &io::ProfileRemark::name), 1);
    // and through any other file
    for (const std::string& other : files) {
      const auto again = path("again_" + other);
      convert_surface(path(file), again, how);
      EXPECT_EQ(ranges::count_if(import_doubts(again, Body::rail), told), 1) << other;
    }
  }
  // a body of several parts has those of all of them
  io::SurfaceSource doubted, clean, both;
  doubted.geometry = io::GeometryFile{path("found.slcs"), {}};
  clean.geometry = StandardProfile{"60E1"};
  both.parts = {clean, doubted, doubted};
  EXPECT_EQ(ranges::count(read_surface(both, Body::rail, 0.0).spec.doubts, "no_sides", &SurfaceDoubt::name), 1);
}

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
  // the check sum covers the lines: another digit of the last error, which by itself is as good, is found by it alone
  std::string text = testing::content_of(path("found.slcs"));
  const std::size_t line = text.rfind("surface-errors"), digit = text.find('\n', line) - 1;
  ASSERT_NE(line, std::string::npos);
  ASSERT_GT(line, text.find("SHA-256 of the slices"));
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{path("found.slcs"), {}};
  EXPECT_NE(read_surface(source, Body::rail, 0.0).spec.errors, nullptr);
  text[digit] = text[digit] == '1' ? '2' : '1';
  input.write("found.slcs", text);
  const auto changed_errors = io::read_surface_errors(path("found.slcs"));
  ASSERT_NE(changed_errors, nullptr);
  EXPECT_NE(to_lines(*changed_errors), lines);
  try {
    read_surface(source, Body::rail, 0.0);
    ADD_FAILURE() << "the check sum was not looked at";
  } catch (const Error& error) {
    EXPECT_THAT(error.message(), HasSubstr("not those that this file was written with"));
  }
  // what parts of a body know is not known of the whole, and that is said
  io::SurfaceSource part, body;
  part.geometry = io::GeometryFile{path("found.ply"), {}};
  body.parts = {part, part};
  const NaturalSurface joined = read_surface(body, Body::rail, 0.0);
  EXPECT_EQ(joined.spec.errors, nullptr);
  EXPECT_THAT(joined.note, HasSubstr("of 2 of its 2 parts is not counted"));
  // switched off there is none
  io::ImportSettings off;
  off.fit.errors = false;
  EXPECT_FALSE(import("truth.toml", Body::rail, 60000, 30e-6, "found.slcs", off).errors);
  EXPECT_EQ(io::read_surface_errors(path("found.slcs")), nullptr);
}

const std::string kNewWheel = "shape.standard = \"S1002\"", kNewRail = "shape.standard = \"60E1\"";

void ImportedNoise::compare(const std::vector<Trial>& trials, int least) const {
  int compared = 0, covered = 0;
  double stated = 0.0, true_square = 0.0;  // of pressures over their values: mean squares
  for (const Trial& trial : trials) {
    const bool wheel = trial.body == Body::wheel;
    const auto text = [&](const std::string& keys) {
      return case_text(wheel ? keys : kNewWheel, wheel ? kNewRail : keys, trial.y_mm);
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
          if (patch == patches.end() || std::fabs(patch->y_tr - meant.y_tr) > kNear) {
            EXPECT_TRUE(any_grave(found.cases[k].remarks))
                << trial.name << ' ' << noise << ": no contact at y = " << meant.y_tr;
            continue;
          }
          ASSERT_TRUE(patch->noise) << trial.name << ' ' << noise;
          const double off = patch->pmax - meant.pmax, sigma = patch->noise->pmax;
          const bool doubted = ranges::any_of(found.cases[k].remarks, [&](const Remark& remark) {
            return remark.kind == RemarkKind::noisy_profile && remark.patch == 1 + (patch - patches.begin());
          });
          constexpr double kSame = 0.01, kFar = 0.05;
          // a fit rounds the jump of curvature between the arcs of the gauge corner (docs/scans.md)
          constexpr double kRounded = 0.12, kJump = 741e-3;
          ++compared;
          covered += std::fabs(off) <= std::max(2.5 * sigma, kSame * meant.pmax) ? 1 : 0;
          stated += std::pow(sigma / meant.pmax, 2), true_square += std::pow(off / meant.pmax, 2);
          const std::string where =
              fmt::format("{}, {} um, case {}, y = {:.1f} mm: {:.1f} MPa, truly {:.1f}, sigma {:.1f}", trial.name,
                          1e6 * noise, k + 1, 1e3 * meant.y_tr, 1e-6 * patch->pmax, 1e-6 * meant.pmax, 1e-6 * sigma);
          EXPECT_TRUE(doubted || std::fabs(off) < (!wheel && meant.y_tr < kJump ? kRounded : kFar) * meant.pmax)
              << where;
        }
    }
  }
  EXPECT_GE(compared, least);
  EXPECT_GE(covered, compared * 4 / 5) << compared;
  constexpr double kMostOverstated = 3.0;  // what covers everything says nothing
  EXPECT_LT(std::sqrt(stated), kMostOverstated * std::sqrt(true_square));
}

TEST_F(ImportedNoise, OfFitsCoversWhatResultsAreOff) {
  write_hollow("hollow.csv", -66e-3);
  compare({{"new wheel", Body::wheel, kNewWheel, "[-3, 0, 3, 5.5]", 600000},
           {"hollow wheel", Body::wheel, "shape.file = \"hollow.csv\"\nshape.smoothing = \"none\"", "[-3, 0, 3, 5.5]",
            600000},
           {"squat", Body::rail, kNewRail + "\n[[rail.squats]]\nlength_mm = 40\nwidth_mm = 30\ndepth_mm = 0.4",
            "[-3, 0, 3]", 150000}},
          25);
}

/// Virtual scans of a new rail and of one with a squat: error bars name their sources, and hold the truth;
/// scripts/error-bars.py asks a thousand scans.
TEST_F(ImportedNoise, ErrorBarsHoldTheTruth) {
  constexpr int kScans = 5;
  const std::string squat = kNewRail + "\n[[rail.squats]]\nlength_mm = 120\nwidth_mm = 60\ndepth_mm = 0.2";
  int known = 0, within_two = 0, named = 0;
  double normalised = 0.0;
  for (const std::string& keys : {kNewRail, squat}) {
    const auto text = [](const std::string& rail) {
      return case_text(kNewWheel, rail, "[0]", "dx_mm = 1\nds_mm = 1\n[case]\nerror_bars = \"always\"\n");
    };
    input.write("truth.toml", text(keys));
    const io::CaseResult truth = run_text(text(keys), input.folder()).cases.at(0);
    EXPECT_THAT(truth.uncertainty.value().message, HasSubstr("nothing says how well"));
    for (int seed = 1; seed <= kScans; ++seed) {
      import("truth.toml", Body::rail, 80000, 30e-6, "found.slcs", {}, static_cast<std::uint64_t>(seed));
      const io::CaseResult found = run_text(text("shape.file = \"found.slcs\""), input.folder()).cases.at(0);
      ASSERT_TRUE(found.uncertainty) << "the surface knows its errors";
      ASSERT_EQ(found.uncertainty->message, "");
      for (const io::CaseUncertainty::Source& source : found.uncertainty->sources)
        named += source.name == "lateral placement of the rail" ? 1 : 0;
      for (const io::CaseUncertainty::Number& number : found.uncertainty->numbers) {
        if (number.name != "patch_1.pmax_MPa" || !(number.sigma > 0.0)) continue;
        const double off = std::fabs(number.value - 1e-6 * truth.patches.at(0).pmax) / number.sigma;
        ++known, within_two += off < 2.0 ? 1 : 0;
        normalised += off * off;
      }
    }
  }
  EXPECT_EQ(named, 2 * kScans);
  ASSERT_GE(known, 2 * kScans - 1);
  EXPECT_GE(within_two, 3 * known / 4);
  constexpr double kMostOverstated = 4.0;  // what covers everything says nothing
  EXPECT_GT(std::sqrt(normalised / known), 1.0 / kMostOverstated);
}

TEST_F(ImportedNoise, OfKeptLinesCoversWhatResultsAreOff) {
  compare({{"lines of a wheel", Body::wheel, kNewWheel, "[-3, 0, 3, 5.5]", 30000, "keep"}}, 8);
}

}  // namespace
}  // namespace treadmark::app
