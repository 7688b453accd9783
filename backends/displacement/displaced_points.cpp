// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/displaced_points.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

#include "treadmark/backends/displacement/displaced_line.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::displacement {

namespace {

Rectangle around(const std::vector<PlanePoint>& points, std::size_t begin, std::size_t end) {
  Rectangle r{points[begin].x, points[begin].x, points[begin].y, points[begin].y};
  for (std::size_t i = begin + 1; i < end; ++i) {
    r.x_min = std::min(r.x_min, points[i].x), r.x_max = std::max(r.x_max, points[i].x);
    r.y_min = std::min(r.y_min, points[i].y), r.y_max = std::max(r.y_max, points[i].y);
  }
  return r;
}

/// What the base says about a range of points.
struct Seen {
  std::size_t present = 0;
  double inner = std::numeric_limits<double>::infinity(), outer = -inner;  ///< least and greatest side * z
  double steepest = 0.0;

  Seen(const std::vector<PlanePoint>& points, std::size_t begin, std::size_t end, double side) {
    for (std::size_t i = begin; i < end; ++i) {
      const PlanePoint& p = points[i];
      if (std::isnan(p.z)) continue;
      ++present;
      inner = std::min(inner, side * p.z), outer = std::max(outer, side * p.z);
      steepest = std::max(steepest, std::hypot(p.dzdx, p.dzdy));
    }
  }
};

Interval ordered(double a, double b) { return {std::min(a, b), std::max(a, b)}; }

constexpr std::size_t kLeaf = 256;  ///< points that are judged together
constexpr double kLeafSize = 3e-3;  ///< [m]

/// Points of the same square of kLeafSize next to each other, whatever the order of the list.
void order_by_squares(std::vector<PlanePoint>& points, const Rectangle& r) {
  constexpr double kMost = 1e9;
  if (!(std::max(r.x_max - r.x_min, r.y_max - r.y_min) <= kMost * kLeafSize)) return;
  std::vector<std::pair<std::uint64_t, std::size_t>> squares(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto ix = to_whole<std::uint64_t>((points[i].x - r.x_min) / kLeafSize);
    const auto iy = to_whole<std::uint64_t>((points[i].y - r.y_min) / kLeafSize);
    squares[i] = {(iy << 32) | ix, i};
  }
  if (std::is_sorted(squares.begin(), squares.end())) return;
  std::sort(squares.begin(), squares.end());
  std::vector<PlanePoint> ordered_points;
  ordered_points.reserve(points.size());
  for (const auto& one : squares) ordered_points.push_back(points[one.second]);
  points.swap(ordered_points);
}

}  // namespace

void DisplacedPoints::solve(std::vector<PlanePoint>& points) {
  leaves_.clear(), leaf_unknowns_.clear(), unknowns_.clear(), searched_.clear(), slopes_.clear();
  if (points.empty()) return;
  divide_list(points);
  iterate(points);
  for (std::size_t k = 0; k < leaves_.size(); ++k) {
    const Range all = leaf_unknowns_[k];
    const bool proven = outermost_everywhere(leaves_[k], all);
    for (std::size_t i = all.begin; i < all.end; ++i) {
      const Unknown& w = unknowns_[i];
      PlanePoint& p = points[w.point];
      const Leaf alone{{w.point, w.point + 1}, {p.x, p.x, p.y, p.y}, leaves_[k].outermost, 0.0};
      if (w.state == Unknown::State::solved && (proven || outermost_everywhere(alone, {i, i + 1}))) {
        p.z = w.t;
        p.dzdx = slopes_[i].x();
        p.dzdy = slopes_[i].y();
      } else {
        searched_.push_back(w.point);
      }
    }
  }
  for (const std::size_t i : searched_) search(points[i]);
}

