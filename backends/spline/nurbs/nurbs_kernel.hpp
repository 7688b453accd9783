// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/backends/spline/nurbs/nurbs_kernels.hpp"
#include "treadmark/backends/spline/nurbs/nurbs_limits.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/lanes4.hpp"

namespace treadmark::spline {
namespace {
namespace nurbs_lanes {

using namespace lanes;

struct Extent {
  V4 low, high;
};
TREADMARK_LANES void include(Extent& e, V4 x) { e.low = least(e.low, x), e.high = most(e.high, x); }
template <class Points>
TREADMARK_LANES Extent extent(const Points& b) {
  Extent e{b[0][0], b[0][0]};
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) include(e, b[i][j]);
  return e;
}

// Control points of four patches, a coordinate at a time: b[coordinate][i][j].
TREADMARK_LANES void control_points(const ViewArrays& view, const PatchCorners* const (&patches)[4], V4 (&b)[3][4][4]) {
  V4 third_u, third_v;
  for (int lane = 0; lane < 4; ++lane) {
    third_u[lane] = patches[lane]->size_u * (1.0 / 3.0);
    third_v[lane] = patches[lane]->size_v * (1.0 / 3.0);
  }
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      V4 c[3][4];
      for (int k = 0; k < 3; ++k) {
        for (int lane = 0; lane < 4; ++lane) c[k][lane] = load(patches[lane]->corner[i][j] + 4 * k);
        transpose(c[k]);
      }
      const V4 p[4][3] = {{c[0][0] - view.origin[0], c[0][1] - view.origin[1], c[0][2] - view.origin[2]},
                          {c[0][3], c[1][0], c[1][1]},
                          {c[1][2], c[1][3], c[2][0]},
                          {c[2][1], c[2][2], c[2][3]}};
      const V4 su = i ? -third_u : third_u, sv = j ? -third_v : third_v;
      const int m = 3 * i, n = 3 * j, m1 = 1 + i, n1 = 1 + j;
      for (int k = 0; k < 3; ++k) {
        const double* r = view.to_plane + 3 * k;
        const auto turned = [&](const V4(&d)[3]) __attribute__((always_inline)) {
          return r[0] * d[0] + r[1] * d[1] + r[2] * d[2];
        };
        const V4 at = turned(p[0]), du = su * turned(p[1]), dv = sv * turned(p[2]), duv = (su * sv) * turned(p[3]);
        b[k][m][n] = at;
        b[k][m1][n] = at + du;
        b[k][m][n1] = at + dv;
        b[k][m1][n1] = at + du + dv + duv;
      }
    }
}

// See detail::centred_powers.
TREADMARK_LANES void centred_powers(V4& b0, V4& b1, V4& b2, V4& b3) {
  const V4 outer = b0 + b3, inner = b1 + b2, wide = b3 - b0, narrow = b2 - b1;
  b0 = 0.125 * (outer + 3.0 * inner);
  b1 = 0.75 * (wide + narrow);
  b2 = 1.5 * (outer - inner);
  b3 = wide - 3.0 * narrow;
}
TREADMARK_LANES void to_powers(V4 (&b)[4][4]) {
  for (int j = 0; j < 4; ++j) centred_powers(b[0][j], b[1][j], b[2][j], b[3][j]);
  for (int i = 0; i < 4; ++i) centred_powers(b[i][0], b[i][1], b[i][2], b[i][3]);
}

constexpr double kUpright = 1e100;  // [1/m] of A: seen edge-on

// NurbsLeaf's constructor for four polynomial patches: powers, and a bit for each that is regular.
TREADMARK_LANES int prepare(V4 (&b)[3][4][4], PatchPowers (&out)[4]) {
  V4 c[2][4][4];
  for (int k = 0; k < 2; ++k) {
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 4; ++j) c[k][i][j] = b[k][i][j];
    to_powers(c[k]);
  }
  const V4 x_s = c[0][1][0], x_t = c[0][0][1], y_s = c[1][1][0], y_t = c[1][0][1];
  const V4 inverse = 1.0 / (x_s * y_t - x_t * y_s);
  const V4 a[4] = {y_t * inverse, -x_t * inverse, -y_s * inverse, x_s * inverse};
  V4 g[2][4][4];
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j) {
      const V4 x = b[0][i][j] - c[0][0][0], y = b[1][i][j] - c[1][0][0];
      g[0][i][j] = a[0] * x + a[1] * y;
      g[1][i][j] = a[2] * x + a[3] * y;
    }
  // |3 difference - 1| from the least and greatest of the differences
  V4 e2 = all(0.0), one = all(1.0);
  for (int k = 0; k < 2; ++k) {
    Extent by_s{g[k][1][0] - g[k][0][0], g[k][1][0] - g[k][0][0]};
    Extent by_t{g[k][0][1] - g[k][0][0], g[k][0][1] - g[k][0][0]};
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < 3; ++j) {
        include(by_s, g[k][j + 1][i] - g[k][j][i]);
        include(by_t, g[k][i][j + 1] - g[k][i][j]);
      }
    const V4 centre_s = k == 0 ? one : all(0.0), centre_t = one - centre_s;
    const V4 e_s = most(magnitude(3.0 * by_s.low - centre_s), magnitude(3.0 * by_s.high - centre_s));
    const V4 e_t = most(magnitude(3.0 * by_t.low - centre_t), magnitude(3.0 * by_t.high - centre_t));
    e2 += e_s * e_s + e_t * e_t;
  }
  const V4 border = all(nurbs_limits::kRounding);
  const Extent s = extent(g[0]), t = extent(g[1]);
  V4 rows[4][4] = {{a[0], a[1], a[2], a[3]},
                   {s.low - border, s.high + border, t.low - border, t.high + border},
                   {a[0] * c[0][2][0] + a[1] * c[1][2][0], a[0] * c[0][1][1] + a[1] * c[1][1][1],
                    a[0] * c[0][0][2] + a[1] * c[1][0][2], all(0.0)},
                   {a[2] * c[0][2][0] + a[3] * c[1][2][0], a[2] * c[0][1][1] + a[3] * c[1][1][1],
                    a[2] * c[0][0][2] + a[3] * c[1][0][2], all(0.0)}};
  for (auto& row : rows) transpose(row);
  to_powers(b[2]);
  for (int lane = 0; lane < 4; ++lane) {
    PatchPowers& o = out[lane];
    o.middle[0] = c[0][0][0][lane], o.middle[1] = c[1][0][0][lane];
    store(o.a, rows[0][lane]);
    store(o.reach, rows[1][lane]);
    o.rational = false;
  }
  for (int lane = 0; lane < 4; ++lane) {
    PatchPowers& o = out[lane];
    for (int k = 0; k < 3; ++k) o.bend[k] = rows[2][lane][k], o.bend[3 + k] = rows[3][lane][k];
  }
  for (int i = 0; i < 4; ++i) {
    transpose(c[0][i]);
    transpose(c[1][i]);
    transpose(b[2][i]);
    for (int lane = 0; lane < 4; ++lane) {
      store(out[lane].x + 4 * i, c[0][i][lane]);
      store(out[lane].y + 4 * i, c[1][i][lane]);
      store(out[lane].z + 4 * i, b[2][i][lane]);
    }
  }
  // comparisons drop what is not a number
  const V4 size = magnitude(a[0]) + magnitude(a[1]) + magnitude(a[2]) + magnitude(a[3]);
  return bits((size < kUpright) & (e2 < nurbs_limits::kContraction * nurbs_limits::kContraction));
}

