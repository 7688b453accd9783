// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;

io::CaseResult solved(const std::filesystem::path& file) {
  return run_cases(io::read_any_case(file.string(), {})).cases.at(0);
}

TEST(CadWheel, GivesTheContactOfTheStandardProfile) {
  TREADMARK_NEEDS("cad");
  const treadmark::testing::SampleInput input;
  input.write("standard.toml", treadmark::testing::standard_case("0.5"));
  ConvertSettings settings;
  settings.body = Body::wheel;
  settings.resolution = 0.1e-3;
  const Converted c = convert_surface(input.folder() / "standard.toml", input.folder() / "wheel.step", settings);
  EXPECT_EQ(c.kind, "CAD");
  EXPECT_GT(c.fit.points, 1000u);
  EXPECT_LT(c.fit.height_max, 0.5e-6);  // the joints of S1002 are steps
  EXPECT_LT(c.fit.height_rms, 0.1e-6);
  input.write("cad.toml", treadmark::testing::standard_case("0.5", "shape.file = \"wheel.step\"\n"));
  const io::CaseResult given = solved(input.folder() / "standard.toml"), cad = solved(input.folder() / "cad.toml");
  ASSERT_EQ(cad.status, Status::ok);
  ASSERT_EQ(cad.patches.size(), given.patches.size());
  EXPECT_NEAR(cad.patches[0].pmax / given.patches[0].pmax, 1.0, 1e-3);
  EXPECT_NEAR(cad.patches[0].y_tr, given.patches[0].y_tr, 1e-5);
}

constexpr double kSameHeights = 0.1e-6;  ///< [m] that another program gets the surface within

const char* const kSquat = "[[rail.squats]]\nlength_mm = 30\nwidth_mm = 40\ndepth_mm = 0.2\ny_center_mm = -5\n";
const char* const kRoundedFlat =
    "shape.standard = \"S1002\"\n[[wheel.flats]]\nshape = \"rounded\"\nlength_mm = 60\ndepth_mm = 0.3\n"
    "y_center_mm = 6\nwidth_mm = 60\n";

TEST(CadRail, ASquatGoesThereAndBack) {
  TREADMARK_NEEDS("cad");
  const treadmark::testing::SampleInput input;
  input.write("squat.toml", treadmark::testing::standard_case("1.0", "shape.standard = \"S1002\"\n", kSquat));
  ConvertSettings settings;
  settings.body = Body::rail;
  settings.range_x = {-0.03, 0.03};
  for (const double resolution : {1e-3, 0.5e-3, 0.0}) {
    settings.resolution = resolution;
    const Converted c = convert_surface(input.folder() / "squat.toml", input.folder() / "rail.step", settings);
    EXPECT_GT(c.fit.points, 5000u);
    EXPECT_EQ(c.fit.missing, 0u);
    EXPECT_LT(c.fit.height_max, kSameHeights) << resolution;
    EXPECT_THAT(c.written.note, HasSubstr("the B-spline of #"));
    EXPECT_EQ(c.written.surface->backend(), "nurbs");
  }
  // what was read is written again as it is
  ConvertSettings as_it_is;
  as_it_is.body = Body::rail;
  const Converted again = convert_surface(input.folder() / "rail.step", input.folder() / "again.step", as_it_is);
  EXPECT_LT(again.fit.height_max, 1e-12);
}

TEST(CadWheel, AFlatGoesThereAndBack) {
  TREADMARK_NEEDS("cad");
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::standard_case("1.0", kRoundedFlat));
  ConvertSettings settings;
  settings.body = Body::wheel;
  for (const double resolution : {1e-3, 0.5e-3, 0.0}) {
    settings.resolution = resolution;
    settings.range_theta.reset();
    if (resolution > 0.0) settings.range_theta = {-0.1, 0.1};
    const Converted c = convert_surface(input.folder() / "flat.toml", input.folder() / "wheel.step", settings);
    EXPECT_GT(c.fit.points, 5000u);
    EXPECT_EQ(c.fit.missing, 0u);
    EXPECT_LT(c.fit.height_max, kSameHeights) << resolution;
  }
}

TEST(CadRail, IsWhateverRepresentationIsAskedFor) {
  TREADMARK_NEEDS("cad");
  const treadmark::testing::SampleInput input;
  input.write("squat.toml", treadmark::testing::standard_case("1.0", "shape.standard = \"S1002\"\n", kSquat));
  ConvertSettings settings;
  settings.body = Body::rail;
  settings.range_x = {-0.03, 0.03};
  convert_surface(input.folder() / "squat.toml", input.folder() / "rail.step", settings);
  const double pressure = solved(input.folder() / "squat.toml").patches.at(0).pmax;
  for (const char* backend : {"", "nurbs", "mesh", "spline", "thb"}) {
    std::string text = treadmark::testing::standard_case("1.0");
    text.replace(text.find("shape.standard = \"60E1\""), 23, "shape.file = \"rail.step\"");
    if (backend[0] != '\0')
      text.insert(text.find("[track]"), "backend = \"" + std::string(backend) + "\"\n" +
                                            (std::string(backend) == "nurbs" ? "" : "resolution_mm = 0.5\n"));
    input.write("cad.toml", text);
    const io::CaseResult cad = solved(input.folder() / "cad.toml");
    ASSERT_EQ(cad.status, Status::ok) << backend;
    EXPECT_NEAR(cad.patches.at(0).pmax / pressure, 1.0, backend == std::string("mesh") ? 5e-3 : 1e-3) << backend;
  }
}

