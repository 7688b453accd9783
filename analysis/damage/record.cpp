// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/damage/record.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "treadmark/analysis/damage/wear.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::damage {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;
constexpr double kMostCells = 20e6;

/// Cells and shares of them; the shares of one element sum up to one.
using Shares = std::vector<std::pair<int, double>>;

/// Share of a box [-a, a] that moved by [-b, b] which lies below t: two even distributions one after the other.
double below(double t, double a, double b) {
  const double half = std::max(a, b), other = std::min(a, b);
  if (t <= -(half + other)) return 0.0;
  if (t >= half + other) return 1.0;
  if (other < 1e-9 * half) return std::clamp(0.5 * (t + half) / half, 0.0, 1.0);
  const auto square = [](double x) { return x > 0.0 ? x * x : 0.0; };
  return (square(t + half + other) - square(t + half - other) - square(t - half + other) + square(t - half - other)) /
         (8.0 * half * other);
}

/// Cells of step d, the middle of the first at x0, below the moved box round a middle.
Shares shares_of(double middle, double a, double b, double x0, double d) {
  Shares shares;
  const double first_edge = x0 - 0.5 * d;
  const int first = to_whole<int>(std::floor((middle - a - b - first_edge) / d)),
            last = to_whole<int>(std::floor((middle + a + b - first_edge) / d));
  double before = 0.0;
  for (int k = first; k <= last; ++k) {
    const double upto = k == last ? 1.0 : below(first_edge + (k + 1) * d - middle, a, b);
    if (upto > before) shares.emplace_back(k, upto - before);
    before = upto;
  }
  return shares;
}

/// Rows under an element; what hangs over the border of the surface goes to the rows that are there.
Shares rows_of(const SurfaceCells& cells, double y_low, double y_high) {
  const double half = 0.5 * (y_high - y_low);
  Shares rows = shares_of(0.5 * (y_low + y_high), std::max(half, 1e-12), 0.0, cells.y0, cells.dy);
  double there = 0.0;
  std::erase_if(rows, [&](const auto& row) { return !cells.exists(row.first); });
  for (const auto& row : rows) there += row.second;
  if (!(there > 0.0))
    throw Error(ErrorKind::input_data,
                fmt::format("a contact at y = {:.3f} mm lies beside the surface that evolves", 1e3 * y_low), {},
                "the surface must go on beyond its contacts");
  for (auto& row : rows) row.second /= there;
  return rows;
}

Shares columns_of(const SurfaceCells& cells, const PassedPatch& patch, const PassedElement& e, const Stretch& s,
                  double radius) {
  if (cells.uniform()) return {{0, 1.0}};
  const double half = 0.5 * patch.length / radius, moved = 0.5 * (s.end - s.begin);
  const double middle = e.u + 0.5 * (s.begin + s.end) - s.middle;
  // the larger one first; a whole turn is not more than one
  Shares shares = shares_of(middle, half, std::max(moved, 0.0), cells.u0, cells.du);
  for (auto& share : shares) {
    share.first = cells.wrapped(share.first);
    if (share.first < 0 || share.first >= cells.nu)
      throw Error(ErrorKind::input_data,
                  fmt::format("a contact at x = {:.1f} mm lies beyond the cells of the rail", 1e3 * middle), {},
                  "this is a defect of the program");
  }
  return shares;
}

}  // namespace

