// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/uncertainty.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/app/surfaces/surface_store.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/random.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/results/derivative_table.hpp"
#include "treadmark/io/results/read_hdf5.hpp"
#include "treadmark/io/results/write_hdf5.hpp"
#include "treadmark/io/results/write_json.hpp"
#include "treadmark/model/shape/surface_errors.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/support/parts.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;
using Number = io::CaseUncertainty::Number;

std::string known_to(const std::string& key, const std::string& sigma, const std::string& more = {}) {
  return fmt::format("[[case.uncertainty]]\nkey = \"{}\"\nsigma = {}\n{}", key, sigma, more);
}

io::CaseUncertainty uncertainty_of_text(const std::string& text) {
  const io::RunResult run = run_cases(io::parse_case_text(text, "case.toml"));
  EXPECT_TRUE(run.cases.at(0).uncertainty.has_value());
  return run.cases[0].uncertainty.value_or(io::CaseUncertainty{});
}

Number number_named(const io::CaseUncertainty& u, const std::string& name) {
  for (const Number& one : u.numbers)
    if (one.name == name) return one;
  ADD_FAILURE() << "no " << name << ": " << u.message;
  return {};
}

/// A cylinder on the crown of a rail: z is the approach, and what Hertz found are powers of it.
std::string on_the_crown(double z_mm) {
  return fmt::format(R"([wheel]
shape.start_y_mm = -60
shape.arcs = [{{ length_mm = 120, curvature_per_m = 0 }}]
[rail]
shape.standard = "60E1"
[track]
cant_rad = 0.0
[wheelset]
y_mm = 0
z_mm = {}
velocity_m_s = 2
vpitch_rad_s = -4.3478
[friction]
coefficient = 0.3
[discretisation]
dx_mm = 0.5
ds_mm = 0.5
[solver]
tolerance = 1e-8
)",
                     z_mm);
}

TEST(Uncertainty, IsThatOfHertzFormulas) {
  const io::CaseUncertainty u = uncertainty_of_text(on_the_crown(0.06) + known_to("wheelset.z_mm", "0.001") +
                                                    known_to("friction.coefficient", "0.01"));
  ASSERT_EQ(u.message, "");
  ASSERT_EQ(u.sources.size(), 2u);
  EXPECT_EQ(u.checked, 8);
  constexpr double kElements = 0.02;  // derivatives are those of elements in contact
  const Number force = number_named(u, "patch_1.fn_N"), pressure = number_named(u, "patch_1.pmax_MPa");
  EXPECT_NEAR(force.sigma, 1.5 * force.value / 0.06 * 0.001, kElements * force.sigma);
  EXPECT_NEAR(pressure.sigma, 0.5 * pressure.value / 0.06 * 0.001, kElements * pressure.sigma);
  EXPECT_FALSE(force.sampled);
  // elements are counted in the eight solutions that derivatives are held to
  const Number elements = number_named(u, "patch_1.elements.ncon");
  EXPECT_TRUE(elements.sampled);
  EXPECT_NEAR(elements.sigma, elements.value / 0.06 * 0.001, 0.7 * elements.sigma);
  EXPECT_NEAR(force.shares.at(0), 1.0, 1e-6);
  EXPECT_EQ(io::dominant_source(u, force), "100 % wheelset.z_mm");
  const std::string text = io::uncertainty_text(u);
  EXPECT_THAT(text, HasSubstr(fmt::format("{:.0f}00 +- {:.0f}00", force.value / 100.0, force.sigma / 100.0))) << text;
}

