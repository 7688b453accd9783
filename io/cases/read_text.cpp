// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/read_text.hpp"

#include <fstream>
#include <iterator>

#include "treadmark/core/error.hpp"
#if __has_include("treadmark/io/profiles/sha256.hpp")
#include "treadmark/io/profiles/sha256.hpp"
#define TREADMARK_CASES_HAVE_SHA256 1
#endif

namespace treadmark::io {

std::string read_text(const std::filesystem::path& file) {
  std::error_code code;
  if (std::filesystem::is_directory(file, code))
    throw Error(ErrorKind::configuration, "a case file is expected, this is a folder", {file.string()});
  std::ifstream stream(file, std::ios::binary);
  if (!stream) throw Error(ErrorKind::configuration, "the case file cannot be opened", {file.string()}, "check its name");
  return std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
}

std::string text_sha256(std::string_view text) {
#ifdef TREADMARK_CASES_HAVE_SHA256
  return sha256_hex(text);
#else
  static_cast<void>(text);
  return {};
#endif
}

}  // namespace treadmark::io
