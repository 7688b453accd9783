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

/// What stands at the top of a file; nothing of one that is not TOML.
CaseTable top_of(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".toml" ? parse_toml(read_text(file), file.string()) : CaseTable{};
}

const CaseEntry* entry_of(const CaseTable& table, std::string_view key) {
  const auto found = std::ranges::find(table, key, &CaseEntry::key);
  return found == table.end() ? nullptr : &*found;
}

/// Whether there is such a table, and none of a study.
bool has_without_study(const std::filesystem::path& file, std::string_view key) {
  const CaseTable top = top_of(file);
  return entry_of(top, key) != nullptr && entry_of(top, "study") == nullptr;
}

}  // namespace

bool is_simulation_file(const std::filesystem::path& file) { return has_without_study(file, "simulation"); }
bool is_evolution_file(const std::filesystem::path& file) { return has_without_study(file, "evolve"); }
bool is_study_file(const std::filesystem::path& file) { return entry_of(top_of(file), "study") != nullptr; }
bool is_vehicle_file(const std::filesystem::path& file) { return entry_of(top_of(file), "vehicle") != nullptr; }
bool is_track_file(const std::filesystem::path& file) {
  // Cases have a table of this name, too.
  const CaseTable top = top_of(file);
  const CaseEntry* track = entry_of(top, "track");
  return track != nullptr && track->value.is_table() && entry_of(track->value.table(), "name") != nullptr;
}
bool is_import_file(const std::filesystem::path& file) {
  const CaseTable top = top_of(file);
  constexpr std::string_view kTables[] = {"scan", "placement", "clean", "fit", "damage", "map"};
  return std::ranges::any_of(kTables, [&](std::string_view name) { return entry_of(top, name) != nullptr; });
}

}  // namespace treadmark::io