SurfaceCells make_cells(const Surface& surface, Body body, double nominal_radius, const CellSettings& settings) {
  if (!(settings.dy > 0.0) || !(settings.du > 0.0))
    throw Error(ErrorKind::configuration, "the steps of a surface that evolves must be positive");
  constexpr double kWidest = 1.0;  // [m]
  const Box3 box = surface.bounds();
  const double y_min = std::max(box.min.y(), -kWidest), y_max = std::min(box.max.y(), kWidest);
  SurfaceCells cells;
  cells.body = body;
  cells.dy = settings.dy;
  cells.y0 = settings.dy * std::ceil(y_min / settings.dy);
  const double rows = std::floor((y_max - cells.y0) / settings.dy) + 1.0;
  double columns = 1.0;
  if (settings.uniform) {
    cells.du = body == Body::wheel ? kTurn : 1.0;
  } else if (body == Body::wheel) {
    columns = std::max(64.0, std::round(kTurn * nominal_radius / settings.du));
    cells.du = kTurn / columns;
  } else {
    columns = std::ceil((settings.u_max - settings.u_min) / settings.du) + 1.0;
    cells.u0 = settings.u_min;
    cells.du = settings.du;
  }
  if (!(rows >= 2.0) || !(rows * columns <= kMostCells))
    throw Error(ErrorKind::configuration,
                fmt::format("a surface of {:.0f} x {:.0f} cells cannot evolve", columns, rows), {},
                fmt::format("choose du_mm and dy_mm for at least two rows and at most {:.0f} cells", kMostCells));
  cells.nu = to_whole<int>(columns);
  cells.ny = to_whole<int>(rows);
  cells.radius.assign(static_cast<std::size_t>(cells.ny), 1.0);
  std::vector<Vec2> points;
  points.reserve(static_cast<std::size_t>(cells.ny));
  for (int j = 0; j < cells.ny; ++j) points.emplace_back(0.0, cells.y(j));
  std::vector<double> z(points.size());
  surface.heights_at(Pose{}, points, {z, {}, {}});
  std::size_t found = 0;
  for (std::size_t j = 0; j < z.size(); ++j) {
    const bool there = std::isfinite(z[j]);
    found += there ? 1 : 0;
    if (!there || body == Body::wheel) cells.radius[j] = z[j];
  }
  if (found < 2)
    throw Error(ErrorKind::input_data, "there is no surface to evolve at x = 0 or theta = 0", {},
                "the cells of an evolution begin there");
  return cells;
}

void add_patch(SurfaceRecord& record, const SurfaceCells& cells, const WearLaw& law, const PassedPatch& patch,
               const Stretch& stretch, double seconds, double count) {
  record.work_of_contacts += patch.power * seconds;
  const double area = patch.element_area();
  std::set<int> touched;
  for (const PassedElement& e : patch.elements) {
    const double volume = depth_rate(law, patch, e) * area * seconds, work = e.dissipation * area * seconds;
    record.volume_by_law += volume;
    // way of the surfaces over each other at the element's place, over the width that it has in the view of the cells
    const double swept = e.slip * patch.velocity * seconds * patch.length * (e.y_high - e.y_low);
    for (const auto& [j, share_y] : rows_of(cells, e.y_low, e.y_high)) {
      double* temperatures = patch.fatigue[FatigueMeasure::martensite] > 0.0 ? &record.temperature.ref(0, j) : nullptr;
      const double radius = cells.radius[static_cast<std::size_t>(j)], slid = swept / cells.area(j);
      double *volumes = &record.volume.ref(0, j), *works = &record.work.ref(0, j), *slides = &record.sliding.ref(0, j),
             *pressures = &record.pressure.ref(0, j), *tractions = &record.traction.ref(0, j);
      touched.insert(j);
      for (const auto& [i, share_u] : columns_of(cells, patch, e, stretch, radius)) {
        const double share = share_y * share_u;
        volumes[i] += share * volume;
        works[i] += share * work;
        slides[i] += share * slid;
        pressures[i] = std::max(pressures[i], e.pressure);
        tractions[i] = std::max(tractions[i], e.traction);
        if (temperatures) temperatures[i] = std::max(temperatures[i], e.temperature);
      }
    }
  }
  // stretches lie side by side: a cell has a part of a passage from each that shares it
  Shares along{{0, 1.0}};
  if (!cells.uniform()) {
    const double half = 0.5 * (stretch.end - stretch.begin);
    along = shares_of(stretch.begin + half, half, 0.0, cells.u0, cells.du);
    for (auto& share : along) share.second *= 2.0 * half / cells.du;
  }
  for (auto& share : along) share.first = cells.wrapped(share.first);
  std::erase_if(along, [&](const auto& share) { return share.first < 0 || share.first >= cells.nu; });
  const auto raise = [&along](CellSheet& sheet, int j, double value) {
    if (!(value > 0.0)) return;
    for (const auto& [i, part] : along) sheet.ref(i, j) = std::max(sheet.ref(i, j), value);
  };
  for (const int j : touched) {
    for (const auto& [i, part] : along) record.passages.ref(i, j) += count * part;
    if (patch.fatigue[FatigueMeasure::whole_life] != 0.0)
      for (const auto& [i, part] : along)
        record.damage.ref(i, j) += count * part * patch.fatigue[FatigueMeasure::whole_life];
    raise(record.t_gamma, j, patch.t_gamma());
    raise(record.fi_surf, j, patch.fatigue[FatigueMeasure::fi_surf]);
  }
  for (const PassedStress& s : patch.stresses)
    for (const auto& [j, share] : rows_of(cells, s.y_low, s.y_high)) {
      StressRecord& at = record.stresses[s.depth];
      raise(at.von_mises, j, s.stress.von_mises);
      raise(at.shear, j, s.stress.shear);
      raise(at.shakedown, j, s.stress.shakedown);
      raise(at.dang_van, j, s.stress.dang_van);
    }
}

