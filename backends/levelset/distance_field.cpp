// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/distance_field.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <tuple>

#include <fmt/format.h>

#include "treadmark/backends/levelset/block_index.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel_blocks.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::levelset {

namespace {

constexpr int kEdge = DistanceGrid::kEdge;
/// A cell whose hull only just keeps off zero counts as one that holds it: rounding decides nothing.
constexpr double kMargin = 1e-9;

std::size_t as_index(int n) { return static_cast<std::size_t>(n); }
std::size_t index_of(const std::array<int, 3>& n) { return as_index(64 * n[0] + 8 * n[1] + n[2]); }

/// Of the 27 nodes about a cell, from it.
Vec3 offset_of(int k) {
  const int i = k / 9 - 1, j = k / 3 % 3 - 1, l = k % 3 - 1;
  return Vec3(i, j, l);
}

/// Coordinate of a node in its own block or in the neighbour: which neighbour (0, 1, 2), and where in it.
std::pair<int, int> wrapped(int n) { return {(n + kEdge) / kEdge, (n + kEdge) % kEdge}; }

template <class Visit>
void for_each_marked(const std::array<std::uint64_t, 8>& marked, const Visit& visit) {
  for (int i = 0; i < kEdge; ++i)
    for (std::uint64_t rest = marked[static_cast<std::size_t>(i)]; rest != 0; rest &= rest - 1) {
      const int at = std::countr_zero(rest);
      visit(std::array<int, 3>{i, at / kEdge, at % kEdge});
    }
}

bool is_marked(const std::array<std::uint64_t, 8>& marked, const std::array<int, 3>& n) {
  return (marked[static_cast<std::size_t>(n[0])] >> (kEdge * n[1] + n[2]) & 1u) != 0;
}

/// Centre and half sizes of a box along the axes of a plane.
struct Extent {
  Vec3 centre, half;
  Extent(const LatticeView& view, const Vec3& middle, const Vec3& half_size)
      : centre(view.rotation.transpose() * (middle - view.origin)),
        half(view.rotation.transpose().cwiseAbs() * half_size + Vec3::Constant(kMargin)) {}
  bool over(const Rectangle& r) const {
    return centre.x() + half.x() >= r.x_min && centre.x() - half.x() <= r.x_max && centre.y() + half.y() >= r.y_min &&
           centre.y() - half.y() <= r.y_max;
  }
};

}  // namespace

