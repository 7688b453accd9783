// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/surfaces/convert_surface.hpp"
#include "treadmark/app/surfaces/read_surface.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/writing/write_cases.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/error_text.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using treadmark::testing::error_of;

/// Of a squat as [[rail.squats]] has it: 30 mm long, 24 mm wide, 0.4 mm deep at (2, 3) mm.
double dip_mm(double x, double y) {
  x -= 2.0, y -= 3.0;
  if (std::fabs(x) >= 15.0 || std::fabs(y) >= 12.0) return 0.0;
  return 0.1 * (1.0 + std::cos(2.0 * std::numbers::pi * x / 30.0)) *
         (1.0 + std::cos(2.0 * std::numbers::pi * y / 24.0));
}

/// Positions and values times what they are in; value: (x, y) [mm] -> [mm].
template <class Value>
std::string table(const std::string& corner, Value value, double step = 0.5, double scale = 1.0,
                  double deviation = 1.0) {
  std::string text = corner;
  for (double y = -11.0; y <= 17.0; y += step) text += fmt::format(",{:.10g}", scale * y);
  text += "\n";
  for (double x = -15.0; x <= 19.0; x += step) {
    text += fmt::format("{:.10g}", scale * x);
    for (double y = -11.0; y <= 17.0; y += step) text += fmt::format(",{:.10g}", deviation * value(x, y));
    text += "\n";
  }
  return text;
}

class OffsetTable : public ::testing::Test {
 protected:
  void SetUp() override { TREADMARK_NEEDS("scans"); }
  io::SurfaceSource source(const std::string& text, const std::string& name = "table.csv") const {
    input_.write(name, text);
    io::SurfaceSource s;
    s.geometry = StandardProfile{"60E1"};
    s.offsets.file = input_.folder() / name;
    return s;
  }
  std::string refusal(const std::string& text, const std::string& name = "table.csv") const {
    return error_of([&] { read_surface(source(text, name), Body::rail, 0.0); });
  }
  const treadmark::testing::SampleInput input_;
};

TEST_F(OffsetTable, IsWhatTheFormulaOfTheDefectIs) {
  const NaturalSurface given = read_surface(source(table("mm", dip_mm)), Body::rail, 0.0);
  EXPECT_EQ(given.surface->backend(), "offset");
  EXPECT_EQ(given.note, "") << "it ends at zero";
  io::SurfaceSource formula;
  formula.geometry = StandardProfile{"60E1"};
  formula.defects.squats = {{.length = 30e-3, .width = 24e-3, .depth = 0.4e-3, .x_center = 2e-3, .y_center = 3e-3}};
  const NaturalSurface squat = read_surface(formula, Body::rail, 0.0);
  for (double x = -20e-3; x < 25e-3; x += 1.7e-3)
    for (double y = -20e-3; y < 20e-3; y += 1.3e-3)
      EXPECT_NEAR(height_at(*given.surface, {}, {x, y}), height_at(*squat.surface, {}, {x, y}), 2e-7) << x << ' ' << y;
}

TEST_F(OffsetTable, KnowsItsUnits) {
  const auto depth = [&](const io::SurfaceSource& s) {
    io::SurfaceSource plain = s;
    plain.offsets = {};
    return height_at(*read_surface(s, Body::rail, 0.0).surface, {}, {2e-3, 3e-3}) -
           height_at(*read_surface(plain, Body::rail, 0.0).surface, {}, {2e-3, 3e-3});
  };
  EXPECT_NEAR(depth(source(table("mm", dip_mm))), 0.4e-3, 1e-7);
  EXPECT_NEAR(depth(source(table("# unit m\n", dip_mm, 0.5, 1e-3, 1e-3))), 0.4e-3, 1e-7);
  io::SurfaceSource said = source(table("x", dip_mm, 0.5, 1.0, 1e3));
  said.offsets.deviation_unit = LengthUnit::micrometre;
  EXPECT_NEAR(depth(said), 0.4e-3, 1e-7);
  EXPECT_THAT(refusal(table("x", dip_mm, 0.5, 1.0, 1e3)), AllOf(HasSubstr("table.csv:"), HasSubstr("more than 50 mm")));
}

TEST_F(OffsetTable, IsRefusedAtThePlaceThatIsWrong) {
  const auto with = [](const char* cell) { return fmt::format("x,-1,0,1\n0,0,0,0\n1,0,{},0\n2,0,0,0\n", cell); };
  EXPECT_EQ(refusal(with("0.01")), "");
  EXPECT_THAT(refusal(with("")), HasSubstr("table.csv:3:5: a cell without a deviation"));
  EXPECT_THAT(refusal(with("nan")), HasSubstr("table.csv:3:5: a cell without a deviation"));
  EXPECT_THAT(refusal(with("abc")), HasSubstr("table.csv:3:5"));
  EXPECT_THAT(refusal("x,-1,0,2\n0,0,0,0\n1,0,0,0\n"), AllOf(HasSubstr("table.csv:1:8"), HasSubstr("evenly")));
  EXPECT_THAT(refusal("x,-1,0,1\n0,0,0,0\n1,0,0\n"), HasSubstr("table.csv:3"));
  EXPECT_THAT(refusal("x,-1,0,1\n0,0,0,0\n1,0,0,0\n1.5,0,0,0\n3,0,0,0\n"), HasSubstr("evenly"));
  // 60E1 ends at 36 mm
  EXPECT_THAT(refusal("x,30,40,50\n0,0,0,0\n10,0,0.1,0\n20,0,0,0\n"),
              AllOf(HasSubstr("table.csv:3:6"), HasSubstr("beside the rail"), HasSubstr("y = 40 mm")));
  EXPECT_EQ(refusal("x,30,40,50\n0,0,0,0\n10,0.1,0,0\n20,0,0,0\n"), "") << "nothing is added there";
  // Micrometres taken for millimetres: nothing that a surface does
  EXPECT_THAT(refusal(with("20")), HasSubstr("table.csv:3:5: a deviation of 20 mm, steeper than 45 degrees"));
  EXPECT_THAT(refusal("x,-1,0,1\n0,0,0,0\n1,2,2,2\n2,0,0,0\n"), HasSubstr("table.csv:3:3: a deviation of 2 mm"));
  EXPECT_THAT(refusal("ncols 3\nnrows 3\nxllcorner 0\nyllcorner 0\ncellsize 1\nnodata_value -9\n0 0 0\n0 -9 0\n0 0 0\n",
                      "grid.asc"),
              HasSubstr("grid.asc:8:3: a cell without a deviation"));
}

