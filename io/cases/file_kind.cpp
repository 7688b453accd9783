// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/file_kind.hpp"

#include <string>
#include <string_view>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/cases/read_case.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/io/settings/toml_value.hpp"

namespace treadmark::io {
namespace {

/// What stands at the top of a file; nothing of one that is not TOML.
CaseTable top_of(const std::filesystem::path& file) {
  return extension_of(file) == ".toml" ? parse_toml(read_text(file), file.string()) : CaseTable{};
}

const CaseEntry* entry_of(const CaseTable& table, std::string_view key) {
  const auto found = ranges::find(table, key, &CaseEntry::key);
  return found == table.end() ? nullptr : &*found;
}

}  // namespace

FileKind file_kind(const std::filesystem::path& file) { return kind_of(top_of(file)); }

FileKind kind_of(const CaseTable& top) {
  const auto has = [&](std::string_view key) { return entry_of(top, key) != nullptr; };
  if (has("study")) return FileKind::study;
  if (has("evolve")) return FileKind::evolution;
  if (has("design")) return FileKind::design;
  if (has("simulation")) return FileKind::simulation;
  if (has("vehicle")) return FileKind::vehicle;
  const CaseEntry* track = entry_of(top, "track");
  if (track != nullptr && track->value.is_table() && entry_of(track->value.table(), "name") != nullptr)
    return FileKind::track;
  if (has("limits")) return FileKind::limits;
  constexpr std::string_view kOfImports[] = {"scan", "placement", "clean", "fit", "damage", "map"};
  return ranges::any_of(kOfImports, has) ? FileKind::import : FileKind::other;
}

}  // namespace treadmark::io
