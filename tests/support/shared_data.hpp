// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <optional>

namespace treadmark::testing {

/// Folder with third-party reference data: $TREADMARK_SHARED or ../shared beside the sources; nothing if absent.
inline std::optional<std::filesystem::path> shared_folder() {
  namespace fs = std::filesystem;
  if (const char* configured = std::getenv("TREADMARK_SHARED"); configured != nullptr && fs::exists(configured))
    return fs::path(configured);
  const fs::path beside = fs::path(TREADMARK_SOURCE_DIR).parent_path() / "shared";
  if (fs::exists(beside / "data")) return beside;
  return std::nullopt;
}

}  // namespace treadmark::testing

/// Skips a test that needs the reference data; in CI (CI=true) a missing folder is a failure instead.
#define TREADMARK_REQUIRE_SHARED()                                                                        \
  const auto shared = treadmark::testing::shared_folder();                                                \
  if (!shared) {                                                                                          \
    const char* ci = std::getenv("CI");                                                                   \
    if (ci != nullptr && std::string(ci) == "true") FAIL() << "reference data folder 'shared' not found"; \
    GTEST_SKIP() << "reference data folder 'shared' not found";                                           \
  }
