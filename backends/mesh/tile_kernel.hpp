// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/lanes.hpp"
#include "treadmark/backends/mesh/tile.hpp"
#include "treadmark/backends/mesh/triangle_kernel.hpp"

namespace treadmark::mesh {
namespace {

/// Points of a tile, first and last column and row.
struct Range {
  int x0, x1, y0, y1;
  bool empty() const { return x0 > x1 || y0 > y1; }
};

/// Columns or rows from low to high in units of the step; values are limited first, so that all conversions are of
/// numbers that are not negative and cut like floor.
TREADMARK_LANES int first_at(double low, int n) {
  const double v = low < -1.0 ? -1.0 : low > n ? n : low;
  return n - static_cast<int>(n - v) < 0 ? 0 : n - static_cast<int>(n - v);
}
TREADMARK_LANES int last_at(double high, int n) {
  const double v = high < -1.0 ? -1.0 : high > n - 1 ? n - 1 : high;
  return static_cast<int>(v + 1.0) - 1;
}

struct TileFill {
  const MeshArrays& mesh;
  const PlaneLines& lines;
  Tile& tile;
  V4 column[3], extent[3], base;  ///< rows of the rotation, their magnitudes, where the origin goes
  double slack_x, slack_y;      ///< in steps: points this far beside still count as covered

  [[gnu::always_inline]] inline TileFill(const MeshArrays& m, const PlaneLines& l, Tile& t) : mesh(m), lines(l), tile(t) {
    base = all(0.0);
    for (int j = 0; j < 3; ++j) {
      column[j] = V4{l.rotation[j][0], l.rotation[j][1], l.rotation[j][2], 0.0};
      extent[j] = magnitude(column[j]);
      base -= column[j] * all(l.origin[j]);
    }
    constexpr double kRounding = 1e-6;  // of numbers of columns
    slack_x = kNearEdge * t.inverse_dx + kRounding;
    slack_y = kNearEdge * t.inverse_dy + kRounding;
  }

  [[gnu::always_inline]] inline Range range(double x_low, double x_high, double y_low, double y_high) const {
    return {first_at((x_low - tile.x[0]) * tile.inverse_dx - slack_x, tile.nx),
            last_at((x_high - tile.x[0]) * tile.inverse_dx + slack_x, tile.nx),
            first_at((y_low - tile.y[0]) * tile.inverse_dy - slack_y, tile.ny),
            last_at((y_high - tile.y[0]) * tile.inverse_dy + slack_y, tile.ny)};
  }

  struct Open {
    std::uint32_t node;
    Range range;
    double outermost;
  };

