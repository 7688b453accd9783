// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/io/cases/read_case.hpp"

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/missing_file.hpp"
#include "treadmark/io/cases/contact_program/read_inp.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/files/shape_extension.hpp"
#include "treadmark/io/files/text.hpp"

namespace treadmark::io {

namespace {

/// What to do with a file that holds no case.
std::string advice_on_kind(const std::filesystem::path& file) {
  for (const std::string_view result : {".json", ".h5", ".html", ".svg"})
    if (extension_of(file) == result) return "treadmark report and treadmark plot show results";
  if (shape_extension(file))
    return "a case names its wheel and rail: treadmark new case writes one with wheel.shape.file and rail.shape.file";
  return "use .toml (Treadmark) or .inp (CONTACT)";
}

}  // namespace

CaseFile read_any_case(const std::filesystem::path& file, std::span<const std::string> overrides) {
  return all_cases(read_listed_cases(file, overrides));
}

ListedCases read_listed_cases(const std::filesystem::path& file, std::span<const std::string> overrides) {
  const std::string extension = extension_of(file);
  if (extension == ".toml") return parse_listed_cases(read_text(file), file, overrides);
  std::error_code ignored;
  if (const std::string name = file.string();
      name.find('=') != std::string::npos && !std::filesystem::exists(file, ignored))
    throw Error(ErrorKind::configuration, fmt::format("'{}' is no file", name), {},
                "keys of a case are changed by --set KEY=VALUE, without blanks");
  if (extension != ".inp") {
    require_file(file, "case file", ErrorKind::configuration);
    throw Error(ErrorKind::configuration,
                extension.empty() ? "a case file is expected, this has no extension"
                                  : fmt::format("'{}' is no kind of case file", extension),
                {file.string()}, advice_on_kind(file));
  }
  CaseFile result = read_contact_input(file);
  apply_overrides(result, overrides);
  return {std::move(result), nullptr};
}

std::string read_text(const std::filesystem::path& file) { return read_input(file, "file"); }

}  // namespace treadmark::io
