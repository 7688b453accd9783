// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "treadmark/io/results/result_model.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark::io {

/// The numbers of a result, one row each: all writers and readers of result files walk these tables, their schema is
/// made of them, and the documentation is held against them. Fields of patches have their own table (field_table.hpp).

/// A unit of measure in SI, in the names of JSON and for people. The conversions take SI.
struct Unit {
  std::string_view si;  ///< "1" = dimensionless, empty = a count
  double (*in_file)(double);
  std::string_view shown;  ///< "-" = dimensionless, empty = a count
  double (*to_shown)(double);
};

/// Rows that are known together, in the order in which HDF5 has them.
enum class Block {
  force,
  creepage,
  approach,
  pressure,
  energy,
  relative,  ///< older files lack these
  count,     ///< older files lack these
  heat,      ///< each where it was computed; also what noise leaves uncertain
  shape,     ///< older files lack these, and contacts at the end of a surface
  refined,   ///< where it was estimated
  rolling,
  place,
  angle,
  in_grid,
  arc,
  local,
  work,
  wheelset,
  deflection,
  roller,
  timing,
};

/// Attribute of HDF5 in SI units; component >= 0: rows below each other with the same name are the components of a
/// vector.
struct Stored {
  std::string_view name = {};  ///< empty: not stored
  int component = -1;
};

/// In the summary on the terminal and beside the pictures of reports.
struct Label {
  enum class Digits { four_decimals, five, four, whole };
  std::string_view text = {};  ///< in the summary; empty: not there
  Digits digits = Digits::five;
  std::string_view page = {};      ///< name in the data of reports, with its unit; empty: not there
  std::string_view in_shift = {};  ///< text in a shift; empty: as text
};

template <class T>
struct Quantity {
  std::string_view object, key;  ///< JSON: member of the patch or case (empty: itself) and name; no key: not there
  Unit unit;
  Block block;
  Access<T> access;
  std::string_view meaning;
  Stored stored = {};
  Label label = {};
  Unit in_shift = {};  ///< no name: as unit

  bool has(const T& item) const { return access.has == nullptr || access.has(item); }
  const Unit& unit_in(bool shift) const { return shift && !in_shift.si.empty() ? in_shift : unit; }
};

/// In the order of JSON; T is PatchResult or CaseResult.
template <class T>
std::span<const Quantity<T>> quantities();
template <>
std::span<const Quantity<PatchResult>> quantities();
template <>
std::span<const Quantity<CaseResult>> quantities();

/// The member that says whether a patch or case has the rows of a block; nullptr: each row says it itself.
template <class T>
bool T::*flag_of(Block block);
template <>
bool PatchResult::*flag_of(Block block);
template <>
bool CaseResult::*flag_of(Block block);

template <class T>
bool has_block(const T& item, Block block) {
  const auto flag = flag_of<T>(block);
  return flag == nullptr || item.*flag;
}

/// Calls visit(rows) for each attribute of a block: one row, or those of the components of a vector.
template <class T, class Visit>
void for_each_stored(Block block, Visit&& visit) {
  const auto rows = quantities<T>();
  for (std::size_t first = 0, next = 0; first < rows.size(); first = next) {
    const Stored& stored = rows[first].stored;
    next = first + 1;
    while (next < rows.size() && stored.component >= 0 && rows[next].stored.name == stored.name) ++next;
    if (rows[first].block == block && !stored.name.empty()) visit(rows.subspan(first, next - first));
  }
}

/// A name of JSON with its object, "force_on_rail.fz_tr_N", and without the unit, for the number in SI.
std::string name_in_file(std::string_view object, std::string_view key);
std::string name_in_si(std::string_view object, std::string_view key, const Unit& unit);
template <class T>
std::string name_of(const Quantity<T>& row) {
  return name_in_file(row.object, row.key);
}
template <class T>
std::string si_name(const Quantity<T>& row) {
  return name_in_si(row.object, row.key, row.unit);
}

/// All rows with a key in JSON as Markdown table (docs/results.md).
std::string patch_quantity_table();
std::string case_quantity_table();

}  // namespace treadmark::io