TEST(CadRail, TakesTheBackendOfTheCommandLine) {
  TREADMARK_NEEDS("cad");
  TREADMARK_NEEDS("hdf5");
  const treadmark::testing::SampleInput input;
  std::string text = treadmark::testing::standard_case("1.0");
  text.replace(text.find("shape.standard = \"60E1\""), 23, "shape.file = \"rail.step\"");
  input.write("cad.toml", text);
  input.write("squat.toml", treadmark::testing::standard_case("1.0", "shape.standard = \"S1002\"\n", kSquat));
  ConvertSettings settings;
  settings.body = Body::rail;
  settings.range_x = {-0.03, 0.03};
  convert_surface(input.folder() / "squat.toml", input.folder() / "rail.step", settings);
  const auto run = [&](const char* backend) {
    return treadmark::testing::run_program({"run", (input.folder() / "cad.toml").string(), "--rail-backend", backend,
                                            "--resolution", "0.5", "-o", (input.folder() / "out").string()});
  };
  for (const char* backend : {"thb", "offset"}) {
    const treadmark::testing::ProgramResult r = run(backend);
    EXPECT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.err, HasSubstr(fmt::format("rail as {} at 0.5 mm", backend)));
    EXPECT_THAT(r.out, HasSubstr("case 1: ok"));
  }
  EXPECT_THAT(run("none").err, HasSubstr("'none'"));
}

TEST(CadRail, SidesThatMoveAreAMeshOnTheFaces) {
  TREADMARK_NEEDS("cad");
  io::SurfaceSource source;
  const std::filesystem::path file = std::filesystem::path(TREADMARK_SOURCE_DIR) / "tests/io/cad/data/nose.step";
  source.geometry = io::GeometryFile{file, {}};
  source.where = {file.string(), 0, 0};
  const NaturalSurface nose = read_surface(source, Body::rail, 0.0);
  EXPECT_EQ(nose.surface->backend(), "mesh");
  EXPECT_THAT(nose.note, HasSubstr("its sides move"));
  double most = 0.0, squares = 0.0;
  int count = 0;
  for (int i = 0; i < 60; ++i) {
    const double x = 0.005 + 0.0015 * i,
                 scale = 1.0 + 2.0 * x;  // of a crown of 80 mm, with corners of 13 mm from 0.2 rad
    const std::vector<double> angles = [] {
      std::vector<double> all;
      for (int k = -110; k <= 110; ++k) all.push_back(0.01 * k);
      return all;
    }();
    std::vector<double> y, z, found(angles.size()), cosine;
    for (const double angle : angles) {
      const double a = std::fabs(angle), side = angle < 0.0 ? -1.0 : 1.0;
      const bool corner = a > 0.2;
      const double r = corner ? 0.013 : 0.08, y0 = corner ? 0.067 * std::sin(0.2) : 0.0,
                   z0 = corner ? 0.08 - 0.067 * std::cos(0.2) : 0.08;
      y.push_back(scale * side * (y0 + r * std::sin(a)));
      z.push_back(scale * (z0 - r * std::cos(a)));
      cosine.push_back(std::cos(a));
    }
    section_heights(*nose.surface, Body::rail, x, y, {found, {}, {}});
    for (std::size_t k = 0; k < y.size(); ++k) {
      ASSERT_FALSE(std::isnan(found[k])) << x << ' ' << y[k];
      const double off = std::fabs(found[k] - z[k]) * cosine[k];
      most = std::max(most, off);
      squares += off * off, ++count;
    }
  }
  EXPECT_LT(most, 2e-6);
  EXPECT_LT(std::sqrt(squares / count), 0.2e-6);
}

TEST(CadFiles, HaveUnitsOfTheirOwn) {
  TREADMARK_NEEDS("cad");
  const treadmark::testing::SampleInput input;
  input.write("cad.toml",
              treadmark::testing::standard_case("1.0", "shape.file = \"wheel.step\"\nshape.scale_to_mm = 2\n"));
  input.write("wheel.step", "");
  EXPECT_THAT(treadmark::testing::error_of([&] { solved(input.folder() / "cad.toml"); }),
              HasSubstr("scale_to_mm does not belong to a file of CAD"));
}

}  // namespace
}  // namespace treadmark::app
