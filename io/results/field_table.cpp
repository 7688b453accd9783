// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/field_table.hpp"

#include <fmt/format.h>

#include <cstddef>

#include "treadmark/core/error.hpp"

namespace treadmark::io {

void check_field_sizes(const PatchFields& fields, int case_number, int patch_number) {
  const auto check = [&](std::string_view name, std::size_t size) {
    if (size == 0 || size == fields.grid.size()) return;
    throw Error(ErrorKind::configuration,
                fmt::format("case {}, patch {}: field {} has {} values on a grid of {} elements", case_number,
                            patch_number, name, size, fields.grid.size()));
  };
  for (const FieldColumn& column : kFieldColumns) check(column.name, (fields.*column.values).size());
  check("state", fields.state.size());
  if (!fields.row_angle.empty() && fields.row_angle.size() != static_cast<std::size_t>(fields.grid.ny))
    throw Error(ErrorKind::configuration, fmt::format("case {}, patch {}: {} inclinations of {} rows", case_number,
                                                      patch_number, fields.row_angle.size(), fields.grid.ny));
}

std::string field_quantity_table() {
  std::string out = "| dataset | unit | meaning |\n|---|---|---|\n";
  for (const FieldColumn& column : kFieldColumns)
    out += fmt::format("| `{}` | {}{} | {} |\n", column.name, column.unit,
                       column.unit == column.unit_shift ? "" : fmt::format(" (shift: {})", column.unit_shift),
                       column.meaning);
  return out;
}

}  // namespace treadmark::io
