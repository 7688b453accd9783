// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/report/pages/history_panels.hpp"

#include <algorithm>
#include <numbers>
#include <set>

namespace treadmark::app::report {
namespace {

std::optional<std::size_t> find(const io::SimulationResult& result, const std::string& column) {
  const auto at = std::ranges::find(result.columns, column, &io::HistoryColumn::name);
  if (at == result.columns.end()) return {};
  return static_cast<std::size_t>(at - result.columns.begin());
}

}  // namespace

ShownUnit shown_unit(const std::string& column) {
  const auto ends = [&](const char* unit) { return column.ends_with(unit); };
  if (ends("_N")) return {1e-3, "kN"};
  if (ends("_Pa")) return {1e-6, "MPa"};
  if (ends("_m2")) return {1e6, "mm²"};
  if (ends("_rad")) return {180.0 / std::numbers::pi, "°"};
  if (ends("_W")) return {1.0, "W"};
  if (ends("_J")) return {1.0, "J"};
  if (ends("_s")) return {1.0, "s"};
  if (column == "x_m" || ends("_x_m")) return {1.0, "m"};  // distance travelled
  if (ends("_m")) return {1e3, "mm"};
  return {1.0, ""};
}

std::vector<std::size_t> thinned_rows(const io::SimulationResult& result, const std::vector<std::string>& columns,
                                      std::size_t most) {
  const std::size_t rows = result.rows();
  std::vector<std::size_t> out;
  std::vector<std::size_t> watched;
  for (const std::string& column : columns)
    if (const auto index = find(result, column)) watched.push_back(*index);
  const std::size_t each = 2 * std::max<std::size_t>(1, watched.size());
  if (rows <= most || most < each + 2) {
    for (std::size_t row = 0; row < rows; ++row) out.push_back(row);
    return out;
  }
  std::set<std::size_t> kept{0, rows - 1};
  const std::size_t stretches = std::max<std::size_t>(1, (most - 2) / each), width = result.columns.size();
  for (std::size_t k = 0; k < stretches; ++k) {
    const std::size_t begin = k * rows / stretches, end = (k + 1) * rows / stretches;
    if (watched.empty() && begin < end) kept.insert(begin);
    for (const std::size_t column : watched) {
      std::size_t low = begin, high = begin;
      for (std::size_t row = begin; row < end; ++row) {
        const double value = result.values[row * width + column];
        if (value < result.values[low * width + column]) low = row;
        if (value > result.values[high * width + column]) high = row;
      }
      kept.insert({low, high});
    }
  }
  return {kept.begin(), kept.end()};
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

}  // namespace treadmark::app::report
