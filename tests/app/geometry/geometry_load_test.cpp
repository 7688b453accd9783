// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;
using treadmark::testing::run_program;

const std::vector<std::string> kLoaded{"geometry", "--wheel",    "S1002", "--rail",         "60E1", "--cant",
                                       "1:40",     "--gauge-mm", "1435",  "--axle-load-kN", "200"};

std::vector<std::string> loaded_with(const std::vector<std::string>& more) {
  std::vector<std::string> arguments = kLoaded;
  arguments.insert(arguments.end(), more.begin(), more.end());
  return arguments;
}

TEST(GeometryLoad, WritesJsonByItsSchema) {
  const auto result = run_program(loaded_with({"--json", "-", "--roll", "free"}));
  ASSERT_EQ(result.status, 0) << result.err;
  const nlohmann::json out = nlohmann::json::parse(result.out), schema = nlohmann::json::parse(geometry_schema());
  EXPECT_EQ(treadmark::testing::first_violation(out, schema, schema), "");
  const nlohmann::json &g = out.at("geometry"), &f = g.at("functions"), &load = g.at("load");
  EXPECT_EQ(f.size(), columns<FunctionRow>().size() + columns<geometry::LoadedPosition>().size());
  const std::size_t rows = f.at("y_mm").size();
  for (const auto& [name, values] : f.items()) EXPECT_EQ(values.size(), rows) << name;
  std::size_t pressures = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    const auto at = [&](const char* name) { return f.at(name).at(i); };
    const double up = at("normal_force_right_N").get<double>() * std::cos(at("angle_right_rad").get<double>()) +
                      at("normal_force_left_N").get<double>() * std::cos(at("angle_left_rad").get<double>());
    EXPECT_NEAR(up, 200e3, 1e-4) << i;  // twelve digits are written
    EXPECT_NEAR(at("holding_force_N").get<double>(), 200e3 * at("holding_force_over_weight").get<double>(), 1e-4) << i;
    // a number or a reason, never both
    for (const char* side : {"right", "left"}) {
      const bool none = at(fmt::format("pressure_{}_MPa", side).c_str()).is_null();
      EXPECT_EQ(none, !at(fmt::format("no_pressure_{}", side).c_str()).is_null()) << i;
      EXPECT_EQ(none, at(fmt::format("shared_{}", side).c_str()).is_null()) << i;
      pressures += none ? 0 : 1;
    }
  }
  EXPECT_GT(pressures, rows);
  EXPECT_NEAR(load.at("rail").at("youngs_modulus_MPa").get<double>(), 2.0 * 82e3 * 1.28, 1e-6);
  EXPECT_NEAR(load.at("right").at("normal_force_N").get<double>(), load.at("left").at("normal_force_N").get<double>(),
              1e-3);
  EXPECT_NEAR(load.at("elastic_roll_rad").get<double>(), 0.0, 1e-12);
  EXPECT_LE(std::fabs(load.at("largest_pressure").at("y_mm").get<double>()), 3.0);
  // without a load there is none of it
  const auto plain =
      run_program({"geometry", "--wheel", "S1002", "--rail", "60E1", "--gauge-mm", "1435", "--json", "-"});
  EXPECT_THAT(plain.out, Not(HasSubstr("pressure")));
}

TEST(GeometryLoad, WritesTablesPicturesAndReport) {
  const treadmark::testing::TemporaryFolder folder;
  const auto result = run_program(
      loaded_with({"-o", (folder.path() / "out").string(), "--report", (folder.path() / "report.html").string()}));
  ASSERT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("axle load               200000 N\n"));
  EXPECT_THAT(result.out, HasSubstr("holding force           0 N\n"));
  EXPECT_THAT(result.out, HasSubstr("nearer to it than       3 mm\n"));
  EXPECT_THAT(result.out, HasSubstr("  right                 normal force 100"));
  const auto text_of = [&](const char* name) { return treadmark::testing::content_of(folder.path() / name); };
  const std::string table = text_of("out/functions.csv");
  EXPECT_THAT(table, HasSubstr(",normal_force_right_N,"));
  EXPECT_THAT(table, HasSubstr(",no_pressure_right,no_pressure_left\n"));
  EXPECT_THAT(text_of("out/charts.svg"), HasSubstr("largest pressures by Hertz"));
  const std::string page = text_of("report.html");
  EXPECT_THAT(page, HasSubstr("largest pressure"));
  EXPECT_THAT(page, HasSubstr("axle load 200 kN"));
  // The middle of the shifts is shown first.
  const std::size_t at = page.find("\"start\":"), count = page.find("\"count\":");
  ASSERT_NE(at, std::string::npos);
  EXPECT_EQ(2 * std::stoi(page.substr(at + 8)) + 1, std::stoi(page.substr(count + 8)));
}

