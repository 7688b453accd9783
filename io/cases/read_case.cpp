// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/read_case.hpp"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

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

}  // namespace treadmark::io
