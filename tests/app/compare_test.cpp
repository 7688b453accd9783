// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/results/comparison_store.hpp"
#include "treadmark/io/results/comparison_table.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/app/standard_case.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::app {
namespace {

using ::testing::HasSubstr;

const io::ComparisonCandidate& find(const io::Comparison& comparison, const std::string& name, double resolution) {
  for (const io::ComparisonCandidate& c : comparison.candidates)
    if (c.name == name && c.resolution == resolution) return c;
  throw std::runtime_error("no candidate " + name);
}

TEST(CompareCases, ThePrismaticSectionIsThatOfEachCase) {
  const treadmark::testing::SampleInput input;
  // at the flat, and where the wheel is round
  input.write("flat.toml", treadmark::testing::standard_case("1.0", treadmark::testing::kWheelWithFlat,
                                                             "[[cases]]\nwheelset.pitch_deg = [0, 20]\n"));
  const io::CaseFile file = io::read_any_case((input.folder() / "flat.toml").string(), {});
  CompareSettings settings;
  settings.backends = {"prismatic", "chords"};
  settings.resolutions = {0.5e-3};
  const io::Comparison comparison = compare_cases(file, settings);
  const io::ComparisonCandidate& prismatic = find(comparison, "prismatic", 0.5e-3);
  ASSERT_EQ(prismatic.failure, "");
  ASSERT_EQ(prismatic.rows.size(), 2u);
  EXPECT_GT(std::fabs(prismatic.rows[0].pmax_error), 0.05) << "the flat is no ring";
  EXPECT_LT(std::fabs(prismatic.rows[1].pmax_error), 0.01);
  EXPECT_GT(prismatic.wheel.difference.height_max, 0.1e-3) << "and the comparison says so";
  const io::ComparisonCandidate& chords = find(comparison, "chords", 0.5e-3);
  ASSERT_EQ(chords.failure, "");
  for (const io::ComparisonRow& row : chords.rows) EXPECT_LT(row.position_error, 1e-3);
  EXPECT_LT(chords.wheel.difference.height_max, 5e-6);
}

TEST(CompareCases, APressureWithoutLimitBlamesNoRepresentation) {
  const treadmark::testing::SampleInput input;
  // the wheel stands on an end of a fresh flat: sharp, and round
  input.write("edge.toml",
              treadmark::testing::standard_case(
                  "0.3", "shape.standard = \"S1002\"\n[[wheel.flats]]\nshape = \"fresh\"\nlength_mm = 60\n",
                  "[[cases]]\nwheelset.pitch_deg = 3.7393\n[[cases]]\nwheelset.pitch_deg = 3.7393\n"
                  "[[cases.wheel.flats]]\nshape = \"fresh\"\nlength_mm = 60\nedge_radius_mm = 50\n"));
  CompareSettings settings;
  settings.backends = {"spline"};
  settings.resolutions = {2e-3};
  const io::Comparison comparison =
      compare_cases(io::read_any_case((input.folder() / "edge.toml").string(), {}), settings);
  const std::vector<io::ComparisonRow>& rows = find(comparison, "spline", 2e-3).rows;
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_TRUE(std::isnan(rows[0].pmax_error));
  EXPECT_GT(std::abs(rows[1].pmax_error), 0.01) << "samples 2 mm apart do not hold an edge of 6 mm";
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const io::ComparisonRow& truth = comparison.candidates[0].rows[i];
    EXPECT_NEAR(rows[i].mean_pressure_error, rows[i].fn / rows[i].area * truth.area / truth.fn - 1.0, 1e-12);
    EXPECT_LT(rows[i].force_error, 0.01);
  }
  EXPECT_THAT(io::comparison_table(comparison), HasSubstr("case 1: the largest pressure has no limit (edge_pressure)"));
}

