// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <concepts>
#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/io/simulations/table_reader.hpp"

namespace treadmark::io {

/// A table whose keys are members of a Root, which stand for their keys: pointers to them, or Root& -> member&. Where
/// several keys have one member, it stands for the one that is given, else for the first.
template <class Root>
class TableOf : public TableReader {
 public:
  TableOf(const CaseTable& table, SourcePosition where, std::string path, const KeyTable<Root>& keys)
      : TableReader(table, std::move(where), std::move(path), keys.infos), rows_(keys.rows) {}
  /// One of a list of tables.
  TableOf(const CaseValue& table, std::string path, const KeyTable<Root>& keys)
      : TableOf(table.table(), table.where, std::move(path), keys) {}
  /// Some of the keys of a table.
  TableOf(const TableReader& table, const KeyTable<Root>& keys) : TableReader(table), rows_(keys.rows) {}

  /// Sets all members whose keys are given, but for those that readers take apart. Of keys of one member only one may
  /// be given.
  void read(Root& out) const {
    for (auto row = rows_.begin(); row != rows_.end(); ++row)
      for (auto other = rows_.begin(); other != row; ++other)
        if (row->member && other->member && row->member(out) == other->member(out))
          TableReader::exclude(other->info.path, row->info.path);
    for (const SettingKey<Root>& row : rows_) {
      if (!row.set) continue;
      if (row.info.required) TableReader::need(row.info.path);
      if (const CaseValue* value = checked_if(row.info.path)) row.set(out, *value, {});
    }
  }
  Root read() const {
    Root out{};
    read(out);
    return out;
  }

  template <class Member>
  std::string_view key(Member member) const requires std::invocable<Member, const Root&> {
    static const Root fresh{};
    const void* const place = &std::invoke(member, fresh);
    std::string_view first;
    for (const SettingKey<Root>& row : rows_) {
      if (!row.member || row.member(fresh) != place) continue;
      if (TableReader::find(row.info.path) != nullptr) return row.info.path;
      if (first.empty()) first = row.info.path;
    }
    return first;
  }
  template <class Member>
  const CaseValue* find(Member member) const requires std::invocable<Member, const Root&> {
    return TableReader::find(key(member));
  }
  template <class Member>
  const CaseValue& need(Member member, std::string advice = {}) const requires std::invocable<Member, const Root&> {
    return TableReader::need(key(member), std::move(advice));
  }
  template <class Member>
  std::string path_of(Member member) const requires std::invocable<Member, const Root&> {
    return TableReader::path_of(key(member));
  }
  template <class Member>
  std::vector<const CaseValue*> tables(Member member) const requires std::invocable<Member, const Root&> {
    return TableReader::tables(key(member));
  }
  template <class One, class Other>
  void exclude(One one, Other other) const
      requires(std::invocable<One, const Root&>&& std::invocable<Other, const Root&>) {
    TableReader::exclude(key(one), key(other));
  }
  /// Refuses that a key is given without another one, without which it does nothing.
  template <class One, class Other>
  void go_with(One one, Other other) const
      requires(std::invocable<One, const Root&>&& std::invocable<Other, const Root&>) {
    TableReader::go_with(key(one), key(other));
  }
  /// Error(configuration) at the value of a key.
  template <class Member>
  [[noreturn]] void refuse(Member member, std::string message, std::string advice = {}) const {
    throw Error(ErrorKind::configuration, std::move(message), need(member).where, std::move(advice));
  }
  using TableReader::exclude;
  using TableReader::find;
  using TableReader::need;
  using TableReader::path_of;
  using TableReader::tables;

 private:
  const std::vector<SettingKey<Root>>& rows_;
};

}  // namespace treadmark::io
