// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/projected_lanes.hpp"
#include "treadmark/core/kernel.hpp"

namespace treadmark::mesh {
namespace {

/// Points of a tile, first and last column and row.
struct Range {
  int x0, x1, y0, y1;
};

struct TileFill {
  const MeshArrays& mesh;
  const PlaneLines& lines;
  Tile& tile;
  // Rectangles are counted in steps of the grid as (-x_low, -y_low, x_high, y_high), so that rounding down leaves the
  // points inside of them, and limits are limits from above.
  V4 column[3], extent[3], base, limit;
  double across[3], outer[3], outer_base;  ///< the same for heights, outwards
  double slack_x, slack_y;                 ///< in steps: points this far beside still count as covered

  [[gnu::always_inline]] inline TileFill(const MeshArrays& m, const PlaneLines& l, Tile& t)
      : mesh(m), lines(l), tile(t) {
    constexpr double kRounding = 1e-6;  // of numbers of columns
    slack_x = kNearEdge * t.inverse_dx + kRounding;
    slack_y = kNearEdge * t.inverse_dy + kRounding;
    const V4 scale = {-t.inverse_dx, -t.inverse_dy, t.inverse_dx, t.inverse_dy};
    base = V4{slack_x, slack_y, slack_x, slack_y} - scale * V4{t.x[0], t.y[0], t.x[0], t.y[0]};
    limit = V4{0.0, 0.0, static_cast<double>(t.nx - 1), static_cast<double>(t.ny - 1)};
    outer_base = kBoxRounding;
    for (int j = 0; j < 3; ++j) {
      const double rx = l.rotation[j][0], ry = l.rotation[j][1], rz = l.rotation[j][2];
      column[j] = scale * V4{rx, ry, rx, ry};
      extent[j] = magnitude(column[j]);
      base -= column[j] * all(l.origin[j]);
      across[j] = l.side * rz;
      outer[j] = rz < 0.0 ? -rz : rz;
      outer_base -= across[j] * l.origin[j];
    }
  }

  /// The points of a rectangle; see column.
  [[gnu::always_inline]] inline V4 points(V4 rectangle) const { return least(floor(rectangle), limit); }
  TREADMARK_LANES bool empty(V4 points) { return points[0] + points[2] < 0.0 || points[1] + points[3] < 0.0; }
  TREADMARK_LANES Range range(V4 points) {
    int r[4];
    store(r, points);
    return {-r[0], r[2], -r[1], r[3]};
  }

  struct Open {
    V4 points;
    double outermost;
    std::uint32_t node;
  };

  [[gnu::always_inline]] inline void look(std::uint32_t i, Open& open) const {
    const BvhNode& node = mesh.nodes[i];
    V4 middle = base, half = all(0.0);
    double z = outer_base;
    for (int j = 0; j < 3; ++j) {
      middle = fma(column[j], all(node.middle[j]), middle);
      half = fma(extent[j], all(node.half[j]), half);
      z += across[j] * node.middle[j] + outer[j] * node.half[j];
    }
    open = {points(middle + half), z, i};
  }

  /// Whether all points of the range have something farther out.
  [[gnu::always_inline]] inline bool hidden(const Range& r, double outermost) const {
    for (int iy = r.y0; iy <= r.y1; ++iy)
      for (int ix = r.x0; ix <= r.x1; ++ix)
        if (!(tile.depth[iy * Tile::kStride + ix] > outermost + kSameHeight)) return false;
    return true;
  }

  void ask(int at) {
    tile.asked[at] = true;
    tile.any_asked = true;
  }