/// Cuts the list into ranges that may be judged as a whole.
void DisplacedPoints::divide_list(std::vector<PlanePoint>& points) {
  const std::size_t n = points.size();
  Rectangle r = around(points, 0, n);
  const auto small = [](const Rectangle& one) {
    return std::max(one.x_max - one.x_min, one.y_max - one.y_min) <= kLeafSize;
  };
  if (!small(r)) {
    const HeightBounds near = view_.base.height_bounds(view_.X_SP, enlarged(r, max_offset_));
    if (near.empty ||
        view_.field.range(view_.natural_box(r, {near.z_min - max_offset_, near.z_max + max_offset_})).zero())
      return;
    order_by_squares(points, r);
  }
  std::size_t begin = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const PlanePoint& p = points[i];
    Rectangle grown{p.x, p.x, p.y, p.y};
    if (i > begin)
      grown = {std::min(r.x_min, p.x), std::max(r.x_max, p.x), std::min(r.y_min, p.y), std::max(r.y_max, p.y)};
    if (i > begin && (i - begin == kLeaf || !small(grown))) {
      divide(points, {begin, i}, max_offset_);
      begin = i;
      grown = {p.x, p.x, p.y, p.y};
    }
    r = grown;
  }
  divide(points, {begin, n}, max_offset_);
}

/// Leaves alone what no offset can reach, and divides the rest until it is small enough to be judged as a whole.
void DisplacedPoints::divide(std::vector<PlanePoint>& points, const Range& range, double max_offset) {
  constexpr double kSteep = 6.0;  // slope up to which one judgement serves many points
  const std::size_t n = range.end - range.begin;
  const double side = view_.side();
  const Rectangle r = around(points, range.begin, range.end);
  const HeightBounds near = view_.base.height_bounds(view_.X_SP, enlarged(r, max_offset));
  if (near.empty) return;
  const Seen seen(points, range.begin, range.end, side);
  const bool whole = seen.present == n;

  // Offsets from the hits of the base outwards; where a point missed the base, at all heights of the base near by.
  const double top = side > 0.0 ? near.z_max + max_offset : near.z_min - max_offset;
  const double bottom = whole ? side * seen.inner : side > 0.0 ? near.z_min - max_offset : near.z_max + max_offset;
  const Rectangle uy = view_.natural_box(r, ordered(bottom, top));
  const OffsetRange offsets = view_.offsets(uy);
  if (offsets.zero()) return;

  const double size = std::max(r.x_max - r.x_min, r.y_max - r.y_min);
  const auto halve = [&] {
    const std::size_t middle = range.begin + n / 2;
    divide(points, {range.begin, middle}, max_offset);
    divide(points, {middle, range.end}, max_offset);
  };
  if (n > 1 && seen.steepest > kSteep) return halve();

  const View::Directions e = view_.directions(uy);
  const Rectangle moved = View::moved_back(r, offsets, e);
  const Reach farthest = displacement::reach(r, moved);
  const double reach = std::max(farthest.x, farthest.y);
  if (seen.present == 0 && reach <= kNoReach) return;
  const Rectangle sources{std::min(r.x_min, moved.x_min), std::max(r.x_max, moved.x_max),
                          std::min(r.y_min, moved.y_min), std::max(r.y_max, moved.y_max)};
  // Another sheet of the base close by would show as heights far beyond those of the points.
  const double slack = (1.5 * seen.steepest + 0.3) * (2.0 * size + 4.0 * reach) + 1e-4;
  double outermost_base = side > 0.0 ? near.z_max : -near.z_min;
  if (!(seen.present > 0 && outermost_base - seen.outer <= slack)) {
    const HeightBounds source = view_.base.height_bounds(view_.X_SP, sources);
    if (source.empty) return;
    outermost_base = side > 0.0 ? source.z_max : -source.z_min;
  }
  if (seen.present > 0 && outermost_base - seen.outer > slack && reach > kNoReach) {
    if (n > 1) return halve();
    searched_.push_back(range.begin);
    return;
  }
  const Interval shift = View::along_normal(offsets, e);
  const double beyond = side > 0.0 ? std::max(0.0, shift.high) : std::max(0.0, -shift.low);
  const double rate = view_.rate(offsets, uy, view_.X_SP.apply({r.x_min, r.y_min, bottom}));
  collect(points, {range, r, side * (std::max(outermost_base, seen.outer) + beyond), rate});
  if (reach > kNoReach)
    for (std::size_t i = range.begin; i < range.end; ++i)
      if (std::isnan(points[i].z)) searched_.push_back(i);
}

