// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/settings/key_list.hpp"

namespace treadmark::io {

/// A key of the case file, and the list that its keys are put into (io/cases/case_keys_*.cpp).
using CaseKey = SettingKey<Case>;
using KeyList = SettingKeys<Case>;

/// All keys, in the order in which they are applied. Immutable; safe to use from several threads.
std::span<const CaseKey> case_keys();

/// What a case file without keys says of a wheel on a rail, or of a patch: every key has its default.
Case case_without_keys(bool patch);

/// Within a layer of a case file.
inline constexpr ExclusiveSections kExclusiveSections[] = {{"patch", "hertz", "gap"}};

/// A key of a layer, and where it stands.
struct GivenKey {
  std::string_view path;
  const SourcePosition* where;
};
/// Errors: Error(configuration) at the second of keys in sections that exclude each other.
void check_exclusive_sections(std::span<const GivenKey> keys);

/// Applies the entries of one layer of a case file (defaults, one [[cases]] entry): checks names, types, ranges and
/// exclusions first, so that a Case is changed only when everything is right.
void apply_table(Case& target, const CaseTable& table, const std::filesystem::path& folder);

/// Sets one key after checking scope, type and range.
void apply_value(Case& target, const CaseKey& key, const CaseValue& value, const std::filesystem::path& folder);

/// The key of this path; null: there is none.
const CaseKey* case_key(std::string_view path);
/// Throws Error(configuration), which names the nearest key.
[[noreturn]] void refuse_unknown_case_key(std::string_view path, const SourcePosition& where);

/// Applies one override; its path may also name a key of a list element ("wheel.flats.0.depth_mm",
/// "rail.corrugations.0.waves.1.phase_deg").
void apply_assignment(Case& target, const CaseOverride& assignment, const std::filesystem::path& folder);

/// The number that a case has for a key, in the unit of the key, also of a list element ("wheel.flats.0.depth_mm").
/// Nothing where the key says nothing of this case: it belongs to others, or to another way to say it that this case
/// uses, or its element leaves it at its default. Errors: Error(configuration) for a path that is no key, or a key that
/// is no number.
std::optional<double> number_of(const Case& c, const std::string& path);

/// JSON Schema (draft 2020-12) of the Treadmark case file, for editors and validators; from the same table as the
/// reader.
std::string case_file_schema();

/// All keys as Markdown tables, one for each section (docs/case-file.md).
std::string case_key_table();

}  // namespace treadmark::io