struct Row {
  V4 value, slope;
};
// A cubic and its slope.
TREADMARK_LANES Row cubic(V4 c0, V4 c1, V4 c2, V4 c3, V4 t) {
  const V4 p2 = c3 * t + c2, p1 = p2 * t + c1, q1 = c3 * t + p2;
  return {p1 * t + c0, q1 * t + p1};
}
struct Jet {
  V4 value, by_s, by_t;
};
TREADMARK_LANES Jet jet(const double (&c)[16], V4 s, V4 t) {
  Row r[4];
  for (int i = 0; i < 4; ++i) r[i] = cubic(all(c[4 * i]), all(c[4 * i + 1]), all(c[4 * i + 2]), all(c[4 * i + 3]), t);
  const Row along = cubic(r[0].value, r[1].value, r[2].value, r[3].value, s);
  return {along.value, along.slope, r[0].slope + s * (r[1].slope + s * (r[2].slope + s * r[3].slope))};
}
TREADMARK_LANES V4 value(const double (&c)[16], V4 s, V4 t) {
  V4 r[4];
  for (int i = 0; i < 4; ++i) r[i] = c[4 * i] + t * (c[4 * i + 1] + t * (c[4 * i + 2] + t * c[4 * i + 3]));
  return r[0] + s * (r[1] + s * (r[2] + s * r[3]));
}
TREADMARK_LANES V4 clamped(V4 x) { return least(most(x, all(-nurbs_limits::kFurthest)), all(nurbs_limits::kFurthest)); }

