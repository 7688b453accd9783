// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/design/run_design.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/cases/section_heights.hpp"
#include "treadmark/app/cases/solve_cases.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_design.hpp"
#include "treadmark/model/shape/natural_view.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

namespace fs = std::filesystem;

using ::testing::AllOf;
using ::testing::HasSubstr;
using treadmark::testing::ProgramResult;
using treadmark::testing::run_program;
using treadmark::testing::RunningProgram;
using treadmark::testing::TemporaryFolder;

std::string text_of_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

nlohmann::json result_in(const fs::path& folder) {
  return nlohmann::json::parse(text_of_file(folder / "design.json"), nullptr, false);
}

/// A rail 60E1 with a ridge of 0.1 mm on its head, as points.
void write_ridged_rail(const TemporaryFolder& folder) {
  const fs::path plain = folder.path() / "plain.csv";
  ASSERT_EQ(run_program({"convert", "60E1", plain.string()}).status, 0);
  std::istringstream lines(text_of_file(plain));
  std::string head, text;
  std::getline(lines, head);
  text = head + '\n';
  char comma = 0;
  for (double y = 0.0, z = 0.0; lines >> y >> comma >> z; lines.ignore(200, '\n')) {
    const double from_top = (y + 4.0) / 5.0;
    text += fmt::format("{},{}\n", y, z - 0.1 * std::exp(-from_top * from_top));
  }
  folder.write("ridged.csv", text);
}

/// Wheels of three diameters pass over it, each in a place of its own.
std::string over_the_ridge(const char* element_mm) {
  return R"([design]
[[design.vary]]
label = "wheel"
values = [
  { label = "920 mm at -3 mm", set = ["wheelset.nominal_radius_mm=460", "wheelset.y_mm=-3"] },
  { label = "860 mm at 0 mm", set = ["wheelset.nominal_radius_mm=430", "wheelset.y_mm=0"] },
  { label = "960 mm at 3 mm", set = ["wheelset.nominal_radius_mm=480", "wheelset.y_mm=3"] },
]
[design.depth]
from_mm = -12
to_mm = 6
step_mm = 6
most_mm = [0, 0.2, 0.2, 0]
[[design.goals]]
quantity = "pmax_MPa"
over = "largest"
[wheel]
shape.standard = "S1002"
[rail]
shape.file = "ridged.csv"
shape.smoothing = "none"
[track]
gauge_mm = 1435
gauge_height_mm = 14
cant = "1:40"
[wheelset]
flange_back_distance_mm = 1360
flange_back_position_mm = -70
nominal_radius_mm = 460
vertical_force_N = 80e3
velocity_m_s = 20
rolling = "nominal"
[discretisation]
dx_mm = )" +
         std::string(element_mm) + "\nds_mm = " + element_mm + "\n";
}

double largest(const nlohmann::json& result, const char* which) {
  double most = 0.0;
  for (const auto& number : result.at("numbers"))
    if (number.at("quantity") == "pmax_MPa" && number.at(which).is_number())
      most = std::max(most, number.at(which).get<double>());
  return most;
}

/// The same depths without a search: a natural spline through four places, and none beyond.
double largest_pressure(const DesignCases& cases, const std::vector<CaseGeometry>& given, double first, double second) {
  const SectionHeights depth{
      Facing::up, -36e-3, 6e-3, {0.0, 0.0, 0.0, 0.0, 0.0, first, second, 0.0, 0.0, 0.0, 0.0, 0.0}};
  std::vector<std::optional<wheelrail::Geometry>> bodies;
  bodies.reserve(given.size());
  for (const CaseGeometry& one : given) {
    wheelrail::Geometry& changed = bodies.emplace_back(one.geometry).value();
    changed.rail = with_heights(std::move(changed.rail), depth, 1.0);
  }
  double most = 0.0;
  for (const io::CaseResult& c : solve_cases(cases.given(), bodies).cases)
    for (const io::PatchResult& patch : c.patches) most = std::max(most, 1e-6 * patch.pmax);
  return most;
}

