// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/pages/subsurface_figures.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::app::pages {

using namespace report;

namespace {

using Block3 = io::SubsurfaceBlock;
using Value = io::SubsurfaceValue;

struct StressedBody {
  const char *id, *name;
  bool is_rail;

  bool has(const Value& v) const { return (v.point.z() >= 0.0) == is_rail; }
};
constexpr StressedBody kBodies[] = {{"rail", "the rail", true}, {"wheel", "the wheel", false}};

struct Direction {
  const char *id, *words, *axis;
  int component;  ///< of a point
};
constexpr Direction kDirections[] = {{"along", "along the track", "x", 0}, {"across", "across the track", "s", 1}};

struct Stress {
  const char *id, *name, *label;
  bool diverging;
  double (*of)(const Value&);
};
constexpr Stress kStresses[] = {
    {"von-mises", "Von Mises stress", "von Mises stress", false, [](const Value& v) { return v.von_mises; }},
    {"greatest-principal", "Greatest principal stress", "σ_1, tension positive", true,
     [](const Value& v) { return v.principal.x(); }},
    {"least-principal", "Least principal stress", "σ_3, tension positive", true,
     [](const Value& v) { return v.principal.z(); }},
};

/// Points of a block in a plane across the contact plane, on lines of growing position and growing height.
struct Plane {
  std::vector<double> position, height;  ///< [m]; height = -n
  std::vector<const Value*> points;      ///< rows of equal height
  double most = -kInfinity;              ///< of von Mises [Pa]

