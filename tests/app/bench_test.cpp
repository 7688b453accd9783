// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>

#include "treadmark/app/bench/bench_case.hpp"
#include "treadmark/app/bench/bench_pair.hpp"
#include "treadmark/app/bench/bench_report.hpp"
#include "treadmark/app/bench/bench_surfaces.hpp"
#include "treadmark/app/bench/check_surface.hpp"
#include "treadmark/app/bench/machine.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/conformance/wrong_backends.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"
#include "treadmark/tests/support/file_content.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using nlohmann::json;
using ::testing::HasSubstr;
using treadmark::testing::run_program;

constexpr BenchGrid kSmall{0.5e-3, 3000};
const char* kTimes[] = {"build_s",       "ns_per_height", "ns_per_height_tilted", "ns_per_normal", "search_cold_s",
                        "search_warm_s", "distance_s"};

BenchSettings small_settings(std::vector<std::string> backends) {
  BenchSettings settings;
  settings.backends = std::move(backends);
  settings.resolutions = {2e-3};
  settings.seconds_per_measure = 1e-3;
  settings.grid = kSmall;
  return settings;
}

json parsed(const std::string& text) {
  const json document = json::parse(text);
  const json schema = json::parse(bench_schema());
  EXPECT_EQ(treadmark::testing::first_violation(document, schema, schema), "");
  return document;
}

TEST(BenchSchema, IsMadeOfItsRows) {
  const json schema = json::parse(bench_schema()), row = schema["properties"]["rows"]["items"];
  treadmark::testing::expect_rows<BenchRow>(row);
  EXPECT_EQ(row["properties"].size(), columns<BenchRow>().size());
  EXPECT_EQ(row["properties"]["body"]["enum"], json({"rail", "wheel"}));
}

/// A surface with an error that no height of its own gives away.
class Wrong final : public treadmark::testing::WrongSurface {
 public:
  enum class Fault { raised, slopes, hole, grids, grids_a_little };
  Wrong(std::shared_ptr<const Surface> other, Fault fault)
      : WrongSurface(std::move(other), "wrong", 1.0, 1.0), fault_(fault) {}

 private:
  void do_heights(const PlaneGrid& plane, const HeightsOut& out) const override {
    right_->heights(plane, out);
    const Grid2& g = plane.grid;
    if (fault_ == Fault::raised)
      for (double& z : out.z) z += 3e-4;
    const double off = fault_ == Fault::grids ? 1e-7 : fault_ == Fault::grids_a_little ? 3e-9 : 0.0;
    if (g.size() > 1)
      for (double& z : out.z) z += off;
    if (fault_ == Fault::slopes)
      for (double& slope : out.dzdy) slope += 0.01;
    if (fault_ == Fault::hole && g.size() > 1)
      for (const auto& values : {out.z, out.dzdx, out.dzdy})
        if (!values.empty()) values[g.index(g.nx / 2, g.ny / 2)] = NAN;
  }

  Fault fault_;
};

TEST(Bench, AgreesAndHasTimesInEveryBackend) {
  const BenchReport report = bench_surfaces(bench_case(), small_settings({}));
  EXPECT_TRUE(report.complete);
  EXPECT_TRUE(report.agrees());
  EXPECT_EQ(report.truth, "analytic");
  ASSERT_EQ(report.rows.size(),
            2 * backend_names().size());  // rail and wheel, formulas once, the others at one resolution
  for (const BenchRow& row : report.rows) {
    SCOPED_TRACE(row.backend + " " + row.reason);
    EXPECT_GT(row.height, 0.0);
    EXPECT_GT(row.search_warm, 0.0);
    EXPECT_EQ(row.patches, 1);
    EXPECT_EQ(row.backend == "analytic", row.difference == 0.0);
    EXPECT_EQ(row.backend.starts_with("offset"), std::isfinite(row.base_height));
  }
  const json document = parsed(bench_json(report));
  for (const json& row : document["rows"]) {
    EXPECT_EQ(row["agrees"], true);
    for (const char* key : kTimes) EXPECT_GT(row[key].get<double>(), 0.0) << row["backend"] << key;
  }
}