TEST(CompareCases, RowsAreThoseOfARunWithTheSameBackend) {
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::flat_wheel_case());
  const io::CaseFile file = io::read_any_case((input.folder() / "flat.toml").string(), {});
  CompareSettings settings;
  settings.backends = {"analytic", "spline", "mesh"};
  settings.resolutions = {2e-3};
  const io::Comparison comparison = compare_cases(file, settings);
  EXPECT_EQ(comparison.truth, "analytic");
  ASSERT_EQ(comparison.candidates.size(), 3u);  // analytic is the truth and stands there once
  EXPECT_TRUE(comparison.complete);

  io::CaseFile as_mesh = file;
  for (io::Case& c : as_mesh.cases) {
    auto& source = std::get<io::WheelRailCase>(c.content).wheel;
    source.backend = "mesh";
    source.resolution = 2e-3;
  }
  const io::RunResult truth = run_cases(file), mesh = run_cases(as_mesh);
  const io::ComparisonCandidate& row_of = find(comparison, "mesh", 2e-3);
  ASSERT_EQ(row_of.rows.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const io::ComparisonRow& row = row_of.rows[i];
    const io::PatchResult &p = mesh.cases[i].patches[0], &t = truth.cases[i].patches[0];
    EXPECT_EQ(row.pmax, p.pmax);
    EXPECT_EQ(row.fx, p.fx);
    EXPECT_EQ(row.ncon, p.ncon);
    EXPECT_TRUE(row.comparable);
    EXPECT_NEAR(row.pmax_error, p.pmax / t.pmax - 1.0, 1e-12);
    EXPECT_NEAR(row.position_error, std::hypot(p.x_tr - t.x_tr, p.y_tr - t.y_tr), 1e-15);
    EXPECT_NEAR(row.area_error, static_cast<double>(p.ncon) / t.ncon - 1.0, 1e-12);
    EXPECT_NE(row.pmax_error, 0.0);
  }
  EXPECT_EQ(row_of.wheel.backend, "mesh");
  EXPECT_EQ(row_of.rail.backend, "analytic");  // the round rail has no defect: it stays as it is
  EXPECT_GT(row_of.wheel.difference.points, 1000u);
  EXPECT_GT(row_of.wheel.difference.height_max, 1e-9);
  for (const io::ComparisonRow& row : comparison.candidates[0].rows) EXPECT_EQ(row.pmax_error, 0.0);
}

TEST(CompareCases, BodiesAndCombinationsAsAskedFor) {
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::flat_wheel_case());
  const std::vector<std::string> one_case{"wheelset.pitch_deg=0"};
  const io::CaseFile file = io::read_any_case((input.folder() / "flat.toml").string(), one_case);
  CompareSettings settings;
  settings.resolutions = {2e-3};
  settings.backends = {"spline"};
  settings.bodies = CompareSettings::Bodies::both;
  const io::Comparison both = compare_cases(file, settings);
  EXPECT_EQ(find(both, "spline", 2e-3).rail.backend, "spline");
  settings.bodies = CompareSettings::Bodies::rail;
  const io::Comparison rail = compare_cases(file, settings);
  EXPECT_EQ(find(rail, "spline", 2e-3).rail.backend, "spline");
  EXPECT_EQ(find(rail, "spline", 2e-3).wheel.backend, "analytic");
  settings.wheel_backends = {"spline", "offset"};
  settings.rail_backends = {"spline", "mesh"};
  const io::Comparison nine = compare_cases(file, settings);
  EXPECT_EQ(nine.candidates.size(), 5u);
  const io::ComparisonCandidate& mixed = find(nine, "offset+mesh", 2e-3);
  EXPECT_EQ(mixed.wheel.backend, "offset");
  EXPECT_EQ(mixed.rail.backend, "mesh");
}

TEST(CompareCases, MeasuredPointsAreTheTruthWhereThereIsNoFormula) {
  const treadmark::testing::SampleInput input;
  io::CaseFile file = io::read_any_case(input.inp(), {});
  // the same search for all: the locus, which round wheels get else, finds the lowest point 1e-8 m from the grid's, and
  // the reference program's mesh follows the data, which offsets do not have
  for (io::Case& c : file.cases) {
    auto& d = std::get<io::WheelRailCase>(c.content).discretisation;
    d.method = 5;
    d.conventions = Conventions::treadmark;
  }
  CompareSettings settings;
  settings.backends = {"analytic", "spline", "offset"};
  settings.resolutions = {1e-3};
  const io::Comparison comparison = compare_cases(file, settings);
  EXPECT_EQ(comparison.truth, "spline");
  const io::ComparisonCandidate& analytic = find(comparison, "analytic", 0.0);
  EXPECT_THAT(analytic.failure, HasSubstr("needs a formula"));
  EXPECT_TRUE(analytic.rows.empty());
  // nothing changes along round wheels and prismatic rails: both bodies, and offsets over them are nothing
  const io::ComparisonCandidate& offset = find(comparison, "offset", 1e-3);
  EXPECT_EQ(offset.rail.backend, "offset");
  for (const io::ComparisonRow& row : offset.rows) EXPECT_LT(std::fabs(row.pmax_error), 1e-9);
}

