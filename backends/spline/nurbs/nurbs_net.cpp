// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/spline/nurbs/nurbs_net.hpp"

#include <limits>

#include "treadmark/backends/spline/banded.hpp"
#include "treadmark/core/cancellation.hpp"

namespace treadmark::spline {
namespace {

struct Corners {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity()), max = -min;
  void include(const Vec3& p) {
    min = min.cwiseMin(p);
    max = max.cwiseMax(p);
  }
};

// The 16 control points from the corners; position and direction take them to another frame.
template <class Position, class Direction>
BezierPatch from_corners(const PatchCorners& patch, const Position& position, const Direction& direction) {
  BezierPatch out;
  out.rational = false;
  for (int i = 0; i < 2; ++i)
    for (int j = 0; j < 2; ++j) {
      const auto three = [&](int first) { return Eigen::Map<const Vec3>(patch.corner[i][j] + first); };
      const double su = (i ? -1.0 : 1.0) * patch.size_u / 3.0, sv = (j ? -1.0 : 1.0) * patch.size_v / 3.0;
      const Vec3 p = position(three(0)), du = direction(three(3)) * su, dv = direction(three(6)) * sv,
                 duv = direction(three(9)) * (su * sv);
      const int a = 3 * i, b = 3 * j, a1 = i ? 2 : 1, b1 = j ? 2 : 1;
      const auto set = [&](int m, int n, const Vec3& q) { out.b[m][n] = {q.x(), q.y(), q.z(), 1.0}; };
      set(a, b, p);
      set(a1, b, p + du);
      set(a, b1, p + dv);
      set(a1, b1, p + du + dv + duv);
    }
  return out;
}

}  // namespace

NurbsNet::NurbsNet(std::vector<double> u_breaks, std::vector<double> v_breaks, std::vector<Quad> points)
    : u_(std::move(u_breaks)), v_(std::move(v_breaks)), points_(std::move(points)) {
  build_boxes();
}

NurbsNet::NurbsNet(std::vector<double> u_breaks, std::vector<double> v_breaks, std::vector<Corner> corners)
    : u_(std::move(u_breaks)), v_(std::move(v_breaks)), corners_(std::move(corners)) {
  build_boxes();
}

NurbsNet::NurbsNet(std::vector<Cell> cells, std::vector<Corner> corners)
    : cells_(std::move(cells)), corners_(std::move(corners)) {
  build_boxes();
}

void NurbsNet::build_boxes() {
  const auto box = [](const Corners& c) {
    constexpr double kUp = 3e-7;  // more than the rounding to single precision of both
    const Vec3 middle = 0.5 * (c.min + c.max), half = 0.5 * (c.max - c.min);
    return Box{middle.cast<float>(),
               (half * (1.0 + kUp) + middle.cwiseAbs() * kUp + Vec3::Constant(1e-30)).cast<float>()};
  };
  Corners all;
  Level first{patches_u(), patches_v(), {}};
  first.boxes.reserve(static_cast<std::size_t>(first.nu) * static_cast<std::size_t>(first.nv));
  for (int iu = 0; iu < first.nu; ++iu, check_cancelled())
    for (int iv = 0; iv < first.nv; ++iv) {
      const BezierPatch p = patch(iu, iv);
      Corners corners;
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < 4; ++j) corners.include(p.point(i, j));
      all.include(corners.min);
      all.include(corners.max);
      first.boxes.push_back(box(corners));
    }
  bounds_ = {all.min, all.max};
  levels_.push_back(std::move(first));
  while (levels_.back().boxes.size() > 1) {
    const Level& below = levels_.back();
    const int fan_u = fan_out_u(), fan_v = fan_out_v();
    Level above{(below.nu + fan_u - 1) / fan_u, (below.nv + fan_v - 1) / fan_v, {}};
    for (int iu = 0; iu < above.nu; ++iu)
      for (int iv = 0; iv < above.nv; ++iv) {
        Corners corners;
        for (int ku = fan_u * iu; ku < std::min(fan_u * (iu + 1), below.nu); ++ku)
          for (int kv = fan_v * iv; kv < std::min(fan_v * (iv + 1), below.nv); ++kv) {
            corners.include(below.at(ku, kv).centre() - below.at(ku, kv).half());
            corners.include(below.at(ku, kv).centre() + below.at(ku, kv).half());
          }
        above.boxes.push_back(box(corners));
      }
    levels_.push_back(std::move(above));
  }
}