TEST(Bench, WhatDisagreesSaysWhyAndHasNoTimes) {
  const BenchScene scene = make_bench_scene(bench_case(), kSmall);
  const auto always = [](const std::string&) { return true; };
  for (const auto& [fault, words] : {std::pair{Wrong::Fault::raised, "from the surface as given"},
                                     {Wrong::Fault::slopes, "slopes differ"},
                                     {Wrong::Fault::hole, "no height where there is a surface"},
                                     {Wrong::Fault::grids, "from its own single heights"}}) {
    BenchPair pair{"wrong", 2e-3, scene.rail->surface, std::make_shared<Wrong>(scene.wheel->surface, fault), 1.0, 1.0};
    const auto rows = measure_pair(scene, pair, 1e-3, always);
    ASSERT_TRUE(rows.has_value());
    EXPECT_TRUE((*rows)[0].agrees);
    EXPECT_FALSE((*rows)[1].agrees);
    EXPECT_THAT((*rows)[1].reason, HasSubstr(words));
    EXPECT_TRUE(std::isnan((*rows)[0].search_cold));  // the pair cannot be searched with a wrong wheel

    BenchReport report;
    report.libraries = library_versions();
    report.rows.assign(rows->begin(), rows->end());
    EXPECT_FALSE(report.agrees());
    const json row = parsed(bench_json(report))["rows"][1];
    EXPECT_EQ(row["agrees"], false);
    for (const char* key : kTimes) EXPECT_TRUE(row[key].is_null()) << key;
    EXPECT_THAT(bench_table(report), HasSubstr("does not agree: "));
    EXPECT_THAT(bench_markdown(report), HasSubstr("| wrong | 2 | wheel | NO | - |"));
    EXPECT_THAT(bench_svg(report), HasSubstr("does not agree"));
  }
}

TEST(Bench, DistancesThatDisagreeTakeTheTimesOfBothBodies) {
  const BenchScene scene = make_bench_scene(bench_case(), kSmall);
  // less than what a coarse mesh may change with the direction of sight, but the same direction asked for in two ways
  const BenchPair pair{
      "wrong", 2e-3, scene.rail->surface, std::make_shared<Wrong>(scene.wheel->surface, Wrong::Fault::grids_a_little),
      1.0,     1.0};
  const auto rows = measure_pair(scene, pair, 1e-3, [](const std::string&) { return true; });
  ASSERT_TRUE(rows.has_value());
  for (const BenchRow& row : *rows) {
    EXPECT_FALSE(row.agrees);
    EXPECT_THAT(row.reason, HasSubstr("undeformed distance: "));
    EXPECT_TRUE(std::isnan(row.height));
    EXPECT_TRUE(std::isnan(row.build));
    EXPECT_EQ(row.patches, -1);
  }
}

TEST(Bench, SurfacesAsGivenMustBeEqualSampledOnesWithinChords) {
  EXPECT_EQ(representation_limit(0.0, 80.0), 1e-9);
  // twice the chord's height h^2/8 times the curvature, and rounding
  EXPECT_NEAR(representation_limit(1e-3, 80.0), 2e-5 + 5e-8, 1e-12);
  const BenchScene scene = make_bench_scene(bench_case(), kSmall);
  const auto flat = represent(*scene.wheel, {"mesh-flat", 2e-3, scene.regions.wheel}).surface;
  EXPECT_EQ(check_surface(*flat, scene.wheel_view, 2e-3).reason, "");
  EXPECT_THAT(check_surface(*flat, scene.wheel_view, 0.2e-3).reason, HasSubstr("from the surface as given"));
  EXPECT_THAT(check_surface(*flat, scene.wheel_view, 0.0).reason, HasSubstr("from the surface as given"));
}

TEST(Bench, WhatCannotBeBuiltIsARow) {
  const treadmark::testing::SampleInput input;  // measured points: no formula
  const auto result = run_program({"bench", input.inp().string(), "--backends", "analytic", "--json", "-", "--quiet"});
  EXPECT_EQ(result.status, 1);
  const json document = parsed(result.out);
  ASSERT_EQ(document["rows"].size(), 2u);
  EXPECT_EQ(document["rows"][0]["agrees"], false);
  EXPECT_THAT(document["rows"][0]["reason"].get<std::string>(), HasSubstr("needs a formula"));
  EXPECT_TRUE(document["rows"][1]["build_s"].is_null());
}

