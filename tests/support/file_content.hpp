// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace treadmark::testing {

/// All bytes of a file; none where it is missing.
inline std::string content_of(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

/// Of the folder docs: that it holds a text made of what the program knows, which is printed where it does not.
inline void expect_in_document(const std::string& name, const std::string& text) {
  EXPECT_NE(content_of(TREADMARK_SOURCE_DIR "/docs/" + name).find(text), std::string::npos)
      << "docs/" << name << " must contain:\n"
      << text;
}

}  // namespace treadmark::testing
