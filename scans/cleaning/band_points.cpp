// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/cleaning/band_points.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/scans/placement/band_frame.hpp"

namespace treadmark::scans {
namespace {

constexpr std::size_t kBlock = 16384;
constexpr double kRow = 2e-3;  // rows in which the ends are looked for [m]
constexpr std::size_t kFewestPoints = 1000;
// cells of the coarsest splines; fine ones are these halved again and again (see fit/)
constexpr double kCoarseA = 64e-3, kCoarseS = 16e-3;

enum : std::uint8_t { kOn, kBeyond, kFar, kNotKept };

struct Ends {
  double a_min, a_max;
  bool closed;
};

/// Where a row is filled: the rows of at least a tenth of the points of the median filled row.
Ends ends_of(const std::vector<float>& a, const std::vector<std::uint8_t>& what, Body body, double radius) {
  double least = 1e300, most = -1e300;
  for (std::size_t i = 0; i < a.size(); ++i)
    if (what[i] == kOn) {
      least = std::min(least, static_cast<double>(a[i]));
      most = std::max(most, static_cast<double>(a[i]));
    }
  const bool wheel = body == Body::wheel;
  const double start = wheel ? -std::numbers::pi * radius : least,
               length = wheel ? 2.0 * std::numbers::pi * radius : most - least;
  const auto rows = to_whole<std::size_t>(std::max(1.0, std::ceil(length / kRow)));
  const double row = length / static_cast<double>(rows);
  std::vector<std::size_t> count(rows, 0);
  for (std::size_t i = 0; i < a.size(); ++i)
    if (what[i] == kOn) ++count[std::min(rows - 1, to_whole<std::size_t>(std::max(0.0, (a[i] - start) / row)))];
  std::vector<std::size_t> filled;
  for (const std::size_t c : count)
    if (c > 0) filled.push_back(c);
  if (filled.empty()) return {0.0, 0.0, false};
  const std::size_t enough = std::max<std::size_t>(1, median_of(filled) / 10);
  // runs of rows with nothing between two lines of the scanner are no ends
  std::vector<std::size_t> present;
  for (std::size_t k = 0; k < rows; ++k)
    if (count[k] >= enough) present.push_back(k);
  std::vector<double> gaps;
  for (std::size_t k = 1; k < present.size(); ++k)
    gaps.push_back(row * static_cast<double>(present[k] - present[k - 1]));
  if (wheel) gaps.push_back(row * static_cast<double>(present.front() + rows - present.back()));
  std::sort(gaps.begin(), gaps.end());
  if (wheel) gaps.pop_back();  // the widest may be where an arc is open
  double typical = kRow;
  if (!gaps.empty()) {
    // by length: nine tenths of the band have no wider gaps
    double sum = 0.0, all = 0.0;
    for (const double g : gaps) all += g;
    for (const double g : gaps) {
      sum += g;
      typical = g;
      if (sum >= 0.9 * all) break;
    }
  }
  if (!wheel)
    return {start + row * static_cast<double>(present.front()), start + row * static_cast<double>(present.back() + 1),
            false};
  // the widest gap round the wheel
  double widest = row * static_cast<double>(present.front() + rows - present.back());
  std::size_t from = present.back(), to = present.front() + rows;
  for (std::size_t k = 1; k < present.size(); ++k)
    if (const double gap = row * static_cast<double>(present[k] - present[k - 1]); gap > widest) {
      widest = gap;
      from = present[k - 1];
      to = present[k];
    }
  constexpr double kOpen = 40e-3;
  if (widest <= std::max(kOpen, 3.0 * typical)) return {start, start + length, true};
  // open: from the far side of the gap round to its near side
  double a_min = start + row * static_cast<double>(to % rows), a_max = start + row * static_cast<double>(from + 1);
  if (a_max <= a_min) a_max += length;
  return {a_min, a_max, false};
}

}  // namespace

BandIntervals intervals_of(const Projection& projection) {
  const std::size_t count = projection.points.rows >> projection.points.halvings_a;
  return {projection.band.a_min, projection.band.length() / static_cast<double>(count), count};
}

Projection project(std::span<const Vec3> points, std::span<const std::uint8_t> keep, const Pose& X_CS,
                   const Section& section, const ProjectSettings& settings) {
  const bool wheel = settings.body == Body::wheel;
  const double origin = settings.part ? settings.part->from : 0.0;  // far along a rail floats tell no places
  std::vector<float> a(points.size()), s(points.size()), d(points.size());
  std::vector<std::uint8_t> what(points.size(), kNotKept);
  parallel_for((points.size() + kBlock - 1) / kBlock, [&](std::size_t block) {
    for (std::size_t i = kBlock * block; i < std::min(points.size(), kBlock * (block + 1)); ++i) {
      if (!keep.empty() && keep[i] == 0) continue;
      const Natural n = natural(settings.body, X_CS.apply_inverse(points[i]));
      const auto foot = section.foot({n.y, n.v}, settings.farthest);
      if (!foot) {
        const bool beside =
            n.y < section.y_min() || n.y > section.y_max() || std::fabs(n.v - section.v_at(n.y)) < settings.farthest;
        what[i] = beside ? kBeyond : kFar;
        continue;
      }
      a[i] = static_cast<float>((wheel ? n.u * settings.radius : n.u) - origin);
      s[i] = static_cast<float>(foot->s);
      d[i] = static_cast<float>(foot->distance);
      what[i] = kOn;
    }
  });
  Projection out;
  out.band = {settings.body, wheel ? settings.radius : 1.0, section, 0.0, 0.0, false};
  const auto on = static_cast<std::size_t>(std::count(what.begin(), what.end(), kOn));
  if (on < kFewestPoints && !settings.part)
    throw Error(ErrorKind::input_data, fmt::format("only {} points lie on the running band", on), {},
                fmt::format("is it the right object{}? a band needs thousands of points",
                            wheel ? ", and its nominal radius right where one was given" : ""));
  const Ends ends = settings.part ? Ends{0.0, settings.part->step * static_cast<double>(settings.part->count), false}
                                  : ends_of(a, what, settings.body, settings.radius);
  out.band.a_min = origin + ends.a_min;
  out.band.a_max = origin + ends.a_max;
  out.band.closed = ends.closed;

  BandPoints& band = out.points;
  // whole numbers of coarse cells: four or more round a wheel, so that rows four apart never meet (see fit/)
  const auto halvings = [&](double coarse) {
    return to_whole<std::size_t>(std::clamp(std::floor(std::log2(coarse / settings.finest) + 0.3), 0.0, 8.0));
  };
  double coarse_rows =
      std::max(1.0, std::round(ends.a_max - ends.a_min > 0.0 ? (ends.a_max - ends.a_min) / kCoarseA : 1.0));
  if (ends.closed) coarse_rows = std::max(4.0, 4.0 * std::round(coarse_rows / 4.0));
  if (settings.part) coarse_rows = static_cast<double>(settings.part->count);
  const double coarse_columns = std::max(1.0, std::round(section.length() / kCoarseS));
  band.halvings_a = halvings(kCoarseA);
  band.halvings_s = halvings(kCoarseS);
  band.rows = to_whole<std::size_t>(coarse_rows) << band.halvings_a;
  band.columns = to_whole<std::size_t>(coarse_columns) << band.halvings_s;
  band.cell_a = out.band.length() / static_cast<double>(band.rows);
  band.cell_s = section.length() / static_cast<double>(band.columns);
  const double turn = 2.0 * std::numbers::pi * settings.radius;
  std::vector<std::uint32_t> cell(points.size(), ~0u);
  band.begin.assign(band.rows * band.columns + 1, 0);
  for (std::size_t i = 0; i < points.size(); ++i) {
    out.beyond_section += what[i] == kBeyond ? 1 : 0;
    out.far_off += what[i] == kFar ? 1 : 0;
    if (what[i] != kOn) continue;
    double from = a[i] - ends.a_min;
    if (wheel && from < 0.0) from += turn;
    if (wheel && from >= turn) from -= turn;
    if (from < 0.0 || (from >= out.band.length() && !ends.closed)) {
      ++out.beyond_length;
      continue;
    }
    a[i] = static_cast<float>(from);
    const auto row = std::min(band.rows - 1, to_whole<std::size_t>(from / band.cell_a));
    const auto column = std::min(band.columns - 1, to_whole<std::size_t>(s[i] / band.cell_s));
    cell[i] = static_cast<std::uint32_t>(row * band.columns + column);
    ++band.begin[cell[i] + 1];
  }
  for (std::size_t k = 1; k < band.begin.size(); ++k) band.begin[k] += band.begin[k - 1];
  const std::size_t count = band.begin.back();
  band.a.resize(count);
  band.s.resize(count);
  band.d.resize(count);
  band.index.resize(count);
  band.state.assign(count, PointState::used);
  std::vector<std::uint32_t> next(band.begin.begin(), band.begin.end() - 1);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (cell[i] == ~0u) continue;
    const std::uint32_t k = next[cell[i]]++;
    band.a[k] = a[i];
    band.s[k] = s[i];
    band.d[k] = d[i];
    band.index[k] = static_cast<std::uint32_t>(i);
  }
  return out;
}

}  // namespace treadmark::scans
