// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/slices/slice_surface.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <numeric>
#include <string>
#include <type_traits>

#include "treadmark/backends/spline/grid_lines.hpp"
#include "treadmark/backends/spline/interval.hpp"
#include "treadmark/backends/spline/point_batches.hpp"
#include "treadmark/backends/spline/slices/slice_bounds.hpp"
#include "treadmark/backends/spline/slices/slice_section.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/surface_change.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {
namespace {

// Lines of a task share their cuts; fixed, so that results do not depend on the number of threads.
constexpr std::size_t kSliceLinesPerTask = 16;

constexpr std::size_t kPointsWorthThreads = 2000;

// Of one thread, used again by the next call.
struct Workspace {
  SectionWorkspace section;
  ColumnHits hits[2] = {ColumnHits(0, Facing::up), ColumnHits(0, Facing::down)};
  std::vector<double> along, across;
};
Workspace& workspace() {
  thread_local Workspace work;
  return work;
}

// A last correction of v is a small part of a cell, except at folds, where it means nothing.
constexpr double kPolish = 1e-4;

template <class Geometry>
constexpr bool kIsWheel = std::is_same_v<Geometry, WheelGeometry>;

void raise(SliceNet& net, int span, int line, double by) {
  SliceNet::LineCubic cubic = net.line(span, line);
  cubic.power[0].w += by;
  net.set_line(span, line, cubic);
}

template <class Geometry>
SliceNet with_radius(SliceNet net, double nominal_radius) {
  if constexpr (kIsWheel<Geometry>)
    for (int span = 0; span < net.spans(); ++span)
      for (int line = 0; line < net.lines(); ++line) raise(net, span, line, nominal_radius);
  return net;
}

// Runs of cells [first, last) that may lie over a window.
struct CellRun {
  int first, last;
};

HitArrays hit_arrays(ColumnHits& hits, bool places) {
  if (!places) return {hits.sign(), hits.n.data(), nullptr, nullptr, nullptr};
  return {hits.sign(), hits.n.data(), hits.cell.data(), hits.v.data(), hits.u.data()};
}

template <class Geometry>
std::vector<CellRun> runs_over(const PlaneWindow& window, const SliceNet& net, const SliceHulls& hulls,
                               bool single_line) {
  thread_local std::vector<char> marks;
  marks.assign(static_cast<std::size_t>(net.cells()) + 1, 0);
  mark_cells_over(WindowOn<Geometry>(window), net, hulls, single_line, marks);
  std::vector<CellRun> runs;
  // memchr is quicker than a loop, and the last mark is never set
  const char* const begin = marks.data();
  const char* const end = begin + net.cells();
  for (const char* first = begin;
       (first = static_cast<const char*>(std::memchr(first, 1, static_cast<std::size_t>(end - first)))) != nullptr;) {
    const char* last = static_cast<const char*>(std::memchr(first, 0, static_cast<std::size_t>(end - first) + 1));
    runs.push_back({static_cast<int>(first - begin), static_cast<int>(last - begin)});
    first = last;
  }
  return runs;
}

// Cells of a section, cut already, that points of one line may lie over, and how far each reaches along it.
struct CellReaches {
  std::vector<int> cell;
  std::vector<double> low, high, reach;
  bool rising = false, falling = false;  ///< the section goes one way

  // Those from which on, in either direction, cells do not end before `first`, and from which on they begin behind
  // `last`.
  std::pair<std::size_t, std::size_t> over(double first, double last) const {
    const auto at = [](const std::vector<double>& v, auto it) { return static_cast<std::size_t>(it - v.begin()); };
    if (rising) return {at(high, ranges::lower_bound(high, first)), at(low, ranges::upper_bound(low, last))};
    if (falling)
      return {at(low, ranges::lower_bound(low, last, std::greater<>())),
              at(high, ranges::upper_bound(high, first, std::greater<>()))};
    return {0, cell.size()};
  }

