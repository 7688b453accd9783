// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cctype>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/io/tables/text_of.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::report {

/// A card for each column of a row that belongs there, with its meaning.
template <class Row>
void add_cards(Cards& cards, const Row& row) {
  for (const treadmark::Column<Row>& column : columns<Row>()) {
    if ((column.shown & kInCards) == 0 || !column.known(row)) continue;
    std::string label(column.label);
    label[0] = static_cast<char>(std::toupper(static_cast<unsigned char>(label[0])));
    cards.cards.push_back({std::move(label), io::text_of(row, column), std::string(column.meaning)});
  }
}

/// All that people read of a row.
template <class Row>
void add_facts(Facts& facts, const Row& row) {
  for (const treadmark::Column<Row>& column : columns<Row>())
    if (io::said(row, column)) facts.entries.emplace_back(column.label, io::text_of(row, column));
}

/// A line a row, of the columns that people read; numbers have so many digits, whole ones all.
template <class Row>
Table table_of(std::string id, std::string caption, const std::vector<Row>& rows, int digits = Number{}.digits) {
  Table table{std::move(id), std::move(caption), {}};
  table.rows.resize(rows.size());
  for (const treadmark::Column<Row>& column : columns<Row>()) {
    if (column.label.empty()) continue;
    table.columns.push_back({std::string(column.label), column.unit.name == "1" ? "" : std::string(column.unit.name)});
    for (std::size_t i = 0; i < rows.size(); ++i)
      table.rows[i].cells.push_back(column.access.word != nullptr
                                        ? Cell(column.access.word(rows[i]))
                                        : Cell(Number{column.in_file(rows[i]), column.access.whole ? 12 : digits}));
  }
  return table;
}

}  // namespace treadmark::report