std::size_t NurbsNet::memory_bytes() const {
  std::size_t bytes = points_.capacity() * sizeof(Quad) + corners_.capacity() * sizeof(Corner) +
                      (u_.capacity() + v_.capacity()) * sizeof(double) + cells_.capacity() * sizeof(Cell);
  for (const Level& level : levels_) bytes += level.boxes.capacity() * sizeof(Box);
  return bytes;
}

BezierPatch NurbsNet::patch(int iu, int iv) const { return patch(iu, iv, Pose{}); }

BezierPatch NurbsNet::patch(int iu, int iv, const Pose& X) const {
  const Mat3 turn = X.rotation.transpose();
  if (by_corners())
    return from_corners(
        corners(iu, iv), [&](const Vec3& p) { return Vec3(turn * (p - X.origin)); },
        [&](const Vec3& d) { return Vec3(turn * d); });
  BezierPatch out;
  const std::size_t stride = 3 * (v_.size() - 1) + 1;
  const Quad* corner = points_.data() + 3 * (static_cast<std::size_t>(iu) * stride + static_cast<std::size_t>(iv));
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      const Quad& q = corner[i * stride + j];
      const double w = q.w();
      const Vec3 p = turn * (Vec3(q.x(), q.y(), q.z()) - w * X.origin);
      out.b[i][j] = {p.x(), p.y(), p.z(), w};
    }
  return out;
}

PatchCorners NurbsNet::corners(int iu, int iv) const {
  static_assert(sizeof(Corner) == 12 * sizeof(double));
  const auto u = static_cast<std::size_t>(iu), v = static_cast<std::size_t>(iv);
  if (is_list()) {
    const Cell& c = cells_[u];
    const auto listed = [&](int i, int j) { return corners_[c.corner[i][j]].p.data(); };
    return {{{listed(0, 0), listed(0, 1)}, {listed(1, 0), listed(1, 1)}}, c.u1 - c.u0, c.v1 - c.v0};
  }
  const std::size_t row = v_.size(), next = (u + 1) * row < corners_.size() ? u + 1 : 0;
  const auto at = [&](std::size_t i, std::size_t j) { return corners_[i * row + j].p.data(); };
  return {{{at(u, v), at(u, v + 1)}, {at(next, v), at(next, v + 1)}}, u_[u + 1] - u_[u], v_[v + 1] - v_[v]};
}

NurbsNet::Range NurbsNet::range() const {
  if (!is_list()) return {u_.front(), u_.back(), v_.front(), v_.back()};
  Range all = range(0, 0);
  for (const Cell& c : cells_)
    all = {std::min(all.u0, c.u0), std::max(all.u1, c.u1), std::min(all.v0, c.v0), std::max(all.v1, c.v1)};
  return all;
}

Vec3 NurbsNet::number_place(std::size_t number) const {
  if (by_corners()) return corners_[number / 4].p;
  const Quad& q = points_[number];
  return Vec3(q.x(), q.y(), q.z()) / q.w();
}

NurbsNet NurbsNet::with_number(std::size_t number, const Vec3& by) const {
  if (!by_corners()) {
    std::vector<Quad> points = points_;
    const double w = points[number].w();
    points[number] = points[number] + w * Quad(by.x(), by.y(), by.z(), 0.0);
    return NurbsNet(u_, v_, std::move(points));
  }
  constexpr Vec3 Corner::*kMembers[] = {&Corner::p, &Corner::p_u, &Corner::p_v, &Corner::p_uv};
  std::vector<Corner> corners = corners_;
  corners[number / 4].*kMembers[number % 4] += by;
  return is_list() ? NurbsNet(cells_, std::move(corners)) : NurbsNet(u_, v_, std::move(corners));
}

NurbsNet::Place NurbsNet::find(double u, double v) const {
  int iu = 0, iv = 0;
  if (is_list()) {
    double nearest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < patches_u() && nearest > 0.0; ++i) {
      const Range r = range(i, 0);
      const double beside = std::max({r.u0 - u, u - r.u1, 0.0}) + std::max({r.v0 - v, v - r.v1, 0.0});
      if (beside < nearest) nearest = beside, iu = i;
    }
  } else {
    iu = find_span(u_, u, 0, patches_u() - 1);
    iv = find_span(v_, v, 0, patches_v() - 1);
  }
  const Range r = range(iu, iv);
  const auto local = [](double x, double low, double high) {
    return std::clamp((x - low) / (high - low), 0.0, 1.0) - 0.5;
  };
  return {iu, iv, local(u, r.u0, r.u1), local(v, r.v0, r.v1)};
}

}  // namespace treadmark::spline