  /// The point lies exactly on an edge: whether this triangle takes it. Of two neighbours the lower number does,
  /// insides take all theirs, vertices are left to the hierarchy.
  [[gnu::noinline]] bool takes_edge(std::uint32_t index, bool front, const double (&e)[3], int at, double x, double y) {
    const int zeros = (e[0] == 0.0) + (e[1] == 0.0) + (e[2] == 0.0);
    if (zeros > 1) {
      ask(at);
      return false;
    }
    if (!front) return true;
    const int zero = e[0] == 0.0 ? 0 : e[1] == 0.0 ? 1 : 2;
    const std::uint32_t other = mesh.neighbours[3 * index + static_cast<std::uint32_t>(zero)];
    if (other > index) return true;  // a rim, too
    double q[9];
    for (int k = 0; k < 3; ++k)
      project(mesh, lines, mesh.triangles[3 * other + static_cast<std::uint32_t>(k)], q + 3 * k);
    double f[3];
    edge_functions(q, x, y, lines.side, f);
    return !(f[0] >= 0.0 && f[1] >= 0.0 && f[2] >= 0.0 && f[0] + f[1] + f[2] > 0.0);
  }

  /// Seen edge-on, or a needle: signs say little, so that all points close by are left to the hierarchy.
  [[gnu::noinline]] void ask_near(const double (&q)[9], const Range& r, double tolerance) {
    for (int iy = r.y0; iy <= r.y1; ++iy)
      for (int ix = r.x0; ix <= r.x1; ++ix) {
        double e[3];
        edge_functions(q, tile.x[ix], tile.y[iy], 1.0, e);
        const double low = e[0] < e[1] ? (e[0] < e[2] ? e[0] : e[2]) : (e[1] < e[2] ? e[1] : e[2]);
        const double high = e[0] > e[1] ? (e[0] > e[2] ? e[0] : e[2]) : (e[1] > e[2] ? e[1] : e[2]);
        if (low >= -tolerance || high <= tolerance) ask(iy * Tile::kStride + ix);
      }
  }

  /// First and last columns of rows r.y0 to r.y1 that a triangle crosses, four rows at a time, within r and about
  /// kNearEdge more. sign: +1 if the triangle turns from x to y. Edges along the rows limit nothing.
  [[gnu::always_inline]] inline void cut_rows(const double (&q)[9], double sign, const Range& r, int* first,
                                              int* last) const {
    constexpr double kFlat = 1e-6, kFar = 1e9;
    double from[3], from_per_y[3], to[3], to_per_y[3];
    for (int k = 0; k < 3; ++k) {
      const double *a = q + 3 * ((k + 1) % 3), *b = q + 3 * ((k + 2) % 3);
      const double dx = a[0] - b[0], dy = a[1] - b[1], rise = dy < 0.0 ? -dy : dy, run = dx < 0.0 ? -dx : dx;
      from[k] = -kFar;
      to[k] = kFar;
      from_per_y[k] = to_per_y[k] = 0.0;
      if (!(rise > kFlat * run)) continue;
      const double per = dx / dy, x = ((a[0] - tile.x[0]) - (a[1] - tile.y[0]) * per) * tile.inverse_dx;
      const double margin = slack_x * (1.0 + run / rise);
      if (sign * dy > 0.0)
        from[k] = x - margin, from_per_y[k] = per * tile.inverse_dx;
      else
        to[k] = x + margin, to_per_y[k] = per * tile.inverse_dx;
    }
    for (int iy = r.y0; iy <= r.y1; iy += kLanes) {
      const V4 y = load(tile.y + iy) - all(tile.y[0]);
      const auto at = [&](double c, double per) { return all(c) + all(per) * y; };
      const V4 low = most(most(at(from[0], from_per_y[0]), at(from[1], from_per_y[1])), at(from[2], from_per_y[2]));
      const V4 high = least(least(at(to[0], to_per_y[0]), at(to[1], to_per_y[1])), at(to[2], to_per_y[2]));
      // limits first, so that conversions hold
      const V4 left = all(static_cast<double>(r.x0)), right = all(static_cast<double>(r.x1));
      store(first + (iy - r.y0), -floor(-least(most(low, left), right + all(1.0))));
      store(last + (iy - r.y0), floor(least(most(high, left - all(1.0)), right)));
    }
  }

  static constexpr std::int64_t kUnset = -100;

