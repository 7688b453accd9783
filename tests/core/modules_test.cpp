// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/core/modules.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>

namespace treadmark {
namespace {

using ::testing::Contains;
using ::testing::ElementsAre;

TEST(Modules, LieWhereTheyWereBuiltOrWhereTheEnvironmentSays) {
  unsetenv("TREADMARK_MODULES");
  EXPECT_THAT(module_folders(), Contains(TREADMARK_BINARY_DIR "/lib/treadmark"));
  setenv("TREADMARK_MODULES", "/elsewhere", 1);
  EXPECT_THAT(module_folders(), ElementsAre("/elsewhere"));
  setenv("TREADMARK_MODULES", "", 1);
  EXPECT_THAT(module_folders(), Contains(TREADMARK_BINARY_DIR "/lib/treadmark"));
  unsetenv("TREADMARK_MODULES");
}

}  // namespace
}  // namespace treadmark
