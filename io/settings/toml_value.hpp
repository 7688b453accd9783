// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/never_held.hpp"

namespace treadmark::io {

struct CaseValue;

/// Entries of a table in the order of the file, with the position of each key.
struct CaseEntry;
using CaseTable = std::vector<CaseEntry>;

/// A value of a file with its position, independent of the TOML library.
struct CaseValue {  // NOLINT(bugprone-exception-escape): lists of themselves move without throwing
  SourcePosition where;
  std::variant<bool, std::int64_t, double, std::string, std::vector<CaseValue>, CaseTable, NeverHeld> data;

  bool is_table() const { return std::holds_alternative<CaseTable>(data); }
  bool is_list() const { return std::holds_alternative<std::vector<CaseValue>>(data); }
  const CaseTable& table() const { return std::get<CaseTable>(data); }
  const std::vector<CaseValue>& list() const { return std::get<std::vector<CaseValue>>(data); }
  const std::string& text() const { return std::get<std::string>(data); }
  bool flag() const { return std::get<bool>(data); }
  std::int64_t integer() const { return std::get<std::int64_t>(data); }
  /// Number of an integer or a real.
  double number() const;
  /// "a number", "text" ... for messages.
  std::string_view kind() const;
};

struct CaseEntry {  // NOLINT(bugprone-exception-escape)
  std::string key;
  SourcePosition key_where;
  CaseValue value;
};

/// Parses TOML in UTF-8 or UTF-16; throws Error (configuration) with the position of a syntax error and what to write
/// instead (toml_faults.hpp), or of what is nested too deeply (toml_nesting.hpp).
CaseTable parse_toml(std::string_view text, const std::string& name);

/// A text as it stands in a TOML file, in quotes.
std::string toml_text(const std::string& text);

/// The value of an override "key.path=value": TOML syntax, and a bare word is text.
struct CaseOverride {
  std::string path;
  CaseValue value;
  std::string raw;  ///< the value as written: "60E1" is a number in TOML but may be meant as text
};
CaseOverride parse_override(std::string_view assignment);

}  // namespace treadmark::io