TEST(Design, GrindingIsWhatASearchOverAGridFinds) {
  const TemporaryFolder folder;
  write_ridged_rail(folder);
  const std::string file = folder.write("grind.toml", over_the_ridge("1")).string();
  const fs::path out = folder.path() / "out";
  const ProgramResult run = run_program({"design", file, "-o", out.string()});
  ASSERT_TRUE(fs::exists(out / "design.json")) << run.err;
  const nlohmann::json result = result_in(out);
  EXPECT_THAT(result.at("status").get<std::string>(), ::testing::AnyOf("converged", "stalled", "limit")) << run.out;
  EXPECT_LE(result.at("solutions").get<int>(), 100);
  EXPECT_EQ(result.at("check_solutions"), 6);
  EXPECT_LT(result.at("largest_disagreement").get<double>(), 0.2) << run.out;
  EXPECT_EQ(result.at("variables").size(), 2u) << "places without a range are given";

  const io::DesignFile read = io::read_design_file(file);
  const DesignCases cases(read);
  const std::vector<CaseGeometry> given = check_geometry(cases.given());
  const double start = largest_pressure(cases, given, 0.0, 0.0);
  double least = start;
  for (const double first : {0.03e-3, 0.05e-3, 0.07e-3})
    for (const double second : {0.0, 0.04e-3, 0.08e-3})
      least = std::min(least, largest_pressure(cases, given, first, second));
  constexpr double kSame = 5e-3;  // of solutions to a smaller tolerance
  EXPECT_NEAR(largest(result, "before"), start, kSame * start);
  EXPECT_LT(largest(result, "after"), 0.92 * start) << run.out;
  EXPECT_LE(largest(result, "after"), (1.0 + kSame) * least) << run.out;
  EXPECT_NEAR(largest(result, "written"), largest(result, "after"), 0.02 * least);
  const auto& depth = result.at("depth").at("depth_mm");
  EXPECT_NEAR(largest_pressure(cases, given, 1e-3 * depth.at(1).get<double>(), 1e-3 * depth.at(2).get<double>()),
              largest(result, "after"), kSame * least);

  // what is written is read again by others
  EXPECT_LT(run_program({"check", (out / "designed.toml").string()}).status, 2) << "warnings at most";
  EXPECT_THAT(text_of_file(out / "designed.toml"), HasSubstr("rail.csv"));
  EXPECT_TRUE(fs::exists(out / "before/result.json"));
  EXPECT_TRUE(fs::exists(out / "after/result.json"));
  if (has_part("report") && has_part("hdf5")) {
    const fs::path page = folder.path() / "page.html";
    ASSERT_EQ(run_program({"report", out.string(), "-o", page.string()}).status, 0);
    EXPECT_THAT(text_of_file(page), AllOf(HasSubstr("What was sought."), HasSubstr("Before, of the design")));
  }
}

