// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "treadmark/tests/app/running_program.hpp"
#include "treadmark/tests/app/simulation/sample_simulation.hpp"

namespace treadmark::testing {
namespace {

TEST(FullOutput, IsAFailureOfSimulateAndSweep) {
  const SampleSimulation input;
  for (const char* command : {"simulate -o \"$1/run\" \"$1/simulation.toml\"", "assess \"$1/run\"",
                              "sweep \"$1/study.toml\" -o \"$1/out\""}) {
    const ProgramResult r = RunningProgram({"sh", "-c", std::string("\"$0\" --quiet ") + command + " > /dev/full",
                                            "treadmark", input.path("")})
                                .wait();
    EXPECT_EQ(r.status, 1) << command;
    EXPECT_THAT(r.err, ::testing::HasSubstr("could not be written to standard output"));
  }
}

}  // namespace
}  // namespace treadmark::testing
