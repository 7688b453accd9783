// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Elements that nobody gives: chosen from each patch.
#include <gtest/gtest.h>

#include <string>

#include "treadmark/app/cases/run_cases.hpp"
#include "treadmark/app/compare/compare_cases.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/file_content.hpp"

namespace treadmark::app {
namespace {

/// README's own case, with a wheel that is there.
io::CaseFile readme_case() {
  const std::string text = treadmark::testing::content_of(TREADMARK_SOURCE_DIR "/README.md");
  const std::size_t from = text.find("```toml\n") + 8;
  std::string toml = text.substr(from, text.find("```", from) - from);
  const std::string file = "shape.file = \"wheel.csv\"";
  toml.replace(toml.find(file), file.size(), "shape.standard = \"S1002\"");
  return io::parse_case_text(toml, "readme.toml");
}

void expect_same(const io::RunResult& a, const io::RunResult& b) {
  ASSERT_EQ(a.cases.size(), b.cases.size());
  for (std::size_t i = 0; i < a.cases.size(); ++i) {
    ASSERT_EQ(a.cases[i].patches.size(), b.cases[i].patches.size());
    for (std::size_t k = 0; k < a.cases[i].patches.size(); ++k) {
      const io::PatchResult &p = a.cases[i].patches[k], &q = b.cases[i].patches[k];
      EXPECT_EQ(p.fields.grid, q.fields.grid);
      EXPECT_EQ(p.fields.pressure, q.fields.pressure);
      EXPECT_EQ(p.fx, q.fx);
      ASSERT_TRUE(p.refinement && q.refinement);
      EXPECT_EQ(p.refinement->pmax, q.refinement->pmax);
      EXPECT_EQ(p.refinement->force, q.refinement->force);
    }
  }
}

TEST(ChosenElements, NewCaseAndReadmeAgree) {
  const treadmark::testing::SampleInput input;
  const std::string file = (input.folder() / "case.toml").string();
  ASSERT_EQ(treadmark::testing::run_program({"new", "case", file}).status, 0);
  expect_same(run_cases(io::read_any_case(file, {})), run_cases(readme_case()));
}

TEST(ChosenElements, DoNotDependOnThreads) {
  const io::CaseFile file = readme_case();
  const io::RunResult many = run_cases(file);
  const ThreadLimit one(1);
  const io::RunResult single = run_cases(file);
  expect_same(many, single);
  for (const io::CaseResult& c : single.cases) {
    EXPECT_TRUE(c.remarks.empty()) << to_line(c.remarks.front());
    for (const io::PatchResult& p : c.patches) {
      EXPECT_LT(p.refinement->pmax, 0.05);
      EXPECT_LT(p.refinement->force, 0.03);
    }
  }
}

TEST(ChosenElements, AreThoseOfAllRepresentationsInAComparison) {
  io::CaseFile file = readme_case();
  file.cases.resize(1);
  CompareSettings settings;
  settings.backends = {"spline", "mesh"};
  settings.resolutions = {1e-3};
  const io::Comparison compared = compare_cases(file, settings);
  ASSERT_EQ(compared.candidates.size(), 3U);
  const auto grid = [&](std::size_t i) { return compared.candidates.at(i).results.at(0).patches.at(0).fields.grid; };
  for (const std::size_t other : {1, 2}) {
    EXPECT_EQ(grid(other).dx, grid(0).dx);
    EXPECT_EQ(grid(other).dy, grid(0).dy);
  }
}

}  // namespace
}  // namespace treadmark::app