/// The wheel may be in the air: contact of what is left follows from the formula, too.
TEST(Uncertainty, IsSampledWhereContactIsLost) {
  constexpr double kSpread = 0.9;  // of the approach
  const io::CaseUncertainty u = uncertainty_of_text(on_the_crown(0.02) + known_to("wheelset.z_mm", "0.018"));
  ASSERT_EQ(u.message, "");
  EXPECT_EQ(u.samples, 200);
  EXPECT_THAT(u.why, HasSubstr("contact comes or goes"));
  EXPECT_NEAR(u.others, 200 * 0.1333, 19.0);  // four deviations of such a count
  double weight = 0.0, first = 0.0, second = 0.0;
  for (double t = -1.0 / kSpread; t < 8.0; t += 1e-3) {
    const double density = std::exp(-0.5 * t * t), power = std::pow(std::max(0.0, 1.0 + kSpread * t), 1.5);
    weight += density, first += density * power, second += density * power * power;
  }
  const double spread = std::sqrt(second / weight - std::pow(first / weight, 2));
  const Number force = number_named(u, "patch_1.fn_N");
  EXPECT_TRUE(force.sampled);
  EXPECT_NEAR(force.sigma / force.value, spread, 0.2 * spread);
  EXPECT_THAT(io::uncertainty_text(u), HasSubstr("(sampled)"));
}

TEST(Uncertainty, IsThatOfSolutionsDrawnAtRandom) {
  constexpr double kForce = 4e3, kPlace = 0.05;
  constexpr int kDrawn = 120;
  const std::string text = treadmark::testing::standard_case("1.0");
  const std::string known =
      "[case]\n" + known_to("wheelset.vertical_force_N", "4e3") + known_to("wheelset.y_mm", "0.05");
  const std::string heading = "[wheelset]\n";
  const auto with = [&](const std::string& more) {
    std::string whole = text;
    whole.insert(whole.find(heading) + heading.size(), "y_mm = 2\n");
    return whole + more;
  };
  const io::CaseUncertainty u = uncertainty_of_text(with(known));
  ASSERT_EQ(u.message, "");
  Random random(7);
  const auto normal = [&] {
    double sum = -6.0;
    for (int i = 0; i < 12; ++i) sum += random.uniform();
    return sum;
  };
  std::string cases;
  for (int i = 0; i < kDrawn; ++i) {
    const double force = 80e3 + kForce * normal(), place = 2.0 + kPlace * normal();  // in this order
    cases += fmt::format("[[cases]]\nwheelset.vertical_force_N = {}\nwheelset.y_mm = {}\n", force, place);
  }
  const io::RunResult run = run_cases(io::parse_case_text(with(cases), "case.toml"));
  const auto spread = [&](double (*of)(const io::CaseResult&)) {
    double first = 0.0, second = 0.0;
    for (const io::CaseResult& c : run.cases) first += of(c) / kDrawn, second += of(c) * of(c) / kDrawn;
    return std::sqrt(second - first * first);
  };
  constexpr double kFew = 0.25;  // four deviations of what so few draws tell
  const double pressure = spread([](const io::CaseResult& c) { return 1e-6 * c.patches.at(0).pmax; });
  const double lateral = spread([](const io::CaseResult& c) { return c.force_tr.y(); });
  const Number by_derivatives = number_named(u, "patch_1.pmax_MPa"), bent = number_named(u, "force_on_rail.fy_tr_N");
  EXPECT_FALSE(by_derivatives.sampled);
  EXPECT_NEAR(by_derivatives.sigma, pressure, kFew * pressure);
  EXPECT_TRUE(bent.sampled) << "elements so large give it another slope at every place";
  EXPECT_NEAR(bent.sigma, lateral, kFew * lateral);
}

