// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/io/histories/history_model.hpp"
#include "treadmark/report/page.hpp"

namespace treadmark::app::pages {

/// How a quantity of histories is shown: its unit and what the SI value is multiplied by.
struct ShownUnit {
  double factor = 1.0;
  std::string name;
};

/// The name of a column without its unit, where shown_unit gives one: "q_max_N" is "q_max".
std::string shown_name(const std::string& column);

/// By the ending of the column's name: _N in kN (wear numbers in N), _Pa in MPa, _m2 in mm², _rad in degrees, gaps and
/// small displacements in mm.
ShownUnit shown_unit(const std::string& column);

/// Rows of a history of which at most `most` are to be shown, in order: first and last, and in each of many stretches
/// those with the least and the greatest value of each column, so that no peak is lost.
std::vector<std::size_t> thinned_rows(const io::SimulationResult& result, const std::vector<std::string>& columns,
                                      std::size_t most);

/// Values of a column at these rows in the shown unit; nothing where there is no such column.
std::optional<std::vector<double>> column_at(const io::SimulationResult& result, const std::string& column,
                                             const std::vector<std::size_t>& rows);

/// A panel with the columns that exist, as curves; nothing where none does. names: of the curves.
struct NamedColumn {
  std::string column, name;
};
std::optional<report::Panel> history_panel(const io::SimulationResult& result, const std::string& label,
                                           const std::vector<NamedColumn>& columns,
                                           const std::vector<std::size_t>& rows);

}  // namespace treadmark::app::pages
