// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/displaced_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::displacement {

namespace {
constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
constexpr int kColumns = 16;       ///< of a block
constexpr int kTogether = 4 * kColumns;  ///< columns solved together: what they need stays in the cache
/// [m] What is left of the way aside: heights then miss half its square times the curvature, normals its curvature.
constexpr double kLinear = 2e-10;
/// [m] Way along the surface for which the slopes of an offset are the same.
constexpr double kSamePlace = 1e-8;
}  // namespace

DisplacedBand::DisplacedBand(const View& view, double max_offset, const Grid2& grid, const BaseHeights& base, const HeightsOut& out)
    : view_(view),
      max_offset_(max_offset),
      g_(grid),
      base_(base),
      out_(out),
      across_(view.X_SP.rotation.row(1).transpose()),
      along_rail_(view.X_SP.rotation.row(0).transpose()),
      up_rail_(view.X_SP.rotation.row(2).transpose()),
      natural_(view.body, view.X_SP) {}

inline bool DisplacedBand::is_last(double step, const Block& block, double steepness) {
  const double size = std::fabs(step);
  return size * block.rate * steepness <= kLinear && size * block.tilt <= kSamePlace;
}

inline DisplacedBand::Equation DisplacedBand::equation(const Point& p, double x, double y) const {
  const bool wheel = view_.body == Body::wheel;
  const Vec3 e = wheel ? Vec3(along_rail_ * p.sin + up_rail_ * p.cos) : up_rail_;
  const Vec3 a = wheel ? Vec3(along_rail_ * p.cos - up_rail_ * p.sin) : along_rail_;
  const double du_along = wheel ? p.per_r : 1.0, de_along = wheel ? p.per_r : 0.0;
  const double aside_x = x - p.d * e.x() - p.cx, aside_y = y - p.d * e.y() - p.cy;
  const Vec3 M(-p.hx, -p.hy, 1.0);
  const double Me = M.dot(e), Ma = M.dot(a);
  return {p.t - p.d * e.z() - (p.h + p.hx * aside_x + p.hy * aside_y), M.norm(),
          M - a * (p.d_u * du_along * Me + p.d * de_along * Ma) - across_ * (p.d_y * Me)};
}

void DisplacedBand::solve(int first, int last) {
  first_ = first, last_ = last;
  left_.clear();
  for (int iy = first; iy < last; ++iy) std::copy_n(base_.row(iy), g_.nx, out_.z.data() + g_.index(0, iy));
  for (int begin = 0; begin < g_.nx; begin += kTogether) {
    divide(begin, std::min(begin + kTogether, g_.nx));
    if (!columns_.empty()) solve_columns();
  }
  solve_left();
}

void DisplacedBand::divide(int first_column, int last_column) {
  blocks_.clear(), columns_.clear();
  for (int begin = first_column; begin < last_column; begin += kColumns) {
    Block block{};
    const int end = std::min(begin + kColumns, last_column);
    const Kind kind = judge(begin, end, block);
    if (kind == Kind::together) {
      blocks_.push_back(block);
      for (int ix = begin; ix < end; ++ix) columns_.push_back({ix, blocks_.size() - 1});
    } else if (kind == Kind::one_by_one) {
      for (int iy = first_; iy < last_; ++iy)
        for (int ix = begin; ix < end; ++ix) leave(ix, iy);
    }
  }
}

void DisplacedBand::solve_columns() {
  const std::size_t m = columns_.size();
  points_.resize(m * static_cast<std::size_t>(last_ - first_));
  for (auto& rise : rise_) rise.assign(m, kNaN);
  for (auto* one : {&x_, &t_, &d_, &d_u_, &d_y_}) one->resize(m);
  natural_.resize(m);
  const int ix = columns_[m / 2].ix;
  const double z = base_.row(first_)[ix];
  natural_.look_near(view_.X_SP.apply({g_.x(ix), g_.y(first_), std::isnan(z) ? 0.0 : z}));
  for (int iy = first_; iy < last_; ++iy) solve_row(iy);
  ask_base();
  finish();
}

