// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

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
void add_cells(std::string& line, const Row& row, treadmark::Digits digits = treadmark::Digits::twelve) {
  for (const Column<Row>& column : columns<Row>()) {
    if (column.key.empty()) continue;
    if (!column.known(row))
      line += ',';
    else if (column.access.word != nullptr)
      line += csv_cell(column.access.word(row)) + ',';
    else if (column.access.flag)
      line += column.access.get(row) != 0.0 ? "true," : "false,";
    else
      line += csv_cell(column.in_file(row), column.access.whole ? treadmark::Digits::all : digits) + ',';
  }
}

/// A table: its keys, then a line a row.
template <class Row>
std::string csv_of(const std::vector<Row>& rows, treadmark::Digits digits = treadmark::Digits::twelve) {
  std::string out;
  add_heads<Row>(out);
  out.back() = '\n';
  for (const Row& row : rows) {
    add_cells(out, row, digits);
    out.back() = '\n';
  }
  return out;
}

}  // namespace treadmark::io