TEST(Bench, StopsBetweenMeasures) {
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  std::size_t last = 0;
  progress.report = [&](std::size_t finished, std::size_t total, const std::string& what) {
    EXPECT_LT(finished, total);
    EXPECT_GE(finished, last);
    last = finished;
    if (what == "offset 2 mm, wheel, heights") stop = true;
  };
  const BenchReport report = bench_surfaces(bench_case(), small_settings({"spline", "offset", "nurbs"}), progress);
  EXPECT_FALSE(report.complete);
  ASSERT_EQ(report.rows.size(), 2u);
  EXPECT_EQ(report.rows[1].backend, "spline");
  EXPECT_THAT(bench_table(report), HasSubstr("interrupted"));
}

TEST(Bench, ThePageOfFiguresHasTheColumnsOfTheTable) {
  const std::string page = treadmark::testing::content_of(TREADMARK_SOURCE_DIR "/docs/bench.md");
  std::string table = bench_markdown({});
  table.erase(0, table.find("\n\n") + 2);  // the machine
  EXPECT_THAT(page, HasSubstr(table));
  for (const std::string_view backend : backend_names())
    EXPECT_THAT(page, HasSubstr("| " + std::string(backend) + " | "));
}

TEST(Bench, MedianOfRepeats) {
  int calls = 0;
  EXPECT_GE(median_time([&] { ++calls; }, 0.0), 0.0);
  EXPECT_EQ(calls, 4);  // one that does not count and three that do
}

TEST(BenchCommand, WritesTableAndFiles) {
  const treadmark::testing::SampleInput input;
  const auto folder = input.folder() / "out";
  const auto result = run_program({"bench", "--backends", "analytic,spline", "--resolutions", "2",
                                   "--seconds-per-measure", "0.001", "-o", folder.string(), "--json",
                                   (input.folder() / "b.json").string(), "--set", "wheelset.pitch_deg=2"});
  EXPECT_EQ(result.status, 0) << result.err;
  EXPECT_THAT(result.out, HasSubstr("patches"));
  EXPECT_THAT(result.out, HasSubstr("spline"));
  const json document = parsed(input.read("b.json"));
  EXPECT_EQ(document["threads"], 1);
  EXPECT_EQ(document["rows"].size(), 4u);
  EXPECT_EQ(document["settings"][0], "wheelset.pitch_deg=2");
  EXPECT_EQ(input.read("out/bench.json"), input.read("b.json"));
  EXPECT_THAT(input.read("out/bench.csv"), HasSubstr("backend,resolution_mm,body,agrees,"));
  EXPECT_THAT(input.read("out/bench.svg"), HasSubstr("</svg>"));
}

TEST(BenchCommand, TakesCasesAndPrintsMarkdown) {
  const treadmark::testing::SampleInput input;
  const auto result = run_program({"bench", input.inp().string(), "--backends", "spline", "--resolutions", "1",
                                   "--seconds-per-measure", "0.001", "--markdown", "--threads", "2"});
  EXPECT_EQ(result.status, 0) << result.err << result.out;
  EXPECT_THAT(result.out, HasSubstr("| spline | - | rail | 0 |"));  // as given
  EXPECT_THAT(result.out, HasSubstr("| spline | 1 | wheel |"));
  EXPECT_THAT(result.out, HasSubstr(has_part("tbb") ? "2 threads" : "1 thread"));
}

TEST(BenchCommand, RefusesWhatMakesNoSense) {
  const auto refused = [](std::vector<std::string> arguments, const char* words) {
    arguments.insert(arguments.begin(), "bench");
    const auto result = run_program(arguments);
    EXPECT_EQ(result.status, 2) << words;
    EXPECT_THAT(result.err, HasSubstr(words));
    EXPECT_EQ(result.out, "");
  };
  refused({"--backends", "clay"}, "unknown backend 'clay' (choose analytic, spline");
  refused({"--resolutions", "0"}, "resolutions must be positive");
  refused({"--resolutions", "-1"}, "resolutions must be positive");
  refused({"--seconds-per-measure", "0"}, "the time of a measure must be positive");
  refused({"--set", "no.such_key=1"}, "no.such_key");
  refused({"missing.toml"}, "missing.toml");
}

TEST(BenchCommand, FailsWithoutContact) {
  const auto result = run_program({"bench", "--backends", "spline", "--set", "wheelset.z_mm=-5"});
  EXPECT_NE(result.status, 0);
  EXPECT_EQ(result.out, "");
}

}  // namespace
}  // namespace treadmark::app