  template <class Geometry>
  void find(const SliceSection<Geometry>& section, const std::vector<CellRun>& runs) {
    cell.clear(), low.clear(), high.clear(), reach.clear();
    bool monotonic = true;
    for (const CellRun& run : runs)
      for (int k = run.first; k < run.last; ++k) {
        const SectionPoint a = section.start_of(k), b = section.end_of(k);
        const double rise = b.s - a.s;
        cell.push_back(k);
        low.push_back(std::min(a.s, b.s));
        high.push_back(std::max(a.s, b.s));
        reach.push_back(std::max(std::abs(a.ds), std::abs(b.ds)));
        monotonic = monotonic && a.ds * rise >= 0.0 && b.ds * rise >= 0.0 && reach.back() <= 3.0 * std::abs(rise);
      }
    // Beyond its ends goes only a cubic that turns (Fritsch and Carlson 1980).
    for (std::size_t i = 0; i < cell.size() && !monotonic; ++i) low[i] -= reach[i], high[i] += reach[i];
    rising = ranges::is_sorted(low) && ranges::is_sorted(high);
    falling = !rising && ranges::is_sorted(low, std::greater<>()) && ranges::is_sorted(high, std::greater<>());
  }
};

template <class Geometry>
void raster_cells(const SliceSection<Geometry>& section, const CellReaches& reaches, const Samples& samples,
                  ColumnHits& hits) {
  SectionRaster<SliceSection<Geometry>, ColumnHits> raster(section, samples, hits, hits.queue);
  const double slack = kEdgeSlack * samples.step, first = samples.first - slack, last = samples.last() + slack;
  const auto [begin, end] = reaches.over(first, last);
  for (std::size_t i = begin; i < end; ++i) {
    if (!(reaches.high[i] >= first && reaches.low[i] <= last)) continue;
    const int k = reaches.cell[i];
    raster.cell(k, k + 1.0, section.start_of(k), k + 2.0, section.end_of(k));
  }
  raster.finish();
}

// The same by kernels where these serve; does not say whether there are several hits.
template <class Geometry>
void hit_cells(SliceSection<Geometry>& section, const std::vector<CellRun>& runs, const Samples& samples, bool places,
               ColumnHits& hits) {
  SectionRaster<SliceSection<Geometry>, ColumnHits> raster(section, samples, hits, hits.queue);
  const SampleArrays sample_arrays{samples.first, samples.step, samples.count, kEdgeSlack};
  const HitArrays arrays = hit_arrays(hits, places);
  for (const CellRun& run : runs)
    section.hit(run.first, run.last, sample_arrays, arrays,
                [&](int k) { raster.cell(k, k + 1.0, section.start_of(k), k + 2.0, section.end_of(k)); });
  raster.finish();
}

// Calls use(point, section, hits) for every point of a list, in parallel; hits.n[0] is NaN where there is no surface.
template <class Geometry, class Use>
void for_hits(const SliceNet& net, const SliceHulls& hulls, const Geometry& geometry, const Pose& X_SP,
              std::span<const Vec2> points_P, const Use& use) {
  const bool along_y = Geometry::lines_along_y(X_SP.rotation);
  const Vec3 across = X_SP.rotation.col(along_y ? 0 : 1), along = X_SP.rotation.col(along_y ? 1 : 0),
             normal = X_SP.rotation.col(2);
  const auto over = [&](const Interval& a, const Interval& s) {
    return runs_over<Geometry>({across, along, normal, X_SP.origin, widened(a.low, a.high), widened(s.low, s.high)},
                               net, hulls, true);
  };
  const auto count = [](const std::vector<CellRun>& runs) {
    std::size_t cells = 0;
    for (const CellRun& run : runs) cells += static_cast<std::size_t>(run.last - run.first);
    return cells;
  };
  for_listed_points(points_P, along_y, [&](std::span<const ListedPoint> points) {
    ColumnHits hits(1, kIsWheel<Geometry> ? Facing::down : Facing::up);
    CellReaches reaches;
    SliceSection<Geometry> section(net, hulls, geometry, across, along, normal, X_SP.origin, workspace().section);
    const auto do_batch = [&](std::span<const ListedPoint> batch, const std::vector<CellRun>& runs) {
      section.restart();
      for_lines(batch, [&](ListedLine line) {
        section.start_cut(line.front().across);
        for (const CellRun& run : runs) section.cut(run.first, run.last);
        reaches.find(section, runs);
        for (const ListedPoint& p : line) {
          hits.clear();
          raster_cells(section, reaches, one_sample(p.along), hits);
          use(p, section, hits);
        }
      });
    };
    for (std::size_t first = 0; first < points.size(); first += kPointsPerBatch)
      split_batch(points.subspan(first, std::min(kPointsPerBatch, points.size() - first)), over, count, do_batch);
  });
}

}  // namespace