namespace {

/// Sums of so many times the other one, or the larger ones.
template <class Record, std::size_t n>
void gather(const SheetRow<Record> (&rows)[n], Record& to, const Record& from, double times) {
  for (const SheetRow<Record>& sheet : rows)
    for (const auto& [j, row] : (from.*sheet.sheet).rows()) {
      double* values = &(to.*sheet.sheet).ref(0, j);
      for (std::size_t i = 0; i < row.size(); ++i)
        values[i] = sheet.summed ? values[i] + times * row[i] : std::max(values[i], row[i]);
    }
}

}  // namespace

void add_times(SurfaceRecord& record, const SurfaceRecord& other, double times) {
  gather(kSheets, record, other, times);
  for (std::size_t k = 0; k < record.stresses.size(); ++k)
    gather(kStressSheets, record.stresses[k], other.stresses[k], times);
  for (std::size_t k = 0; k < record.flow.size(); ++k) gather(kFlowSheets, record.flow[k], other.flow[k], times);
  record.volume_by_law += times * other.volume_by_law;
  record.work_of_contacts += times * other.work_of_contacts;
}

namespace {

/// Weights from 0 on, of a step.
std::vector<double> gaussian(double deviation, double step) {
  constexpr double kReach = 4.0;
  std::vector<double> weights;
  for (int k = 0; k * step <= kReach * deviation; ++k) {
    const double t = k * step / deviation;
    weights.push_back(std::exp(-0.5 * t * t));
  }
  return weights;
}

void smooth_across(CellSheet& sheet, const SurfaceCells& cells, double deviation) {
  const std::vector<double> weights = gaussian(deviation, cells.dy);
  const int reach = static_cast<int>(weights.size()) - 1;
  CellSheet out(sheet.nu());
  for (const auto& [j, row] : sheet.rows()) {
    if (ranges::count(row, 0.0) == static_cast<std::ptrdiff_t>(row.size())) continue;
    double sum = 0.0;
    for (int k = -reach; k <= reach; ++k)
      if (cells.exists(j + k)) sum += weights[static_cast<std::size_t>(std::abs(k))];
    for (int k = -reach; k <= reach; ++k) {
      if (!cells.exists(j + k)) continue;
      const double share = weights[static_cast<std::size_t>(std::abs(k))] / sum;
      double* values = &out.ref(0, j + k);
      for (std::size_t i = 0; i < row.size(); ++i) values[i] += share * row[i];
    }
  }
  sheet = std::move(out);
}

void smooth_along(CellSheet& sheet, const SurfaceCells& cells, double deviation) {
  for (auto& [j, row] : sheet.rows()) {
    const std::vector<double> weights = gaussian(deviation, cells.du * cells.radius[static_cast<std::size_t>(j)]);
    const int reach = std::min(static_cast<int>(weights.size()) - 1, (cells.nu - 1) / 2);
    const auto there = [&](int i) { return cells.closed() || (i >= 0 && i < cells.nu); };
    std::vector<double> out(row.size(), 0.0);
    for (int i = 0; i < cells.nu; ++i) {
      if (row[static_cast<std::size_t>(i)] == 0.0) continue;
      double sum = 0.0;
      for (int k = -reach; k <= reach; ++k)
        if (there(i + k)) sum += weights[static_cast<std::size_t>(std::abs(k))];
      for (int k = -reach; k <= reach; ++k)
        if (there(i + k))
          out[static_cast<std::size_t>(cells.wrapped(i + k))] +=
              row[static_cast<std::size_t>(i)] * weights[static_cast<std::size_t>(std::abs(k))] / sum;
    }
    row = std::move(out);
  }
}

}  // namespace

