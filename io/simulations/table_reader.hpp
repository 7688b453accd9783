// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/core/pose.hpp"
#include "treadmark/io/settings/key_info.hpp"

namespace treadmark::io {

/// One table of a file, all of whose keys are known. Values come with type and range checked as their keys say, and
/// numbers in SI units by the ending of their key (unit_of_key). Refers to table and keys, which must outlive it; only
/// keys that are known may be asked for. Errors of all functions:
/// Error(configuration) at the place of the value, of a missing one at that of the table.
class TableReader {
 public:
  /// path: of the table in messages, "" = top of the file. Refuses keys that are not among known, with the nearest one
  /// that is.
  TableReader(const CaseTable& table, SourcePosition where, std::string path, const std::vector<KeyInfo>& known);

  const SourcePosition& where() const { return where_; }
  const std::string& path() const { return path_; }
  std::string path_of(std::string_view key) const;
  KeyType type_of(std::string_view key) const { return info(key).type; }

  /// The value, or null without it.
  const CaseValue* find(std::string_view key) const;
  /// The value. advice: without it, instead of what the key says itself.
  const CaseValue& need(std::string_view key, std::string advice = {}) const;
  const CaseTable* table(std::string_view key) const;
  /// The tables of a list [[key]]; none without it.
  std::vector<const CaseValue*> tables(std::string_view key) const;

  /// The value, checked, or null without it.
  const CaseValue* checked_if(std::string_view key) const;
  std::string text(std::string_view key) const;
  std::string text_or(std::string_view key, std::string otherwise) const;
  /// Empty without the key.
  std::vector<std::string> words(std::string_view key) const;
  /// A list of three numbers each.
  std::vector<Vec3> points(std::string_view key) const;
  /// Refuses that both are given.
  void exclude(std::string_view one, std::string_view other) const;
  /// Refuses that one is given without the other.
  void go_with(std::string_view one, std::string_view other) const;

  [[noreturn]] void fail(std::string message, std::string advice = {}) const;

 private:
  /// What is known of a key, with its whole path.
  KeyInfo info(std::string_view key) const;
  const CaseValue& checked(std::string_view key) const;

  const CaseTable& table_;
  SourcePosition where_;
  std::string path_;
  const std::vector<KeyInfo>& known_;
};

/// Error(configuration) for a name that is not among known, with the nearest one: "<what> 'bogi' is not known (did you
/// mean 'bogie'?)".
void check_name(std::string_view what, const std::string& name, std::span<const std::string> known,
                const SourcePosition& where);

}  // namespace treadmark::io