  bool empty() const { return points.empty(); }
};

/// That of the points of one body with this number in the other direction; empty where it is none.
Plane plane_of(const Block3& block, const StressedBody& body, const Direction& direction, int other) {
  const bool along = direction.component == 0;
  const auto at = [&](int i, int iz) -> const Value& {
    const auto ix = static_cast<std::size_t>(along ? i : other), iy = static_cast<std::size_t>(along ? other : i);
    const auto nx = static_cast<std::size_t>(block.nx), ny = static_cast<std::size_t>(block.ny);
    return block.values[ix + nx * (iy + ny * static_cast<std::size_t>(iz))];
  };
  std::vector<int> columns(static_cast<std::size_t>(along ? block.nx : block.ny)), layers;
  std::iota(columns.begin(), columns.end(), 0);
  ranges::sort(columns, {}, [&](int i) { return at(i, 0).point[direction.component]; });
  for (int iz = 0; iz < block.nz; ++iz)
    if (body.has(at(0, iz))) layers.push_back(iz);
  ranges::sort(layers, {}, [&](int iz) { return -at(0, iz).point.z(); });
  Plane plane;
  if (columns.size() < 2 || layers.size() < 2) return plane;
  plane.position.reserve(columns.size());
  plane.height.reserve(layers.size());
  plane.points.reserve(columns.size() * layers.size());
  for (const int i : columns) plane.position.push_back(at(i, 0).point[direction.component]);
  for (const int iz : layers) {
    plane.height.push_back(-at(0, iz).point.z());
    for (const int i : columns) {
      plane.points.push_back(&at(i, iz));
      plane.most = std::max(plane.most, at(i, iz).von_mises);
    }
  }
  return plane;
}

/// Of all blocks of a case the plane with the largest von Mises stress.
Plane worst_plane(const io::CaseResult& result, const StressedBody& body, const Direction& direction) {
  Plane worst;
  for (const io::PatchResult& patch : result.patches)
    for (const Block3& block : patch.subsurface)
      for (int other = 0; other < (direction.component == 0 ? block.ny : block.nx); ++other)
        if (Plane plane = plane_of(block, body, direction, other); plane.most > worst.most) worst = std::move(plane);
  return worst;
}

/// The part of the way from a line to the next, and its number; nothing outside of all lines.
std::optional<std::pair<std::size_t, double>> between(const std::vector<double>& lines, double at) {
  if (!(at >= lines.front() && at <= lines.back())) return std::nullopt;
  const std::size_t k = piece_at(lines, at);
  const double step = lines[k + 1] - lines[k];
  return std::pair{k, step > 0.0 ? (at - lines[k]) / step : 0.0};
}

/// The stress [MPa] over the cells of a map, linear between the points; NaN outside.
std::vector<double> over_map(const MapView& map, const Plane& plane, const Stress& stress) {
  std::vector<double> out(static_cast<std::size_t>(map.nx) * static_cast<std::size_t>(map.ny), NAN);
  if (plane.empty()) return out;
  const std::size_t n = plane.position.size();
  for (int j = 0; j < map.ny; ++j)
    for (int i = 0; i < map.nx; ++i) {
      const auto x = between(plane.position, (map.x0 + i * map.dx) / kMilli);
      const auto h = between(plane.height, (map.y0 + j * map.dy) / kMilli);
      if (!x || !h) continue;
      const auto value = [&](std::size_t k) {
        const std::size_t at = k * n + x->first;
        return std::lerp(stress.of(*plane.points[at]), stress.of(*plane.points[at + 1]), x->second);
      };
      out[static_cast<std::size_t>(j) * static_cast<std::size_t>(map.nx) + static_cast<std::size_t>(i)] =
          kMega * std::lerp(value(h->first), value(h->first + 1), h->second);
    }
  return out;
}

/// Cells over what all planes reach; fewer where there are many cases.
MapView empty_map(const std::vector<Plane>& planes, const Direction& direction, const Stress& stress) {
  constexpr double kColumns = 128.0, kRows = 64.0, kMostNumbers = 1e5;  // over all cases
  double x_low = kInfinity, x_high = -kInfinity, h_low = kInfinity, h_high = -kInfinity;
  for (const Plane& plane : planes) {
    if (plane.empty()) continue;
    x_low = std::min(x_low, plane.position.front()), x_high = std::max(x_high, plane.position.back());
    h_low = std::min(h_low, plane.height.front()), h_high = std::max(h_high, plane.height.back());
  }
  const double share = std::min(1.0, std::sqrt(kMostNumbers / (kColumns * kRows * static_cast<double>(planes.size()))));
  MapView map;
  map.x = Axis{direction.axis, "mm"};
  map.y = Axis{"−n, height over the contact plane", "mm"};
  map.label = stress.label, map.unit = "MPa", map.diverging = stress.diverging;
  map.nx = std::max(8, to_whole<int>(share * kColumns)), map.ny = std::max(8, to_whole<int>(share * kRows));
  map.x0 = kMilli * x_low, map.dx = kMilli * (x_high - x_low) / (map.nx - 1);
  map.y0 = kMilli * h_low, map.dy = kMilli * (h_high - h_low) / (map.ny - 1);
  return map;
}

/// Largest von Mises stress of each layer of a body, by depth [mm], [MPa].
std::vector<std::pair<double, double>> by_depth(const io::CaseResult& result, const StressedBody& body) {
  std::vector<std::pair<double, double>> out;
  for (const io::PatchResult& patch : result.patches)
    for (const Block3& block : patch.subsurface)
      for (const Value& v : block.values)
        if (body.has(v)) out.emplace_back(kMilli * std::fabs(v.point.z()), kMega * v.von_mises);
  // Of equal depths the first is the largest.
  ranges::sort(
      out, [](const auto& a, const auto& b) { return a.first != b.first ? a.first < b.first : a.second > b.second; });
  out.erase(std::unique(out.begin(), out.end(), [](const auto& a, const auto& b) { return a.first == b.first; }),
            out.end());
  return out;
}

std::optional<Figure> depth_figure(const io::RunResult& run) {
  ChartView view;
  view.x = Axis{"depth below the surface", "mm"};
  Panel panel{"largest von Mises stress", "MPa"};
  bool any = false;
  view.by_step.reserve(run.cases.size());
  for (const io::CaseResult& result : run.cases) {
    ChartView::Curves curves;
    std::vector<std::vector<std::pair<double, double>>> lines;
    for (const StressedBody& body : kBodies) {
      lines.push_back(by_depth(result, body));
      for (const auto& [depth, stress] : lines.back()) curves.x.push_back(depth);
    }
    ranges::sort(curves.x);
    curves.x.erase(std::unique(curves.x.begin(), curves.x.end()), curves.x.end());
    any = any || curves.x.size() > 1;
    std::vector<std::vector<double>>& y = curves.y.emplace_back();
    for (const auto& line : lines) {
      std::vector<double>& values = y.emplace_back(curves.x.size(), NAN);
      for (const auto& [depth, stress] : line)
        values[static_cast<std::size_t>(ranges::lower_bound(curves.x, depth) - curves.x.begin())] = stress;
    }
    view.by_step.push_back(std::move(curves));
  }
  if (!any) return std::nullopt;
  for (const StressedBody& body : kBodies) panel.series.push_back({body.id, {}, {}, Series::Marks::both});
  view.panels.push_back(std::move(panel));
  return Figure{"stress-by-depth", "Largest von Mises stress over the depth", std::move(view)};
}

}  // namespace

std::optional<Section> subsurface_section(const io::RunResult& run) {
  Section section{"below", "Stresses below the surface"};
  for (const StressedBody& body : kBodies)
    for (const Direction& direction : kDirections) {
      std::vector<Plane> planes;
      planes.reserve(run.cases.size());
      for (const io::CaseResult& result : run.cases) planes.push_back(worst_plane(result, body, direction));
      if (ranges::all_of(planes, &Plane::empty)) continue;
      for (const Stress& stress : kStresses) {
        MapView map = empty_map(planes, direction, stress);
        map.by_step.reserve(planes.size());
        for (const Plane& plane : planes) map.by_step.push_back(over_map(map, plane, stress));
        section.blocks.emplace_back(Figure{
            std::string(stress.id) + '-' + direction.id + '-' + body.id,
            std::string(stress.name) + " in " + body.name + ", " + direction.words, std::move(map),
            "The plane through the largest von Mises stress of the chosen case, in the axes of its patch; linear "
            "between the points that the case asks for."});
      }
    }
  if (std::optional<Figure> figure = depth_figure(run)) section.blocks.emplace_back(std::move(*figure));
  if (section.blocks.empty()) return std::nullopt;
  return section;
}

}  // namespace treadmark::app::pages
