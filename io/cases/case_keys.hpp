// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"
#include "treadmark/io/cases/case_value.hpp"

namespace treadmark::io {

enum class KeyType { number, integer, flag, text, choice, path, number_list, table_list };

/// Which cases a key belongs to.
enum class KeyScope { any, wheel_rail, patch };

/// What is published about one key of the case file: the reader, the schema and the documentation all come from it.
struct KeyInfo {
  std::string path;  ///< "wheelset.pitch_deg"; within a table_list the name only
  KeyType type = KeyType::number;
  std::string doc;
  std::string default_text;                        ///< as TOML; empty = none
  std::optional<double> above, at_least, at_most;  ///< limits in the unit of the key
  std::vector<std::string> choices;
  std::string pattern;  ///< text: regular expression for the schema and messages; empty = anything
  bool (*matches)(std::string_view) = nullptr;  ///< text: what pattern says, as code; set with it
  std::string group, alternative;               ///< keys of one group with different alternatives exclude each other
  KeyScope scope = KeyScope::any;
  bool required = false;          ///< in a table_list
  std::vector<KeyInfo> elements;  ///< keys of the tables of a table_list
};

/// One key with the way to its place in a Case.
struct CaseKey {
  KeyInfo info;
  /// value has been checked against info; relative paths count from folder.
  std::function<void(Case&, const CaseValue& value, const std::filesystem::path& folder)> set;
  /// Numbers that are stored as they are: the value in the unit of the key. Empty for all other keys.
  std::function<double(const Case&)> get;
  /// table_list only: changes some keys of the element with this index (which exists, or Error). A key of a nested list
  /// has the rest of its path as name: "waves.1.phase_deg".
  std::function<void(Case&, std::size_t index, const CaseTable& entries, const SourcePosition& where)> set_element;
};

/// All keys, in the order in which they are applied. Immutable; safe to use from several threads.
std::span<const CaseKey> case_keys();

/// Sections of one parent that exclude each other within a layer of a case file.
struct ExclusiveSections {
  std::string_view parent, one, other;
};
inline constexpr ExclusiveSections kExclusiveSections[] = {{"patch", "hertz", "gap"}};

/// Number and key of "3.depth_mm", which follows the path of a list in an override.
struct ElementPath {
  std::size_t index = 0;
  std::string key;
};
/// Errors: Error(configuration) if rest does not start with a number and a dot.
ElementPath split_element_path(const KeyInfo& list, std::string_view rest, const SourcePosition& where);

/// SI value of one unit of the key: from the ending of its name (_mm, _N, _deg, _rad, _us, _GPa, _MPa, _m_s, _per_m
/// ...).
double unit_of_key(std::string_view path);

/// Type and range; throws Error (configuration) at the value.
void check_value(const KeyInfo& key, const CaseValue& value);
/// The same for one table of a list; complete: all required keys must be there.
void check_elements(const KeyInfo& list, const CaseTable& entries, const SourcePosition& where, bool complete);

/// Applies the entries of one layer of a case file (defaults, one [[cases]] entry): checks names, types, ranges and
/// exclusions first, so that a Case is changed only when everything is right.
void apply_table(Case& target, const CaseTable& table, const std::filesystem::path& folder);

/// Applies one override; its path may also name a key of a list element ("wheel.flats.0.depth_mm",
/// "rail.corrugations.0.waves.1.phase_deg").
void apply_assignment(Case& target, const CaseOverride& assignment, const std::filesystem::path& folder);

}  // namespace treadmark::io