void DisplacedPoints::collect(std::vector<PlanePoint>& points, const Leaf& leaf) {
  const std::size_t first = unknowns_.size();
  for (std::size_t i = leaf.range.begin; i < leaf.range.end; ++i) {
    const PlanePoint& p = points[i];
    if (std::isnan(p.z)) continue;
    unknowns_.push_back({i, p.z, p.x, p.y, p.z, p.dzdx, p.dzdy, 0.0, leaf.rate, 1.0, 0.0, Unknown::State::moving});
  }
  leaves_.push_back(leaf);
  leaf_unknowns_.push_back({first, unknowns_.size()});
}

void DisplacedPoints::iterate(const std::vector<PlanePoint>& points) {
  constexpr int kIterations = 16;
  slopes_.resize(unknowns_.size());
  active_.resize(unknowns_.size());
  for (std::size_t k = 0; k < active_.size(); ++k) active_[k] = k;
  const Pose& X = view_.X_SP;
  for (int iteration = 0; !active_.empty(); ++iteration) {
    const std::size_t n = active_.size();
    for (auto* buffer : {&u_, &y_, &d_, &d_u_, &d_y_}) buffer->resize(n);
    for (std::size_t k = 0; k < n; ++k) {
      const Unknown& w = unknowns_[active_[k]];
      const PlanePoint& p = points[w.point];
      const Vec3 q = X.apply({p.x, p.y, w.t});
      u_[k] = view_.body == Body::rail ? q.x() : std::atan2(q.x(), q.z());
      y_[k] = q.y();
    }
    view_.field.evaluate(u_, y_, d_, d_u_, d_y_);
    // The first step trusts the tangent plane of the base over the point itself; then the base is asked where it
    // counts.
    if (iteration > 0) {
      asking_.clear();
      moved_.clear();
      for (std::size_t k = 0; k < n; ++k) {
        Unknown& w = unknowns_[active_[k]];
        const PlanePoint& p = points[w.point];
        const NaturalPoint q(view_.body, X.apply({p.x, p.y, w.t}));
        const Vec2 at(p.x - d_[k] * X.rotation.col(0).dot(q.e), p.y - d_[k] * X.rotation.col(1).dot(q.e));
        // near by, the tangent plane is as good as the base itself
        constexpr double kSamePlace = 2e-10;  // [m]
        if (std::fabs(at.x() - w.cx) <= kSamePlace && std::fabs(at.y() - w.cy) <= kSamePlace) continue;
        w.cx = at.x(), w.cy = at.y();
        asking_.push_back(active_[k]);
        moved_.push_back(at);
      }
      ask_base();
    }
    for (std::size_t k = 0; k < n; ++k) {
      Unknown& w = unknowns_[active_[k]];
      advance(points[w.point], w, k, iteration);
      if (iteration == kIterations && w.state == Unknown::State::moving) w.state = Unknown::State::failed;
    }
    std::erase_if(active_, [&](std::size_t i) { return unknowns_[i].state != Unknown::State::moving; });
  }
}

void DisplacedPoints::ask_base() {
  const std::size_t n = moved_.size();
  if (n == 0) return;
  for (auto* buffer : {&h_, &hx_, &hy_}) buffer->resize(n);
  view_.base.heights_at(view_.X_SP, moved_, {h_, hx_, hy_});
  for (std::size_t k = 0; k < n; ++k) {
    Unknown& w = unknowns_[asking_[k]];
    w.h = h_[k], w.hx = hx_[k], w.hy = hy_[k];
  }
}