DistanceField::DistanceField(DistanceGrid grid, const RimBlocks& rim) : grid_(std::move(grid)) {
  const std::vector<DistanceGrid::Block> given = std::move(grid_.blocks);
  grid_.blocks = {};
  blocks_.resize(given.size());
  values_.resize(given.size());
  for (std::size_t b = 0; b < given.size(); ++b) {
    blocks_[b].first = given[b].first;
    if (b >= rim.size() || rim[b].empty()) continue;
    blocks_[b].rim = static_cast<std::int32_t>(rims_.size());
    std::copy_n(rim[b].begin(), DistanceGrid::kNodes, rims_.emplace_back().begin());
  }
  connect();
  const auto neighbour = [&](std::size_t b, std::array<int, 3> n, int axis, int step, float& value) {
    n[static_cast<std::size_t>(axis)] += step;
    std::array<int, 3> where{};
    std::array<int, 3> local{};
    for (std::size_t a = 0; a < 3; ++a) std::tie(where[a], local[a]) = wrapped(n[a]);
    const std::int32_t other = blocks_[b].around[as_index(9 * where[0] + 3 * where[1] + where[2])];
    if (other < 0) return false;
    const auto at = static_cast<int>(index_of(local));
    const DistanceGrid::Block& from = given[static_cast<std::size_t>(other)];
    value = from.value[static_cast<std::size_t>(at)];
    return from.knows(at);
  };
  // Quasi-interpolation: less an eighth of the second differences a spline of the values has order 3 (de Boor 2001).
  parallel_blocks(given.size(), kBlocksAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t b = from; b < to; ++b)
      for (int node = 0; node < DistanceGrid::kNodes; ++node) {
        const std::array<int, 3> n{node >> 6, node >> 3 & 7, node & 7};
        const double value = given[b].value[static_cast<std::size_t>(node)];
        double bend = 0.0;
        if (given[b].knows(node))
          for (int axis = 0; axis < 3; ++axis) {
            float below = 0.0f, above = 0.0f;
            if (neighbour(b, n, axis, -1, below) && neighbour(b, n, axis, 1, above))
              bend += static_cast<double>(below) + static_cast<double>(above) - 2.0 * value;
          }
        values_[b][static_cast<std::size_t>(node)] = static_cast<float>(value - bend / 8.0);
      }
  });
  std::vector<Node> leaves(given.size());
  std::atomic<std::size_t> torn = 0;
  parallel_blocks(given.size(), kBlocksAtOnce, [&](std::size_t from, std::size_t to) {
    std::size_t own = 0;
    for (std::size_t b = from; b < to; ++b) mark(given, static_cast<std::uint32_t>(b), own);
    torn += own;
  });
  if (torn > 0)
    throw Error(ErrorKind::input_data,
                fmt::format("the narrow band of '{}' is too narrow: at {} places of its surface distances are missing",
                            grid_.name, torn.load()),
                {}, "its half width must be 3 voxels or more");
  parallel_blocks(given.size(), kBlocksAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t b = from; b < to; ++b) {
      Node& leaf = leaves[b];
      leaf.block = static_cast<std::uint32_t>(b);
      leaf.half = Vec3::Constant(-1.0);
      Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;
      int count = 0;
      Coefficients c;
      for_each_marked(blocks_[b].marked, [&](const std::array<int, 3>& n) {
        const Vec3 at = node(leaf.block, n);
        low = low.cwiseMin(at - Vec3::Constant(0.5)), high = high.cwiseMax(at + Vec3::Constant(0.5));
        gather(leaf.block, n, c);
        leaf.slab.normal += cell_gradient(c, Vec3::Zero());
        ++count;
      });
      if (count == 0) continue;
      leaf.centre = 0.5 * (low + high), leaf.half = 0.5 * (high - low);
      Slab& slab = leaf.slab;
      slab.normal /= count;
      slab.low = std::numeric_limits<double>::infinity(), slab.high = -slab.low;
      Vec3 turn = Vec3::Zero();
      for_each_marked(blocks_[b].marked, [&](const std::array<int, 3>& n) {
        const Vec3 at = node(leaf.block, n) - leaf.centre;
        gather(leaf.block, n, c);
        for (int k = 0; k < 27; ++k) c[static_cast<std::size_t>(k)] -= slab.normal.dot(at + offset_of(k));
        const auto [least, most] = cell_range(c);
        slab.low = std::min(slab.low, least), slab.high = std::max(slab.high, most);
        for (int axis = 0; axis < 3; ++axis) {
          const std::size_t step = axis == 0 ? 9 : axis == 1 ? 3 : 1;
          for (std::size_t k = 0; k + step < c.size(); ++k)
            if (k / step % 3 != 2) turn[axis] = std::max(turn[axis], std::fabs(c[k + step] - c[k]));
        }
      });
      slab.turn = turn.norm();
      slab.constant = -slab.normal.dot(leaf.centre);
    }
  });
  std::erase_if(leaves, [](const Node& leaf) { return leaf.half.x() < 0.0; });
  if (leaves.empty())
    throw Error(ErrorKind::input_data, fmt::format("there is no surface in '{}'", grid_.name), {},
                "distances must change their sign, and be positive outside");
  nodes_.reserve(2 * leaves.size());
  grow_tree(leaves, 0, leaves.size());
  low_ = nodes_.front().centre - nodes_.front().half, high_ = nodes_.front().centre + nodes_.front().half;
}

std::size_t DistanceField::memory_bytes() const {
  return sizeof(*this) + blocks_.capacity() * sizeof(Block) + nodes_.capacity() * sizeof(Node) +
         (values_.capacity() + rims_.capacity()) * sizeof(values_.front());
}

void DistanceField::connect() {
  BlockIndex index(blocks_.size());
  for (std::size_t b = 0; b < blocks_.size(); ++b) index.put(blocks_[b].first, static_cast<std::uint32_t>(b));
  parallel_blocks(blocks_.size(), kBlocksAtOnce, [&](std::size_t from, std::size_t to) {
    for (std::size_t b = from; b < to; ++b)
      for (int k = 0; k < 27; ++k) {
        std::array<std::int32_t, 3> at = blocks_[b].first;
        at[0] += kEdge * (k / 9 - 1), at[1] += kEdge * (k / 3 % 3 - 1), at[2] += kEdge * (k % 3 - 1);
        blocks_[b].around[static_cast<std::size_t>(k)] = index.find(at);
      }
  });
}

