// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/io/splines/read_splines.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/io/splines/sample_splines.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using treadmark::testing::SampleInput;
using treadmark::testing::standard_case;

constexpr double kNanometre = 1e-9;

io::CaseResult solved_with_splines(const std::filesystem::path& file) {
  return run_cases(io::read_any_case(file.string(), {})).cases.at(0);
}

template <class Action>
std::string what_of(const Action& action) {
  try {
    action();
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

NaturalSurface surface_of(const std::filesystem::path& file, Body body) {
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{file, {}};
  return read_surface(source, body, body == Body::wheel ? 0.46 : 0.0);
}

/// Heights of two surfaces differ at most so much, where there is one.
double greatest_difference(const Surface& a, const Surface& b, Body body, double u_from, double u_to) {
  double most = 0.0;
  std::size_t found = 0;
  std::vector<double> y, za, zb;
  for (double at = -0.05; at < 0.05; at += 0.7e-3) y.push_back(at);
  za.resize(y.size()), zb.resize(y.size());
  for (int i = 0; i <= 20; ++i) {
    HeightsOut out_a, out_b;
    out_a.z = za, out_b.z = zb;
    const double u = u_from + (u_to - u_from) * i / 20.0;
    section_heights(a, body, u, y, out_a);
    section_heights(b, body, u, y, out_b);
    for (std::size_t k = 0; k < y.size(); ++k) {
      if (std::isnan(za[k]) || std::isnan(zb[k])) continue;
      ++found;
      most = std::max(most, std::abs(za[k] - zb[k]));
    }
  }
  EXPECT_GT(found, 500u);
  return most;
}

TEST(SplineFiles, ConvertedSurfacesComeBackWithinANanometre) {
  TREADMARK_NEEDS("expat");
  const SampleInput input;
  input.write("squat.toml", standard_case("1.0", treadmark::testing::kWheelWithFlat,
                                          "[[rail.squats]]\nlength_mm = 30\nwidth_mm = 40\ndepth_mm = 0.2\n"));
  for (const Body body : {Body::rail, Body::wheel})
    for (const char* backend : {"nurbs", "thb", "thb-quadratic"}) {
      const bool wheel = body == Body::wheel;
      ConvertSettings settings;
      settings.body = body;
      settings.backend = backend;
      settings.resolution = 1e-3;
      (wheel ? settings.range_theta : settings.range_x) = {-0.05, 0.05};
      const Converted c = convert_surface(input.folder() / "squat.toml", input.folder() / "out.xml", settings);
      EXPECT_EQ(c.kind, "splines");
      EXPECT_EQ(c.written.surface->backend(), backend);
      EXPECT_GT(c.fit.points, 1000u);
      // as the backend itself represents the shape
      const Representation wanted{backend, settings.resolution, c.written.region};
      const RepresentedSurface own = represent(c.source, wanted);
      EXPECT_LT(greatest_difference(*own.surface, *c.written.surface, body, -0.045, 0.045), kNanometre)
          << backend << wheel;
      // and once more from the file, which is not sampled
      ConvertSettings again;
      again.body = body;
      again.nominal_radius = wheel ? 0.46 : 0.0;
      const Converted d = convert_surface(input.folder() / "out.xml", input.folder() / "again.xml", again);
      EXPECT_EQ(d.written.surface->backend(), backend);
      EXPECT_LT(greatest_difference(*d.written.surface, *c.written.surface, body, -0.045, 0.045), kNanometre);
    }
}

TEST(SplineFiles, GiveTheContactOfTheSurfaceTheyWereMadeFrom) {
  TREADMARK_NEEDS("expat");
  const SampleInput input;
  input.write("standard.toml", standard_case("1.0"));
  ConvertSettings settings;
  settings.body = Body::rail;
  settings.range_x = {-0.05, 0.05};
  convert_surface(input.folder() / "standard.toml", input.folder() / "rail.xml", settings);  // arcs, exactly
  std::string text = standard_case("1.0");
  text.replace(text.find("shape.standard = \"60E1\""), 23, "shape.file = \"rail.xml\"");
  input.write("splines.toml", text);
  const io::CaseResult given = solved_with_splines(input.folder() / "standard.toml"),
                       splines = solved_with_splines(input.folder() / "splines.toml");
  ASSERT_EQ(splines.status, Status::ok);
  ASSERT_EQ(splines.patches.size(), given.patches.size());
  constexpr double kSolver = 1e-4;  // of the balance of forces
  EXPECT_NEAR(splines.patches[0].pmax / given.patches[0].pmax, 1.0, kSolver);
  EXPECT_NEAR(splines.patches[0].y_tr, given.patches[0].y_tr, 1e-6);
}

TEST(SplineFiles, AWheelAsGismoWritesIt) {
  TREADMARK_NEEDS("expat");
  const SampleInput input;
  input.write("shell.xml", treadmark::testing::kWheelShell);
  const NaturalSurface wheel = surface_of(input.folder() / "shell.xml", Body::wheel);
  EXPECT_EQ(wheel.surface->backend(), "nurbs");
  std::vector<double> r(3);
  HeightsOut out;
  out.z = r;
  for (const double angle : {-0.7, -0.1, 0.0, 0.5}) {
    section_heights(*wheel.surface, Body::wheel, angle, std::vector<double>{-0.02, 0.0, 0.025}, out);
    for (const double value : r) EXPECT_NEAR(value, 0.46, 1e-12) << angle;
  }
  EXPECT_THAT(what_of([&] { surface_of(input.folder() / "shell.xml", Body::rail); }),
              ::testing::Not(HasSubstr("bad_")));
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{input.folder() / "shell.xml", {}};
  EXPECT_THAT(what_of([&] { read_surface(source, Body::wheel, 2.0); }), HasSubstr("the nominal radius is 2000 mm"));
  std::get<io::GeometryFile>(source.geometry).options.mirror_y = 1;
  EXPECT_THAT(what_of([&] { read_surface(source, Body::wheel, 0.46); }), HasSubstr("only scale_to_mm"));
}

TEST(SplineFiles, SeveralPatchesAreOneBodyWhoseGapsAreNamed) {
  TREADMARK_NEEDS("expat");
  const SampleInput input;
  const auto read = [&](double step, const std::string& more = "0 2 1 1 0 1 1 1") {
    input.write("plates.xml", treadmark::testing::two_plates(step, more));
    return surface_of(input.folder() / "plates.xml", Body::rail);
  };
  EXPECT_EQ(read(0.0).note, "");
  const NaturalSurface stepped = read(0.03);
  EXPECT_THAT(stepped.note, HasSubstr("a gap of 30 um between side 2 of Geometry 0 and side 1 of Geometry 1"));
  std::vector<double> z(1);
  HeightsOut out;
  out.z = z;
  section_heights(*stepped.surface, Body::rail, 0.15, std::vector<double>{0.01}, out);
  EXPECT_NEAR(z[0], 0.03e-3, 1e-12);
  section_heights(*stepped.surface, Body::rail, 0.05, std::vector<double>{0.01}, out);
  EXPECT_NEAR(z[0], 0.0, 1e-12);
  EXPECT_THAT(what_of([&] { read(0.3); }), HasSubstr("are said to meet, but are 300 um apart"));
  EXPECT_THAT(read(0.3, "").note, HasSubstr("a gap of 300 um"));
  // written again, patch by patch
  ConvertSettings settings;
  settings.body = Body::rail;
  read(0.03);
  const Converted c = convert_surface(input.folder() / "plates.xml", input.folder() / "out.xml", settings);
  EXPECT_THAT(c.written.note, HasSubstr("a gap of 30 um"));
  EXPECT_LT(c.fit.height_max, kNanometre);
  EXPECT_THAT(
      io::profiles::read_text(input.folder() / "out.xml", "file", {}),
      HasSubstr("<interfaces>0 2 1 1 0 1 0 1\n</interfaces>\n<boundary>0 1\n0 3\n0 4\n1 2\n1 3\n1 4\n</boundary>"));
  const io::SplineFile back = io::read_splines(input.folder() / "out.xml");
  ASSERT_EQ(back.interfaces.size(), 1u);
  EXPECT_EQ(back.interfaces[0].second_side, 1);
  EXPECT_FALSE(back.interfaces[0].reversed);
  read(0.3, "");  // too far apart to be said to meet
  convert_surface(input.folder() / "plates.xml", input.folder() / "out.xml", settings);
  EXPECT_TRUE(io::read_splines(input.folder() / "out.xml").interfaces.empty());
}

TEST(SplineFiles, OfTheProgramKnowTheirBackends) {
  TREADMARK_NEEDS("expat");
  const SampleInput input;
  input.write("rail.xml", treadmark::testing::hierarchical_rail(0.5));
  const auto convert = [&](const char* backend, const char* name) {
    return treadmark::testing::run_program({"convert", (input.folder() / "rail.xml").string(),
                                            (input.folder() / name).string(), "--body", "rail", "--backend", backend});
  };
  const auto refused = [&](const char* backend, const char* name) {
    const treadmark::testing::ProgramResult r = convert(backend, name);
    EXPECT_NE(r.status, 0) << backend << name;
    EXPECT_FALSE(std::filesystem::exists(input.folder() / name)) << backend << name;
    return r.err;
  };
  EXPECT_THAT(refused("mesh", "out.xml"), HasSubstr("the backend 'mesh' has no splines to write"));
  EXPECT_THAT(refused("none", "out.xml"), HasSubstr("'none'"));
  EXPECT_THAT(refused("thb", "out.ply"), HasSubstr("--backend belongs to files of splines"));
  const treadmark::testing::ProgramResult tensor = convert("nurbs", "out.xml");
  EXPECT_EQ(tensor.status, 0) << tensor.err;
  EXPECT_FALSE(io::read_splines(input.folder() / "out.xml").surfaces.at(0).hierarchical);
}

TEST(SplineFiles, AHierarchyStaysOneAndTakesDefects) {
  TREADMARK_NEEDS("expat");
  const SampleInput input;
  input.write("rail.xml", treadmark::testing::hierarchical_rail(0.5));
  const NaturalSurface rail = surface_of(input.folder() / "rail.xml", Body::rail);
  EXPECT_EQ(rail.surface->backend(), "thb-quadratic");
  // four functions of 0.5 mm: in the middle each is (1/2 1/2) x (1/2 1/2) of the square of its values at a knot
  std::vector<double> z(1);
  HeightsOut out;
  out.z = z;
  section_heights(*rail.surface, Body::rail, 0.0, std::vector<double>{0.0}, out);
  EXPECT_NEAR(z[0], 0.5e-3, 1e-12);
  io::SurfaceSource source;
  source.geometry = io::GeometryFile{input.folder() / "rail.xml", {}};
  EXPECT_THAT(what_of([&] { read_surface(source, Body::rail, 0.5); }), HasSubstr("cannot become a roller"));
  ConvertSettings settings;
  settings.body = Body::rail;
  settings.backend = "mesh";
  EXPECT_THAT(what_of([&] { convert_surface(input.folder() / "rail.xml", input.folder() / "out.xml", settings); }),
              HasSubstr("has no splines to write"));
}

TEST(SplineFiles, HigherDegreesAreReadAndWrittenAgain) {
  TREADMARK_NEEDS("expat");
  const SampleInput input;
  SplineSurface plate;  // z = 300 y^4 - 2e3 x^3 y^2 as blossoms of degrees 3 and 5
  plate.levels.push_back({SplineKnots{3, {0, 0, 0, 0, 0.1, 0.1, 0.1, 0.1}}, SplineKnots{5, {}}});
  for (const double end : {-0.03, 0.03}) plate.levels[0][1].knots.insert(plate.levels[0][1].knots.end(), 6, end);
  for (int j = 0; j <= 5; ++j)
    for (int i = 0; i <= 3; ++i) {
      // of j ends and 5 - j beginnings: means of the products of 2 and of 4 of them
      const double s = (5.0 - 2.0 * j), h = 0.03, second = (s * s - 5.0) / 20.0 * h * h,
                   fourth = (j == 0 || j == 5   ? 1.0
                             : j == 1 || j == 4 ? -0.6
                                                : 0.2) *
                            h * h * h * h;
      plate.points.emplace_back(0.1 * i / 3.0, -0.2 * h * s, 300.0 * fourth - (i == 3 ? 2e3 * 1e-3 * second : 0.0));
    }
  io::write_splines(input.folder() / "plate.xml", std::vector<SplineSurface>{plate});
  const NaturalSurface read = surface_of(input.folder() / "plate.xml", Body::rail);
  EXPECT_THAT(read.note, HasSubstr("degrees 3 x 5 by cubics within"));
  std::vector<double> z(1);
  HeightsOut out;
  out.z = z;
  for (const double x : {0.01, 0.05, 0.093})
    for (const double y : {-0.028, -0.01, 0.0, 0.017}) {
      section_heights(*read.surface, Body::rail, x, std::vector<double>{y}, out);
      EXPECT_NEAR(z[0], 300.0 * std::pow(y, 4) - 2e3 * x * x * x * y * y, 1e-8) << x << ' ' << y;
    }
  // as it is, into both kinds of files
  ConvertSettings settings;
  settings.body = Body::rail;
  for (const char* name : {"again.xml", "again.step"}) {
    if (std::string_view(name) == "again.step" && !has_part("cad")) continue;
    const Converted c = convert_surface(input.folder() / "plate.xml", input.folder() / name, settings);
    EXPECT_THAT(c.written.note, HasSubstr("degrees 3 x 5 by cubics within")) << name;
    EXPECT_LT(c.fit.height_max, 1e-12) << name;
  }
}

TEST(SplineFiles, SplinesOfOtherFilesAreNotSampled) {
  SurfaceSpec spec;
  SplineSurface plate;
  plate.levels.push_back({SplineKnots{1, {0.0, 0.0, 0.1, 0.1}}, SplineKnots{2, {0.0, 0.0, 0.0, 0.06, 0.06, 0.06}}});
  for (const double y : {-0.03, 0.0, 0.03})
    for (const double x : {0.0, 0.1}) plate.points.emplace_back(x, y, y * y);
  spec.shape = plate;
  const std::vector<SplineSurface> told = to_splines(create_natural(spec), {});
  ASSERT_EQ(told.size(), 1u);
  EXPECT_EQ(told[0].levels[0][1].knots, plate.levels[0][1].knots);
  EXPECT_EQ(told[0].points, plate.points);
}

}  // namespace
}  // namespace treadmark::app
