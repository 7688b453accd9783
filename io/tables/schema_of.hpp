// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// A member of a JSON object that a row of a table writes.
struct SchemaRow {
  std::string key;        ///< "object.member": of an object in it
  std::string_view type;  ///< "number", "integer", "boolean", "string"
  bool or_null = false;
  bool always = true;  ///< false: left out where it is not known
  std::string meaning = {};
  bool listed = false;  ///< a list of these, one an item
};
using SchemaRows = std::vector<SchemaRow>;
using SchemaTables = std::map<std::string, SchemaRows>;  ///< by the name that a template has for them

/// What value_of (json_of.hpp) writes of a column.
template <class Row>
SchemaRow schema_row(const Column<Row>& column) {
  const Access<Row>& access = column.access;
  const bool word = access.word != nullptr;
  return {std::string(column.key),
          word           ? "string"
          : access.flag  ? "boolean"
          : access.whole ? "integer"
                         : "number",
          word ? access.flag : !access.flag && !access.whole, access.has == nullptr, std::string(column.meaning)};
}

/// What json_of writes of a row.
template <class Row>
SchemaRows schema_rows() {
  SchemaRows rows;
  for (const Column<Row>& column : columns<Row>())
    if (!column.key.empty()) rows.push_back(schema_row(column));
  return rows;
}

/// The same, each changed by change(row).
template <class Change>
SchemaRows changed(SchemaRows rows, Change change) {
  for (SchemaRow& row : rows) change(row);
  return rows;
}

/// What add_lists writes of such rows.
SchemaRows listed(SchemaRows rows);

/// JSON Schema (draft 2020-12) from a template, which is JSON and has what rows do not say. In it, where a schema may
/// stand:
///   "number"            of that type; "number?": or null; "number?: radius": with a description
///   ["number?"]         a list of these; ["number?", 3]: of three
///   {"properties": {}}  an object that has all of them and no others; "key?": which may be missing
///   "rows": "wheel"     beside or in place of "properties": that table's members, too. Those of "object.member" stand
///                       in that object, which may be missing unless one of them is always known; then all are there.
///                       What the template itself says of a member is added to what its row says.
/// The rest is taken as it is. Errors: std::logic_error and those of JSON, for a template with a mistake.
std::string filled_schema(std::string_view text, const SchemaTables& tables);

}  // namespace treadmark::io