TEST_F(OffsetTable, SaysWhereTheSurfaceSteps) {
  const auto constant = [](double, double) { return 0.05; };
  const NaturalSurface s = read_surface(source(table("mm", constant)), Body::rail, 0.0);
  EXPECT_THAT(s.note, AllOf(HasSubstr("table.csv"), HasSubstr("0.05 mm at its border")));
}

TEST_F(OffsetTable, GoesRoundAWheelInDegreesOrMillimetres) {
  std::string degrees = "deg,-20,0,20\n", lengths = "mm,-20,0,20\n";
  for (int k = 0; k < 72; ++k) {
    const double radius = 0.02 * std::cos(3.0 * k * std::numbers::pi / 36.0);
    degrees += fmt::format("{},{:.9f},{:.9f},{:.9f}\n", 5 * k, radius, radius, radius);
    lengths +=
        fmt::format("{:.12g},{:.9f},{:.9f},{:.9f}\n", 460.0 * k * std::numbers::pi / 36.0, radius, radius, radius);
  }
  for (const bool angles : {true, false}) {
    io::SurfaceSource s = source(angles ? degrees : lengths);
    s.geometry = StandardProfile{"S1002"};
    s.offsets.angles_deg = angles;
    s.offsets.unit = LengthUnit::millimetre;
    const NaturalSurface wheel = read_surface(s, Body::wheel, 0.46);
    s.offsets = {};
    const NaturalSurface round = read_surface(s, Body::wheel, 0.46);
    for (const double theta : {0.0, 0.4, 2.0, -2.5}) {
      const Pose X{Vec3::Zero(), rotation_y(theta)};
      EXPECT_NEAR(height_at(*wheel.surface, X, {0.0, 0.0}) - height_at(*round.surface, X, {0.0, 0.0}),
                  0.02e-3 * std::cos(3.0 * theta), 1e-7)
          << angles << ' ' << theta;
    }
  }
}

TEST_F(OffsetTable, IsAKeyOfACaseAndOfTheCommandLine) {
  using treadmark::testing::run_program;
  input_.write("table.csv", table("mm", dip_mm));
  const std::string plain = treadmark::testing::standard_case("1.0"), key = "rail.offsets.file";
  input_.write("plain.toml", plain);
  const auto result = [&](const io::CaseFile& file) { return run_cases(file).cases.at(0); };
  const std::string file = (input_.folder() / "plain.toml").string();
  const io::CaseFile with = io::read_any_case(file, std::vector<std::string>{key + "=\"table.csv\""});
  const io::CaseResult damaged = result(with), sound = result(io::read_any_case(file, {}));
  ASSERT_EQ(damaged.status, Status::ok);
  EXPECT_GT(std::fabs(damaged.z - sound.z), 3e-5) << "the wheel comes down into the dip";
  // written and read again it says the same
  const std::string text = io::case_file_text(with, input_.folder());
  EXPECT_THAT(text, HasSubstr("table.csv"));
  input_.write("again.toml", text);
  EXPECT_EQ(result(io::read_any_case((input_.folder() / "again.toml").string(), {})).z, damaged.z);

  const auto bare = run_program({"check", file, "--set", "rail.offsets.unit=\"mm\""});
  EXPECT_NE(bare.status, 0);
  EXPECT_THAT(bare.err, HasSubstr("rail.offsets.file is missing"));
  TREADMARK_NEEDS("openvdb");
  const auto converted = run_program({"convert", file, (input_.folder() / "rail.vdb").string(), "--body", "rail",
                                      "--offsets", (input_.folder() / "table.csv").string()});
  ASSERT_EQ(converted.status, 0) << converted.err;
  input_.write("vdb.toml", treadmark::testing::standard_case("1.0"));
  input_.edit("vdb.toml", "shape.standard = \"60E1\"", "shape.file = \"rail.vdb\"");
  EXPECT_NEAR(result(io::read_any_case((input_.folder() / "vdb.toml").string(), {})).z, damaged.z, 1e-9);
}

TEST_F(OffsetTable, BelongsToRailsAndWheelsOfOnePiece) {
  const io::SurfaceSource s = source(table("mm", dip_mm));
  EXPECT_THAT(error_of([&] { read_surface(s, Body::rail, 0.3); }), HasSubstr("cannot be added to a roller"));
}

}  // namespace
}  // namespace treadmark::app
