// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/read_text.hpp"

#include <fstream>
#include <iterator>

#include "treadmark/core/error.hpp"

namespace treadmark::io {

std::string read_text(const std::filesystem::path& file) {
  std::error_code code;
  if (std::filesystem::is_directory(file, code))
    throw Error(ErrorKind::configuration, "a case file is expected, this is a folder", {file.string()});
  std::ifstream stream(file, std::ios::binary);
  if (!stream)
    throw Error(ErrorKind::configuration, "the case file cannot be opened", {file.string()}, "check its name");
  return std::string(std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>());
}

}  // namespace treadmark::io