  [[gnu::always_inline]] inline Open look(std::uint32_t i) const {
    const BvhNode& node = mesh.nodes[i];
    V4 m = base, h = all(kBoxRounding);
    for (int j = 0; j < 3; ++j) {
      m = fma(column[j], all(node.middle[j]), m);
      h = fma(extent[j], all(node.half[j]), h);
    }
    return {i, range(m[0] - h[0], m[0] + h[0], m[1] - h[1], m[1] + h[1]), lines.side * m[2] + h[2]};
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

  /// The point lies exactly on an edge: whether this triangle takes it. Of two neighbours the lower number does, insides
  /// take all theirs, vertices are left to the hierarchy.
  [[gnu::noinline]] bool takes_edge(std::uint32_t index, bool front, const double (&e)[3], int at, double x, double y) {
    const int zeros = (e[0] == 0.0) + (e[1] == 0.0) + (e[2] == 0.0);
    if (zeros > 1) {
      ask(at);
      return false;
    }
    if (!front) return true;
    const int across = e[0] == 0.0 ? 0 : e[1] == 0.0 ? 1 : 2;
    const std::uint32_t other = mesh.neighbours[3 * index + static_cast<std::uint32_t>(across)];
    if (other > index) return true;  // a rim, too
    double q[9];
    for (int k = 0; k < 3; ++k) project(mesh, lines, mesh.triangles[3 * other + static_cast<std::uint32_t>(k)], q + 3 * k);
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

  /// Columns of a wide triangle that row y, or rows closer to it than kNearEdge, cross.
  [[gnu::always_inline]] inline void cross(const double (&q)[9], double y, const Range& r, int& first, int& last) const {
    const double low = y - kNearEdge, high = y + kNearEdge;
    double x_low = 1e300, x_high = -1e300;
    const auto widen = [&](double x) {
      if (x < x_low) x_low = x;
      if (x > x_high) x_high = x;
    };
    for (int k = 0; k < 3; ++k) {
      const double *a = q + 3 * k, *b = q + (k == 2 ? 0 : 3 * (k + 1));
      if (a[1] > b[1]) {
        const double* c = a;
        a = b;
        b = c;
      }
      if (b[1] < low || a[1] > high) continue;
      const double height = b[1] - a[1];
      if (!(height > 0.0)) {
        widen(a[0]);
        widen(b[0]);
        continue;
      }
      const double per = (b[0] - a[0]) / height, y1 = a[1] > low ? a[1] : low, y2 = b[1] < high ? b[1] : high;
      widen(a[0] + (y1 - a[1]) * per);
      widen(a[0] + (y2 - a[1]) * per);
    }
    first = first_at((x_low - tile.x[0]) * tile.inverse_dx - slack_x, tile.nx);
    last = last_at((x_high - tile.x[0]) * tile.inverse_dx + slack_x, tile.nx);
    if (first < r.x0) first = r.x0;
    if (last > r.x1) last = r.x1;
  }

  /// Marks the points of one triangle. area: twice the signed one in the plane. False if the slots are used up.
  [[gnu::always_inline]] inline bool mark(std::uint32_t index, const double (&q)[9], double area, const Range& r) {
    const double ax = q[3] - q[0], ay = q[4] - q[1], bx = q[6] - q[3], by = q[7] - q[4], cx = q[0] - q[6], cy = q[1] - q[7];
    const double a2 = ax * ax + ay * ay, b2 = bx * bx + by * by, c2 = cx * cx + cy * cy;
    const double longest2 = a2 > b2 ? (a2 > c2 ? a2 : c2) : (b2 > c2 ? b2 : c2);
    // a bound of the length of an edge that needs no root
    const double tolerance = kNearEdge * ((ax < 0 ? -ax : ax) + (ay < 0 ? -ay : ay) + (bx < 0 ? -bx : bx) + (by < 0 ? -by : by));
    if (!(area * area > kEdgeOn * kEdgeOn * longest2 * longest2)) {
      ask_near(q, r, tolerance);
      return true;
    }
    const bool front = lines.side * area > 0.0;
    const double sign = front ? lines.side : -lines.side;
    constexpr int kWideTriangle = 8;  // columns from which rows are cut to what the triangle crosses
    const bool wide = r.x1 - r.x0 >= kWideTriangle;
    int slot = -1;
    for (int iy = r.y0; iy <= r.y1; ++iy) {
      const double y = tile.y[iy];
      int first = r.x0, last = r.x1;
      if (wide) cross(q, y, r, first, last);
      const V4 say = all(sign * (q[1] - y)), sby = all(sign * (q[4] - y)), scy = all(sign * (q[7] - y));
      for (int ix = first; ix <= last; ix += kLanes) {
        const V4 x = load(tile.x + ix), px = all(q[0]) - x, qx = all(q[3]) - x, rx = all(q[6]) - x;
        const V4 e0 = qx * scy - sby * rx, e1 = rx * say - scy * px, e2 = px * sby - say * qx;
        const V4 low = least(least(e0, e1), e2);
        const M4 near = low >= all(-tolerance);
        if (bits(near) == 0) continue;
        const int at = iy * Tile::kStride + ix;
        M4 in = low > all(0.0);
        const int on_edge = bits(low == all(0.0));
        if (__builtin_expect(on_edge != 0, 0)) {
          for (int k = 0; k < kLanes && ix + k <= last; ++k) {
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
          for (int k = 0; k < kLanes && ix + k <= last; ++k)
            if (same >> k & 1) ask(at + k);
        const M4 better = in & (depth > before);
        if (slot < 0) {
          if (tile.used == Tile::kSlots) return false;
          slot = tile.used++;
          TileTriangle& own = tile.triangles[slot];
          for (int k = 0; k < 9; ++k) own.q[k] = q[k];
          own.index = index;
          own.front = front;
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
      const int count = static_cast<int>(node.begin + node.count - begin) < kLanes ? static_cast<int>(node.begin + node.count - begin) : kLanes;
      std::uint32_t index[kLanes];
      for (int k = 0; k < kLanes; ++k) index[k] = mesh.order[begin + static_cast<std::uint32_t>(k < count ? k : 0)];
      V4 q[9];
      project_lanes(mesh, lines, index, q);
      const V4 x_low = least(least(q[0], q[3]), q[6]), x_high = most(most(q[0], q[3]), q[6]);
      const V4 y_low = least(least(q[1], q[4]), q[7]), y_high = most(most(q[1], q[4]), q[7]);
      const V4 area = (q[3] - q[0]) * (q[7] - q[1]) - (q[4] - q[1]) * (q[6] - q[0]);
      for (int k = 0; k < count; ++k) {
        const Range r = range(x_low[k], x_high[k], y_low[k], y_high[k]);
        if (r.empty()) continue;
        double own[9];
        for (int i = 0; i < 9; ++i) own[i] = q[i][k];
        if (!mark(index[k], own, area[k], r)) return false;
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
    Open stack[kDepth];
    int size = 0;
    stack[size] = look(0);
    if (!stack[size].range.empty()) ++size;
    while (size > 0) {
      const Open open = stack[--size];
      if (hidden(open.range, open.outermost)) continue;
      const BvhNode& node = mesh.nodes[open.node];
      if (node.right == 0) {
        if (!leaf(node)) return false;
        continue;
      }
      // the outer child first: it may hide the other
      const Open a = look(open.node + 1), b = look(node.right);
      const bool a_first = a.outermost >= b.outermost;
      const Open &later = a_first ? b : a, &sooner = a_first ? a : b;
      if (!later.range.empty()) stack[size++] = later;
      if (!sooner.range.empty()) stack[size++] = sooner;
    }
    return true;
  }
};

}  // namespace
}  // namespace treadmark::mesh