/// A wheel of 1:40 with a flange, on rails with round heads: over them only a cone of 1:10 has a conicity of 0.1 at all
/// amplitudes and no bend.
TEST(Design, AConstantConicityIsThatOfACone) {
  const TemporaryFolder folder;
  std::string points = "y [mm],z [mm]\n";
  for (double y = 60.0; y >= -55.0; y -= 0.5) {
    const double root = y < -32.0 ? y + 32.0 : 0.0;
    points += fmt::format("{},{}\n", y, -0.025 * y + 0.05 * root * root);
  }
  folder.write("cone.csv", points);
  const std::string file = folder
                               .write("cone.toml", R"([design]
solutions = 300
[design.depth]
body = "wheel"
from_mm = -35
to_mm = 25
step_mm = 10
least_mm = [-4]
most_mm = [4]
ends = "level"
[[design.goals]]
quantity = "conicity"
amplitudes_mm = [2, 3, 4]
target = 0.1
[[design.goals]]
quantity = "bend_1_per_m"
target = 0
scale = 1
weight = 1
[wheel]
shape.file = "cone.csv"
shape.placement = "as_in_file"
shape.smoothing = "none"
[rail]
shape.standard = "60E1"
[track]
gauge_mm = 1435
gauge_height_mm = 14
cant = "1:40"
[wheelset]
flange_back_distance_mm = 1360
flange_back_position_mm = -70
nominal_radius_mm = 460
vertical_force_N = 80e3
velocity_m_s = 20
rolling = "nominal"
[discretisation]
dx_mm = 2
ds_mm = 2
)")
                               .string();
  const fs::path out = folder.path() / "out";
  const ProgramResult run = run_program({"design", file, "-o", out.string()});
  ASSERT_TRUE(fs::exists(out / "design.json")) << run.err;
  const nlohmann::json result = result_in(out);
  EXPECT_EQ(result.at("solutions"), 0) << "no contact is asked for";
  EXPECT_THAT(result.at("gradients").get<std::string>(), HasSubstr("conicity by differences"));
  int conicities = 0;
  for (const auto& number : result.at("numbers")) {
    if (number.at("quantity") != "conicity") continue;
    ++conicities;
    EXPECT_NEAR(number.at("before").get<double>(), 0.025, 2e-4) << number;
    EXPECT_NEAR(number.at("after").get<double>(), 0.1, 1e-3) << number << run.out;
    EXPECT_NEAR(number.at("written").get<double>(), 0.1, 1e-3) << number;
  }
  EXPECT_EQ(conicities, 3);
  const auto& depth = result.at("depth").at("depth_mm");
  ASSERT_EQ(depth.size(), 7u);
  // straight: where the depths go on level at their ends the curve through them bends, and contact moves a little less
  for (std::size_t k = 1; k + 1 < depth.size(); ++k)
    EXPECT_NEAR(depth.at(k - 1).get<double>() + depth.at(k + 1).get<double>(), 2.0 * depth.at(k).get<double>(), 2e-3)
        << depth;
  EXPECT_NEAR(0.025 + (depth.at(4).get<double>() - depth.at(2).get<double>()) / 20.0, 0.1, 6e-3) << depth;
}

