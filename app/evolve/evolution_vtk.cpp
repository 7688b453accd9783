// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/evolve/evolution_vtk.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "treadmark/analysis/damage/record.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/results/subsurface_table.hpp"

namespace treadmark::app {
namespace {

constexpr int kTurnParts = 72;  // of a wheel that is the same all round

/// Columns as they are drawn.
struct DrawnColumns {
  double first_edge, step;
  int count;

  explicit DrawnColumns(const SurfaceCells& c) : first_edge(c.u0 - 0.5 * c.du), step(c.du), count(c.nu) {
    if (!c.uniform()) return;
    count = c.body == Body::wheel ? kTurnParts : 1;
    step = c.body == Body::wheel ? 2.0 * kPi / kTurnParts : 1.0;
    first_edge = -0.5 * step;
  }
};

/// Heights of the surface over y at a place along.
std::vector<double> section_at(const Surface& surface, Body body, double u, const std::vector<double>& y) {
  std::vector<Vec2> points;
  points.reserve(y.size());
  for (const double value : y) points.emplace_back(body == Body::wheel ? 0.0 : u, value);
  std::vector<double> z(y.size());
  const Pose turned{Vec3::Zero(), Eigen::AngleAxisd(body == Body::wheel ? u : 0.0, Vec3::UnitY()).toRotationMatrix()};
  surface.heights_at(turned, points, {z, {}, {}});
  return z;
}

struct VtkCells {
  const SurfaceCells& cells;
  int first, last;  ///< rows
  int columns;

  std::string array(const std::string& name, const CellSheet& sheet, const auto& value) const {
    std::vector<float> out;
    out.reserve(static_cast<std::size_t>(columns) * static_cast<std::size_t>(last - first + 1));
    for (int j = first; j <= last; ++j)
      for (int i = 0; i < columns; ++i)
        out.push_back(static_cast<float>(value(sheet.at(cells.uniform() ? 0 : i, j), j)));
    return io::vtk_data_array(name, out, 1);
  }

  template <class Record>
  std::string plain(const std::string& prefix, const SheetRow<Record>& row, const Record& record) const {
    const CellSheet& sheet = record.*row.sheet;
    if (sheet.rows().empty()) return "";
    const std::string name =
        prefix + row.name + (std::string_view(row.unit) == "1" ? "" : fmt::format("_{}", row.unit));
    return array(name, sheet, [](double value, int) { return value; });
  }
};

}  // namespace

std::string evolved_surface_vts(const Surface& surface, const io::EvolvedBody& body) {
  const SurfaceCells& c = body.cells;
  const SurfaceRecord& record = body.record;
  int first = c.ny, last = -1;
  for (const auto& row : kSheets)
    if (const auto& rows = (record.*row.sheet).rows(); !rows.empty()) {
      first = std::min(first, rows.begin()->first);
      last = std::max(last, rows.rbegin()->first);
    }
  const DrawnColumns columns(c);
  std::vector<double> y;
  std::vector<std::vector<double>> sections;
  for (int j = first; j <= last + 1; ++j) y.push_back(c.y(j) - 0.5 * c.dy);
  if (y.empty()) return "";
  for (int i = 0; i <= columns.count; ++i)
    sections.push_back(section_at(surface, c.body, columns.first_edge + i * columns.step, y));
  // edges of rows at the border may lie beyond it
  const auto there = [&](std::size_t k) {
    return ranges::all_of(sections, [k](const auto& z) { return std::isfinite(z[k]); });
  };
  std::size_t low = 0, high = y.size() - 1;
  while (low < high && !there(low)) ++low;
  while (high > low && !there(high)) --high;
  if (low == high) return "";
  std::vector<double> points;
  points.reserve(3 * sections.size() * (high - low + 1));
  for (std::size_t k = low; k <= high; ++k)
    for (int i = 0; i <= columns.count; ++i) {
      const double u = columns.first_edge + i * columns.step, z = sections[static_cast<std::size_t>(i)][k];
      const bool wheel = c.body == Body::wheel;
      points.insert(points.end(), {wheel ? z * std::sin(u) : u, y[k], wheel ? z * std::cos(u) : z});
    }
  const VtkCells cells{c, first + static_cast<int>(low), first + static_cast<int>(high) - 1, columns.count};
  std::string data = cells.array("depth_m", record.volume, [&](double volume, int j) {
    return damage::depth_of(c, volume, j);
  }) + cells.array("work_J/m2", record.work, [&](double work, int j) { return work / c.area(j); });
  for (const auto& row : kSheets)
    if (row.sheet != &SurfaceRecord::volume && row.sheet != &SurfaceRecord::work) data += cells.plain("", row, record);
  for (std::size_t k = 0; k < record.stresses.size(); ++k)
    for (const auto& row : kStressSheets) data += cells.plain(fmt::format("depth_{}_", k + 1), row, record.stresses[k]);
  for (std::size_t k = 0; k < record.flow.size(); ++k)
    for (const auto& row : kFlowSheets) data += cells.plain(fmt::format("flow_{}_", k + 1), row, record.flow[k]);
  return io::vtk_structured_grid(fmt::format("0 {} 0 {} 0 0", columns.count, high - low), "CellData", data,
                                 io::vtk_data_array("points_m", points, 3));
}

}  // namespace treadmark::app
