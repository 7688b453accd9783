// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/mesh/projected_lanes.hpp"
#include "treadmark/core/kernel.hpp"

namespace treadmark::mesh {
namespace {

/// Least and greatest z of the part of a triangle over the rectangle round (x, y); false if it lies beside.
bool clipped_heights(const double (&triangle)[9], double x, double y, double half_x, double half_y, double& low,
                     double& high) {
  // one side after the other cuts off what lies beyond it (Sutherland & Hodgman 1974); each adds at most one corner
  double corners[8][3], kept[8][3];
  int count = 3;
  for (int k = 0; k < 3; ++k) {
    corners[k][0] = triangle[3 * k] - x;
    corners[k][1] = triangle[3 * k + 1] - y;
    corners[k][2] = triangle[3 * k + 2];
  }
  for (int cut = 0; cut < 4; ++cut) {
    const int axis = cut / 2;
    const double sign = cut % 2 == 0 ? 1.0 : -1.0, half = axis == 0 ? half_x : half_y;
    int n = 0;
    for (int k = 0; k < count; ++k) {
      const double *a = corners[k], *b = corners[k + 1 == count ? 0 : k + 1];
      const double beyond_a = sign * a[axis] - half, beyond_b = sign * b[axis] - half;
      if (beyond_a <= 0.0) {
        for (int i = 0; i < 3; ++i) kept[n][i] = a[i];
        ++n;
      }
      if ((beyond_a < 0.0 && beyond_b > 0.0) || (beyond_a > 0.0 && beyond_b < 0.0)) {
        const double part = beyond_a / (beyond_a - beyond_b);
        for (int i = 0; i < 3; ++i) kept[n][i] = a[i] + (b[i] - a[i]) * part;
        ++n;
      }
    }
    count = n;
    for (int k = 0; k < count; ++k)
      for (int i = 0; i < 3; ++i) corners[k][i] = kept[k][i];
  }
  if (count == 0) return false;
  low = high = corners[0][2];
  for (int k = 1; k < count; ++k) {
    if (corners[k][2] < low) low = corners[k][2];
    if (corners[k][2] > high) high = corners[k][2];
  }
  return true;
}

constexpr double kHuge = 1e300, kLeastOut = 0.1;  ///< the latter as in SmoothPatches::reach

struct BoundsSearch {
  const MeshArrays& mesh;
  const PlaneLines& lines;
  BoundsQuery query;
  V4 column[3], extent[3], base, half;  ///< rows of the rotation, their magnitudes, the origin seen from the rectangle
  double outwards[3];
  bool upper[3];       ///< the greater component of a normal is the one that looks outwards most
  double small, thin;  ///< nodes below this count as a whole [m]
  double low = kHuge, high = -kHuge;
  bool certain = false;  ///< something is over the rectangle

  [[gnu::always_inline]] inline BoundsSearch(const MeshArrays& m, const PlaneLines& l, const BoundsQuery& q)
      : mesh(m), lines(l), query(q) {
    constexpr double kSmall = 0.125, kThin = 1.0 / 256.0;  // of the longer side
    const double longer = 2.0 * (q.half_x > q.half_y ? q.half_x : q.half_y);
    small = kSmall * longer;
    thin = kThin * longer;
    query.half_x += kNearEdge;
    query.half_y += kNearEdge;
    base = V4{-q.x, -q.y, 0.0, 0.0};
    half = V4{query.half_x, query.half_y, kHuge, kHuge};
    for (int j = 0; j < 3; ++j) {
      column[j] = V4{l.rotation[j][0], l.rotation[j][1], l.rotation[j][2], 0.0};
      extent[j] = magnitude(column[j]);
      base -= column[j] * all(l.origin[j]);
      outwards[j] = l.side * l.rotation[j][2];
      upper[j] = outwards[j] > 0.0;
    }
  }

  struct Seen {
    V4 middle, half;  ///< of the box, from the middle of the rectangle
    double distance;  ///< from it, about
    std::uint32_t node;
    bool over;
  };
  [[gnu::always_inline]] inline void look(std::uint32_t i, Seen& seen) const {
    const BvhNode& node = mesh.nodes[i];
    V4 m = base, h = all(kBoxRounding);
    for (int j = 0; j < 3; ++j) {
      m = fma(column[j], all(node.middle[j]), m);
      h = fma(extent[j], all(node.half[j]), h);
    }
    const V4 away = magnitude(m);
    seen = {m, h, away[0] + away[1], i, bits(away > h + half) == 0};
  }

