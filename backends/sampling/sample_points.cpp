// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/sample_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/backends/sampling/lateral_nodes.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::sampling {
namespace {

constexpr std::size_t kRadiusStations = 33;  // in which the lateral nodes are laid out
constexpr double kMovedAside = 1.5;          // arc of all sections together over that of the longest one
constexpr double kCloser = 0.9;  // nodes that follow a section lie askew from station to station, which costs accuracy

constexpr double kArcSpacing = 0.5e-3;  // [m] steps for which arc length is known to some millionths already

std::vector<double> spread(const std::vector<double>& all) {
  if (all.size() <= kRadiusStations) return all;
  std::vector<double> some;
  for (std::size_t i = 0; i < kRadiusStations; ++i) some.push_back(all[i * (all.size() - 1) / (kRadiusStations - 1)]);
  return some;
}

std::vector<double> even(double from, double to, std::size_t n, bool with_last) {
  std::vector<double> u(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double share = static_cast<double>(i) / static_cast<double>(with_last ? n - 1 : n);
    u[i] = with_last && i + 1 == n ? to : from + (to - from) * share;
  }
  return u;
}

bool is_empty(const PointGrid& grid, std::size_t iu) {
  for (std::size_t iy = 0; iy < grid.y.size(); ++iy)
    if (grid.present(iu, iy)) return false;
  return true;
}

/// Missing points between present ones.
bool has_gap(const PointGrid& grid, std::size_t iu) {
  bool ended = false, begun = false;
  for (std::size_t iy = 0; iy < grid.y.size(); ++iy) {
    if (grid.present(iu, iy)) {
      if (ended) return true;
      begun = true;
    } else {
      ended = begun;
    }
  }
  return false;
}

/// Keeps the longest run of stations that have a surface: a part of a wheel, or of a rail with ends of its own. The
/// ends of triangulated parts are ragged: up to kRagged stations with gaps go too.
void trim(PointGrid& grid) {
  constexpr std::size_t kRagged = 3;
  const std::size_t n = grid.u.size(), ny = grid.y.size();
  std::vector<bool> empty(n);
  for (std::size_t i = 0; i < n; ++i) empty[i] = is_empty(grid, i);
  if (std::find(empty.begin(), empty.end(), true) == empty.end()) return;
  std::size_t best = 0, first = 0;
  for (std::size_t start = 0; start < n; ++start) {
    std::size_t length = 0;
    while (length < n && (grid.closed || start + length < n) && !empty[(start + length) % n]) ++length;
    if (length > best) best = length, first = start;
    if (!grid.closed) start += length;
  }
  for (std::size_t k = 0; k < kRagged && best > 0 && has_gap(grid, first % n); ++k) ++first, --best;
  for (std::size_t k = 0; k < kRagged && best > 0 && has_gap(grid, (first + best - 1) % n); ++k) --best;
  PointGrid kept = grid;
  kept.closed = false;
  kept.u.clear();
  kept.h.clear();
  kept.own_y.clear();
  for (std::size_t i = first; i < first + best; ++i) {
    kept.u.push_back(grid.u[i % n] + (i >= n ? 2.0 * kPi : 0.0));
    const auto keep = [&](const std::vector<double>& from, std::vector<double>& to) {
      const auto row = from.begin() + static_cast<std::ptrdiff_t>((i % n) * ny);
      to.insert(to.end(), row, row + static_cast<std::ptrdiff_t>(ny));
    };
    keep(grid.h, kept.h);
    if (!grid.own_y.empty()) keep(grid.own_y, kept.own_y);
  }
  grid = std::move(kept);
}

}  // namespace

std::vector<double> stations(const Surface& surface, Body body, double nominal_radius, const Region& region,
                             double spacing_u, bool& closed) {
  if (!(spacing_u > 0.0)) throw Error(ErrorKind::configuration, "the spacing of samples must be positive");
  double from = region.u_min, to = region.u_max, step = spacing_u;
  closed = false;
  if (body == Body::wheel) {
    if (!(nominal_radius > 0.0)) throw Error(ErrorKind::configuration, "a wheel needs a positive nominal radius");
    step = spacing_u / nominal_radius;
    closed = !(to - from < 2.0 * kPi - step);
    if (closed) from = -kPi, to = kPi;
  } else {
    const Box3 box = surface.bounds();
    from = std::max(from, box.min.x());
    to = std::min(to, box.max.x());
    if (!std::isfinite(from) || !std::isfinite(to))
      throw Error(ErrorKind::configuration, "a rail without ends needs a range along the track to be sampled in");
  }
  if (!(to > from)) refuse_empty_range();
  const double count = std::max(closed ? 8.0 : 3.0, std::ceil((to - from) / step - 1e-9));
  if (!(count < kMostPoints))
    throw Error(ErrorKind::configuration, "the spacing of samples is too small for the range");
  return even(from, to, to_whole<std::size_t>(count) + (closed ? 0 : 1), !closed);
}

