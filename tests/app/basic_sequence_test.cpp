// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>

#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/io/results/json_schema.hpp"

namespace treadmark::testing {
namespace {

using Json = nlohmann::json;
using ::testing::HasSubstr;
namespace fs = std::filesystem;

Json read(const fs::path& file) {
  std::ifstream in(file);
  return Json::parse(in);
}

const char* kExample = TREADMARK_SOURCE_DIR "/examples/onset-of-rolling.toml";

TEST(BasicSequence, TheOnsetOfRollingEndsInSteadyRolling) {
  SampleInput input;
  const fs::path onset = input.folder() / "onset.json", steady = input.folder() / "steady.json";
  ASSERT_EQ(run_program({"run", kExample, "--json", onset.string()}).status, 0);
  ASSERT_EQ(run_program({"run", kExample, "--set", "case.regime=steady", "--set", "case.history=start", "--json",
                         steady.string()})
                .status,
            0);
  const Json a = read(onset), b = read(steady);
  ASSERT_EQ(a["cases"].size(), 57u);
  const auto xi = [](const Json& run, std::size_t k) {
    return run["cases"][k]["patches"][0]["kinematics"]["xi"].get<double>();
  };
  EXPECT_NEAR(xi(a, 56), xi(b, 56), 1e-4 * std::fabs(xi(b, 56)));
  EXPECT_LT(std::fabs(xi(a, 1)), 0.7 * std::fabs(xi(a, 56))) << "the first step creeps less";
  const Json& s = a["cases"][56]["patches"][0]["sensitivities"];
  EXPECT_LT(s["fx_by_xi"].get<double>(), 0.0);
  EXPECT_GT(s["fn_by_approach"].get<double>(), 0.0);
}

TEST(BasicSequence, IsTheSameForAnyNumberOfThreads) {
  SampleInput input;
  std::string texts[2];
  for (const int threads : {1, 2}) {
    const fs::path file = input.folder() / (threads == 1 ? "one.json" : "two.json");
    ASSERT_EQ(run_program({"run", kExample, "--threads", threads == 1 ? "1" : "2", "--json", file.string()}).status, 0);
    Json run = read(file);
    for (Json& c : run["cases"]) {
      c.erase("seconds");
      c.erase("timing");
    }
    texts[threads - 1] = run["cases"].dump();
  }
  EXPECT_EQ(texts[0], texts[1]);
}

/// Two cases: one whose output is not wanted, one with stresses below the surface and tables of elements.
const char* kTables = R"( 3 MODULE
  203100  P-B-T-N-F-S
  022020  L-D-C-M-Z-E
  00000011  X-H-G-I-A-O-W-R
  999 100 30 1 1e-5
  9000. -0.001 0. 0.
  0.3 0.3
  0.0 0.4 30000.
  0.28 0.28 82000. 82000.
  -3
  12 10 2.0 1.5 1.1
 3 MODULE
  203103  P-B-T-N-F-S
  100000  L-D-C-M-Z-E
  0102341  H-G-I-A-O-W-R
  9000. -0.002 0. 0.
  2 1
  1
  2 0.5 1.0
  0
 0 MODULE
)";

TEST(BasicSequence, WritesTablesAndLeavesOutWhatIsNotWanted) {
  SampleInput input;
  input.write("tables.inp", kTables);
  const fs::path folder = input.folder() / "out";
  const ProgramResult r = run_program({"run", (input.folder() / "tables.inp").string(), "-o", folder.string()});
  ASSERT_EQ(r.status, 0) << r.err;
  const Json run = read(folder / "result.json");
  ASSERT_EQ(run["cases"].size(), 2u);
  EXPECT_EQ(run["cases"][0]["status"], "ok");
  EXPECT_TRUE(run["cases"][0]["patches"].empty());
  ASSERT_EQ(run["cases"][1]["patches"].size(), 1u);
  EXPECT_FALSE(fs::exists(folder / "tables.0001.mat"));
  std::ifstream mat(folder / "tables.0002.mat"), subs(folder / "tables.0002.subs");
  const auto lines = [](std::ifstream& in) {
    int count = 0;
    for (std::string line; std::getline(in, line);)
      count += line.empty() || line.find('%') != std::string::npos ? 0 : 1;
    return count;
  };
  EXPECT_EQ(lines(mat), 6 + 120) << "six lines of head and all elements";
  EXPECT_EQ(lines(subs), 1 + 2 * 120);
}

}  // namespace
}  // namespace treadmark::testing
