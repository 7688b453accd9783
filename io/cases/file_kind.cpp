// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/file_kind.hpp"

#include <algorithm>
#include <cctype>
#include <string>
#include <string_view>

#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::io {
namespace {

bool has_table(const std::filesystem::path& file, std::string_view key, std::string_view without) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".toml") return false;
  const CaseTable document = parse_toml(read_text(file), file.string());
  const auto has = [&](std::string_view name) {
    return std::ranges::any_of(document, [&](const CaseEntry& entry) { return entry.key == name; });
  };
  return has(key) && !has(without);
}

}  // namespace

bool is_simulation_file(const std::filesystem::path& file) { return has_table(file, "simulation", "study"); }
bool is_study_file(const std::filesystem::path& file) { return has_table(file, "study", ""); }
bool is_evolution_file(const std::filesystem::path& file) { return has_table(file, "evolve", "study"); }

}  // namespace treadmark::io