template <class Geometry>
SliceSurface<Geometry>::SliceSurface(SliceNet net, double nominal_radius)
    : net_(with_radius<Geometry>(std::move(net), nominal_radius)),
      nominal_radius_(nominal_radius),
      geometry_(nominal_radius),
      hulls_(net_) {
  if (hulls_.empty()) throw Error(ErrorKind::input_data, "the slices leave no surface");
  if (kIsWheel<Geometry> && !(hulls_.all_w().low > 0.0))
    throw Error(ErrorKind::configuration, "a wheel's radius must be positive on all slices", {},
                "check the nominal radius and the unit of the slices");
}

template <class Geometry>
Vec3 SliceSurface<Geometry>::point(double u, double v) const {
  const int cell = std::clamp(to_whole<int>(v) - 1, 0, net_.cells() - 1);
  return geometry_.derivatives(u, net_.at(net_.find(u), cell, v - (cell + 1)), {}).p;
}

template <class Geometry>
Facing SliceSurface<Geometry>::facing() const {
  return kIsWheel<Geometry> ? Facing::down : Facing::up;
}

template <class Geometry>
Box3 SliceSurface<Geometry>::bounds() const {
  const Interval &y = hulls_.all_y(), &w = hulls_.all_w();
  if constexpr (kIsWheel<Geometry>) return {{-w.high, y.low, -w.high}, {w.high, y.high, w.high}};
  constexpr double kInfinite = std::numeric_limits<double>::infinity();
  return {{-kInfinite, y.low, w.low}, {kInfinite, y.high, w.high}};
}

template <class Geometry>
std::size_t SliceSurface<Geometry>::memory_bytes() const {
  return sizeof(*this) + net_.memory_bytes() + hulls_.memory_bytes();
}

template <class Geometry>
std::vector<double> SliceSurface<Geometry>::data_v() const {
  std::vector<double> v(static_cast<std::size_t>(net_.cells()) + 1);
  std::iota(v.begin(), v.end(), 1.0);
  return v;
}

template <class Geometry>
std::vector<ShapeParameter> SliceSurface<Geometry>::parameters() const {
  constexpr double kWidth = 0.5e-3;   // [m] of cells
  const int some = net_.spans() / 2;  // not one of the ends
  const double spacing = net_.span_end(some) - net_.span_start(some);
  std::vector<ShapeParameter> all(net_.numbers());
  for (std::size_t k = 0; k < all.size(); ++k) {
    const SliceNet::Number n = net_.number(k);
    const Vec3 place = point(n.u, std::clamp<double>(n.line, 1.0, net_.positions()));
    all[k] = {"station_" + std::to_string(n.station) + "_line_" + std::to_string(n.line), "m", step_over(kWidth),
              place};
    if (!n.slope) continue;
    all[k].name += "_slope", all[k].unit = kIsWheel<Geometry> ? "m/rad" : "1", all[k].step /= spacing;
  }
  return all;
}

template <class Geometry>
std::shared_ptr<const Surface> SliceSurface<Geometry>::do_change(std::size_t parameter, double amount) const {
  return std::make_shared<SliceSurface>(with_radius<Geometry>(net_.with_number(parameter, amount), -nominal_radius_),
                                        nominal_radius_);
}

template <class Geometry>
std::optional<HeightsBy> SliceSurface<Geometry>::do_pull_back(const Pose& X_SP, std::span<const Vec2> points_P,
                                                              std::span<const double> weights,
                                                              std::span<double> by) const {
  pull_back_by_displacement(
      *this, X_SP, points_P, weights, [&](std::size_t, const SurfacePoint& at, const Vec3& force) {
        const double pull = kIsWheel<Geometry> ? std::sin(at.u) * force.x() + std::cos(at.u) * force.z() : force.z();
        const int cell = std::clamp(to_whole<int>(at.v) - 1, 0, net_.cells() - 1);
        net_.each_number(net_.find(at.u), cell, at.v - (cell + 1),
                         [&](std::size_t k, double share) { by[k] += share * pull; });
      });
  return HeightsBy::exact;
}

