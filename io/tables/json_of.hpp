// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/tables/number.hpp"

namespace treadmark::io {

/// What a column says of a row; null where it is not known.
template <class Row>
Json value_of(const Row& row, const Column<Row>& column, Digits digits = Digits::twelve) {
  if (!column.known(row)) return nullptr;
  if (column.access.word != nullptr) {
    const std::string word = column.access.word(row);
    return column.access.flag ? text_or_null(word) : Json(word);
  }
  const double value = column.in_file(row);
  if (column.access.flag) return value != 0.0;
  return column.access.whole && std::isfinite(value) ? Json(to_whole<long long>(value)) : number(value, digits);
}

/// The member of a key, which is one of an object for "object.member".
inline Json& member_of(Json& out, std::string_view key) {
  const std::size_t dot = key.find('.');
  if (dot == key.npos) return out[std::string(key)];
  return member_of(out[std::string(key.substr(0, dot))], key.substr(dot + 1));
}

/// Adds that under its key, where it has one and is known.
template <class Row>
void add_to(Json& out, const Row& row, const Column<Row>& column, Digits digits = Digits::twelve) {
  if (!column.key.empty() && column.known(row)) member_of(out, column.key) = value_of(row, column, digits);
}

template <class Row>
void add_all(Json& out, const Row& row, Digits digits = Digits::twelve) {
  for (const Column<Row>& column : columns<Row>()) add_to(out, row, column, digits);
}

template <class Row>
Json json_of(const Row& row, Digits digits = Digits::twelve) {
  Json out = Json::object();
  add_all(out, row, digits);
  return out;
}

/// A list of objects.
template <class Row>
Json json_of(const std::vector<Row>& rows, Digits digits = Digits::twelve) {
  Json out = Json::array();
  for (const Row& row : rows) out.push_back(json_of(row, digits));
  return out;
}

/// Adds a list for each column with a key that is known of a row.
template <class Row>
void add_lists(Json& out, const std::vector<Row>& rows, Digits digits = Digits::twelve) {
  for (const Column<Row>& column : columns<Row>()) {
    const auto known = [&](const Row& row) { return column.known(row); };
    if (column.key.empty() || (column.access.has != nullptr && ranges::none_of(rows, known))) continue;
    Json& list = member_of(out, column.key) = Json::array();
    for (const Row& row : rows) list.push_back(value_of(row, column, digits));
  }
}

}  // namespace treadmark::io
