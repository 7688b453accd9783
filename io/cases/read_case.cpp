// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/cases/read_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <fstream>
#include <iterator>

#include "treadmark/core/error.hpp"
#include "treadmark/io/cases/read_inp.hpp"
#include "treadmark/io/cases/read_toml.hpp"

namespace treadmark::io {

CaseFile read_any_case(const std::filesystem::path& file, std::span<const std::string> overrides) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".toml") return read_case_file(file, overrides);
  if (extension != ".inp")
    throw Error(ErrorKind::configuration, fmt::format("'{}' is no kind of case file", extension), {file.string()},
                "use .toml (Treadmark) or .inp (CONTACT)");
  CaseFile result = read_contact_input(file);
  apply_overrides(result, overrides);
  return result;
}

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