/// Heights that are alike over all of the head move the wheel with them, but not where the rail is placed by its top.
TEST(Uncertainty, OfHeightsReachesThePlace) {
  const std::string by_gauge = treadmark::testing::standard_case("1.0"), track = "[track]\n",
                    alike = "[case]\n" + known_to("rail.shape", "0.01", "length_mm = 2000\n");
  std::string text = by_gauge;
  text.insert(text.find(track) + track.size(), "rail_y_mm = 753.5\nrail_z_mm = 0\n");
  const io::CaseUncertainty u = uncertainty_of_text(text + alike), placed = uncertainty_of_text(by_gauge + alike);
  ASSERT_EQ(u.message, "");
  EXPECT_NEAR(number_named(u, "wheelset.z_mm").sigma, 0.01, 5e-4);
  EXPECT_LT(number_named(placed, "wheelset.z_mm").sigma, 1e-3);
  const io::CaseUncertainty rough =
      uncertainty_of_text(text + "[case]\n" + known_to("rail.shape", "0.0001", "length_mm = 1\n"));
  ASSERT_EQ(rough.message, "");
  EXPECT_GT(number_named(rough, "patch_1.pmax_MPa").sigma, 0.0);
  EXPECT_LT(number_named(rough, "wheelset.z_mm").sigma, 1e-4) << "the mean of several places";
}

/// A rail that its import left uncertain, in place of the 60E1 of cases that say where it lies.
io::RunResult run_on_imported(const std::string& text, const std::vector<SurfaceErrors::Motion>& motions,
                              const std::vector<SurfaceErrors::Field>& fields = {}) {
  auto errors = std::make_shared<SurfaceErrors>();
  errors->y = {-30e-3, 30e-3}, errors->z = {10e-3, 10e-3};
  errors->u = {0.0}, errors->draws = {{0.0, 0.0}};
  errors->motions = motions, errors->fields = fields;
  auto rail = std::make_shared<NaturalSurface>(create_natural({Body::rail, 0.0, StandardProfile{"60E1"}, {}}));
  rail->spec.errors = std::move(errors);
  const io::CaseFile file = io::parse_case_text(text, "case.toml");
  SurfaceStore store;
  store.put(std::get<io::WheelRailCase>(file.cases.at(0).content).rail, Body::rail, 0.0, rail);
  return run_cases(file, store);
}

/// Upright, so that its own axes are those of the track.
std::string on_placed_rail(const std::string& more = {}) {
  std::string text = treadmark::testing::standard_case("1.0");
  const std::string track = "[track]\ncant = \"1:40\"\n";
  text.replace(text.find(track), track.size(), "[track]\ncant_rad = 0\nrail_y_mm = 753.5\nrail_z_mm = 0\n");
  return text + more;
}
const std::string kAsked = "[case]\nerror_bars = \"always\"\n";

/// Where the surface lies in its own axes is as uncertain as where these lie in those of the track.
TEST(Uncertainty, OfAnImportIsThatOfTheSamePlace) {
  struct Pair {
    SurfaceErrors::Motion motion;
    const char *key, *sigma, *name;
  };
  for (const Pair& pair :
       {Pair{{ErrorSource::lateral, 0.02e-3, 0.0, 0.0}, "track.rail_y_mm", "0.02", "lateral placement of the rail"},
        Pair{{ErrorSource::height, 0.0, 0.01e-3, 0.0}, "track.rail_z_mm", "0.01", "height of the rail"},
        Pair{{ErrorSource::tilt, 0.0, 0.0, 1e-4}, "track.cant_rad", "1e-4", "tilt of the rail"}}) {
    const io::RunResult run = run_on_imported(on_placed_rail(kAsked), {pair.motion});
    ASSERT_TRUE(run.cases.at(0).uncertainty) << pair.name;
    const io::CaseUncertainty& found = *run.cases[0].uncertainty;
    const io::CaseUncertainty same = uncertainty_of_text(on_placed_rail(known_to(pair.key, pair.sigma)));
    ASSERT_EQ(found.message, "") << pair.name;
    ASSERT_EQ(found.sources.size(), 2u);
    EXPECT_EQ(found.sources[1].name, pair.name);
    int compared = 0;
    for (const char* name : {"wheelset.z_mm", "patch_1.pmax_MPa", "patch_1.approach_mm", "patch_1.fn_N"}) {
      const Number here = number_named(found, name), there = number_named(same, name);
      if (here.sampled || there.sampled) continue;
      ++compared;
      EXPECT_NEAR(here.sigma, there.sigma, 0.02 * there.sigma + 1e-6 * std::abs(there.value))
          << pair.key << ' ' << name;
      if (here.sigma > 1e-5 * std::abs(here.value)) {
        EXPECT_THAT(io::dominant_source(found, here), HasSubstr(pair.name));
      }
    }
    EXPECT_GT(compared, 0) << pair.name;
  }
}