DisplacedBand::Kind DisplacedBand::judge(int begin, int end, Block& block) {
  const double side = view_.side();
  const Rectangle r{g_.x(begin), g_.x(end - 1), g_.y(first_), g_.y(last_ - 1)};
  int present = 0;
  double least = std::numeric_limits<double>::infinity(), greatest = -least;
  for (int iy = first_ - 1; iy <= last_; ++iy) {
    const double* z = base_.row(iy);
    for (int ix = begin - 1; ix <= end; ++ix) {
      least = z[ix] < least ? z[ix] : least;
      greatest = z[ix] > greatest ? z[ix] : greatest;
    }
    if (iy < first_ || iy == last_) continue;
    for (int ix = begin; ix < end; ++ix) present += z[ix] == z[ix];
  }
  Interval t{least - max_offset_, greatest + max_offset_};
  if (present > 0) {
    // outwards there may be more between the points
    const double more = 0.25 * (greatest - least) + 1e-6;
    (side > 0.0 ? t.high : t.low) += side * more;
  } else {
    const HeightBounds near = view_.base.height_bounds(view_.X_SP, enlarged(r, max_offset_));
    if (near.empty) return Kind::untouched;
    t = {near.z_min - max_offset_, near.z_max + max_offset_};
  }
  const Rectangle uy = view_.natural_box(r, t);
  const OffsetRange offsets = view_.offsets(uy);
  if (offsets.zero()) return Kind::untouched;
  const Reach aside = reach(r, View::moved_back(r, offsets, view_.directions(uy)));
  const double farthest = std::max(aside.x, aside.y);
  const Vec3 corner = view_.X_SP.apply({r.x_min, r.y_min, t.low});
  block = {begin, end, view_.rate(offsets, uy, corner),
           std::max(view_.tilt_along(uy, corner), std::fabs(view_.X_SP.rotation(1, 2))),
           aside.x > kNoReach ? (aside.y > kNoReach ? BaseHeights::kAround : BaseHeights::kAlongX) : BaseHeights::kAlongY,
           farthest > kNoReach};
  if (present == 0) {
    if (!block.moves || view_.base.height_bounds(view_.X_SP, enlarged(r, farthest)).empty) return Kind::untouched;
    return Kind::one_by_one;
  }
  // Points moved back stay beside the places that were looked at.
  if (block.moves && !(block.rate * (t.high - t.low) <= 0.5 * std::min(g_.dx, g_.dy))) return Kind::one_by_one;
  if (block.moves && present < (end - begin) * (last_ - first_)) leave_misses(block, farthest);
  return Kind::together;
}

/// Misses of the base that offsets may change into hits: those near a hit, or near points that nobody knows.
void DisplacedBand::leave_misses(const Block& block, double reach) {
  const double cells = std::ceil(reach / std::min(g_.dx, g_.dy));
  const int w = static_cast<int>(std::min(cells, 2.0 * kColumns));
  for (int iy = first_; iy < last_; ++iy)
    for (int ix = block.first; ix < block.last; ++ix) {
      if (!std::isnan(base_.row(iy)[ix])) continue;
      bool near = ix - w < -1 || ix + w > g_.nx || iy - w < -1 || iy + w > g_.ny;
      for (int jy = iy - w; jy <= iy + w && !near; ++jy)
        for (int jx = ix - w; jx <= ix + w && !near; ++jx) near = !std::isnan(base_.row(jy)[jx]);
      if (near) leave(ix, iy);
    }
}

void DisplacedBand::leave(int ix, int iy) {
  const std::size_t i = g_.index(ix, iy);
  left_.push_back({i, g_.x(ix), g_.y(iy), base_.row(iy)[ix], out_.dzdx.empty() ? kNaN : out_.dzdx[i],
                   out_.dzdy.empty() ? kNaN : out_.dzdy[i]});
}