struct PatchHits {
  V4 z, dzdx, dzdy;
  M4 hit, unsettled;
};

// See NurbsLeaf::solve. Without slopes the height comes from where the last step leads.
template <bool rational, bool slopes>
TREADMARK_LANES PatchHits solve(const PatchPowers& p, V4 x, V4 y, double limit) {
  constexpr int kSteps = 6;
  const V4 dx = x - p.middle[0], dy = y - p.middle[1];
  const V4 s0 = p.a[0] * dx + p.a[1] * dy, t0 = p.a[2] * dx + p.a[3] * dy;
  const M4 may_meet = (s0 >= p.reach[0]) & (s0 <= p.reach[1]) & (t0 >= p.reach[2]) & (t0 <= p.reach[3]);
  PatchHits h{all(0.0), all(0.0), all(0.0), M4{}, M4{}};
  const int wanted = bits(may_meet);
  if (wanted == 0) return h;
  const V4 ss = s0 * s0, st = s0 * t0, tt = t0 * t0;
  V4 s = clamped(s0 - (p.bend[0] * ss + p.bend[1] * st + p.bend[2] * tt));
  V4 t = clamped(t0 - (p.bend[3] * ss + p.bend[4] * st + p.bend[5] * tt));
  {
    // a cheap step by the slopes of the middle
    V4 miss_x = value(p.x, s, t), miss_y = value(p.y, s, t);
    if constexpr (rational) {
      const V4 w = 1.0 / value(p.w, s, t);
      miss_x *= w, miss_y *= w;
    }
    miss_x = x - miss_x, miss_y = y - miss_y;
    s = clamped(s + p.a[0] * miss_x + p.a[1] * miss_y);
    t = clamped(t + p.a[2] * miss_x + p.a[3] * miss_y);
  }
  M4 settled{};
  V4 end_s = s, end_t = t;
  for (int step = 0; step < kSteps; ++step) {
    Jet jx = jet(p.x, s, t), jy = jet(p.y, s, t), jz{};
    if constexpr (slopes) jz = jet(p.z, s, t);
    if constexpr (rational) {
      const Jet jw = jet(p.w, s, t);
      const V4 w = 1.0 / jw.value;
      Jet* const coordinates[] = {&jx, &jy, &jz};
      for (Jet* j : coordinates) {
        j->value *= w;
        j->by_s = (j->by_s - j->value * jw.by_s) * w;
        j->by_t = (j->by_t - j->value * jw.by_t) * w;
      }
    }
    const V4 inverse = 1.0 / (jx.by_s * jy.by_t - jx.by_t * jy.by_s), miss_x = x - jx.value, miss_y = y - jy.value;
    if constexpr (slopes) {
      h.dzdx = (jz.by_s * jy.by_t - jz.by_t * jy.by_s) * inverse;
      h.dzdy = (jz.by_t * jx.by_s - jz.by_s * jx.by_t) * inverse;
      h.z = jz.value + h.dzdx * miss_x + h.dzdy * miss_y;
    }
    end_s = s + (jy.by_t * miss_x - jx.by_t * miss_y) * inverse;
    end_t = t + (jx.by_s * miss_y - jy.by_s * miss_x) * inverse;
    const V4 residual = most(magnitude(miss_x), magnitude(miss_y));
    settled = slopes ? residual * (1.0 + h.dzdx * h.dzdx + h.dzdy * h.dzdy) <= limit : residual <= limit;
    if ((bits(settled) & wanted) == wanted) break;
    s = clamped(end_s), t = clamped(end_t);
  }
  if constexpr (!slopes) h.z = value(p.z, end_s, end_t);
  h.unsettled = may_meet & ~settled;
  h.hit =
      may_meet & settled & (magnitude(end_s) <= nurbs_limits::kBorder) & (magnitude(end_t) <= nurbs_limits::kBorder);
  return h;
}

constexpr int kPointRoom = 64;

