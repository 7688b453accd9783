// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/hdf5/hdf5_reader.hpp"
#include "treadmark/io/hdf5/hdf5_writer.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// What is stored of a row, as attributes of its group.
template <class Row>
void write_attributes(const Hdf5GroupWriter& group, const Row& row) {
  for (const Column<Row>& column : columns<Row>()) {
    if (column.stored.empty() || !column.known(row)) continue;
    const std::string name(column.stored);
    if (column.access.word != nullptr)
      group.add({name, column.access.word(row)});
    else if (column.access.whole)
      group.add({name, static_cast<int>(column.access.get(row))});
    else
      group.add({name, column.access.get(row)});
  }
}

template <class Row>
void read_attributes(const Hdf5GroupReader& group, Row& row) {
  for (const Column<Row>& column : columns<Row>()) {
    if (column.stored.empty()) continue;
    const std::string name(column.stored);
    if (column.access.has != nullptr && !group.has_attribute(name)) continue;
    if (column.access.word != nullptr)
      column.access.put_word(row, group.text(name));
    else
      column.access.put(row, column.access.whole ? group.integer(name) : group.number(name));
  }
}

/// A list of rows: what is stored of each, a dataset a column; NaN: not known.
template <class Row>
void write_rows(const Hdf5GroupWriter& group, const std::vector<Row>& rows) {
  const auto write = [&]<class Value>(const Column<Row>& column, const std::vector<Value>& values) {
    group.write({std::string(column.stored), {values.size()}, std::string(column.unit.si), std::string(column.meaning)},
                values);
  };
  for (const Column<Row>& column : columns<Row>()) {
    if (column.stored.empty()) continue;
    std::vector<std::string> words;
    std::vector<double> numbers;
    for (const Row& row : rows)
      if (column.access.word != nullptr)
        words.push_back(column.access.word(row));
      else
        numbers.push_back(column.known(row) ? column.access.get(row) : kNaN);
    column.access.word != nullptr ? write(column, words) : write(column, numbers);
  }
}

/// Errors: also Error(input_data) for columns of unequal lengths.
template <class Row>
std::vector<Row> read_rows(const Hdf5GroupReader& group) {
  std::vector<Row> rows;
  const auto take = [&](bool first, const auto& values, auto set) {
    if (first) rows.resize(values.size());
    if (values.size() != rows.size())
      throw Error(ErrorKind::input_data, "the columns of a table differ in length", {group.file(), 0, 0});
    for (std::size_t i = 0; i < rows.size(); ++i) set(rows[i], values[i]);
  };
  bool first = true;
  for (const Column<Row>& column : columns<Row>()) {
    if (column.stored.empty()) continue;
    const std::string name(column.stored);
    if (column.access.word != nullptr)
      take(first, group.strings(name), [&](Row& row, const std::string& word) { column.access.put_word(row, word); });
    else
      take(first, group.numbers(name), [&](Row& row, double value) {
        if (column.access.has == nullptr || !std::isnan(value)) column.access.put(row, value);
      });
    first = false;
  }
  return rows;
}

}  // namespace treadmark::io