TEST(GeometryLoad, TakesTheElasticConstantsOfACase) {
  const treadmark::testing::TemporaryFolder folder;
  const auto steel = folder.write("steel.toml", treadmark::testing::standard_case("1.0")),
             soft = folder.write("soft.toml", treadmark::testing::standard_case(
                                                  "1.0", "shape.standard = \"S1002\"\n",
                                                  "[material]\nshear_modulus_GPa = 41\npoisson_ratio = 0.28\n"));
  const auto right = [](const std::filesystem::path& file) {
    SectionStore store;
    GeometryRequest request;
    request.case_file = file.string();
    request.settings.amplitudes = {3e-3};
    EXPECT_FALSE(run_geometry(request, store).load);  // the wheel's force of the case is none of the axle
    request.axle_load = 100e3;
    const GeometryResult result = run_geometry(request, store);
    return result.load->rows[result.load->rows.size() / 2 + 20].right;
  };
  const geometry::LoadedSide a = right(steel), b = right(soft);
  ASSERT_EQ(a.reason, "");
  EXPECT_NEAR(b.semi_axis_x / a.semi_axis_x, std::cbrt(2.0), 1e-9);  // Hertz: axes with the cube root of softness
  EXPECT_NEAR(b.normal_force, a.normal_force, 1e-6);
}

/// The same contacts by the solver of patches, which knows nothing of ellipses.
void expect_as_solved(double force_N, const char* element_mm, const std::string& shifts_mm, double most_misfit,
                      double tolerance) {
  const treadmark::testing::TemporaryFolder folder;
  const auto file =
      folder.write("case.toml", "case.regime = \"none\"\n" + treadmark::testing::standard_case(
                                                                 element_mm, "shape.standard = \"S1002\"\n",
                                                                 "[[cases]]\nwheelset.y_mm = [" + shifts_mm + "]\n"));
  const std::vector<std::string> force{fmt::format("wheelset.vertical_force_N={}", force_N)};
  const io::RunResult run = run_cases(io::read_any_case(file, force));
  GeometryRequest request;
  request.case_file = file.string();
  request.settings.amplitudes = {3e-3};
  SectionStore store;
  const GeometryResult result = run_geometry(request, store);
  const geometry::WheelsetOnTrack wheelset =
      geometry::place(result.right, result.left, result.placement, geometry::Roll::none);
  for (const io::CaseResult& solved : run.cases) {
    ASSERT_EQ(solved.status, Status::ok) << solved.message;
    ASSERT_EQ(solved.patches.size(), 1u);
    const io::PatchResult& patch = solved.patches[0];
    const geometry::Position at = wheelset.at(solved.y);
    // the axle load that makes the force of that patch
    const geometry::LoadedSide side =
        geometry::loaded(wheelset, at, {patch.fn / wheelset.balance(at).right, result.material}).right;
    ASSERT_EQ(side.reason, "");
    EXPECT_FALSE(side.shared);
    EXPECT_LT(side.misfit, most_misfit);
    EXPECT_NEAR(side.normal_force * std::cos(at.right.angle), force_N, 2e-3 * force_N) << solved.y;
    EXPECT_NEAR(patch.pmax, side.pressure, tolerance * side.pressure) << solved.y;
    EXPECT_NEAR(patch.approach, side.approach, tolerance * side.approach) << solved.y;
  }
}

/// S1002 on 60E1 where the curvatures of both hardly change over a patch of 2 mm: on the rail's arc of 80 mm, away from
/// its joints.
TEST(GeometryLoad, AgreesWithTheSolverWhereCurvaturesAreEven) {
  constexpr double kElements = 2e-3;  // of 0.1 mm, twenty over the patch
  expect_as_solved(2500.0, "0.1", "2, 3", 0.03, kElements);
}

/// With a usual load curvatures change over the patch by a third, on one side up and on the other side down.
TEST(GeometryLoad, AgreesWithTheSolverUnderUsualLoads) {
  constexpr double kUneven = 0.02;
  expect_as_solved(100e3, "0.5", "-8, -6, -4, -2.5, 3.5, 4", 0.4, kUneven);
}

TEST(GeometryLoad, BelongsToOnePair) {
  const auto result = run_program(loaded_with({"--pairs", "none.csv"}));
  EXPECT_EQ(result.status, 2);
  EXPECT_THAT(result.err, HasSubstr("--axle-load-kN, --new-wheel and --new-rail belong to one pair"));
  std::vector<std::string> wrong = kLoaded;
  wrong.back() = "-1";
  EXPECT_EQ(run_program(wrong).status, 2);
}

}  // namespace
}  // namespace treadmark::app
