// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/tables/number.hpp"

namespace treadmark::io {

/// What a column says of a row; null where it is not known.
template <class Row>
Json value_of(const Row& row, const Column<Row>& column) {
  if (!column.known(row)) return nullptr;
  if (column.access.word != nullptr) return column.access.word(row);
  if (column.access.whole) return static_cast<long long>(column.access.get(row));
  return number(column.in_file(row));
}

/// Adds that under its key, where it has one and is known.
template <class Row>
void add_to(Json& out, const Row& row, const Column<Row>& column) {
  if (!column.key.empty() && column.known(row)) out[std::string(column.key)] = value_of(row, column);
}

template <class Row>
Json json_of(const Row& row) {
  Json out = Json::object();
  for (const Column<Row>& column : columns<Row>()) add_to(out, row, column);
  return out;
}

/// Adds a list for each column with a key.
template <class Row>
void add_lists(Json& out, const std::vector<Row>& rows) {
  for (const Column<Row>& column : columns<Row>()) {
    if (column.key.empty()) continue;
    Json& list = out[std::string(column.key)] = Json::array();
    for (const Row& row : rows) list.push_back(value_of(row, column));
  }
}

}  // namespace treadmark::io