  /// Marks the points of one triangle. area: twice the signed one in the plane. False if the slots are used up.
  [[gnu::always_inline]] inline bool mark(std::uint32_t index, const double (&q)[9], double area, const Range& r) {
    const double ax = q[3] - q[0], ay = q[4] - q[1], bx = q[6] - q[3], by = q[7] - q[4], cx = q[0] - q[6],
                 cy = q[1] - q[7];
    const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    const double longest2 = a2 > b2 ? (a2 > c2 ? a2 : c2) : (b2 > c2 ? b2 : c2);
    // a bound of the length of an edge that needs no root
    const double tolerance =
        kNearEdge * ((ax < 0 ? -ax : ax) + (ay < 0 ? -ay : ay) + (bx < 0 ? -bx : bx) + (by < 0 ? -by : by));
    if (!(area * area > kEdgeOn * kEdgeOn * longest2 * longest2)) {
      ask_near(q, r, tolerance);
      return true;
    }
    const bool front = lines.side * area > 0.0;
    const double sign = front ? lines.side : -lines.side;
    int first[Tile::kHigh + kLanes], last[Tile::kHigh + kLanes];
    if (r.y0 == r.y1)
      first[0] = r.x0, last[0] = r.x1;
    else
      cut_rows(q, area > 0.0 ? 1.0 : -1.0, r, first, last);
    std::int64_t slot = front ? kUnset : Tile::kInside;
    for (int iy = r.y0; iy <= r.y1; ++iy) {
      const double y = tile.y[iy];
      const int end = last[iy - r.y0];
      const V4 say = all(sign * (q[1] - y)), sby = all(sign * (q[4] - y)), scy = all(sign * (q[7] - y));
      for (int ix = first[iy - r.y0]; ix <= end; ix += kLanes) {
        const V4 x = load(tile.x + ix), px = all(q[0]) - x, qx = all(q[3]) - x, rx = all(q[6]) - x;
        const V4 e0 = qx * scy - sby * rx, e1 = rx * say - scy * px, e2 = px * sby - say * qx;
        const V4 low = least(least(e0, e1), e2);
        const M4 near = low >= all(-tolerance);
        if (bits(near) == 0) continue;
        const int at = iy * Tile::kStride + ix;
        M4 in = low > all(0.0);
        const int on_edge = bits(low == all(0.0));
        if (__builtin_expect(on_edge != 0, 0)) {
          for (int k = 0; k < kLanes && ix + k <= end; ++k) {
            if ((on_edge >> k & 1) == 0) continue;
            const double e[3] = {e0[k], e1[k], e2[k]};
            if (takes_edge(index, front, e, at + k, x[k], y)) in[k] = -1;
          }
        }
        M4 owner = load(tile.owner + at);
        owner = select(near & (owner == each(Tile::kNobody)), each(Tile::kRim), owner);
        const int inside = bits(in);
        if (inside == 0) {
          store(tile.owner + at, owner);
          continue;
        }
        const V4 inverse = all(1.0) / (e0 + e1 + e2);
        const V4 z = (e0 * inverse) * all(q[2]) + (e1 * inverse) * all(q[5]) + (e2 * inverse) * all(q[8]);
        const V4 depth = all(lines.side) * z, before = load(tile.depth + at);
        const int same = bits(in & (magnitude(depth - before) <= all(kSameHeight)));
        if (__builtin_expect(same != 0, 0))
          for (int k = 0; k < kLanes && ix + k <= end; ++k)
            if (same >> k & 1) ask(at + k);
        const M4 better = in & (depth > before);
        if (slot == kUnset) {
          if (tile.used == Tile::kSlots) return false;
          slot = tile.used++;
          TileTriangle& own = tile.triangles[slot];
          for (int k = 0; k < 9; ++k) own.q[k] = q[k];
          own.index = index;
        }
        store(tile.depth + at, select(better, depth, before));
        store(tile.owner + at, select(better, each(slot), owner));
      }
    }
    return true;
  }