void DisplacedPoints::advance(const PlanePoint& p, Unknown& w, std::size_t k, int iteration) {
  constexpr double kRounding = 2e-14, kLinear = 1e-10;  // [m]
  constexpr int kPatience = 4;                          // steps after which the base's own noise is accepted
  const Mat3& R = view_.X_SP.rotation;
  const NaturalPoint q(view_.body, view_.X_SP.apply({p.x, p.y, w.t}));
  const Vec3 e = R.transpose() * q.e;
  const double d = d_[k];
  const double aside_x = p.x - d * e.x() - w.cx, aside_y = p.y - d * e.y() - w.cy;
  const double F = w.t - d * e.z() - (w.h + w.hx * aside_x + w.hy * aside_y);
  const Vec3 M(-w.hx, -w.hy, 1.0);
  const Vec3 g = R.transpose() * q.pull_back(R * M, d, d_u_[k], d_y_[k]);
  constexpr double kLeastSlope = 0.02;
  if (!(g.z() > kLeastSlope)) {  // NaN too
    w.state = Unknown::State::failed;
    return;
  }
  Vec3& slopes = slopes_[static_cast<std::size_t>(&w - unknowns_.data())];
  if (iteration == 0 && d == 0.0 && d_u_[k] == 0.0 && d_y_[k] == 0.0) {  // the base, bit for bit
    w.state = Unknown::State::solved;
    w.steepness = M.norm();
    slopes = {w.hx, w.hy, 0.0};
    return;
  }
  const double step = -F / g.z(), size = std::fabs(step), before = w.last_step;
  w.last_step = size;
  w.steepness = M.norm();
  w.offset = d;
  if (iteration == 0 && aside_x == 0.0 && aside_y == 0.0 && d == 0.0) {  // nothing moves
    w.state = Unknown::State::solved;
  } else {
    w.t += step;
    const double noise = kRounding * w.steepness * w.steepness;
    const bool known = (iteration > 0 || (aside_x == 0.0 && aside_y == 0.0));
    // What is left is the bend of base and offsets over the way the points still go.
    // Slopes belong to the place before the step: it must be as good as the same place.
    constexpr double kSamePlace = 1e-9;  // [m]
    if (known && (size <= noise || (size * w.rate * w.steepness <= kLinear && size <= kSamePlace)))
      w.state = Unknown::State::solved;
    if (iteration > kPatience && size <= 20.0 * noise) w.state = Unknown::State::solved;
    if (iteration > kPatience && size > 0.5 * before) w.state = Unknown::State::failed;
  }
  slopes = {-g.x() / g.z(), -g.y() / g.z(), 0.0};
}

/// Whether F cannot fall again between the solved heights and the outermost one that is possible.
bool DisplacedPoints::outermost_everywhere(const Leaf& leaf, const Range& unknowns) const {
  const double side = view_.side();
  double inner = std::numeric_limits<double>::infinity(), steepness = 1.0;
  for (std::size_t i = unknowns.begin; i < unknowns.end; ++i) {
    if (unknowns_[i].state != Unknown::State::solved) continue;
    inner = std::min(inner, side * unknowns_[i].t);
    steepness = std::max(steepness, unknowns_[i].steepness);
  }
  if (inner >= side * leaf.outermost) return true;
  const Rectangle uy = view_.natural_box(leaf.rectangle, ordered(side * inner, leaf.outermost));
  const OffsetRange offsets = view_.offsets(uy);
  const double x = 0.5 * (leaf.rectangle.x_min + leaf.rectangle.x_max),
               y = 0.5 * (leaf.rectangle.y_min + leaf.rectangle.y_max);
  // Slopes of the base may grow on the way by as much again.
  constexpr double kGrowth = 2.0, kSafe = 0.5;
  return kGrowth * steepness * view_.rate(offsets, uy, view_.X_SP.apply({x, y, side * inner})) <= kSafe;
}

void DisplacedPoints::search(PlanePoint& p) const {
  constexpr double kSame = 1e-11;  // [m]
  const DisplacedLine line(view_, p.x, p.y);
  const double found = line.search(max_offset_);
  if (std::fabs(found - p.z) <= kSame * (1.0 + p.dzdx * p.dzdx + p.dzdy * p.dzdy)) {
    const NaturalPoint q(view_.body, view_.X_SP.apply({p.x, p.y, p.z}));
    const OffsetJet d = view_.field.jet(q.u(), q.y);
    if (d.value == 0.0 && d.d_u == 0.0 && d.d_y == 0.0) return;  // the base, bit for bit
  }
  p.z = found;
  if (std::isnan(p.z)) {
    p.dzdx = p.dzdy = p.z;
    return;
  }
  const DisplacedLine::Sample s = line.at(p.z);
  p.dzdx = s.dzdx;
  p.dzdy = s.dzdy;
  if (std::isnan(s.dzdx) || std::isnan(s.dzdy)) p.z = p.dzdx = p.dzdy = std::numeric_limits<double>::quiet_NaN();
}

}  // namespace treadmark::displacement
