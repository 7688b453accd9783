// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/tables/shown.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// Whether there is something to read.
template <class Row>
bool said(const Row& row, const Column<Row>& column) {
  return !column.label.empty() && column.known(row) &&
         (column.access.word == nullptr || !column.access.word(row).empty());
}

/// A number or text of a row without its unit; a dash where it is not known.
template <class Row>
std::string bare_text(const Row& row, const Column<Row>& column) {
  if (!column.known(row)) return "-";
  if (column.access.word != nullptr) return column.access.word(row);
  if (column.access.flag) return column.access.get(row) != 0.0 ? "yes" : "no";
  return shown_number(column.in_file(row), column.access.whole ? 0 : column.decimals);
}

/// "1435.000 mm", "0.174 +- 0.012"; the reason where there is no number.
template <class Row>
std::string text_of(const Row& row, const Column<Row>& column) {
  const std::string bare = bare_text(row, column);
  const std::string reason = column.access.reason != nullptr ? column.access.reason(row) : std::string();
  if (bare == "-") return reason.empty() ? bare : reason;
  const double uncertainty = column.access.uncertainty != nullptr ? column.access.uncertainty(row) : 0.0;
  return with_unit(bare, column.unit.per_si * uncertainty, column.unit.name);
}

/// A line for each column that people read, its value from the column of this width on.
template <class Row>
std::string lines_of(const Row& row, std::size_t width) {
  std::string out;
  for (const Column<Row>& column : columns<Row>())
    if (said(row, column)) out += text_line(column.label, width, text_of(row, column));
  return out;
}

/// The same in one line, without dashes: "normal force 50008 N, largest pressure 608 MPa".
template <class Row>
std::string phrase_of(const Row& row) {
  std::string out;
  for (const Column<Row>& column : columns<Row>())
    if (const std::string text = said(row, column) ? text_of(row, column) : "-"; text != "-")
      out += (out.empty() ? "" : ", ") + std::string(column.label) + ' ' + text;
  return out;
}

/// A table with a line a row, of the columns that people read of some row; units in its head.
template <class Row>
std::string table_of(const std::vector<Row>& rows) {
  std::vector<std::string> lines(rows.size() + 1);
  for (const Column<Row>& column : columns<Row>()) {
    if (ranges::none_of(rows, [&](const Row& row) { return said(row, column); })) continue;
    const std::string head = with_unit(std::string(column.label), 0.0, column.unit.name);
    std::vector<std::string> cells{head};
    for (const Row& row : rows) cells.push_back(bare_text(row, column));
    add_column(lines, cells, column.access.word != nullptr);
  }
  return joined_lines(lines);
}

}  // namespace treadmark::io