TEST(CompareCases, ThreadsChangeNothingButTimes) {
  TREADMARK_NEEDS("tbb");
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::flat_wheel_case());
  const io::CaseFile file = io::read_any_case((input.folder() / "flat.toml").string(), {});
  CompareSettings settings;
  settings.backends = {"mesh", "offset", "nurbs"};
  settings.resolutions = {2e-3};
  const auto run_with = [&](int threads) {
    const ThreadLimit limit(threads);
    return compare_cases(file, settings);
  };
  const io::Comparison one = run_with(1), four = run_with(4);
  ASSERT_EQ(one.candidates.size(), four.candidates.size());
  for (std::size_t c = 0; c < one.candidates.size(); ++c) {
    EXPECT_EQ(one.candidates[c].wheel.difference.height_max, four.candidates[c].wheel.difference.height_max);
    ASSERT_EQ(one.candidates[c].rows.size(), four.candidates[c].rows.size());
    for (std::size_t i = 0; i < one.candidates[c].rows.size(); ++i) {
      EXPECT_EQ(one.candidates[c].rows[i].pmax, four.candidates[c].rows[i].pmax) << one.candidates[c].name;
      EXPECT_EQ(one.candidates[c].rows[i].fx, four.candidates[c].rows[i].fx);
      EXPECT_EQ(one.candidates[c].rows[i].x_tr, four.candidates[c].rows[i].x_tr);
    }
  }
}

TEST(CompareCases, StopKeepsFinishedCandidates) {
  const treadmark::testing::SampleInput input;
  const io::CaseFile file = io::read_any_case(input.inp(), {});
  CompareSettings settings;
  settings.backends = {"spline", "nurbs"};
  settings.resolutions = {2e-3, 1e-3};
  std::atomic<bool> stop{false};
  Progress progress;
  progress.stop = &stop;
  progress.report = [&](std::size_t finished, std::size_t total, const std::string&) {
    EXPECT_EQ(total, 2u * 5u);
    if (finished == 4) stop = true;
  };
  const io::Comparison comparison = compare_cases(file, settings, progress);
  EXPECT_FALSE(comparison.complete);
  EXPECT_EQ(comparison.candidates.size(), 2u);
}

TEST(CompareCases, RefusesWhatMakesNoSense) {
  const treadmark::testing::SampleInput input;
  const io::CaseFile file = io::read_any_case(input.inp(), {});
  CompareSettings unknown;
  unknown.backends = {"clay"};
  EXPECT_THROW(compare_cases(file, unknown), Error);
  CompareSettings coarse;
  coarse.resolutions = {0.0};
  EXPECT_THROW(compare_cases(file, coarse), Error);
  io::CaseFile none = file;
  none.cases.clear();
  EXPECT_THROW(compare_cases(none, {}), Error);
}

TEST(CompareCommand, WritesTableFilesAndPictures) {
  TREADMARK_NEEDS("hdf5");
  const treadmark::testing::SampleInput input;
  input.write("flat.toml", treadmark::testing::flat_wheel_case());
  const auto folder = input.folder() / "out";
  const auto r = treadmark::testing::run_program({"compare", (input.folder() / "flat.toml").string(), "--backends",
                                                  "spline,mesh-flat", "--resolutions", "2,1", "-o", folder.string()});
  ASSERT_EQ(r.status, 0) << r.err;
  EXPECT_THAT(r.out, HasSubstr("errors are those against the first, analytic\n"));
  EXPECT_THAT(r.out, HasSubstr("mesh-flat"));
  for (const char* file :
       {"compare.json", "compare.csv", "table.txt", "fields.h5", "pressures.svg", "errors.svg", "costs.svg"})
    EXPECT_GT(std::filesystem::file_size(folder / file), 100u) << file;
  const io::Comparison fields = io::read_comparison_fields(folder / "fields.h5");
  ASSERT_EQ(fields.candidates.size(), 5u);  // the truth, and two at two resolutions
  for (const io::ComparisonCandidate& c : fields.candidates) {
    ASSERT_FALSE(c.results.empty());
    EXPECT_FALSE(c.results.front().patches.empty());
    EXPECT_EQ(c.surfaces.size(), &c == &fields.candidates.front() ? 2u : 0u);
  }
  EXPECT_EQ(treadmark::testing::run_program({"compare", (input.folder() / "flat.toml").string(), "--backends", "clay"})
                .status,
            2);
  EXPECT_EQ(treadmark::testing::run_program({"compare", (input.folder() / "flat.toml").string(), "--resolutions", "-1"})
                .status,
            2);
  EXPECT_EQ(treadmark::testing::run_program({"compare", "missing.toml"}).status, 2);
  EXPECT_EQ(treadmark::testing::run_program({"compare", (input.folder() / "flat.toml").string(), "--backends", "spline",
                                             "--wheel-backends", "mesh"})
                .status,
            2);
}

}  // namespace
}  // namespace treadmark::app
