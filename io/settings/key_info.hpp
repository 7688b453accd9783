// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/io/settings/toml_value.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

/// triple: x, y, z; direction: a triple or an empty list; value_list: a list of values of any type.
enum class KeyType {
  number,
  integer,
  flag,
  text,
  choice,
  path,
  number_list,
  triple,
  direction,
  triple_list,
  text_list,
  value_list,
  table,
  table_list
};

/// Which cases a key belongs to: all, or those with one alternative of their content, in its order.
enum class KeyScope { any, wheel_rail, patch };

/// What is published about one key of a file: the reader, the schema and the documentation all come from it.
struct KeyInfo {
  std::string path;  ///< "wheelset.pitch_deg"; within a table_list the name only
  KeyType type = KeyType::number;
  std::string doc;
  std::string default_text;                        ///< as TOML; empty = none
  std::optional<double> above, at_least, at_most;  ///< limits in the unit of the key
  std::vector<std::string> choices;                ///< choice: the words; number, table: those in its place
  std::string pattern;                             ///< text: regular expression for the schema; empty = anything
  bool (*matches)(std::string_view) = nullptr;     ///< text: what pattern says, as code; set with it
  std::string like;                                ///< text: what pattern says, in words; set with it
  std::string group, alternative;                  ///< keys of one group with different alternatives exclude each other
  KeyScope scope = KeyScope::any;
  bool required = false;          ///< not of a case file but in its lists of tables
  std::string missing;            ///< what to do where it is not there but should be
  std::string option;             ///< of a setting of a verb: "--cant 1:N"; empty: made from path
  std::vector<KeyInfo> elements;  ///< keys of a table or of the tables of a table_list
};

KeyInfo key_info(std::string path, KeyType type, std::string doc);

struct KeyLimits {
  std::optional<double> above, at_least, at_most;
};
inline constexpr KeyLimits kPositive{0.0, {}, {}};
inline constexpr KeyLimits kNotNegative{{}, 0.0, {}};
inline constexpr KeyLimits kAnyNumber{};
/// Of wheels and tracks [mm]: what is beyond is in another unit.
inline constexpr KeyLimits kWheelRadiusMm{{}, 1e3 * kLeastWheelRadius, 1e3 * kMostWheelRadius},
    kGaugeMm{{}, 1e3 * kLeastGauge, 1e3 * kMostGauge};

KeyInfo key_info(std::string path, KeyType type, std::string doc, const KeyLimits& limits);

/// Sections of one parent that exclude each other.
struct ExclusiveSections {
  std::string_view parent, one, other;
};

/// Number and key of "3.depth_mm", which follows the path of a list in an override.
struct ElementPath {
  std::size_t index = 0;
  std::string key;
};
/// Errors: Error(configuration) if rest does not start with a number and a dot.
ElementPath split_element_path(const KeyInfo& list, std::string_view rest, const SourcePosition& where);

/// The unit that the name of a key ends with. No ending: the number has no unit.
struct KeyUnit {
  std::string_view ending;
  double si = 1.0;           ///< of one unit
  std::string_view si_name;  ///< of the unit in SI; "1": none
};
KeyUnit unit_at_end(std::string_view path);

/// SI value of one unit of the key: from the ending of its name (_mm, _N, _deg, _rad, _us, _GPa, _MPa, _m_s, _per_m
/// ...).
double unit_of_key(std::string_view path);

/// The numbers of a list that has been checked, in SI units.
std::vector<double> numbers_of(const CaseValue& list, double unit);

/// What to write for a value whose type is another one than that of its key; empty where that is not known.
std::string advice_on_type(const KeyInfo& key, const CaseValue& value);

/// Type and range; throws Error (configuration) at the value. Not for triple_list, text_list, value_list and table.
void check_value(const KeyInfo& key, const CaseValue& value);
/// The same for one table of a list; complete: all required keys must be there.
void check_elements(const KeyInfo& list, const CaseTable& entries, const SourcePosition& where, bool complete);

/// Where a key of a group was given, by group.
struct ChosenKey {
  const KeyInfo* key;
  SourcePosition where;
};
using ChosenKeys = std::vector<ChosenKey>;
/// Refuses a key beside another alternative of its group, else notes it.
void check_exclusive(const KeyInfo& key, const SourcePosition& where, ChosenKeys& chosen);

[[noreturn]] void refuse_unknown_key(std::string_view path, const std::vector<std::string>& known,
                                     const SourcePosition& where);

/// The known key that an unknown one was probably meant to be; empty when nothing is near.
std::string nearest_key(std::string_view path, std::span<const std::string> known);

}  // namespace treadmark::io