// Points of a tile waiting for one patch, with room for three more than counted.
struct Waiting {
  double x[kPointRoom + 4], y[kPointRoom + 4];
  long at[kPointRoom + 4];
  int count = 0;
};

TREADMARK_LANES void put(double* field, const long* at, M4 where, V4 x) {
  const V4 before = {field[at[0]], field[at[1]], field[at[2]], field[at[3]]}, after = where ? x : before;
  for (int lane = 0; lane < 4; ++lane) field[at[lane]] = after[lane];
}

/// Residual at which the last step leaves next to nothing. Slopes of a regular patch differ from that in its middle by
/// less than a factor of some.
template <bool slopes>
double residual_limit(const PatchPowers& p, bool exact) {
  if constexpr (slopes) return exact ? nurbs_limits::kExact : nurbs_limits::kNear;
  const double dzdx = p.z[4] * p.a[0] + p.z[1] * p.a[2], dzdy = p.z[4] * p.a[1] + p.z[1] * p.a[3];
  return nurbs_limits::kNear / (1.0 + 4.0 * (dzdx * dzdx + dzdy * dzdy));
}

template <bool rational, bool slopes>
bool hit_points(const ViewArrays& view, const PatchPowers& patch, const TileArrays& tile, Waiting& points,
                double limit) {
  if (points.count == 0) return true;
  // whole groups, the last point again and again
  for (int k = points.count, last = k - 1; k % 4 != 0; ++k)
    points.x[k] = points.x[last], points.y[k] = points.y[last], points.at[k] = points.at[last];
  M4 unsettled{};
  for (int k = 0; k < points.count; k += 4) {
    const V4 x = load(points.x + k), y = load(points.y + k);
    const PatchHits h = solve<rational, slopes>(patch, x, y, limit);
    M4 good = h.hit;
    if (view.half) good &= h.z >= view.lowest[0] + (view.lowest[1] * x + view.lowest[2] * y);
    unsettled |= h.unsettled;
    const long* at = points.at + k;
    const V4 before = {tile.z[at[0]], tile.z[at[1]], tile.z[at[2]], tile.z[at[3]]};
    good &= ~(view.side * h.z <= view.side * before);  // where there was none, too
    put(tile.z, at, good, h.z);
    if (!slopes || tile.dzdx == nullptr) continue;
    put(tile.dzdx, at, good, h.dzdx);
    put(tile.dzdy, at, good, h.dzdy);
  }
  return bits(unsettled) == 0;
}

// Indices of the points from low to high, which may be wider by kSlack; none where last < first.
TREADMARK_LANES void indices(double low, double high, double first_point, double step, int count, int& first,
                             int& last) {
  using nurbs_limits::kSlack;
  const double from = (low - kSlack - first_point) / step, to = (high + kSlack - first_point) / step;
  first = from < 0.0 ? 0 : from < count ? static_cast<int>(from) + 1 : count;
  last = to < 0.0 ? -1 : to < count ? static_cast<int>(to) : count - 1;
}

/// The part of a row at dy from the middle where the linear guess may meet the patch.
struct RowPart {
  double low, high;
  void meet(double slope, double from, double to) {
    if ((slope < 0.0 ? -slope : slope) < 1e-6) return;  // [1/m] it hardly changes along the row
    const double a = from / slope, b = to / slope, least = a < b ? a : b, greatest = a < b ? b : a;
    low = least > low ? least : low;
    high = greatest < high ? greatest : high;
  }
};
RowPart row_part(const PatchPowers& patch, double dy) {
  RowPart part{patch.range[0] - patch.middle[0], patch.range[1] - patch.middle[0]};
  part.meet(patch.a[0], patch.reach[0] - patch.a[1] * dy, patch.reach[1] - patch.a[1] * dy);
  part.meet(patch.a[2], patch.reach[2] - patch.a[3] * dy, patch.reach[3] - patch.a[3] * dy);
  return part;
}