  /// Up to four triangles of a leaf, one a lane.
  [[gnu::always_inline]] inline bool leaf(const BvhNode& node) {
    for (std::uint32_t begin = node.begin; begin < node.begin + node.count; begin += kLanes) {
      const int count = static_cast<int>(node.begin + node.count - begin) < kLanes
                            ? static_cast<int>(node.begin + node.count - begin)
                            : kLanes;
      std::uint32_t index[kLanes];
      for (int k = 0; k < kLanes; ++k) index[k] = begin + static_cast<std::uint32_t>(k < count ? k : 0);
      V4 q[9];
      project_lanes(mesh, lines, index, q);
      const V4 x_low = least(least(q[0], q[3]), q[6]), x_high = most(most(q[0], q[3]), q[6]);
      const V4 y_low = least(least(q[1], q[4]), q[7]), y_high = most(most(q[1], q[4]), q[7]);
      const V4 to_x = all(tile.inverse_dx), to_y = all(tile.inverse_dy), x0 = all(tile.x[0]), y0 = all(tile.y[0]);
      const V4 left = least(floor((x0 - x_low) * to_x + all(slack_x)), all(0.0));
      const V4 right = least(floor((x_high - x0) * to_x + all(slack_x)), all(limit[2]));
      const V4 top = least(floor((y0 - y_low) * to_y + all(slack_y)), all(0.0));
      const V4 bottom = least(floor((y_high - y0) * to_y + all(slack_y)), all(limit[3]));
      int hit = bits((left + right >= all(0.0)) & (top + bottom >= all(0.0))) & ((1 << count) - 1);
      if (hit == 0) continue;
      const V4 area = (q[3] - q[0]) * (q[7] - q[1]) - (q[4] - q[1]) * (q[6] - q[0]);
      int x_first[kLanes], x_last[kLanes], y_first[kLanes], y_last[kLanes];
      store(x_first, -left), store(x_last, right), store(y_first, -top), store(y_last, bottom);
      double own_lanes[9][kLanes], areas[kLanes];
      for (int i = 0; i < 9; ++i) store(own_lanes[i], q[i]);
      store(areas, area);
      for (int k = 0; k < count; ++k) {
        if ((hit >> k & 1) == 0) continue;
        const Range r{x_first[k], x_last[k], y_first[k], y_last[k]};
        double own[9];
        for (int i = 0; i < 9; ++i) own[i] = own_lanes[i][k];
        if (!mark(index[k], own, areas[k], r)) return false;
      }
    }
    return true;
  }

  bool run() {
    for (int iy = 0; iy < tile.ny; ++iy)
      for (int ix = 0; ix < tile.nx + Tile::kPad; ++ix) {
        const int at = iy * Tile::kStride + ix;
        tile.depth[at] = -__builtin_inf();
        tile.owner[at] = Tile::kNobody;
        tile.asked[at] = false;
      }
    tile.any_asked = false;
    tile.used = 0;
    constexpr int kDepth = 64;  // levels: 32-bit numbers are halved
    Open stack[kDepth + 1];
    int size = 0;
    look(0, stack[0]);
    if (!empty(stack[0].points)) size = 1;
    while (size > 0) {
      const Open& open = stack[size - 1];
      const BvhNode& node = mesh.nodes[open.node];
      if (hidden(range(open.points), open.outermost)) {
        --size;
        continue;
      }
      if (node.right == 0) {
        if (!leaf(node)) return false;
        --size;
        continue;
      }
      // the outer child first: it may hide the other
      const std::uint32_t left = open.node + 1, right = node.right;
      Open &later = stack[size - 1], &sooner = stack[size];
      look(left, later);
      look(right, sooner);
      if (empty(sooner.points)) {
        if (empty(later.points)) --size;
      } else if (empty(later.points)) {
        later = sooner;
      } else {
        if (later.outermost > sooner.outermost) {
          const Open other = later;
          later = sooner;
          sooner = other;
        }
        ++size;
      }
    }
    return true;
  }
};

bool fill_tile(const MeshArrays& mesh, const PlaneLines& lines, Tile& tile) {
  return TileFill(mesh, lines, tile).run();
}

}  // namespace

TREADMARK_KERNEL(TileKernel, fill_tile);

}  // namespace treadmark::mesh
