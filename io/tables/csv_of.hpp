// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include <fmt/format.h>

#include "treadmark/io/files/text.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// Adds the keys of a table to a line, a comma behind each.
template <class Row>
void add_heads(std::string& line) {
  for (const Column<Row>& column : columns<Row>())
    if (!column.key.empty()) line += fmt::format("{},", column.key);
}

/// Adds what the columns say of a row; empty where it is not known.
template <class Row>
void add_cells(std::string& line, const Row& row) {
  for (const Column<Row>& column : columns<Row>()) {
    if (column.key.empty()) continue;
    if (!column.known(row))
      line += ',';
    else if (column.access.word != nullptr)
      line += csv_cell(column.access.word(row)) + ',';
    else
      line += csv_cell(column.in_file(row)) + ',';
  }
}

}  // namespace treadmark::io