  [[gnu::always_inline]] inline void widen(double a, double b) {
    if (a < low) low = a;
    if (b > high) high = b;
  }

  /// How far, at least and at most, the normals of a node look outwards.
  [[gnu::always_inline]] inline void facing(const BvhNode& node, double& least_out, double& most_out) const {
    least_out = most_out = 0.0;
    for (int k = 0; k < 3; ++k) {
      const double a = outwards[k] * static_cast<double>(node.normal_low[k]),
                   b = outwards[k] * static_cast<double>(node.normal_high[k]);
      most_out += upper[k] ? b : a;
      least_out += upper[k] ? a : b;
    }
  }
  TREADMARK_LANES double margin_along(const BvhNode& node, double least_out) {
    return static_cast<double>(node.margin) / (least_out > kLeastOut ? least_out : kLeastOut) + kBoxRounding;
  }

  /// The same of one triangle.
  [[gnu::always_inline]] inline double margin_over(std::uint32_t triangle) const {
    if (!mesh.about) return kBoxRounding;
    constexpr double kRounding = 1e-6;  // of normals in single precision
    const float* about = mesh.about + 4 * static_cast<std::size_t>(triangle);
    double out = 0.0;
    for (int j = 0; j < 3; ++j) out += outwards[j] * static_cast<double>(about[1 + j]);
    out = (out < 0.0 ? -out : out) - kRounding;
    return static_cast<double>(about[0]) / (out > kLeastOut ? out : kLeastOut) + kBoxRounding;
  }

  /// True if the node needs no closer look.
  [[gnu::always_inline]] inline bool settled(const Seen& seen) {
    const BvhNode& node = mesh.nodes[seen.node];
    // too large to count as a whole, and nothing known that its range might lie in
    if (!certain && node.right != 0 && (seen.half[0] > half[0] || seen.half[1] > half[1])) return false;
    double least_out, most_out;
    facing(node, least_out, most_out);
    if (most_out < 0.0) return true;  // shows insides only
    constexpr double kLevel = 0.05;
    const double margin = margin_along(node, least_out);
    double a = seen.middle[2] - seen.half[2], b = seen.middle[2] + seen.half[2], thickness = kHuge;
    V4 n = all(0.0);
    for (int j = 0; j < 3; ++j) n = fma(column[j], all(static_cast<double>(node.slab_normal[j])), n);
    const double level = n[2] < 0.0 ? -n[2] : n[2];
    if (level > kLevel) {
      // the slab over the common part of box and rectangle
      const V4 from = most(seen.middle - seen.half, -half), to = least(seen.middle + seen.half, half);
      const V4 middle = all(0.5) * (from + to), size = all(0.5) * (to - from), shift = n * (middle - seen.middle),
               spread = magnitude(n) * size;
      const double per = 1.0 / n[2], z = seen.middle[2] - (shift[0] + shift[1]) * per,
                   wide = (spread[0] + spread[1]) / level;
      const double s0 = static_cast<double>(node.slab_low) * per, s1 = static_cast<double>(node.slab_high) * per;
      const double below = (s0 < s1 ? s0 : s1) - wide, above = (s0 < s1 ? s1 : s0) + wide;
      if (z + below > a) a = z + below;
      if (z + above < b) b = z + above;
      thickness = s0 < s1 ? s1 - s0 : s0 - s1;
    }
    a -= margin;
    b += margin;
    if (a >= low && b <= high) return true;
    if (node.right == 0) return false;
    if (!(thickness <= thin || (seen.half[0] <= small && seen.half[1] <= small && b - a <= 4.0 * small))) return false;
    const bool inside = bits(magnitude(seen.middle) + seen.half > half) == 0 && least_out > 0.0;
    if (!(inside || certain)) return false;
    certain = true;
    widen(a, b);
    return true;
  }