PointGrid sample_points(const Surface& surface, Body body, double nominal_radius, const SampleSettings& settings) {
  // side and height of an equilateral triangle whose circumscribed circle has the spacing as its diameter
  constexpr double kSide = 0.8660254037844386, kTriangleHeight = 0.75;
  const double spacing_u =
      (settings.staggered ? kSide : 1.0) * (settings.spacing_u > 0.0 ? settings.spacing_u : settings.spacing);
  PointGrid grid;
  grid.body = body;
  grid.u = stations(surface, body, nominal_radius, settings.region, spacing_u, grid.closed);
  const auto refuse = [] {
    throw Error(ErrorKind::configuration,
                "sampling this finely needs more than " + std::to_string(to_whole<int>(kMostPoints)) + " points", {},
                "use a coarser resolution or a smaller region");
  };
  const Box3 box = surface.bounds();
  const double width = std::min(settings.region.y_max, box.max.y()) - std::max(settings.region.y_min, box.min.y());
  // the sections are at least as long as they are wide: no need to look at them to know that they are too many
  if (std::isfinite(width) && static_cast<double>(grid.u.size()) * width / settings.spacing > kMostPoints) refuse();
  const std::vector<double> reference = spread(grid.u);
  const double spacing_y = (settings.staggered ? kTriangleHeight : 1.0) * settings.spacing;
  const double y_min = settings.region.y_min, y_max = settings.region.y_max;
  LateralArc arc = lateral_arc(surface, body, reference, spacing_y, y_min, y_max);
  // common nodes are dense wherever any section is steep: far too many where the sections move aside, which share
  // little
  const bool follow = settings.follow && arc.has_room() && arc.arc.back() > kMovedAside * arc.longest_section;
  if (settings.common && !follow) arc = lateral_arc(surface, body, reference, spacing_y, y_min, y_max, true);
  arc.require_room();
  const int steps =
      follow ? steps_along(arc.longest_section, kCloser * spacing_y) : steps_along(arc.arc.back(), spacing_y);
  grid.y = arc.nodes(steps);
  if (static_cast<double>(grid.u.size()) * static_cast<double>(grid.y.size()) > kMostPoints) refuse();
  grid.h.resize(grid.u.size() * grid.y.size());
  if (settings.staggered) grid.stagger = 0.5 * (grid.u[1] - grid.u[0]);
  if (follow) grid.own_y.resize(grid.h.size());
  // of triangles every other node lies at a station of its own
  const std::size_t kinds = settings.staggered ? 2 : 1;
  std::vector<double> common[2];
  for (std::size_t k = 0; k < grid.y.size(); ++k) common[k % kinds].push_back(grid.y[k]);
  parallel_for(grid.u.size(), [&](std::size_t i) {
    for (std::size_t kind = 0; kind < kinds; ++kind) {
      const double u = grid.u[i] + (kind == 1 ? grid.stagger : 0.0);
      std::vector<double> nodes = common[kind], h(nodes.size());
      if (follow) {
        const LateralArc own = lateral_arc(surface, body, {&u, 1}, std::max(spacing_y, kArcSpacing), y_min, y_max);
        if (own.has_room()) {
          const std::vector<double> all = own.nodes(steps);
          for (std::size_t k = 0; k < nodes.size(); ++k) nodes[k] = all[kinds * k + kind];
        }
        for (std::size_t k = 0; k < nodes.size(); ++k) grid.own_y[grid.index(i, kinds * k + kind)] = nodes[k];
      }
      section_heights(surface, body, u, nodes, {h, {}, {}});
      for (std::size_t k = 0; k < h.size(); ++k) grid.h[grid.index(i, kinds * k + kind)] = h[k];
    }
  });
  trim(grid);
  return grid;
}

}  // namespace treadmark::sampling