template <bool rational, bool slopes>
bool hit_patch(const ViewArrays& view, const PatchPowers& patch, const TileArrays& tile) {
  int i0, i1, j0, j1;
  indices(patch.range[0], patch.range[1], tile.x0 + tile.ix0 * tile.dx, tile.dx, tile.nx, i0, i1);
  indices(patch.range[2], patch.range[3], tile.y0 + tile.iy0 * tile.dy, tile.dy, tile.ny, j0, j1);
  if (i1 < i0) return true;
  bool settled = true;
  const double limit = residual_limit<slopes>(patch, tile.dzdx != nullptr);
  Waiting points;
  constexpr int kWide = 8;  // rows of fewer points are not worth looking at one by one
  const bool wide = i1 - i0 >= kWide;
  for (int j = j0; j <= j1; ++j) {
    const V4 y = all(tile.y0 + (tile.iy0 + j) * tile.dy);
    if (wide) {
      // a long patch that lies askew meets a part of each row only
      const RowPart part = row_part(patch, y[0] - patch.middle[1]);
      indices(patch.middle[0] + part.low, patch.middle[0] + part.high, tile.x0 + tile.ix0 * tile.dx, tile.dx, tile.nx,
              i0, i1);
    }
    int i = i0;
    if (wide && !slopes && !rational)
      for (; i + 3 <= i1; i += 4) {
        const int k = tile.ix0 + i;
        double* const z = tile.z + i + j * tile.stride;
        const V4 x = tile.x0 + V4{double(k), double(k + 1), double(k + 2), double(k + 3)} * tile.dx, before = load(z);
        const PatchHits h = solve<false, false>(patch, x, y, limit);
        M4 good = h.hit & ~(view.side * h.z <= view.side * before);
        if (view.half) good &= h.z >= view.lowest[0] + (view.lowest[1] * x + view.lowest[2] * y);
        store(z, good ? h.z : before);
        settled &= bits(h.unsettled) == 0;
      }
    for (; i <= i1; i += 4) {
      const int k = tile.ix0 + i;
      const long at = i + j * tile.stride;
      store(points.x + points.count, tile.x0 + V4{double(k), double(k + 1), double(k + 2), double(k + 3)} * tile.dx);
      store(points.y + points.count, y);
      for (int lane = 0; lane < 4; ++lane) points.at[points.count + lane] = at + lane;
      points.count += i1 - i < 3 ? i1 - i + 1 : 4;
      if (points.count <= kPointRoom - 4) continue;
      settled &= hit_points<rational, slopes>(view, patch, tile, points, limit);
      points.count = 0;
    }
  }
  return hit_points<rational, slopes>(view, patch, tile, points, limit) && settled;
}

bool hit_polynomial(const ViewArrays& view, const PatchPowers& patch, const TileArrays& tile) {
  return tile.dzdx != nullptr ? hit_patch<false, true>(view, patch, tile) : hit_patch<false, false>(view, patch, tile);
}

bool hit(const ViewArrays& view, const PatchPowers& patch, const TileArrays& tile) {
  return patch.rational ? hit_patch<true, true>(view, patch, tile) : hit_polynomial(view, patch, tile);
}

void hit_corners(const ViewArrays& view, const PatchCorners* patches, int count, const TileArrays& tile, char* left) {
  PatchPowers powers[4];
  for (int k = 0; k < count; k += 4) {
    const auto lane_of = [&](int lane) { return k + lane < count ? patches + k + lane : patches + k; };
    const PatchCorners* const four[4] = {lane_of(0), lane_of(1), lane_of(2), lane_of(3)};
    V4 b[3][4][4];
    control_points(view, four, b);
    const Extent x = extent(b[0]), y = extent(b[1]);
    M4 away{};
    if (view.half) {
      const V4 least_x = least(view.lowest[1] * x.low, view.lowest[1] * x.high);
      const V4 least_y = least(view.lowest[2] * y.low, view.lowest[2] * y.high);
      away = extent(b[2]).high < view.lowest[0] + least_x + least_y - 1e-9;
    }
    V4 ranges[4] = {x.low, x.high, y.low, y.high};
    transpose(ranges);
    const int regular = prepare(b, powers), hidden = bits(away);
    for (int lane = 0; lane < 4 && k + lane < count; ++lane) {
      left[k + lane] = 0;
      if ((hidden >> lane) & 1) continue;
      store(powers[lane].range, ranges[lane]);
      left[k + lane] = !((regular >> lane) & 1) || !hit_polynomial(view, powers[lane], tile);
    }
  }
}

}  // namespace nurbs_lanes

}  // namespace

TREADMARK_KERNEL(NurbsKernel, nurbs_lanes::hit_corners, nurbs_lanes::hit);

}  // namespace treadmark::spline
