// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/sampling/lateral_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/shape/natural_view.hpp"

namespace treadmark::sampling {
namespace {

constexpr double kPerStep = 4.0;        // pieces in which arc length is measured, per wanted step
constexpr double kLeastPiece = 1e-8;    // [m] of y
constexpr double kEndAccuracy = 1e-10;  // [m]

/// All sections at one y.
struct Column {
  double y = 0.0;
  std::vector<double> h;
};

class Sections {
 public:
  Sections(const Surface& surface, Body body, std::span<const double> stations, bool common)
      : surface_(surface), body_(body), stations_(stations), common_(common) {}

  std::vector<Column> at(const std::vector<double>& y) const {
    std::vector<Column> columns(y.size());
    for (std::size_t i = 0; i < y.size(); ++i) columns[i] = {y[i], std::vector<double>(stations_.size())};
    std::vector<double> h(y.size());
    for (std::size_t s = 0; s < stations_.size(); ++s) {
      section_heights(surface_, body_, stations_[s], y, {h, {}, {}});
      for (std::size_t i = 0; i < y.size(); ++i) columns[i].h[s] = h[i];
    }
    return columns;
  }

  bool present(const Column& column) const {
    const auto has = [](double h) { return !std::isnan(h); };
    return common_ ? std::all_of(column.h.begin(), column.h.end(), has)
                   : std::any_of(column.h.begin(), column.h.end(), has);
  }

  /// The present end of a piece of which the other end is not.
  Column end(const Column& inside, double y_outside) const {
    Column best = inside;
    double out = y_outside;
    for (int left = kMostHalvings; left > 0 && std::fabs(out - best.y) > kEndAccuracy; --left) {
      Column middle = at({0.5 * (best.y + out)}).front();
      if (present(middle))
        best = std::move(middle);
      else
        out = middle.y;
    }
    return best;
  }

  /// Greatest arc length of a piece over all sections; a section that begins or ends within counts its width.
  static double length(const Column& a, const Column& b) {
    double longest = b.y - a.y;
    for (std::size_t s = 0; s < a.h.size(); ++s) {
      const double l = std::hypot(b.y - a.y, b.h[s] - a.h[s]);
      if (l > longest) longest = l;  // false for NaN
    }
    return longest;
  }

 private:
  const Surface& surface_;
  Body body_;
  std::span<const double> stations_;
  bool common_;
};

std::vector<Column> refined(const Sections& sections, std::vector<Column> columns, double longest) {
  bool changed = true;
  for (int left = kMostHalvings; changed && left > 0; --left) {
    std::vector<double> extra;
    for (std::size_t i = 1; i < columns.size(); ++i)
      if (columns[i].y - columns[i - 1].y > kLeastPiece && Sections::length(columns[i - 1], columns[i]) > longest)
        extra.push_back(0.5 * (columns[i - 1].y + columns[i].y));
    changed = !extra.empty();
    std::vector<Column> more = sections.at(extra), merged(columns.size() + more.size());
    std::merge(std::make_move_iterator(columns.begin()), std::make_move_iterator(columns.end()),
               std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()), merged.begin(),
               [](const Column& a, const Column& b) { return a.y < b.y; });
    columns = std::move(merged);
  }
  return columns;
}

}  // namespace

LateralArc lateral_arc(const Surface& surface, Body body, std::span<const double> stations, double spacing,
                       double y_min, double y_max, bool common) {
  if (!(spacing > 0.0)) throw Error(ErrorKind::configuration, "the spacing of samples must be positive");
  const Box3 box = surface.bounds();
  const double low = std::max(y_min, box.min.y()), high = std::min(y_max, box.max.y());
  if (!std::isfinite(low) || !std::isfinite(high))
    throw Error(ErrorKind::configuration, "a surface without lateral ends needs a lateral range to be sampled in");
  constexpr double kMostNodes = 1e6;
  if (!((high - low) / spacing < kMostNodes))
    throw Error(ErrorKind::configuration, "the spacing of samples is too small for the width of the surface");
  if (stations.empty() || !(high > low)) return {};

  const Sections sections(surface, body, stations, common);
  const int n = std::max(32, to_whole<int>(std::ceil((high - low) / spacing * kPerStep)));
  std::vector<double> raster(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i <= n; ++i) raster[static_cast<std::size_t>(i)] = i == n ? high : low + (high - low) * i / n;
  std::vector<Column> columns = sections.at(raster);
  const auto is_present = [&](const Column& c) { return sections.present(c); };
  const auto first = std::find_if(columns.begin(), columns.end(), is_present);
  if (first == columns.end()) return {};
  const auto last = std::find_if(columns.rbegin(), columns.rend(), is_present).base() - 1;

  std::vector<Column> inner;
  if (first != columns.begin()) inner.push_back(sections.end(*first, (first - 1)->y));
  for (auto it = first; it <= last; ++it)
    if (inner.empty() || it->y > inner.back().y) inner.push_back(*it);
  if (last + 1 != columns.end()) {
    Column end = sections.end(*last, (last + 1)->y);
    if (end.y > inner.back().y) inner.push_back(std::move(end));
  }
  inner = refined(sections, std::move(inner), spacing / kPerStep);

  LateralArc result;
  result.y.reserve(inner.size());
  for (const Column& column : inner) result.y.push_back(column.y);
  result.arc.assign(inner.size(), 0.0);
  for (std::size_t i = 1; i < inner.size(); ++i)
    result.arc[i] = result.arc[i - 1] + Sections::length(inner[i - 1], inner[i]);
  for (std::size_t s = 0; s < stations.size(); ++s) {
    double own = 0.0;
    for (std::size_t i = 1; i < inner.size(); ++i) {
      const double l = std::hypot(inner[i].y - inner[i - 1].y, inner[i].h[s] - inner[i - 1].h[s]);
      if (!std::isnan(l)) own += l;
    }
    result.longest_section = std::max(result.longest_section, own);
  }
  return result;
}

int steps_along(double length, double spacing) {
  return std::max(3, to_whole<int>(std::ceil(length / spacing - 1e-9)));
}

void refuse_empty_range() {
  throw Error(ErrorKind::configuration,
              "there is no surface in the range to be sampled, or none that all its sections have", {},
              "leave out ends that are ragged: --range-mm FROM,TO of a rail, --range-deg FROM,TO of a wheel");
}

void LateralArc::require_room() const {
  if (y.empty()) refuse_empty_range();
  if (!has_room()) throw Error(ErrorKind::configuration, "the surface is too narrow for samples at this spacing");
}

std::vector<double> LateralArc::nodes(int steps) const {
  std::vector<double> nodes{y.front()};
  std::size_t piece = 1;
  for (int i = 1; i < steps; ++i) {
    const double wanted = arc.back() * i / steps;
    while (arc[piece] < wanted) ++piece;
    const double share = (wanted - arc[piece - 1]) / (arc[piece] - arc[piece - 1]);
    nodes.push_back(y[piece - 1] + share * (y[piece] - y[piece - 1]));
  }
  nodes.push_back(y.back());
  return nodes;
}

std::vector<double> lateral_nodes(const Surface& surface, Body body, std::span<const double> stations, double spacing,
                                  double y_min, double y_max, bool common) {
  const LateralArc arc = lateral_arc(surface, body, stations, spacing, y_min, y_max, common);
  arc.require_room();
  return arc.nodes(steps_along(arc.arc.back(), spacing));
}

}  // namespace treadmark::sampling
