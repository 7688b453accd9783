// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/pages/history_panels.hpp"

#include <iterator>
#include <numbers>
#include <string_view>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/report/shown_steps.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

std::optional<std::size_t> find(const io::SimulationResult& result, const std::string& column) {
  const auto at = ranges::find(result.columns, column, &io::HistoryColumn::name);
  if (at == result.columns.end()) return {};
  return static_cast<std::size_t>(at - result.columns.begin());
}

}  // namespace

namespace {

struct UnitEnding {
  std::string_view ending;
  ShownUnit shown;
};
const UnitEnding kUnitEndings[] = {
    {"_N", {1e-3, "kN"}}, {"_Pa", {1e-6, "MPa"}}, {"_m2", {1e6, "mm²"}},  {"_rad", {180.0 / std::numbers::pi, "°"}},
    {"_W", {1.0, "W"}},   {"_J", {1.0, "J"}},     {"_m_s", {1.0, "m/s"}}, {"_rad_s", {1.0, "rad/s"}},
    {"_s", {1.0, "s"}},   {"_x_m", {1.0, "m"}},  // distance travelled
    {"_m", {1e3, "mm"}}};

const UnitEnding* unit_ending(const std::string& column) {
  const auto found = ranges::find_if(kUnitEndings, [&](const UnitEnding& u) { return column.ends_with(u.ending); });
  return found == std::end(kUnitEndings) ? nullptr : &*found;
}

}  // namespace

ShownUnit shown_unit(const std::string& column) {
  if (column == "x_m") return {1.0, "m"};
  if (column.ends_with("Tgamma_N")) return {1.0, "N"};  // as wear laws have it
  const UnitEnding* unit = unit_ending(column);
  return unit == nullptr ? ShownUnit{} : unit->shown;
}

std::string shown_name(const std::string& column) {
  constexpr std::string_view kPlace = "_x_m";
  const UnitEnding* unit = unit_ending(column);
  if (unit == nullptr) return column;
  return column.substr(0, column.size() - (unit->ending == kPlace ? 2 : unit->ending.size()));
}

std::vector<std::size_t> thinned_rows(const io::SimulationResult& result, const std::vector<std::string>& columns,
                                      std::size_t most) {
  std::vector<RowValue> watched;
  for (const std::string& column : columns)
    if (const auto index = find(result, column))
      watched.emplace_back(
          [&result, at = *index](std::size_t row) { return result.values[row * result.columns.size() + at]; });
  return spread_rows(result.rows(), most, watched);
}

std::optional<std::vector<double>> column_at(const io::SimulationResult& result, const std::string& column,
                                             const std::vector<std::size_t>& rows) {
  const auto index = find(result, column);
  if (!index) return {};
  const double factor = shown_unit(column).factor;
  std::vector<double> out;
  out.reserve(rows.size());
  for (const std::size_t row : rows) out.push_back(factor * result.values[row * result.columns.size() + *index]);
  return out;
}

std::optional<Panel> history_panel(const io::SimulationResult& result, const std::string& label,
                                   const std::vector<NamedColumn>& columns, const std::vector<std::size_t>& rows) {
  Panel panel{label, ""};
  for (const NamedColumn& one : columns)
    if (auto values = column_at(result, one.column, rows)) {
      panel.unit = shown_unit(one.column).name;
      panel.series.push_back({one.name, std::move(*values)});
    }
  if (panel.series.empty()) return {};
  return panel;
}

}  // namespace treadmark::app::pages
