// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/json/json_tree.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// What json_of wrote: every column that can be put must be there, as null where it is NaN, but those that may be not
/// known. Whole numbers are counts. Errors: those of the tree.
template <class Row>
void read_json(const JsonTree& object, Row& row) {
  for (const Column<Row>& column : columns<Row>()) {
    const Access<Row>& access = column.access;
    if (column.key.empty() || (access.put == nullptr && access.put_word == nullptr)) continue;
    if (access.has != nullptr && !object.has(column.key)) continue;
    const JsonTree value = object.at(column.key);
    if (access.put_word != nullptr)
      access.put_word(row, value.text());
    else if (access.flag)
      access.put(row, value.flag() ? 1.0 : 0.0);
    else if (access.whole && !value.is_null())
      access.put(row, static_cast<double>(value.count()));
    else
      access.put(row, value.number() / column.unit.per_si);
  }
}

}  // namespace treadmark::io