TEST(Uncertainty, OfHeightsThatAreAlikeIsThatOfTheRail) {
  const io::RunResult run =
      run_on_imported(on_placed_rail(kAsked), {}, {{ErrorSource::registration, 10.0, {{2e-6, 2e-6}}}});
  ASSERT_TRUE(run.cases.at(0).uncertainty);
  const io::CaseUncertainty& found = *run.cases[0].uncertainty;
  ASSERT_EQ(found.message, "");
  EXPECT_NEAR(number_named(found, "wheelset.z_mm").sigma, 2e-3, 1e-4);
  EXPECT_NEAR(found.sources.at(1).sigma, 2e-3, 2e-4);
}

TEST(Uncertainty, IsAskedForOrNot) {
  const std::vector<SurfaceErrors::Motion> motions{{ErrorSource::height, 0.0, 1e-6, 0.0}};
  const auto known = [&](const std::string& more) {
    int count = 0;
    for (const io::CaseResult& one : run_on_imported(on_placed_rail(more), motions).cases)
      count += one.uncertainty ? 1 : 0;
    return count;
  };
  const std::string three = "[[cases]]\nwheelset.y_mm = [0, 1, 2]\n";
  EXPECT_EQ(known({}), 0) << "they cost dozens of solutions";
  EXPECT_EQ(known(kAsked + three), 3);
  EXPECT_EQ(known("[case]\n" + known_to("wheelset.vertical_force_N", "1e3")), 1);
  EXPECT_EQ(known("[case]\nerror_bars = \"never\"\n"), 0);
  EXPECT_EQ(known("[case]\nerror_bars = \"never\"\n" + known_to("wheelset.vertical_force_N", "1e3")), 0);
  const io::CaseUncertainty nothing = uncertainty_of_text(on_placed_rail(kAsked));
  EXPECT_THAT(nothing.message, HasSubstr("nothing says how well"));
  EXPECT_FALSE(run_cases(io::parse_case_text(on_placed_rail(), "case.toml")).cases.at(0).uncertainty);
}

TEST(Uncertainty, IsReadBackFromHdf5) {
  TREADMARK_NEEDS("hdf5");
  const treadmark::testing::TemporaryFolder folder;
  const io::RunResult run =
      run_cases(io::parse_case_text(on_the_crown(0.06) + known_to("wheelset.z_mm", "0.001"), "case.toml"));
  io::write_hdf5(folder.path() / "fields.h5", run);
  const io::CaseResult back = io::read_hdf5(folder.path() / "fields.h5").cases.at(0);
  ASSERT_TRUE(back.uncertainty);
  EXPECT_EQ(io::uncertainty_text(*back.uncertainty), io::uncertainty_text(*run.cases.at(0).uncertainty));
  EXPECT_EQ(back.uncertainty->numbers.size(), run.cases[0].uncertainty->numbers.size());
}

/// Representations are off by as many deviations as the reference is known to.
TEST(Uncertainty, ScalesComparisons) {
  const io::CaseFile file = io::parse_case_text(
      treadmark::testing::standard_case("1.0") + known_to("wheelset.vertical_force_N", "4e3"), "case.toml");
  CompareSettings settings;
  settings.backends = {"spline"};
  settings.resolutions = {1e-3};
  const io::Comparison found = compare_cases(file, settings);
  ASSERT_EQ(found.candidates.size(), 2u);
  const io::CaseResult& reference = found.candidates[0].results.at(0);
  ASSERT_TRUE(reference.uncertainty);
  EXPECT_FALSE(found.candidates[1].results.at(0).uncertainty) << "error bars are those of the reference";
  const Number pressure = number_named(*reference.uncertainty, "patch_1.pmax_MPa");
  const io::ComparisonRow& row = found.candidates[1].rows.at(0);
  ASSERT_GT(pressure.sigma, 0.0);
  EXPECT_NEAR(row.pmax_sigmas, 1e-6 * (row.pmax - reference.patches.at(0).pmax) / pressure.sigma,
              1e-9 * std::abs(row.pmax_sigmas));
}

