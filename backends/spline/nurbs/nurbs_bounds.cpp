// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/nurbs_bounds.hpp"

#include <cmath>

#include "treadmark/backends/spline/nurbs/nurbs_view.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::spline {
namespace {

constexpr double kSingle = 2.5e-7;  // more than the roundings to single precision add up to, relative
constexpr float kNoSlab = -1e30f;

/// Cells in one direction: several patches in one, or one of several in a patch.
struct Cell {
  int first, last;  // patches [first, last)
  double from, to;  // part of the patch, if it is one
};
std::vector<Cell> cells_of(const std::vector<double>& lengths, double smallest, double largest) {
  std::vector<Cell> cells;
  const int n = static_cast<int>(lengths.size());
  for (int i = 0; i < n;) {
    double length = lengths[static_cast<std::size_t>(i)];
    const int parts = to_whole<int>(std::ceil(length / largest - 1e-9));
    if (parts > 1) {
      for (int k = 0; k < parts; ++k)
        cells.push_back({i, i + 1, static_cast<double>(k) / parts, static_cast<double>(k + 1) / parts});
      ++i;
      continue;
    }
    int last = i + 1;
    while (last < n && length + lengths[static_cast<std::size_t>(last)] <= smallest)
      length += lengths[static_cast<std::size_t>(last++)];
    cells.push_back({i, last, 0.0, 1.0});
    i = last;
  }
  return cells;
}

}  // namespace

NurbsHull::Slab NurbsHull::slab_of(const std::vector<Vec3>& points) {
  // the first and last points of 4 x 4 are corners; so are those of the first and last patch
  const Vec3 low_low = points[0], low_high = points[3], high_low = points[points.size() - 4],
             high_high = points[points.size() - 1];
  const Vec3 normal = ((high_high - low_low).cross(low_high - high_low)).normalized();
  Vec3 min = points[0], max = min;
  for (const Vec3& p : points) min = min.cwiseMin(p), max = max.cwiseMax(p);
  const Vec3 centre = 0.5 * (min + max);
  Slab slab;
  slab.normal = normal.allFinite() ? Eigen::Vector3f(normal.cast<float>()) : Eigen::Vector3f(0.0f, 0.0f, 1.0f);
  slab.centre = centre.cast<float>();
  Interval range = Interval::none();
  Vec3 half = Vec3::Zero();
  for (const Vec3& p : points) {
    const Vec3 from = p - slab.centre.cast<double>();
    const double at = slab.normal.cast<double>().dot(from);
    range.include({at, at});
    half = half.cwiseMax(from.cwiseAbs());
  }
  const double middle = 0.5 * (range.low + range.high);
  slab.offset = static_cast<float>(middle);
  slab.thickness = static_cast<float>((0.5 * range.width() + std::abs(middle) * kSingle) * (1.0 + kSingle) + 1e-12);
  slab.half = (half * (1.0 + kSingle) + Vec3::Constant(1e-12)).cast<float>();
  return slab;
}

NurbsHull::Slab NurbsHull::slab_around(const std::vector<Slab>& parts) {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity()), max = -min, normal = Vec3::Zero();
  const Vec3 first = parts[0].normal.cast<double>();
  for (const Slab& s : parts) {
    const Vec3 centre = s.centre.cast<double>(), half = s.half.cast<double>(), n = s.normal.cast<double>();
    min = min.cwiseMin(centre - half);
    max = max.cwiseMax(centre + half);
    normal += n.dot(first) < 0.0 ? Vec3(-n) : n;
  }
  Slab slab;
  slab.normal = normal.normalized().cast<float>();
  if (!slab.normal.allFinite()) slab.normal = {0.0f, 0.0f, 1.0f};
  slab.centre = (0.5 * (min + max)).cast<float>();
  const Vec3 centre = slab.centre.cast<double>(), n = slab.normal.cast<double>();
  Interval range = Interval::none();
  Vec3 reach = Vec3::Zero();
  for (const Slab& s : parts) {
    // along the normal of the part, and what remains within its box
    const Vec3 from = s.centre.cast<double>() - centre, part = s.normal.cast<double>(), half = s.half.cast<double>();
    const double along = n.dot(part) / part.squaredNorm();
    const double rest = (n - along * part).cwiseAbs().dot(half);
    const double middle = n.dot(from) + along * static_cast<double>(s.offset);
    const double around = std::abs(along) * static_cast<double>(s.thickness) + rest;
    range.include({middle - around, middle + around});
    reach = reach.cwiseMax(from.cwiseAbs() + half);
  }
  const double middle = 0.5 * (range.low + range.high);
  slab.offset = static_cast<float>(middle);
  slab.thickness = static_cast<float>((0.5 * range.width() + std::abs(middle) * kSingle) * (1.0 + kSingle) + 1e-12);
  slab.half = (reach * (1.0 + kSingle) + Vec3::Constant(1e-12)).cast<float>();
  return slab;
}

