// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/case_derivatives.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/results/derivative_table.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"

namespace treadmark::app {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

io::RunResult with_derivatives(const std::string& text, const std::vector<std::string>& keys) {
  const io::CaseFile file = io::parse_case_text(text, "case.toml");
  SurfaceStore store;
  io::RunResult run = run_cases(file, store);
  add_derivatives(run, file, store, keys);
  return run;
}

double derivative(const io::CaseDerivatives& all, const std::string& number, const std::string& key) {
  for (std::size_t k = 0; k < all.parameters.size(); ++k)
    for (const io::CaseDerivatives::Number& n : all.numbers)
      if (all.parameters[k].key == key && n.name == number) return n.by[k];
  ADD_FAILURE() << "no " << number << " by " << key;
  return std::nan("");
}

/// The wheel stands on its flat, 16 mm beside the middle.
const std::string kOnTheFlat =
    treadmark::testing::standard_case("1.0", treadmark::testing::kWheelWithFlat, "[solver]\ntolerance = 1e-9\n") +
    "[[cases]]\nwheelset.pitch_deg = 2\n";

double pmax_with(const std::string& change) {
  io::CaseFile file = io::parse_case_text(kOnTheFlat, "case.toml");
  const std::vector<std::string> changes{change};
  io::apply_overrides(file, changes);
  const io::RunResult run = run_cases(file);
  return 1e-6 * run.cases.at(0).patches.at(0).pmax;
}

TEST(CaseDerivatives, AreThoseOfWholeRuns) {
  const io::RunResult run =
      with_derivatives(kOnTheFlat, {"wheelset.vertical_force_N", "wheel.flats.0.depth_mm", "wheelset.y_mm"});
  ASSERT_TRUE(run.cases.at(0).derivatives);
  const io::CaseDerivatives& d = *run.cases[0].derivatives;
  ASSERT_EQ(d.message, "");
  ASSERT_EQ(d.parameters.size(), 3u);
  EXPECT_EQ(d.parameters[0].value, 80e3);
  EXPECT_EQ(d.parameters[1].value, 0.3);
  EXPECT_FALSE(d.parameters[0].of_surfaces);
  EXPECT_TRUE(d.parameters[1].of_surfaces);
  for (const auto& p : d.parameters) EXPECT_EQ(p.left_out, "") << p.key;
  constexpr double kSame = 1e-3;  // elements come and go within the steps
  const double by_load =
      (pmax_with("wheelset.vertical_force_N=80040") - pmax_with("wheelset.vertical_force_N=79960")) / 80.0;
  EXPECT_NEAR(derivative(d, "patch_1.pmax_MPa", "wheelset.vertical_force_N"), by_load, kSame * std::abs(by_load));
  const double by_depth =
      (pmax_with("wheel.flats.0.depth_mm=0.3001") - pmax_with("wheel.flats.0.depth_mm=0.2999")) / 0.0002;
  EXPECT_NEAR(derivative(d, "patch_1.pmax_MPa", "wheel.flats.0.depth_mm"), by_depth, kSame * std::abs(by_depth));
  EXPECT_NEAR(derivative(d, "force_on_rail.fz_tr_N", "wheelset.vertical_force_N"), 1.0, 1e-6);
  EXPECT_NEAR(derivative(d, "force_on_rail.fz_tr_N", "wheelset.y_mm"), 0.0, 1.0);
  EXPECT_THAT(d.without, Contains("elements.ncon"));
}

/// The amount of the one flat is its depth over 0.3 mm. A wheel that is out of round too has its flats displaced.
TEST(CaseDerivatives, ByTheSurfacesOwnParametersAgreeWithThoseByTheFile) {
  const std::string waves = "[[wheel.polygonizations]]\nharmonics = [{ order = 3, amplitude_um = 20 }]\n";
  const std::string out_of_round =
      treadmark::testing::standard_case("1.0", treadmark::testing::kWheelWithFlat + waves) +
      "[[cases]]\nwheelset.pitch_deg = 2\n";
  const io::RunResult run = with_derivatives(out_of_round, {"wheel.flats.0.depth_mm", "wheel.shape", "rail.shape"});
  ASSERT_TRUE(run.cases.at(0).derivatives);
  const io::CaseDerivatives& d = *run.cases[0].derivatives;
  ASSERT_EQ(d.message, "");
  std::vector<std::string> keys;
  for (const io::CaseDerivatives::Parameter& p : d.parameters) {
    keys.push_back(p.key);
    EXPECT_EQ(p.left_out, "") << p.key;
    EXPECT_EQ(p.of_surfaces, p.key != "wheel.shape_0" && p.key != "wheel.shape_1") << p.key << ": else exact";
  }
  for (const char* key : {"wheel.piece_0_bend_per_m", "wheel.shape_0", "wheel.shape_1",
                          "rail.segment_0_curvature_per_m", "rail.segment_0_length_mm"})
    EXPECT_THAT(keys, Contains(key));
  const double by_depth = derivative(d, "patch_1.pmax_MPa", "wheel.flats.0.depth_mm");
  constexpr double kDifferences = 1e-4;
  EXPECT_NEAR(derivative(d, "patch_1.pmax_MPa", "wheel.shape_0"), 0.3 * by_depth, kDifferences * std::abs(by_depth));
}

TEST(CaseDerivatives, SayWhatIsLeftOut) {
  const io::RunResult run =
      with_derivatives(treadmark::testing::standard_case("1.0") + "[solver]\ntangential_model = \"fastsim\"\n", {});
  ASSERT_TRUE(run.cases.at(0).derivatives);
  EXPECT_THAT(run.cases[0].derivatives->message, HasSubstr("full theory"));
  EXPECT_THAT(io::derivatives_text(*run.cases[0].derivatives), HasSubstr("none: "));
  EXPECT_THROW(with_derivatives(kOnTheFlat, {"wheelset.z_mm"}), Error) << "the force is given";
  EXPECT_THROW(with_derivatives(kOnTheFlat, {"wheelset.y"}), Error);
  EXPECT_THROW(with_derivatives(kOnTheFlat, {"wheel.flats.1.depth_mm"}), Error);
  EXPECT_THROW(with_derivatives(kOnTheFlat, {"rail.shape.standard"}), Error);
  const io::RunResult other =
      with_derivatives(kOnTheFlat, {"discretisation.dx_mm", "wheelset.y_mm", "material.rail_shear_modulus_GPa"});
  const io::CaseDerivatives& d = *other.cases.at(0).derivatives;
  EXPECT_THAT(d.parameters.at(0).left_out, HasSubstr("not known"));
  EXPECT_EQ(d.parameters.at(1).left_out, "");
  EXPECT_NE(d.parameters.at(2).left_out, "") << "steps are not lost in rounding";
  EXPECT_TRUE(std::isnan(derivative(d, "patch_1.pmax_MPa", "discretisation.dx_mm")));
}

TEST(CaseDerivatives, NumbersOfACaseByTheirKeys) {
  const io::Case c = io::parse_case_text(kOnTheFlat, "case.toml").cases.front();
  EXPECT_EQ(io::number_of(c, "wheelset.vertical_force_N"), 80e3);
  EXPECT_EQ(io::number_of(c, "wheel.flats.0.length_mm"), 60.0);
  EXPECT_FALSE(io::number_of(c, "wheelset.z_mm"));
  EXPECT_FALSE(io::number_of(c, "track.rail_y_mm"));
  EXPECT_FALSE(io::number_of(c, "wheel.flats.3.length_mm"));
  EXPECT_THROW(io::number_of(c, "wheel.flats.0.shape"), Error);
  EXPECT_THROW(io::number_of(c, "wheel.flats.0.deepness_mm"), Error);
  EXPECT_THROW(io::number_of(c, "wheel.backend"), Error);
}

TEST(CaseDerivatives, ReachFilesAndTheTerminal) {
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", kOnTheFlat);
  const std::string file = (input.folder() / "flat.toml").string(), folder = (input.folder() / "out").string();
  const auto run = treadmark::testing::run_program({"run", file, "--sensitivities", "-o", folder});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("derivatives by what is given"));
  EXPECT_THAT(run.out, HasSubstr("wheelset.yaw_rad"));
  const auto json = nlohmann::json::parse(input.read("out/result.json"));
  const auto& derivatives = json.at("cases").at(0).at("derivatives");
  const std::size_t count = derivatives.at("by").size();
  EXPECT_GT(count, 5u);
  for (const auto& number : derivatives.at("numbers")) EXPECT_EQ(number.at("by").size(), count);
  const std::string table = input.read("out/derivatives.csv");
  EXPECT_THAT(table, HasSubstr("case,number,wheelset.y_mm,"));
  EXPECT_THAT(table, HasSubstr("\n1,patch_1.pmax_MPa,"));

  ASSERT_EQ(treadmark::testing::run_program({"run", file, "-o", folder}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(input.folder() / "out/derivatives.csv")) << "of an earlier run";
  const auto wrong = treadmark::testing::run_program({"run", file, "--sensitivities", "--by", "wheelset.ymm"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_THAT(wrong.err, HasSubstr("wheelset.y_mm"));
  EXPECT_EQ(treadmark::testing::run_program({"run", file, "--by", "wheelset.y_mm"}).status, 2);
}

}  // namespace
}  // namespace treadmark::app