TEST(Design, DerivativesAreThoseOfSolutions) {
  const TemporaryFolder folder;
  const io::DesignFile file =
      io::read_design_file(folder.write("all.toml", treadmark::testing::standard_case("1.0") + R"([design]
[[design.parameters]]
key = "wheelset.vertical_force_N"
from = 60e3
to = 100e3
[design.depth]
from_mm = -20
to_mm = 10
step_mm = 10
least_mm = [-0.1]
most_mm = [0.3]
[[design.goals]]
quantity = "pmax_MPa"
[[design.goals]]
quantity = "approach_mm"
[[design.limits]]
quantity = "conicity"
amplitudes_mm = [2]
at_most = 1
[[design.limits]]
quantity = "bend_1_per_m"
at_most = 5
[[design.limits]]
quantity = "convexity_1_per_m"
at_least = 0
[[design.limits]]
quantity = "removed_mm2"
at_most = 5
)"));
  DesignCases cases(file);
  ASSERT_EQ(cases.variables().size(), 5u);
  EXPECT_FALSE(cases.variables()[0].surfaces);
  EXPECT_TRUE(cases.variables()[1].surfaces);
  EXPECT_EQ(cases.solutions(), 1u);
  const std::vector<double> here{0.5, 0.25, 0.35, 0.3, 0.25};
  const DesignNumbers numbers = cases.at(here);
  ASSERT_EQ(numbers.size(), 6u);
  EXPECT_NEAR(numbers[5][0].value, 10.0 * (0.0 + 0.04 + 0.02 + 0.0), 1e-9) << "mm by mm";
  EXPECT_NEAR(numbers[3][0].value, (0.0 - 2.0 * 0.0 + 0.04) / 100.0 * 1e3, 1e-9) << "outside there is no depth";
  constexpr double kStep = 4e-3;
  for (std::size_t v = 0; v < here.size(); ++v) {
    std::vector<double> less = here, more = here;
    less[v] -= kStep, more[v] += kStep;
    const DesignNumbers below = cases.at(less), above = cases.at(more);
    for (std::size_t q = 0; q < numbers.size(); ++q)
      for (std::size_t i = 0; i < numbers[q].size() && cases.name_of(q) != "conicity"; ++i) {  // that is differenced
        const DesignNumber& number = numbers[q][i];
        if (!std::isfinite(number.value)) continue;
        ASSERT_EQ(number.by.size(), here.size());
        const double difference = (above[q][i].value - below[q][i].value) / (2.0 * kStep);
        const double size = std::max(std::fabs(difference), 0.02 * std::fabs(number.value));
        EXPECT_NEAR(number.by[v], difference, 0.05 * size + 1e-9)
            << cases.name_of(q) << ' ' << cases.where_of(q, i) << " by " << cases.variables()[v].name;
      }
  }
}

TEST(Design, GoesOnWhereItWasInterruptedWithTheSameResult) {
  const TemporaryFolder folder;
  write_ridged_rail(folder);
  const std::string file = folder.write("grind.toml", over_the_ridge("2")).string();
  const auto words = [&](const char* out) {
    return std::vector<std::string>{
        "design", file, "-o", (folder.path() / out).string(), "--set", "design.solutions=15"};
  };
  const int whole = run_program(words("one")).status;
  std::vector<std::string> interrupted{"treadmark"};
  for (const std::string& word : words("two")) interrupted.push_back(word);
  RunningProgram program(interrupted);
  while (program.running() && !fs::exists(folder.path() / "two/rail.csv"))
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  const auto begun = std::chrono::steady_clock::now();
  program.send(SIGINT);
  const ProgramResult end = program.wait();
  EXPECT_LT(std::chrono::steady_clock::now() - begun, std::chrono::seconds(20));
  const nlohmann::json best = result_in(folder.path() / "two");
  if (best.at("status") == "interrupted") {  // else it was quicker
    EXPECT_EQ(end.status, 1);
    EXPECT_THAT(end.err, HasSubstr("the same command goes on"));
    EXPECT_TRUE(best.at("variables").at(0).at("best").is_number());
  }
  std::vector<std::string> again = words("two");
  again.insert(again.end(), {"--threads", "1"});
  EXPECT_EQ(run_program(again).status, whole);
  for (const char* name : {"history.csv", "numbers.csv", "rail.csv", "designed.toml"})
    EXPECT_EQ(text_of_file(folder.path() / "one" / name), text_of_file(folder.path() / "two" / name)) << name;

  std::vector<std::string> more = words("two");
  more.back() = "design.solutions=18";
  run_program(more);
  const nlohmann::json one = result_in(folder.path() / "one"), two = result_in(folder.path() / "two");
  EXPECT_EQ(two.at("designs").get<int>() > one.at("designs").get<int>(), one.at("status") == "limit")
      << "with more solutions it goes on";
  std::vector<std::string> other = words("two");
  other.insert(other.end(), {"--set", "wheelset.vertical_force_N=70e3"});
  const ProgramResult refused = run_program(other);
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("something else"));
  const ProgramResult full =
      RunningProgram({"sh", "-c", "\"$0\" --quiet design \"$1\" -o \"$2\" --set design.solutions=15 > /dev/full",
                      TREADMARK_PROGRAM, file, (folder.path() / "one").string()})
          .wait();
  EXPECT_EQ(full.status, 1);
  EXPECT_THAT(full.err, HasSubstr("could not be written to standard output"));
}