NurbsHull::Level NurbsHull::level_of(const std::vector<Slab>& slabs, int nu, int nv) const {
  Level level{(nu + fan_u_ - 1) / fan_u_, (nv + fan_v_ - 1) / fan_v_, {}};
  level.blocks.resize(static_cast<std::size_t>(level.blocks_u) * static_cast<std::size_t>(level.blocks_v));
  for (Block& b : level.blocks) {
    for (auto* list : {&b.c_x, &b.c_y, &b.c_z}) list->fill(0.0f);
    for (auto* list : {&b.h_x, &b.h_y, &b.h_z}) list->fill(kNoSlab);
  }
  for (int iu = 0; iu < nu; ++iu)
    for (int iv = 0; iv < nv; ++iv) {
      Block& b = level.blocks[static_cast<std::size_t>(iu / fan_u_) * static_cast<std::size_t>(level.blocks_v) +
                              static_cast<std::size_t>(iv / fan_v_)];
      const auto k = static_cast<std::size_t>(iu % fan_u_ * fan_v_ + iv % fan_v_);
      const Slab& s = slabs[static_cast<std::size_t>(iu) * static_cast<std::size_t>(nv) + static_cast<std::size_t>(iv)];
      b.slabs[k] = s;
      b.c_x[k] = s.centre.x(), b.c_y[k] = s.centre.y(), b.c_z[k] = s.centre.z();
      b.h_x[k] = s.half.x(), b.h_y[k] = s.half.y(), b.h_z[k] = s.half.z();
    }
  return level;
}