TEST(Uncertainty, DoesNotDependOnThreads) {
  const std::string text = on_the_crown(0.02) + known_to("wheelset.z_mm", "0.016");
  std::vector<std::vector<double>> found;
  for (const int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    auto& sigmas = found.emplace_back();
    for (const Number& one : uncertainty_of_text(text).numbers) sigmas.push_back(one.sigma);
  }
  for (std::size_t k = 0; k < found[0].size(); ++k)
    EXPECT_TRUE(found[0][k] == found[1][k] || std::isnan(found[0][k])) << k;
}

TEST(Uncertainty, WithoutDerivativesIsSampled) {
  // errors of the same number that are independent of each other
  const io::CaseUncertainty u =
      uncertainty_of_text(on_the_crown(0.06) + "tangential_model = \"fastsim\"\n" +
                          known_to("wheelset.z_mm", "0.0006") + known_to("wheelset.z_mm", "0.0008"));
  ASSERT_EQ(u.message, "");
  EXPECT_THAT(u.why, HasSubstr("full theory"));
  const Number force = number_named(u, "patch_1.fn_N");
  EXPECT_NEAR(force.sigma, 1.5 * force.value / 0.06 * 0.001, 0.2 * force.sigma);
  EXPECT_NEAR(force.shares.at(0), 0.36, 0.15);
  EXPECT_NEAR(force.shares.at(1), 0.64, 0.15);
}

TEST(Uncertainty, RefusesWhatMakesNoSense) {
  for (const std::string& wrong :
       {known_to("wheelset.vertical_force_N", "1"), known_to("wheelset.z", "1"), known_to("wheelset.z_mm", "-1"),
        known_to("rail.shape", "0.01"), known_to("wheelset.z_mm", "0.01", "length_mm = 3\n"),
        std::string("[[case.uncertainty]]\nkey = \"wheelset.z_mm\"\n")})
    EXPECT_THROW(io::parse_case_text(on_the_crown(0.06) + wrong, "case.toml"), Error) << wrong;
  const io::CaseUncertainty many =
      uncertainty_of_text(on_the_crown(0.06) + known_to("rail.shape", "0.01", "length_mm = 0.001\n"));
  EXPECT_THAT(many.message, HasSubstr("too many"));
  EXPECT_THAT(io::uncertainty_text(many), HasSubstr("none: "));
}

TEST(Uncertainty, ReachesFilesAndTheTerminal) {
  const treadmark::testing::SampleInput input;
  input.write("crown.toml", on_the_crown(0.06) + known_to("wheelset.z_mm", "0.001"));
  const std::string file = (input.folder() / "crown.toml").string(), folder = (input.folder() / "out").string();
  const auto run = treadmark::testing::run_program({"run", file, "-o", folder});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("% wheelset.z_mm"));
  const auto json = nlohmann::json::parse(input.read("out/result.json"));
  const auto schema = nlohmann::json::parse(io::result_schema());
  EXPECT_EQ(treadmark::testing::first_violation(json, schema, schema), "");
  const auto& uncertainty = json.at("cases").at(0).at("uncertainty");
  EXPECT_EQ(uncertainty.at("sources").size(), 1u);
  EXPECT_EQ(uncertainty.at("numbers").at(0).at("shares").size(), 1u);
}

}  // namespace
}  // namespace treadmark::app
