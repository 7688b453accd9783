// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/io/tables/number.hpp"

namespace treadmark::io {

/// Adds what a column says of a row, where it has a key and is known.
template <class Row>
void add_to(Json& out, const Row& row, const Column<Row>& column) {
  if (column.key.empty() || !column.known(row)) return;
  Json& value = out[std::string(column.key)];
  if (column.access.word != nullptr)
    value = row.*column.access.word;
  else if (column.access.whole)
    value = static_cast<long long>(column.access.get(row));
  else
    value = number(column.in_file(row));
}

template <class Row>
Json json_of(const Row& row) {
  Json out = Json::object();
  for (const Column<Row>& column : columns<Row>()) add_to(out, row, column);
  return out;
}

}  // namespace treadmark::io
