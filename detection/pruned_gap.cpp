// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/detection/pruned_gap.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::detection {
namespace {

// A tile costs about as much as the bounds that might spare it.
constexpr int kLogX = 3, kLogY = 4;
constexpr int kLogEverything = 6;  // one task each

constexpr int kTogether = 16;  // tiles

// Bounds hold for real numbers; heights come with rounding of this size.
constexpr double kRounding = 1e-10;

}  // namespace

PrunedGap::PrunedGap(const BodyPair& bodies, const Grid2& grid_T, const std::optional<WheelFacets>& facets,
                     bool everything)
    : source_(bodies, grid_T, facets),
      field_(everything ? GapField(grid_T, kLogEverything, kLogEverything) : GapField(grid_T, kLogX, kLogY)),
      least_known_(kInfinity) {
  if (everything)
    reveal(IndexBox{0, 0, grid_T.nx, grid_T.ny});
  else
    for (const Node& node : parts({{}, 0, 0, field_.tiles_x(), field_.tiles_y()})) push(node);
}

IndexBox PrunedGap::box(int tx, int ty, int nx, int ny) const {
  const IndexBox first = field_.tile_box(tx, ty), last = field_.tile_box(tx + nx - 1, ty + ny - 1);
  return {first.ix, first.iy, last.ix + last.nx - first.ix, last.iy + last.ny - first.iy};
}

void PrunedGap::push(const Node& node) {
  frontier_.push_back(node);
  frontier_.back().bounds.low -= kRounding;
  ranges::push_heap(frontier_, later);
}

PrunedGap::Node PrunedGap::pop() {
  ranges::pop_heap(frontier_, later);
  const Node node = frontier_.back();
  frontier_.pop_back();
  return node;
}

void PrunedGap::refine(const std::vector<Node>& nodes, std::vector<Node>& to_fill) {
  std::vector<std::vector<Node>> smaller(nodes.size());
  const auto one = [&](std::size_t i) { smaller[i] = refined(nodes[i]); };
  if (nodes.size() == 1)
    one(0);
  else
    parallel_for(nodes.size(), one);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    if (smaller[i].empty() && nodes[i].single()) to_fill.push_back(nodes[i]);
    for (const Node& node : smaller[i]) push(node);
  }
}

std::vector<PrunedGap::Node> PrunedGap::refined(const Node& node) const {
  if (!node.single()) return parts(node);
  if (node.looked_closely) return {};
  Node closer = node;
  closer.looked_closely = true;
  closer.bounds.low = source_.least_close(box(node.tx, node.ty, 1, 1), node.bounds);
  return {closer};
}

std::vector<PrunedGap::Node> PrunedGap::parts(const Node& node) const {
  std::vector<Node> nodes;
  const auto add = [&](const GapBounds& bounds, int tx, int ty, int nx, int ny) {
    if (!bounds.empty) nodes.push_back({bounds, tx, ty, nx, ny});
  };
  // Few tiles are cheaper looked at together than halved again and again.
  if (node.nx * node.ny <= kTogether) {
    const IndexBox first{node.tx << field_.log_x(), node.ty << field_.log_y(), 1 << field_.log_x(),
                         1 << field_.log_y()};
    const std::vector<GapBounds> bounds = source_.bounds(first, node.nx, node.ny);
    for (int iy = 0; iy < node.ny; ++iy)
      for (int ix = 0; ix < node.nx; ++ix)
        add(bounds[static_cast<std::size_t>(iy * node.nx + ix)], node.tx + ix, node.ty + iy, 1, 1);
    return nodes;
  }
  const auto part = [&](int tx, int ty, int nx, int ny) { add(source_.bounds(box(tx, ty, nx, ny)), tx, ty, nx, ny); };
  // Bodies slope more across than along the track: tiles are wanted twice as long as wide.
  const Grid2& g = field_.grid();
  const double length = node.nx * std::ldexp(g.dx, field_.log_x()), width = node.ny * std::ldexp(g.dy, field_.log_y());
  if (node.ny == 1 || (node.nx > 1 && length > 2.0 * width)) {
    const int half = node.nx / 2;
    part(node.tx, node.ty, half, node.ny);
    part(node.tx + half, node.ty, node.nx - half, node.ny);
  } else {
    const int half = node.ny / 2;
    part(node.tx, node.ty, node.nx, half);
    part(node.tx, node.ty + half, node.nx, node.ny - half);
  }
  return nodes;
}

void PrunedGap::fill(const std::vector<Node>& nodes) {
  std::vector<GapField::Tile*> tiles;
  for (const Node& n : nodes)
    for (int ty = n.ty; ty < n.ty + n.ny; ++ty)
      for (int tx = n.tx; tx < n.tx + n.nx; ++tx)
        if (!field_.known(tx, ty)) tiles.push_back(&field_.add_tile(tx, ty));
  if (tiles.empty()) return;
  source_.fill(tiles);
  for (const GapField::Tile* tile : tiles) least_known_ = std::min(least_known_, tile->least);
}

void PrunedGap::reveal(double below) {
  std::vector<Node> nodes, to_fill;
  const auto open = [&] { return !frontier_.empty() && frontier_.front().bounds.low < below; };
  while (open()) {
    check_cancelled();
    nodes.clear();
    while (open()) {
      const Node node = pop();
      (node.bounds.high < below ? to_fill : nodes).push_back(node);
    }
    refine(nodes, to_fill);
  }
  fill(to_fill);
}

void PrunedGap::reveal(const IndexBox& box) {
  const int tx = box.ix >> field_.log_x(), ty = box.iy >> field_.log_y();
  fill({{{},
         tx,
         ty,
         ((box.ix + box.nx - 1) >> field_.log_x()) - tx + 1,
         ((box.iy + box.ny - 1) >> field_.log_y()) - ty + 1}});
}

double PrunedGap::least() {
  std::vector<Node> nodes, to_fill;
  const auto open = [&] { return !frontier_.empty() && frontier_.front().bounds.low < least_known_; };
  // Straight down to a first tile, for an idea of the least gap; then what could still be below it, in growing groups,
  // which keep several threads busy.
  if (std::isinf(least_known_) && open()) dive(pop());
  const std::size_t most = std::clamp<std::size_t>(field_.tiles().size() / 64, 4, 64);
  for (std::size_t group = 4; open(); group = std::min(most, 2 * group)) {
    check_cancelled();
    nodes.clear();
    to_fill.clear();
    while (nodes.size() < group && open()) nodes.push_back(pop());
    refine(nodes, to_fill);
    fill(to_fill);
  }
  return std::isfinite(least_known_) ? least_known_ : std::numeric_limits<double>::quiet_NaN();
}

void PrunedGap::dive(Node node) {
  for (std::vector<Node> smaller = refined(node); !smaller.empty(); smaller = refined(node)) {
    std::swap(*ranges::max_element(smaller, later), smaller.back());
    node = smaller.back();
    for (std::size_t i = 0; i + 1 < smaller.size(); ++i) push(smaller[i]);
  }
  if (node.single()) fill({node});
}

std::size_t PrunedGap::points_known() const {
  std::size_t points = 0;
  for (const auto& tile : field_.tiles())
    if (tile) points += tile->box.size();
  return points;
}

}  // namespace treadmark::detection