template <class Values>
void DistanceField::read(const Values& values_of, std::uint32_t block, const std::array<int, 3>& cell, float missing,
                         Coefficients& out) const {
  const Block& own = blocks_[block];
  const auto inner = [](int n) { return n > 0 && n < kEdge - 1; };
  if (inner(cell[0]) && inner(cell[1]) && inner(cell[2])) {
    const float* values = values_of(static_cast<std::int32_t>(block));
    if (values == nullptr) return out.fill(missing);
    values += index_of(cell);
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        for (int k = 0; k < 3; ++k) out[as_index(9 * i + 3 * j + k)] = values[64 * (i - 1) + 8 * (j - 1) + k - 1];
    return;
  }
  std::array<std::array<std::pair<int, int>, 3>, 3> w;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (int s = 0; s < 3; ++s) w[axis][static_cast<std::size_t>(s)] = wrapped(cell[axis] + s - 1);
  std::size_t at = 0;
  for (const auto& [bi, i] : w[0])
    for (const auto& [bj, j] : w[1])
      for (const auto& [bk, k] : w[2]) {
        const std::int32_t other = own.around[as_index(9 * bi + 3 * bj + bk)];
        const float* values = other < 0 ? nullptr : values_of(other);
        out[at++] = values == nullptr ? missing : values[64 * i + 8 * j + k];
      }
}

void DistanceField::gather(std::uint32_t block, const std::array<int, 3>& cell, Coefficients& out) const {
  read([this](std::int32_t b) { return values_[static_cast<std::size_t>(b)].data(); }, block, cell, 0.0f, out);
}

void DistanceField::gather_rim(std::uint32_t block, const std::array<int, 3>& cell, Coefficients& out) const {
  read(
      [this](std::int32_t b) {
        const std::int32_t rim = blocks_[static_cast<std::size_t>(b)].rim;
        return rim < 0 ? nullptr : rims_[static_cast<std::size_t>(rim)].data();
      },
      block, cell, -kFarFromRim, out);
}

void DistanceField::mark(const std::vector<DistanceGrid::Block>& given, std::uint32_t block, std::size_t& torn) {
  Block& own = blocks_[block];
  Coefficients c;
  for (int node = 0; node < DistanceGrid::kNodes; ++node) {
    if (!given[block].knows(node)) continue;
    const std::array<int, 3> n{node >> 6, node >> 3 & 7, node & 7};
    gather(block, n, c);
    const auto [least, most] = std::minmax_element(c.begin(), c.end());
    if (*least > kMargin || *most < -kMargin) continue;
    bool whole = true;
    for (int k = 0; k < 27 && whole; ++k) {
      const auto [bi, i] = wrapped(n[0] + k / 9 - 1);
      const auto [bj, j] = wrapped(n[1] + k / 3 % 3 - 1);
      const auto [bk, l] = wrapped(n[2] + k % 3 - 1);
      const std::int32_t other = own.around[as_index(9 * bi + 3 * bj + bk)];
      whole = other >= 0 && given[static_cast<std::size_t>(other)].knows(64 * i + 8 * j + l);
    }
    if (own.rim >= 0) {
      Coefficients rim;
      gather_rim(block, n, rim);
      if (cell_range(rim).first > kMargin) continue;
    }
    if (!whole) {
      // half the diagonal of a cell and some: farther off a distance says that the surface, or what is within its rim,
      // is not here
      constexpr float kNear = 0.9f;
      const auto at = static_cast<std::size_t>(node);
      const float beyond = own.rim < 0 ? -kFarFromRim : rims_[static_cast<std::size_t>(own.rim)][at];
      torn += std::fabs(given[block].value[at]) < kNear && beyond < kNear ? 1 : 0;
      continue;
    }
    const auto [low, high] = cell_range(c);
    if (low > kMargin || high < -kMargin) continue;
    own.marked[static_cast<std::size_t>(n[0])] |= std::uint64_t{1} << (kEdge * n[1] + n[2]);
  }
}

void DistanceField::grow_tree(std::vector<Node>& leaves, std::size_t from, std::size_t to) {
  const std::size_t at = nodes_.size();
  if (to - from == 1) {
    nodes_.push_back(leaves[from]);
    return;
  }
  Vec3 low = leaves[from].centre - leaves[from].half, high = leaves[from].centre + leaves[from].half;
  for (std::size_t i = from; i < to; ++i) {
    low = low.cwiseMin(leaves[i].centre - leaves[i].half);
    high = high.cwiseMax(leaves[i].centre + leaves[i].half);
  }
  Node& node = nodes_.emplace_back();
  node.centre = 0.5 * (low + high), node.half = 0.5 * (high - low);
  Eigen::Index axis = 0;
  node.half.maxCoeff(&axis);
  const std::size_t middle = (from + to) / 2;
  const auto begin = leaves.begin();
  std::nth_element(begin + static_cast<std::ptrdiff_t>(from), begin + static_cast<std::ptrdiff_t>(middle),
                   begin + static_cast<std::ptrdiff_t>(to), [axis](const Node& a, const Node& b) {
                     return a.centre[axis] != b.centre[axis] ? a.centre[axis] < b.centre[axis] : a.block < b.block;
                   });
  grow_tree(leaves, from, middle);
  nodes_[at].right = static_cast<std::uint32_t>(nodes_.size());
  grow_tree(leaves, middle, to);
}