NurbsHull::NurbsHull(const NurbsNet& net) : fan_u_(net.fan_out_u()), fan_v_(net.fan_out_v()) {
  constexpr double kSmallest = 1e-3, kLargestU = 8e-3, kLargestV = 2e-3;  // [m]
  const auto length = [](const Vec3& a, const Vec3& b) { return (b - a).norm(); };
  int nu = 0, nv = 1;
  std::vector<Slab> slabs;
  std::vector<Vec3> points;
  const auto add = [&](const Cell& cu, const Cell& cv) {
    points.clear();
    for (int iu = cu.first; iu < cu.last; ++iu)
      for (int iv = cv.first; iv < cv.last; ++iv) {
        BezierPatch patch = net.patch(iu, iv);
        if (cu.to - cu.from < 1.0 || cv.to - cv.from < 1.0) patch = patch.part(cu.from, cu.to, cv.from, cv.to);
        for (int i = 0; i < 4; ++i)
          for (int j = 0; j < 4; ++j) points.push_back(patch.point(i, j));
      }
    slabs.push_back(slab_of(points));
  };
  if (net.is_list()) {
    for (int i = 0; i < net.patches_u(); ++i, check_cancelled()) {
      const BezierPatch p = net.patch(i, 0);
      const auto along = [&](int k) { return length(p.point(0, k), p.point(3, k)); };
      const auto across = [&](int k) { return length(p.point(k, 0), p.point(k, 3)); };
      const auto cells_u = cells_of({std::max(along(0), along(3))}, kSmallest, kLargestU),
                 cells_v = cells_of({std::max(across(0), across(3))}, kSmallest, kLargestV);
      for (const Cell& cu : cells_u)
        for (const Cell& cv : cells_v) add({i, i + 1, cu.from, cu.to}, cv);
    }
    nu = static_cast<int>(slabs.size());
  } else {
    // Lengths of patches along the middle of the other direction; turned directions are cut where they bend most.
    const int mid_u = net.patches_u() / 2, mid_v = net.patches_v() / 2;
    std::vector<double> along_u, along_v;
    for (int i = 0; i < net.patches_u(); ++i) {
      const BezierPatch p = net.patch(i, mid_v);
      along_u.push_back(length(p.point(0, 0), p.point(3, 0)));
    }
    for (int j = 0; j < net.patches_v(); ++j) {
      const BezierPatch p = net.patch(mid_u, j);
      along_v.push_back(length(p.point(0, 0), p.point(0, 3)));
    }
    const std::vector<Cell> cells_u = cells_of(along_u, kSmallest, kLargestU),
                            cells_v = cells_of(along_v, kSmallest, kLargestV);
    nu = static_cast<int>(cells_u.size()), nv = static_cast<int>(cells_v.size());
    for (const Cell& cu : cells_u) {
      check_cancelled();
      for (const Cell& cv : cells_v) add(cu, cv);
    }
  }
  for (;;) {
    levels_.push_back(level_of(slabs, nu, nv));
    const Level& level = levels_.back();
    if (level.blocks.size() <= 1) break;
    std::vector<Slab> above, parts;
    for (const Block& b : level.blocks) {
      parts.clear();
      for (std::size_t k = 0; k < kChildren; ++k)
        if (b.h_x[k] >= 0.0f) parts.push_back(b.slabs[k]);
      above.push_back(slab_around(parts));
    }
    slabs = std::move(above);
    nu = level.blocks_u, nv = level.blocks_v;
  }
  const Box3 box = net.bounds();
  extent_ = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).norm();
}

std::size_t NurbsHull::memory_bytes() const {
  std::size_t sum = 0;
  for (const Level& level : levels_) sum += level.blocks.capacity() * sizeof(Block);
  return sum;
}

struct NurbsHull::Search {
  Pose X;
  Vec3 shift;  ///< p_P = turn p_S - shift
  Interval x, y;
  double slack, fine;
  float turn_x[3], turn_y[3], spread_x[3], spread_y[3], outwards[3], away[3];
  float shift_x, shift_y, x_low, x_high, y_low, y_high, least_outwards;
  Interval z = Interval::none();
};

Interval NurbsHull::heights_over(const Pose& X, const Rectangle& r, Facing facing) const {
  const FacingHalf half(X, facing);
  if (half.none) return Interval::none();
  Search s;
  s.X = X;
  s.shift = X.rotation.transpose() * X.origin;
  s.slack = kSingle * 4.0 * (extent_ + s.shift.cwiseAbs().maxCoeff()) + 1e-9;
  s.x = {r.x_min - s.slack, r.x_max + s.slack};
  s.y = {r.y_min - s.slack, r.y_max + s.slack};
  s.fine = 1e-5 + 0.03 * (r.x_max - r.x_min + r.y_max - r.y_min);
  for (int k = 0; k < 3; ++k) {
    s.turn_x[k] = static_cast<float>(X.rotation(k, 0));
    s.turn_y[k] = static_cast<float>(X.rotation(k, 1));
    s.spread_x[k] = std::abs(s.turn_x[k]), s.spread_y[k] = std::abs(s.turn_y[k]);
    s.outwards[k] = static_cast<float>(half.outwards[k]);
    s.away[k] = std::abs(s.outwards[k]);
  }
  s.shift_x = static_cast<float>(s.shift.x()), s.shift_y = static_cast<float>(s.shift.y());
  s.x_low = static_cast<float>(s.x.low - s.slack), s.x_high = static_cast<float>(s.x.high + s.slack);
  s.y_low = static_cast<float>(s.y.low - s.slack), s.y_high = static_cast<float>(s.y.high + s.slack);
  s.least_outwards = half.all ? kNoSlab : static_cast<float>(-2.0 * s.slack);
  descend(levels_.size() - 1, 0, 0, s);
  return s.z.empty() ? s.z : Interval{s.z.low - s.slack, s.z.high + s.slack};
}