  /// Triangles, one a lane.
  [[gnu::always_inline]] inline void leaf(const BvhNode& node) {
    for (std::uint32_t begin = node.begin; begin < node.begin + node.count; begin += kLanes) {
      std::uint32_t index[kLanes];
      for (std::uint32_t k = 0; k < kLanes; ++k) index[k] = begin + k < node.begin + node.count ? begin + k : begin;
      V4 q[9];
      project_lanes(mesh, lines, index, q);
      const V4 *x = q, *y = q + 1, *z = q + 2;  // every third
      const V4 mx = all(query.x), my = all(query.y), hx = all(query.half_x), hy = all(query.half_y), zero = all(0.0);
      const V4 x_low = least(least(x[0], x[3]), x[6]) - mx, x_high = most(most(x[0], x[3]), x[6]) - mx;
      const V4 y_low = least(least(y[0], y[3]), y[6]) - my, y_high = most(most(y[0], y[3]), y[6]) - my;
      const V4 z_low = least(least(z[0], z[3]), z[6]), z_high = most(most(z[0], z[3]), z[6]);
      M4 over = (x_low <= hx) & (x_high >= -hx) & (y_low <= hy) & (y_high >= -hy);
      if (bits(over) == 0) continue;
      const V4 size = (x_high - x_low) + (y_high - y_low), side = all(lines.side);
      const V4 area = side * ((x[3] - x[0]) * (y[6] - y[0]) - (y[3] - y[0]) * (x[6] - x[0]));
      over &= area > all(-kEdgeOn) * size * size;
      for (int k = 0; k < 3; ++k) {
        // beyond an edge with all of the rectangle
        const int i = 3 * ((k + 1) % 3), j = 3 * ((k + 2) % 3);
        const V4 by_x = y[i] - y[j], by_y = x[j] - x[i];
        const V4 e = side * ((x[i] - mx) * (y[j] - my) - (y[i] - my) * (x[j] - mx));
        over &= e + magnitude(by_x) * hx + magnitude(by_y) * hy + all(kEdgeOn) * size * size >= zero;
      }
      if (bits(over) == 0) continue;
      // the plane over the common part of box and rectangle
      const V4 x1 = x[3] - x[0], y1 = y[3] - y[0], z1 = z[3] - z[0], x2 = x[6] - x[0], y2 = y[6] - y[0],
               z2 = z[6] - z[0];
      const V4 per = side / area, gx = (z1 * y2 - y1 * z2) * per, gy = (x1 * z2 - z1 * x2) * per;
      const V4 from_x = most(x_low, -hx), to_x = least(x_high, hx), from_y = most(y_low, -hy), to_y = least(y_high, hy);
      const V4 cx = all(0.5) * (from_x + to_x), cy = all(0.5) * (from_y + to_y), dx = to_x - cx, dy = to_y - cy;
      const V4 middle = z[0] + gx * (cx - (x[0] - mx)) + gy * (cy - (y[0] - my)),
               spread = magnitude(gx) * dx + magnitude(gy) * dy;
      constexpr double kSteepest = 100.0;
      const M4 fine =
          (magnitude(gx) < all(kSteepest)) & (magnitude(gy) < all(kSteepest)) & (area > all(1e-8) * size * size);
      const V4 from = select(fine, most(middle - spread, z_low), z_low),
               to = select(fine, least(middle + spread, z_high), z_high);
      for (int k = 0; k < kLanes; ++k)
        if (bits(over) >> k & 1) {
          double a = from[k], b = to[k];
          if (b - a > query.half_x + query.half_y) {  // steep: to the point
            double corners[9];
            for (int i = 0; i < 9; ++i) corners[i] = q[i][k];
            if (!clipped_heights(corners, query.x, query.y, query.half_x, query.half_y, a, b)) continue;
          }
          const double margin = margin_over(index[k]);
          widen(a - margin, b + margin);
          certain = true;
        }
    }
  }

  BoundsFound run() {
    constexpr int kDepth = 64;  // levels: 32-bit numbers are halved
    Seen stack[kDepth + 1];
    int count = 0;
    look(0, stack[0]);
    if (stack[0].over) count = 1;
    while (count > 0) {
      const Seen& seen = stack[count - 1];
      if (settled(seen)) {
        --count;
        continue;
      }
      const BvhNode& node = mesh.nodes[seen.node];
      if (node.right == 0) {
        leaf(node);
        --count;
        continue;
      }
      // the middle first: it is most likely to settle that there is something
      const std::uint32_t left = seen.node + 1, right = node.right;
      Seen &later = stack[count - 1], &sooner = stack[count];
      look(left, later);
      look(right, sooner);
      if (!sooner.over) {
        if (!later.over) --count;
      } else if (!later.over) {
        later = sooner;
      } else {
        if (later.distance < sooner.distance) {
          const Seen other = later;
          later = sooner;
          sooner = other;
        }
        ++count;
      }
    }
    return {low, high};
  }
};

BoundsFound find_bounds(const MeshArrays& mesh, const PlaneLines& lines, const BoundsQuery& query) {
  return BoundsSearch(mesh, lines, query).run();
}

}  // namespace

TREADMARK_KERNEL(BoundsKernel, find_bounds);

}  // namespace treadmark::mesh