template <class Geometry>
void SliceSurface<Geometry>::do_heights(const PlaneGrid& plane_grid, const HeightsOut& out) const {
  const GridLines g(plane_grid, Geometry::lines_along_y(plane_grid.X_SP.rotation));
  const auto dz_along = g.along_is_y ? out.dzdy : out.dzdx, dz_across = g.along_is_y ? out.dzdx : out.dzdy;
  const bool slopes = !dz_along.empty() || !dz_across.empty();
  const auto do_task = [&](std::size_t task) {
    Workspace& work = workspace();
    ColumnHits& hits = work.hits[kIsWheel<Geometry>];
    hits.resize(g.samples.count);
    SliceSection<Geometry> section(net_, hulls_, geometry_, g.across, g.along, g.normal, g.origin, work.section);
    const int first = static_cast<int>(task * kSliceLinesPerTask);
    const int last = std::min(g.lines, first + static_cast<int>(kSliceLinesPerTask)) - 1;
    const auto runs =
        runs_over<Geometry>({g.across, g.along, g.normal, g.origin, widened(g.across_at(first), g.across_at(last)),
                             widened(g.samples.first, g.samples.last())},
                            net_, hulls_, first == last);
    for (int line = first; line <= last; ++line) {
      hits.clear();
      if (slopes) hits.clear_places();
      section.start_cut(g.across_at(line));
      for (const CellRun& run : runs) section.cut(run.first, run.last);
      hit_cells(section, runs, g.samples, slopes, hits);
      const std::size_t start = static_cast<std::size_t>(line) * g.across_stride;
      const auto write = [&](const std::vector<double>& values, std::span<double> to) {
        if (to.empty()) return;
        for (std::size_t i = 0; i < hits.n.size(); ++i) to[start + i * g.along_stride] = values[i];
      };
      write(hits.n, out.z);
      if (!slopes) continue;
      work.along.resize(hits.u.size()), work.across.resize(hits.u.size());
      section.slopes_of(hit_arrays(hits, true), g.samples.count, {work.along.data(), work.across.data()});
      write(work.along, dz_along);
      write(work.across, dz_across);
    }
  };
  const std::size_t tasks = (static_cast<std::size_t>(g.lines) + kSliceLinesPerTask - 1) / kSliceLinesPerTask;
  if (plane_grid.grid.size() < kPointsWorthThreads)
    for (std::size_t task = 0; task < tasks; ++task) do_task(task);
  else
    parallel_for(tasks, do_task);
}

template <class Geometry>
void SliceSurface<Geometry>::do_heights_at(const Pose& X_SP, std::span<const Vec2> points_P,
                                           const HeightsOut& out) const {
  const bool along_y = Geometry::lines_along_y(X_SP.rotation);
  const auto dz_along = along_y ? out.dzdy : out.dzdx, dz_across = along_y ? out.dzdx : out.dzdy;
  const bool slopes = !dz_along.empty() || !dz_across.empty();
  for_hits(net_, hulls_, geometry_, X_SP, points_P,
           [&](const ListedPoint& p, const SliceSection<Geometry>& section, const ColumnHits& hits) {
             if (!out.z.empty()) out.z[p.index] = hits.n[0];
             if (!slopes) return;
             typename SliceSection<Geometry>::Slopes slope{hits.n[0], hits.n[0]};  // NaN stays
             if (!std::isnan(hits.n[0])) slope = section.slopes(hits.cell[0], hits.v[0], hits.u[0]);
             if (!dz_along.empty()) dz_along[p.index] = slope.along;
             if (!dz_across.empty()) dz_across[p.index] = slope.across;
           });
}

template <class Geometry>
void SliceSurface<Geometry>::do_evaluate(std::span<const Vec2> uv, std::span<SurfaceJet> out) const {
  for (std::size_t i = 0; i < uv.size(); ++i) {
    const double u = uv[i].x(), v = uv[i].y();
    out[i] = {};
    if (!std::isfinite(u) || !(v >= 1.0 && v <= net_.positions())) continue;
    const SliceNet::Place place = net_.find(u);
    const int cell = std::clamp(to_whole<int>(v) - 1, 0, net_.cells() - 1);
    const double f = v - (cell + 1);
    const SurfaceJet jet = jet_of(geometry_.derivatives(u, net_.at(place, cell, f), net_.second_at(place, cell, f)));
    if (jet.p.allFinite()) out[i] = jet;
  }
}