const Coefficients& DistanceField::Reader::distances(std::uint32_t block, const std::array<int, 3>& cell) {
  const std::uint64_t key = std::uint64_t{block} << 9 | index_of(cell);
  if (key != last_) field_.gather(block, cell, values_), last_ = key;
  return values_;
}

const Coefficients& DistanceField::Reader::rim(std::uint32_t block, const std::array<int, 3>& cell) {
  const std::uint64_t key = std::uint64_t{block} << 9 | index_of(cell);
  if (key != last_rim_) field_.gather_rim(block, cell, rim_values_), last_rim_ = key;
  return rim_values_;
}

/// each(leaf, extent) says whether to go on below nodes of that extent; leaves are visited when their parents were.
template <class Each>
void DistanceField::each_over(const LatticeView& view, const Rectangle& r, const Each& each) const {
  constexpr std::size_t kDeepest = 64;  // halves of at most 2^32 blocks
  std::array<std::uint32_t, kDeepest> waiting;
  std::size_t count = 0;
  waiting[count++] = 0;
  while (count > 0) {
    const std::uint32_t at = waiting[--count];
    const Node& node = nodes_[at];
    const Extent extent(view, node.centre, node.half);
    if (!extent.over(r) || !each(node, extent)) continue;
    if (node.right != 0) waiting[count++] = node.right, waiting[count++] = at + 1;
  }
}

void DistanceField::candidates(const LatticeView& view, const Rectangle& r, std::vector<Candidate>& out) const {
  out.clear();
  each_over(view, r, [&](const Node& node, const auto& extent) {
    if (node.right == 0) out.push_back({view.inwards * extent.centre.z() - extent.half.z(), node.block});
    return true;
  });
  std::sort(out.begin(), out.end(), [](const Candidate& a, const Candidate& b) {
    return a.depth != b.depth ? a.depth < b.depth : a.block < b.block;
  });
}

Crossing DistanceField::first_crossing(Reader& reader, const LatticeView& view,
                                       const std::vector<Candidate>& candidates, double x, double y,
                                       double beyond) const {
  Crossing best;
  if (!std::isfinite(x) || !std::isfinite(y)) return best;
  for (const Candidate& c : candidates) {
    if (c.depth > best.depth) break;
    meet(reader, view, c.block, x, y, beyond, best);
  }
  return best;
}

/// Walks through the cells of a block that the line passes (Amanatides and Woo 1987) and looks into the marked ones.
void DistanceField::meet(Reader& reader, const LatticeView& view, std::uint32_t block, double x, double y,
                         double beyond, Crossing& best) const {
  const Block& own = blocks_[block];
  const Vec3 first(own.first[0], own.first[1], own.first[2]);
  const Vec3 from = view.at(x, y, 0.0) - first, along = view.inwards * view.rotation.col(2);
  // the depth at which the line passes a border between cells: the same numbers for both of them
  const auto border = [&](int axis, int n) { return (n - 0.5 - from[axis]) / along[axis]; };
  double enter = -std::numeric_limits<double>::infinity(), leave = -enter;
  for (int axis = 0; axis < 3; ++axis) {
    if (along[axis] == 0.0) {
      if (from[axis] < -0.5 || from[axis] > kEdge - 0.5) return;
      continue;
    }
    const double a = border(axis, 0), b = border(axis, kEdge);
    enter = std::max(enter, std::min(a, b)), leave = std::min(leave, std::max(a, b));
  }
  if (!(enter <= leave) || enter > best.depth || leave < beyond) return;
  std::array<int, 3> cell{};
  for (int axis = 0; axis < 3; ++axis)
    cell[static_cast<std::size_t>(axis)] =
        to_whole<int>(std::floor(std::clamp(from[axis] + enter * along[axis] + 0.5, 0.0, kEdge - 0.5)));
  double begin = enter;
  for (;;) {
    double end = leave;
    int across = -1;
    for (int axis = 0; axis < 3; ++axis) {
      if (along[axis] == 0.0) continue;
      const double t = border(axis, cell[static_cast<std::size_t>(axis)] + (along[axis] > 0.0 ? 1 : 0));
      if (across < 0 || t < end) end = t, across = axis;
    }
    if (end > begin && end >= beyond && is_marked(own.marked, cell)) {
      const Vec3 node(cell[0], cell[1], cell[2]);
      const Vec3 a = from + begin * along - node, b = from + end * along - node;
      const LinePolynomial line = along_line(reader.distances(block, cell), a, b);
      each_crossing(line, [&](double s, bool falls) {
        const double depth = begin + s * (end - begin);
        if (depth >= best.depth) return true;
        if (depth <= beyond) return false;
        if (own.rim >= 0 && cell_value(reader.rim(block, cell), a + s * (b - a)) > 0.0) return false;
        best = {block, cell, depth, falls};
        return true;
      });
    }
    if (across < 0 || end >= best.depth) return;
    int& n = cell[static_cast<std::size_t>(across)];
    n += along[across] > 0.0 ? 1 : -1;
    if (n < 0 || n >= kEdge) return;
    begin = std::max(begin, end);
  }
}