/// Over a straight sum the best depth is the least one, whatever counts as 1.
TEST(Design, AScaleDoesNotBoundWhatIsFound) {
  const TemporaryFolder folder;
  const io::DesignFile file =
      io::read_design_file(folder.write("sum.toml", treadmark::testing::standard_case("2.0") + R"([design]
[design.depth]
from_mm = -10
to_mm = 10
step_mm = 10
least_mm = [-0.2]
most_mm = [0]
[[design.goals]]
quantity = "removed_mm2"
over = "largest"
scale = 0.1
)"));
  const DesignResult result = run_design(file, {folder.path() / "out", {}});
  EXPECT_EQ(result.status, "converged") << result.message;
  EXPECT_NEAR(result.best, -3.0 * 0.2 * 10.0 / 0.1, 0.1);
  for (const DesignVariable& variable : result.variables) EXPECT_NEAR(variable.best, -0.2, 1e-3) << variable.name;
  EXPECT_LT(result.disagreement, 1e-6);
  EXPECT_THAT(result.warnings, ::testing::IsEmpty());
}

TEST(Design, WritesTheSurfaceThatItFound) {
  const TemporaryFolder folder;
  const std::string base = treadmark::testing::standard_case("2.0"),
                    depth =
                        "from_mm = -10\nto_mm = 10\nstep_mm = 10\nmost_mm = [0.2]\n"
                        "[[design.goals]]\nquantity = \"removed_mm2\"\n";
  const auto height = [](const io::CaseFile& file, Body body) {
    const wheelrail::Geometry bodies = check_geometry(file).front().geometry;
    const std::array<double, 1> y{0.0};
    std::array<double, 1> z{};
    section_heights(body == Body::rail ? *bodies.rail : *bodies.wheel, body, 0.0, y, {z, {}, {}});
    return z[0];
  };
  constexpr double kAsWritten = 15e-6;  // m, of samples 1 mm apart

  const io::DesignFile squat = io::read_design_file(
      folder.write("squat.toml", base + "[[rail.squats]]\nlength_mm = 60\nwidth_mm = 40\ndepth_mm = 0.2\n[design]\n" +
                                     "[[design.parameters]]\nkey = \"rail.squats.0.depth_mm\"\nfrom = 0.1\nto = 0.3\n" +
                                     "[design.depth]\n" + depth));
  DesignCases over_squat(squat);
  const double rail = height(over_squat.given(), Body::rail);
  EXPECT_NEAR(height(over_squat.written({0.5, 0.5, 0.5, 0.5}, folder.path()), Body::rail), rail + 0.1e-3, kAsWritten);
  EXPECT_NEAR(height(over_squat.written({1.0, 0.5, 0.5, 0.5}, folder.path()), Body::rail), rail + 0.2e-3, kAsWritten);
  EXPECT_TRUE(fs::exists(folder.path() / "rail.slcs"));

  // a profile counts from the nominal radius, here one that is sought, too
  const io::DesignFile wheel = io::read_design_file(
      folder.write("wheel.toml",
                   base + "[design]\n[[design.parameters]]\nkey = \"wheelset.nominal_radius_mm\"\nfrom = 440\n" +
                       "to = 480\n[design.depth]\nbody = \"wheel\"\n" + depth),
      std::vector<std::string>{"wheelset.nominal_radius_mm=460"});
  DesignCases of_wheel(wheel);
  EXPECT_NEAR(height(of_wheel.written({1.0, 0.5, 0.5, 0.5}, folder.path()), Body::wheel), 0.48 - 0.1e-3, kAsWritten);
  EXPECT_TRUE(fs::exists(folder.path() / "wheel.csv"));
}

TEST(Design, ReplacesNoInput) {
  const TemporaryFolder folder;
  write_ridged_rail(folder);
  fs::rename(folder.path() / "ridged.csv", folder.path() / "rail.csv");
  const std::string text = over_the_ridge("2"), given = text_of_file(folder.path() / "rail.csv");
  const std::size_t name = text.find("ridged.csv");
  const fs::path file = folder.write("grind.toml", text.substr(0, name) + "rail.csv" + text.substr(name + 10));
  const ProgramResult refused = run_program({"design", file.string(), "-o", folder.path().string()});
  EXPECT_EQ(refused.status, 2);
  EXPECT_THAT(refused.err, HasSubstr("would overwrite"));
  EXPECT_EQ(text_of_file(folder.path() / "rail.csv"), given);
}

/// What reading alone does not see.
TEST(Design, RefusesWhatMakesNoSense) {
  const TemporaryFolder folder;
  const std::string base = treadmark::testing::standard_case("2.0");
  const auto error = [&](const std::string& design) -> std::string {
    const io::DesignFile file = io::read_design_file(folder.write("bad.toml", base + "[design]\n" + design));
    try {
      const DesignCases cases(file);
    } catch (const Error& e) {
      return e.what();
    }
    return "";
  };
  const std::string depth = "[design.depth]\nfrom_mm = -10\nto_mm = 10\nstep_mm = 10\nmost_mm = [0.2]\n";
  const std::string goal = "[[design.goals]]\nquantity = ";
  EXPECT_EQ(error(depth + goal + "\"pmax_MPa\"\n"), "");
  EXPECT_THAT(error(depth + goal + "\"pmaxx_MPa\"\n"), AllOf(HasSubstr("bad.toml:"), HasSubstr("pmax_MPa")));
  EXPECT_THAT(error(depth + goal + "\"elements.ncon\"\n"), HasSubstr("has no derivatives"));
  EXPECT_THAT(error(depth + goal + "\"conicity\"\n"), HasSubstr("needs amplitudes_mm"));
  EXPECT_THAT(error(depth + goal + "\"pmax_MPa\"\namplitudes_mm = [3]\n"), HasSubstr("has no amplitudes"));
  const std::string load = "[[design.parameters]]\nkey = \"wheelset.vertical_force_N\"\nfrom = 70e3\nto = 90e3\n";
  EXPECT_THAT(error(load + goal + "\"removed_mm2\"\n"), HasSubstr("of a depth, and none is sought"));
  const auto sought = [](const char* key, const char* from, const char* to) {
    return fmt::format("[[design.parameters]]\nkey = \"{}\"\nfrom = {}\nto = {}\n", key, from, to);
  };
  const std::string pmax = goal + "\"pmax_MPa\"\n";
  EXPECT_THAT(error(sought("wheelset.vertical_force_N", "10e3", "20e3") + pmax), HasSubstr("is not between"));
  EXPECT_THAT(error(sought("rail.squats.0.depth_mm", "0.1", "1") + pmax), HasSubstr("is not given by the base"));
  EXPECT_THAT(error(sought("rail.shape.standard", "0", "1") + pmax), HasSubstr("bad.toml:"));
  EXPECT_THAT(
      error(sought("wheelset.y_mm", "-1", "1") + "[[design.vary]]\nkey = \"wheelset.y_mm\"\nvalues = [0, 1]\n" + pmax),
      HasSubstr("not the same in all positions"));
  EXPECT_THAT(error("[design.depth]\nfrom_mm = -10\nto_mm = 190\nstep_mm = 10\nmost_mm = [0.2]\n" + pmax),
              HasSubstr("there is no rail at y ="));
  EXPECT_THAT(error("[design.depth]\nfrom_mm = -30\nto_mm = 30\nstep_mm = 60\nmost_mm = [0.2]\n" + goal +
                    "\"convexity_1_per_m\"\n"),
              HasSubstr("convexity there is not known"));
  EXPECT_THAT(error("[[design.vary]]\nkey = \"rail.shape.standard\"\nvalues = [\"60E1\", \"60E2\"]\n" + depth + pmax),
              HasSubstr("different surfaces of the rail"));
  DesignOptions options{folder.path() / "out", {}};
  const io::DesignFile few = io::read_design_file(folder.write(
      "few.toml", base + "[[cases]]\nwheelset.y_mm = [0, 1, 2]\n[design]\nsolutions = 2\n" + depth + pmax));
  EXPECT_THROW(run_design(few, options), Error);
}

}  // namespace
}  // namespace treadmark::app