/// The offsets of one row where its heights lie, to within what Newton's last step makes good.
void DisplacedBand::solve_row(int iy) {
  constexpr int kPasses = 4;
  const double* z = base_.row(iy);
  active_.clear();
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    Point& p = at(iy, k);
    p.present = !std::isnan(z[columns_[k].ix]);
    if (!p.present) continue;
    double rise = 4.0 * (rise_[0][k] + rise_[2][k]) - 6.0 * rise_[1][k] - rise_[3][k];
    if (std::isnan(rise)) rise = 3.0 * (rise_[0][k] - rise_[1][k]) + rise_[2][k];
    if (std::isnan(rise)) rise = 2.0 * rise_[0][k] - rise_[1][k];
    if (std::isnan(rise)) rise = rise_[0][k];
    p.t = z[columns_[k].ix] + (std::isnan(rise) ? 0.0 : rise);
    p.step = 0.0;
    active_.push_back(k);
  }
  for (int pass = 0; pass < kPasses && !active_.empty(); ++pass) {
    approach(iy, active_, next_);
    active_.swap(next_);
  }
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Point& p = at(iy, k);
    rise_[3][k] = rise_[2][k];
    rise_[2][k] = rise_[1][k];
    rise_[1][k] = rise_[0][k];
    rise_[0][k] = p.present ? p.t + p.step - z[columns_[k].ix] : kNaN;
  }
}

/// Asks for the offsets, and steps with the tangent plane of the base. next: points that this moves too far.
void DisplacedBand::approach(int iy, const std::vector<std::size_t>& active, std::vector<std::size_t>& next) {
  const double y = g_.y(iy), per_2dx = 0.5 / g_.dx, per_2dy = 0.5 / g_.dy;
  const double *z = base_.row(iy), *before = base_.row(iy - 1), *behind = base_.row(iy + 1);
  const std::size_t n = active.size();
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t k = active[j];
    Point& p = at(iy, k);
    x_[j] = g_.x(columns_[k].ix);
    t_[j] = p.t = p.t + p.step;
  }
  natural_.find(y, x_.data(), t_.data(), n);
  const auto first = [n](std::vector<double>& all) { return std::span<double>(all.data(), n); };
  view_.field.evaluate(first(natural_.u), first(natural_.y), first(d_), first(d_u_), first(d_y_));
  next.clear();
  for (std::size_t j = 0; j < n; ++j) {
    const std::size_t k = active[j];
    Point& p = at(iy, k);
    p.d = d_[j], p.d_u = d_u_[j], p.d_y = d_y_[j];
    p.sin = natural_.sin[j], p.cos = natural_.cos[j], p.per_r = natural_.per_r[j];
    const int ix = columns_[k].ix;
    p.hx = (z[ix + 1] - z[ix - 1]) * per_2dx, p.hy = (behind[ix] - before[ix]) * per_2dy;
    if (std::isnan(p.hx)) p.hx = 0.0;
    if (std::isnan(p.hy)) p.hy = 0.0;
    p.cx = x_[j], p.cy = y, p.h = z[ix];
    const Equation q = equation(p, x_[j], y);
    p.step = -q.F / q.g.z();
    if (!is_last(p.step, blocks_[columns_[k].block], q.steepness)) next.push_back(k);
  }
}

void DisplacedBand::ask_base() {
  const bool wheel = view_.body == Body::wheel;
  moved_.clear(), asking_.clear();
  for (int iy = first_; iy < last_; ++iy)
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      Point& p = at(iy, k);
      if (!p.present || !blocks_[columns_[k].block].moves) continue;
      const double ex = wheel ? along_rail_.x() * p.sin + up_rail_.x() * p.cos : up_rail_.x();
      const double ey = wheel ? along_rail_.y() * p.sin + up_rail_.y() * p.cos : up_rail_.y();
      p.cx -= p.d * ex, p.cy -= p.d * ey;
      asking_.push_back(&p);
      moved_.push_back({p.cx, p.cy});
    }
  const std::size_t n = moved_.size();
  if (n == 0) return;
  for (auto* one : {&h_, &hx_, &hy_}) one->resize(n);
  view_.base.heights_at(view_.X_SP, moved_, {h_, hx_, hy_});
  for (std::size_t j = 0; j < n; ++j) asking_[j]->h = h_[j], asking_[j]->hx = hx_[j], asking_[j]->hy = hy_[j];
}