void NurbsHull::descend(std::size_t at, int block_u, int block_v, Search& s) const {
  const Level& level = levels_[at];
  const Block& b = level.blocks[static_cast<std::size_t>(block_u) * static_cast<std::size_t>(level.blocks_v) +
                                static_cast<std::size_t>(block_v)];
  int over[kChildren];
  for (std::size_t k = 0; k < kChildren; ++k) {  // one loop without branches
    const float x = s.turn_x[0] * b.c_x[k] + s.turn_x[1] * b.c_y[k] + s.turn_x[2] * b.c_z[k] - s.shift_x;
    const float y = s.turn_y[0] * b.c_x[k] + s.turn_y[1] * b.c_y[k] + s.turn_y[2] * b.c_z[k] - s.shift_y;
    const float h_x = s.spread_x[0] * b.h_x[k] + s.spread_x[1] * b.h_y[k] + s.spread_x[2] * b.h_z[k];
    const float h_y = s.spread_y[0] * b.h_x[k] + s.spread_y[1] * b.h_y[k] + s.spread_y[2] * b.h_z[k];
    const float out = s.outwards[0] * b.c_x[k] + s.outwards[2] * b.c_z[k] + s.away[0] * b.h_x[k] + s.away[2] * b.h_z[k];
    over[k] = (x - h_x <= s.x_high) & (x + h_x >= s.x_low) & (y - h_y <= s.y_high) & (y + h_y >= s.y_low) &
              (out >= s.least_outwards);
  }
  for (std::size_t k = 0; k < kChildren; ++k) {
    if (!over[k]) continue;
    const Slab& slab = b.slabs[k];
    const Vec3 normal = s.X.rotation.transpose() * slab.normal.cast<double>();
    const Vec3 c = s.X.rotation.transpose() * slab.centre.cast<double>() - s.shift;
    const Vec3 h = s.X.rotation.transpose().cwiseAbs() * slab.half.cast<double>();
    Interval z{c.z() - h.z(), c.z() + h.z()};
    double thickness = h.z();
    const Interval x{std::max(s.x.low, c.x() - h.x()), std::min(s.x.high, c.x() + h.x())};
    const Interval y{std::max(s.y.low, c.y() - h.y()), std::min(s.y.high, c.y() + h.y())};
    constexpr double kEdgeOn = 1e-3;
    if (std::abs(normal.z()) > kEdgeOn) {
      // the slab over that part of the box which is over the rectangle
      const double per = 1.0 / normal.z(), by_x = -normal.x() * per, by_y = -normal.y() * per;
      thickness = std::abs(per) * (static_cast<double>(slab.thickness) + 1e-9);
      const double middle = c.z() + per * static_cast<double>(slab.offset) + by_x * (0.5 * (x.low + x.high) - c.x()) +
                            by_y * (0.5 * (y.low + y.high) - c.y());
      const double around =
          0.5 * (std::abs(by_x) * std::abs(x.width()) + std::abs(by_y) * std::abs(y.width())) + thickness;
      z = {std::max(z.low, middle - around), std::min(z.high, middle + around)};
      if (z.empty()) z = {c.z() - h.z(), c.z() + h.z()};
    }
    if (z.low >= s.z.low && z.high <= s.z.high) continue;
    // back in the surface frame the part may turn out to lie beside the box
    const Vec3 part = s.X.rotation * (Vec3(x.low + x.high, y.low + y.high, z.low + z.high) * 0.5 + s.shift);
    const Vec3 reach = s.X.rotation.cwiseAbs() * (Vec3(std::abs(x.width()), std::abs(y.width()), z.width()) * 0.5);
    if (((part - slab.centre.cast<double>()).cwiseAbs() - reach - slab.half.cast<double>()).maxCoeff() > s.slack)
      continue;
    if (at > 0 && thickness > s.fine)
      descend(at - 1, fan_u_ * block_u + static_cast<int>(k) / fan_v_, fan_v_ * block_v + static_cast<int>(k) % fan_v_,
              s);
    else
      s.z.include(z);
  }
}

}  // namespace treadmark::spline