bool DistanceField::depths(const LatticeView& view, const Rectangle& r, double& least, double& greatest) const {
  least = std::numeric_limits<double>::infinity(), greatest = -least;
  // What lies within what was found already changes nothing. Blocks much smaller than the rectangle count as a whole.
  constexpr double kSmall = 0.25, kFlat = 1e-3;
  const double size = (r.x_max - r.x_min) + (r.y_max - r.y_min);
  const auto nothing_new = [&](const Extent& e) {
    const double depth = view.inwards * e.centre.z();
    return depth - e.half.z() >= least && depth + e.half.z() <= greatest;
  };
  // the part of a slab over the rectangle, within a box
  const auto clip = [&](const Extent& e, const Slab& slab, const Vec3& middle, double& from, double& to) {
    const double depth = view.inwards * e.centre.z();
    from = depth - e.half.z(), to = depth + e.half.z();
    const Vec3 n = view.rotation.transpose() * slab.normal;
    const double slope = view.inwards * n.z();
    if (slope - slab.turn > 0.0) return false;  // seen from inside everywhere
    if (std::fabs(slope) < kFlat) return true;
    const double mid = slab.normal.dot(middle) + slab.constant;
    double rest_low = -mid - slab.high, rest_high = -mid - slab.low;  // of n . (p - middle)
    for (const auto& [k, low, high] : {std::tuple{0, r.x_min, r.x_max}, std::tuple{1, r.y_min, r.y_max}}) {
      const double a = std::max(low - e.centre[k], -e.half[k]), b = std::min(high - e.centre[k], e.half[k]);
      rest_low -= std::max(n[k] * a, n[k] * b), rest_high -= std::min(n[k] * a, n[k] * b);
    }
    const double a = depth + rest_low / slope, b = depth + rest_high / slope;
    from = std::max(from, std::min(a, b) - kMargin), to = std::min(to, std::max(a, b) + kMargin);
    return from <= to;
  };
  Coefficients c;
  each_over(view, r, [&](const Node& node, const Extent& extent) {
    if (nothing_new(extent)) return false;
    if (node.right != 0) return true;
    double from = 0.0, to = 0.0;
    if (!clip(extent, node.slab, node.centre, from, to)) return false;
    if (from >= least && to <= greatest) return false;
    if (kEdge < kSmall * size) {
      least = std::min(least, from), greatest = std::max(greatest, to);
      return false;
    }
    for_each_marked(blocks_[node.block].marked, [&](const std::array<int, 3>& n) {
      const Vec3 at = this->node(node.block, n);
      const Extent one(view, at, Vec3::Constant(0.5));
      if (!one.over(r) || nothing_new(one)) return;
      gather(node.block, n, c);
      Slab slab;
      slab.normal = cell_gradient(c, Vec3::Zero());
      slab.constant = -slab.normal.dot(at);
      slab.turn = 2.0 * slab.normal.norm();  // not asked: what faces away is as rare as its blocks
      for (int k = 0; k < 27; ++k) c[static_cast<std::size_t>(k)] -= slab.normal.dot(offset_of(k));
      std::tie(slab.low, slab.high) = cell_range(c);
      if (!clip(one, slab, at, from, to)) return;
      least = std::min(least, from), greatest = std::max(greatest, to);
    });
    return false;
  });
  return least <= greatest;
}

}  // namespace treadmark::levelset