void DisplacedBand::finish() {
  constexpr double kLeastSlope = 0.02;
  // Slopes of the base may grow outwards by as much again.
  constexpr double kGrowth = 2.0, kSafe = 0.5;
  const bool slopes = !out_.dzdx.empty() || !out_.dzdy.empty();
  const double per_dx = 1.0 / g_.dx, per_dy = 1.0 / g_.dy;
  for (int iy = first_; iy < last_; ++iy)
    for (std::size_t k = 0; k < columns_.size(); ++k) {
      Point& p = at(iy, k);
      if (!p.present) continue;
      const int ix = columns_[k].ix;
      const Block& block = blocks_[columns_[k].block];
      const std::size_t i = g_.index(ix, iy);
      if (!block.moves) {  // the slopes of the base are those at the point itself
        if (!out_.dzdx.empty()) p.hx = out_.dzdx[i];
        if (!out_.dzdy.empty()) p.hy = out_.dzdy[i];
      }
      if (block.moves && !std::isnan(p.h) && (std::isnan(p.hx) || std::isnan(p.hy))) {  // a rim seen edge-on
        for (const auto array : {out_.z, out_.dzdx, out_.dzdy})
          if (!array.empty()) array[i] = kNaN;
        continue;
      }
      const Equation q = equation(p, g_.x(ix), g_.y(iy));
      const double step = -q.F / q.g.z(), aside = block.rate * q.steepness;
      bool good = q.g.z() > kLeastSlope && is_last(step, block, q.steepness);
      if (block.moves && good) {
        const double jx = (p.cx - g_.x0) * per_dx + 0.5, jy = (p.cy - g_.y0) * per_dy + 0.5;  // the nearest point is below
        good = kGrowth * aside <= kSafe && jx >= -1.0 && jx < g_.nx + 1 && jy >= -1.0 && jy < g_.ny + 1 &&
               (base_.smooth(std::clamp(static_cast<int>(jx), 0, g_.nx - 1), std::clamp(static_cast<int>(jy), 0, g_.ny - 1)) &
                block.needed) != 0;
      }
      if (!good) {
        leave(ix, iy);
        continue;
      }
      if (p.d == 0.0 && p.d_u == 0.0 && p.d_y == 0.0) continue;  // the base, bit for bit
      out_.z[i] = p.t + step;
      if (!slopes) continue;
      if (!out_.dzdx.empty()) out_.dzdx[i] = -q.g.x() / q.g.z();
      if (!out_.dzdy.empty()) out_.dzdy[i] = -q.g.y() / q.g.z();
    }
}

void DisplacedBand::solve_left() {
  const std::size_t n = left_.size();
  if (n == 0) return;
  if (out_.dzdx.empty() || out_.dzdy.empty()) {
    std::vector<Vec2> at(n);
    std::vector<double> z(n), zx(n), zy(n);
    for (std::size_t i = 0; i < n; ++i) at[i] = {left_[i].x, left_[i].y};
    view_.base.heights_at(view_.X_SP, at, {z, zx, zy});
    for (std::size_t i = 0; i < n; ++i) left_[i].dzdx = zx[i], left_[i].dzdy = zy[i];
  }
  DisplacedPoints(view_, max_offset_).solve(left_);
  for (const PlanePoint& p : left_) {
    out_.z[p.index] = p.z;
    if (!out_.dzdx.empty()) out_.dzdx[p.index] = p.dzdx;
    if (!out_.dzdy.empty()) out_.dzdy[p.index] = p.dzdy;
  }
}

}  // namespace treadmark::displacement