template <class Geometry>
void SliceSurface<Geometry>::do_locate(const Pose& X_SP, std::span<const Vec2> points_P,
                                       std::span<SurfacePoint> out) const {
  for_hits(net_, hulls_, geometry_, X_SP, points_P,
           [&](const ListedPoint& at, const SliceSection<Geometry>& section, const ColumnHits& hits) {
             SurfacePoint& found = out[at.index];
             found = {};
             if (std::isnan(hits.n[0])) return;
             found.status = hits.several[0] ? LocateStatus::ambiguous : LocateStatus::converged;
             // One more step, since u and v themselves are wanted here.
             const int cell = hits.cell[0];
             const SectionPoint p = section.point(cell, hits.v[0], hits.u[0]);
             const double step = std::abs(at.along - p.s) < kPolish * std::abs(p.ds) ? (at.along - p.s) / p.ds : 0.0;
             const double v = std::clamp(hits.v[0] + step, cell + 1.0, cell + 2.0), u = p.u + step * p.du;
             found.u = kIsWheel<Geometry> ? wrap_angle(u) : u;
             found.v = v;
             const SliceNet::Place place = net_.find(u);
             const double f = v - (cell + 1);
             set_geometry(geometry_.derivatives(u, net_.at(place, cell, f), net_.second_at(place, cell, f)), found);
           });
}

template <class Geometry>
HeightBounds SliceSurface<Geometry>::do_height_bounds(const Pose& X_SP, const Rectangle& rectangle_P) const {
  const bool along_y = Geometry::lines_along_y(X_SP.rotation);
  const Interval x = widened(rectangle_P.x_min, rectangle_P.x_max), y = widened(rectangle_P.y_min, rectangle_P.y_max);
  const WindowOn<Geometry> window({X_SP.rotation.col(along_y ? 0 : 1), X_SP.rotation.col(along_y ? 1 : 0),
                                   X_SP.rotation.col(2), X_SP.origin, along_y ? x : y, along_y ? y : x});
  if (!window.exists()) return {0.0, 0.0, true};
  const SliceTree tree(window, net_, hulls_);
  const Interval n = BoundSearch(tree, facing()).range(tree.root());
  if (n.empty()) return {0.0, 0.0, true};
  return {n.low - 1e-12, n.high + 1e-12, false};
}

// Every small box goes to all rectangles it may be over: no descent for each of them.
template <class Geometry>
void SliceSurface<Geometry>::do_grid_bounds(const Pose& X_SP, const RectangleGrid& r,
                                            std::span<HeightBounds> out) const {
  const bool along_y = Geometry::lines_along_y(X_SP.rotation);
  const Vec3 across = X_SP.rotation.col(along_y ? 0 : 1), along = X_SP.rotation.col(along_y ? 1 : 0);
  const Interval x = widened(r.first.x_min, r.first.x_max), y = widened(r.first.y_min, r.first.y_max);
  const Interval first_across = along_y ? x : y, first_along = along_y ? y : x;
  const double step_across = along_y ? r.step_x : r.step_y, step_along = along_y ? r.step_y : r.step_x;
  const int n_across = along_y ? r.nx : r.ny, n_along = along_y ? r.ny : r.nx;
  const Interval all_along{first_along.low, first_along.high + (n_along - 1) * step_along};
  std::vector<Interval> heights(static_cast<std::size_t>(n_along));
  for (int i = 0; i < n_across; ++i) {
    ranges::fill(heights, Interval::none());
    const WindowOn<Geometry> window(
        {across, along, X_SP.rotation.col(2), X_SP.origin, first_across + i * step_across, all_along});
    if (window.exists())
      for_small_boxes(window, net_, hulls_, first_along.width(), [&](const Interval& s, const Interval& n) {
        const double begin = std::max(0.0, std::ceil((s.low - first_along.high) / step_along));
        const double end = std::min(n_along - 1.0, std::floor((s.high - first_along.low) / step_along));
        if (!(begin <= end)) return;
        for (auto j = static_cast<std::size_t>(begin); j <= static_cast<std::size_t>(end); ++j) heights[j].include(n);
      });
    for (int j = 0; j < n_along; ++j) {
      const Interval& n = heights[static_cast<std::size_t>(j)];
      out[along_y ? r.index(i, j) : r.index(j, i)] =
          n.empty() ? HeightBounds{0.0, 0.0, true} : HeightBounds{n.low - 1e-12, n.high + 1e-12, false};
    }
  }
}

template class SliceSurface<RailGeometry>;
template class SliceSurface<WheelGeometry>;

}  // namespace treadmark::spline
