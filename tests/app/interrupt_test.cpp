// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>

#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/support/parts.hpp"

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;
using namespace std::chrono_literals;

/// A ball on a plane; with many elements and sweeps it takes hours.
std::string ball(int elements, const char* method) {
  const double width = 2.0, step = width / elements, first = -0.5 * width + 0.5 * step;
  const auto line = [](const char* key, double value) {
    return key + std::string(" = ") + std::to_string(value) + "\n";
  };
  const std::string count = std::to_string(elements);
  return "[case]\nregime = \"steady\"\n[solver]\nmethod = \"" + std::string(method) +
         "\"\n[patch]\nnormal_force_N = 1000.0\ncreepage_x = 1e-3\nrolling_step_mm = 0.005\nvelocity_m_s = 1.0\nmx = " +
         count + "\nmy = " + count + "\n" + line("x0_mm", first) + line("y0_mm", first) + line("dx_mm", step) +
         line("dy_mm", step) +
         "[patch.gap]\nkind = \"quadratic\"\ncoefficients_si = [10.0, 0.0, 10.0, 0.0, 0.0, 0.0]\n";
}

/// Whether a file appears while the program runs.
bool appears(const std::filesystem::path& file, RunningProgram& program) {
  for (int i = 0; i < 6000 && program.running(); ++i) {
    if (std::filesystem::exists(file)) return true;
    std::this_thread::sleep_for(10ms);
  }
  return false;
}

TEST(Interrupt, IsHeardWithinALongCase) {
  TREADMARK_NEEDS("hdf5");
  for (const int signal : {SIGINT, SIGTERM}) {
    const SampleInput input;
    input.write("quick.toml", ball(8, "automatic"));
    input.write("endless.toml", ball(400, "sweeps"));
    const auto file = [&](const char* name) { return (input.folder() / name).string(); };
    RunningProgram program({"treadmark", "run", file("quick.toml"), file("endless.toml"), "-o", file("out")});
    ASSERT_TRUE(appears(input.folder() / "out/quick/result.json", program));
    std::this_thread::sleep_for(2s);  // into the other one, most likely
    ASSERT_TRUE(program.running());
    const auto start = std::chrono::steady_clock::now();
    program.send(signal);
    const ProgramResult result = program.wait();
    EXPECT_LT(std::chrono::steady_clock::now() - start, 20s);
    EXPECT_EQ(result.status, 1);
    EXPECT_THAT(result.err, HasSubstr("interrupted: 0 of 1 cases finished"));
    EXPECT_TRUE(std::filesystem::exists(input.folder() / "out/quick/fields.h5")) << "what is complete";
  }
}

TEST(Interrupt, InputBeyondAllMeaningIsRefusedWithItsPlace) {
  const SampleInput input;
  const auto refusal = [&](const char* from, const char* to) {
    std::string text = ball(8, "automatic");
    text.replace(text.find(from), std::string(from).size(), to);
    input.write("huge.toml", text);
    const ProgramResult result = run_program({"run", (input.folder() / "huge.toml").string()});
    EXPECT_EQ(result.status, 2);
    return result.err;
  };
  EXPECT_THAT(refusal("creepage_x = 1e-3", "creepage_x = 1e50"), HasSubstr("huge.toml:7:"));
  EXPECT_THAT(refusal("creepage_x = 1e-3", "creepage_x = 1e50"), HasSubstr("must be at most 1000000000000"));
  EXPECT_THAT(refusal("creepage_x = 1e-3", "spin_rad_m = -1e50"), HasSubstr("must be at least -1000000000000"));
  EXPECT_THAT(refusal("velocity_m_s = 1.0", "velocity_m_s = 1e10"), HasSubstr("must be at most 1000000000"));
  EXPECT_THAT(refusal("[patch]", "[friction]\ncoefficient = 1e13\n[patch]"), HasSubstr("must be at most 1000000"));
  input.edit("case.inp", "0.300   0.300", "1e13 1e13");
  EXPECT_THAT(run_program({"run", input.inp().string()}).err, HasSubstr("greatest magnitude that is taken, 1e+06"));
}

}  // namespace
}  // namespace treadmark::testing