void smooth(CellSheet& sheet, const SurfaceCells& cells, double deviation) {
  if (!(deviation > 0.0)) return;
  smooth_across(sheet, cells, deviation);
  if (!cells.uniform()) smooth_along(sheet, cells, deviation);
}

double depth_of(const SurfaceCells& cells, double volume, int row) {
  if (volume == 0.0) return 0.0;
  const double v = volume / (cells.du * cells.dy);
  if (cells.body == Body::rail) return v;
  const double r = cells.radius[static_cast<std::size_t>(row)], rest = r * r - 2.0 * v;
  if (!(rest > 0.0)) throw Error(ErrorKind::numerical, "more is removed from the wheel than it has");
  return 2.0 * v / (r + std::sqrt(rest));
}

DepthExtent depth_extent(const SurfaceCells& cells, const CellSheet& volume) {
  DepthExtent extent;
  for (const auto& [j, row] : volume.rows())
    for (int i = 0; i < cells.nu; ++i) {
      const double d = depth_of(cells, row[static_cast<std::size_t>(i)], j);
      extent.depth = std::max(extent.depth, d);
      extent.raised = std::max(extent.raised, -d);
      for (const int side : {j - 1, j + 1})
        if (cells.exists(side))
          extent.slope = std::max(extent.slope, std::fabs(d - depth_of(cells, volume.at(i, side), side)) / cells.dy);
      if (const int before = cells.wrapped(i - 1); !cells.uniform() && before >= 0)
        extent.slope_along =
            std::max(extent.slope_along, std::fabs(d - depth_of(cells, row[static_cast<std::size_t>(before)], j)) /
                                             (cells.du * cells.radius[static_cast<std::size_t>(j)]));
    }
  return extent;
}

OffsetMap offsets_of(const SurfaceCells& cells, const CellSheet& volume, double half_length, std::string name) {
  constexpr int kTurnColumns = 32;
  constexpr double kRailStep = 10e-3;  // [m]
  OffsetMap map;
  map.name = std::move(name);
  map.grid.y0 = cells.y0, map.grid.dy = cells.dy, map.grid.ny = cells.ny;
  map.grid.x0 = cells.u0, map.grid.dx = cells.du, map.grid.nx = cells.nu;
  if (cells.uniform() && cells.body == Body::wheel) {
    map.grid.nx = kTurnColumns;
    map.grid.dx = kTurn / kTurnColumns;
  } else if (cells.uniform()) {
    const int side = to_whole<int>(std::ceil(half_length / kRailStep));
    map.grid.nx = 2 * side + 1;
    map.grid.dx = kRailStep;
    map.grid.x0 = -side * kRailStep;
  }
  const double sign = cells.body == Body::wheel ? -1.0 : 1.0;
  map.offset.assign(map.grid.size(), 0.0f);
  for (const auto& [j, row] : volume.rows())
    for (int i = 0; i < map.grid.nx; ++i) {
      const double removed = row[cells.uniform() ? 0 : static_cast<std::size_t>(i)];
      map.offset[map.grid.index(i, j)] = static_cast<float>(sign * depth_of(cells, removed, j));
    }
  return map;
}

}  // namespace treadmark::damage
