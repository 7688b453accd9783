// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/displaced_band.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/kernel.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::displacement {

namespace {
constexpr int kColumns = 32;  ///< of a block
/// [m] What is left of the way aside: heights then miss half its square times the curvature, normals its curvature.
constexpr double kLinear = 2e-10;
/// [m] Way along the surface for which the slopes of an offset are the same.
constexpr double kSamePlace = 1e-8;

/// Whether a step leaves offset, base and their slopes as they are but for rounding and straight changes.
bool is_last(double step, double rate, double tilt, double steepness) {
  const double size = std::fabs(step);
  return size * rate * steepness <= kLinear && size * tilt <= kSamePlace;
}
}  // namespace

BandPoints DisplacedBand::Points::pointers() {
  return {t.data(),     d.data(),  d_u.data(), d_y.data(),    sin.data(),   cos.data(),
          per_r.data(), h.data(),  hx.data(),  hy.data(),     step.data(),  steepness.data(),
          gx.data(),    gy.data(), gz.data(),  back_x.data(), back_y.data()};
}

DisplacedBand::DisplacedBand(const View& view, double max_offset, const Grid2& grid, const BaseHeights& base,
                             const HeightsOut& out)
    : view_(view),
      max_offset_(max_offset),
      g_(grid),
      base_(base),
      out_(out),
      kernel_(fastest_kernel<BandKernel>()),
      axes_{view.body == Body::wheel, {}, {}, {}},
      patch_(base, grid, !out.dzdx.empty() || !out.dzdy.empty()),
      natural_(view.body, view.X_SP) {
  for (int k = 0; k < 3; ++k) {
    axes_.along[k] = view.X_SP.rotation(0, k);
    axes_.across[k] = view.X_SP.rotation(1, k);
    axes_.up[k] = view.X_SP.rotation(2, k);
  }
  natural_.resize(kTogether);
}

void DisplacedBand::solve(int first, int last) {
  first_ = first, last_ = last;
  left_.clear(), asking_.clear(), blocks_.clear();
  for (int begin = 0; begin < g_.nx; begin += static_cast<int>(kTogether))
    divide(begin, std::min(begin + static_cast<int>(kTogether), g_.nx));
  ask_base();
  solve_left();
}

/// Judges blocks and solves runs of those that are solved together.
void DisplacedBand::divide(int first_column, int last_column) {
  int run = first_column;
  const auto end_run = [&](int end) {
    if (end > run) solve_columns(run, end);
  };
  for (int begin = first_column; begin < last_column; begin += kColumns) {
    Block block{};
    const int end = std::min(begin + kColumns, last_column);
    const Kind kind = judge(begin, end, block);
    if (kind == Kind::together) {
      blocks_.push_back(block);
      for (int ix = begin; ix < end; ++ix) block_[static_cast<std::size_t>(ix - run)] = blocks_.size() - 1;
      continue;
    }
    if (kind == Kind::one_by_one)
      for (int iy = first_; iy < last_; ++iy)
        for (int ix = begin; ix < end; ++ix) leave(ix, iy);
    end_run(begin);
    run = end;
  }
  end_run(last_column);
}

void DisplacedBand::solve_columns(int first_column, int last_column) {
  begin_ = first_column;
  n_ = static_cast<std::size_t>(last_column - first_column);
  moves_ = false;
  for (std::size_t k = 0; k < n_; ++k) {
    now_.x[k] = g_.x(begin_ + static_cast<int>(k));
    moves_ = moves_ || block_of(k).moves;
  }
  if (moves_) moves_ = patch_.look(first_column, last_column, first_, last_);
  for (Row& rise : rise_) rise.fill(kNaN);
  const std::size_t middle = n_ / 2;
  const double z = base_.row(first_)[begin_ + static_cast<int>(middle)];
  natural_.look_near(view_.X_SP.apply({now_.x[middle], g_.y(first_), std::isnan(z) ? 0.0 : z}));
  for (int iy = first_; iy < last_; ++iy) {
    foretell(iy);
    approach(iy);
    see_base(iy);
    finish(iy);
  }
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
  block = {
      begin,
      end,
      view_.rate(offsets, uy, corner),
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
  const int w = to_whole<int>(std::min(cells, 2.0 * kColumns));
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

/// Where the heights of a row will lie, and the tangent planes of the base.
void DisplacedBand::foretell(int iy) {
  const double per_2dx = 0.5 / g_.dx, per_2dy = 0.5 / g_.dy;
  const double *z = base_.row(iy) + begin_, *before = base_.row(iy - 1) + begin_, *behind = base_.row(iy + 1) + begin_;
  for (std::size_t k = 0; k < n_; ++k) {
    double rise = 4.0 * (rise_[0][k] + rise_[2][k]) - 6.0 * rise_[1][k] - rise_[3][k];
    if (std::isnan(rise)) rise = 3.0 * (rise_[0][k] - rise_[1][k]) + rise_[2][k];
    if (std::isnan(rise)) rise = 2.0 * rise_[0][k] - rise_[1][k];
    if (std::isnan(rise)) rise = rise_[0][k];
    if (std::isnan(rise)) rise = 0.0;
    const bool present = !std::isnan(z[k]);
    now_.h[k] = present ? z[k] : 0.0;
    now_.t[k] = now_.h[k] + rise;
    const std::ptrdiff_t i = static_cast<std::ptrdiff_t>(k);
    const double hx = (z[i + 1] - z[i - 1]) * per_2dx, hy = (behind[i] - before[i]) * per_2dy;
    now_.hx[k] = std::isnan(hx) ? 0.0 : hx;
    now_.hy[k] = std::isnan(hy) ? 0.0 : hy;
  }
}

void DisplacedBand::ask_offsets(Points& p, double y, std::size_t n) {
  natural_.find(y, p.x.data(), p.t.data(), n);
  view_.field.evaluate({natural_.u.data(), n}, {natural_.y.data(), n}, {p.d.data(), n}, {p.d_u.data(), n},
                       {p.d_y.data(), n});
  if (axes_.wheel) {
    std::copy_n(natural_.sin.data(), n, p.sin.data());
    std::copy_n(natural_.cos.data(), n, p.cos.data());
    std::copy_n(natural_.per_r.data(), n, p.per_r.data());
  }
  kernel_.solve_tangent(axes_, n, p.pointers());
}

/// Asks for the offsets, and steps with the tangent plane of the base, until that does not move the points too far.
void DisplacedBand::approach(int iy) {
  constexpr int kPasses = 4;
  const double y = g_.y(iy);
  const double* z = base_.row(iy) + begin_;
  ask_offsets(now_, y, n_);
  std::size_t n = 0;
  for (std::size_t k = 0; k < n_; ++k) {
    const Block& block = block_of(k);
    if (!is_last(now_.step[k], block.rate, block.tilt, now_.steepness[k]) && !std::isnan(z[k])) which_[n++] = k;
  }
  for (int pass = 1; pass < kPasses && n > 0; ++pass) {
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t k = which_[j];
      again_.x[j] = now_.x[k];
      again_.t[j] = now_.t[k] + now_.step[k];
      again_.h[j] = now_.h[k], again_.hx[j] = now_.hx[k], again_.hy[j] = now_.hy[k];
    }
    ask_offsets(again_, y, n);
    std::size_t next = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const std::size_t k = which_[j];
      for (Row Points::*one : {&Points::t, &Points::d, &Points::d_u, &Points::d_y, &Points::sin, &Points::cos,
                               &Points::per_r, &Points::step, &Points::steepness, &Points::back_x, &Points::back_y})
        (now_.*one)[k] = (again_.*one)[j];
      const Block& block = block_of(k);
      if (!is_last(now_.step[k], block.rate, block.tilt, now_.steepness[k])) which_[next++] = k;
    }
    n = next;
  }
  for (std::size_t k = 0; k < n_; ++k) {
    rise_[3][k] = rise_[2][k];
    rise_[2][k] = rise_[1][k];
    rise_[1][k] = rise_[0][k];
    rise_[0][k] = now_.t[k] + now_.step[k] - z[k];
  }
}

/// The base at the points moved back.
void DisplacedBand::see_base(int iy) {
  known_.fill(false);
  if (moves_) {
    const double per_dx = 1.0 / g_.dx, per_dy = 1.0 / g_.dy;
    for (std::size_t k = 0; k < n_; ++k) along_[k] = -now_.back_x[k] * per_dx, across_[k] = -now_.back_y[k] * per_dy;
    patch_.row(iy, along_.data(), across_.data(), now_.h.data(), now_.hx.data(), now_.hy.data(), known_.data());
  }
  for (std::size_t k = 0; k < n_; ++k) {
    if (block_of(k).moves) continue;
    // nothing moves: the base is that at the point itself
    const int ix = begin_ + static_cast<int>(k);
    const std::size_t i = g_.index(ix, iy);
    known_[k] = true;
    now_.h[k] = base_.row(iy)[ix];
    if (!out_.dzdx.empty()) now_.hx[k] = out_.dzdx[i];
    if (!out_.dzdy.empty()) now_.hy[k] = out_.dzdy[i];
  }
}

inline bool DisplacedBand::is_good(const Points& p, std::size_t k, int ix, int iy, const Block& block, double moved_x,
                                   double moved_y) const {
  constexpr double kLeastSlope = 0.02;
  // Slopes of the base may grow outwards by as much again.
  constexpr double kGrowth = 2.0, kSafe = 0.5;
  if (!(p.gz[k] > kLeastSlope) || !is_last(p.step[k], block.rate, block.tilt, p.steepness[k])) return false;
  if (!block.moves) return true;
  if (!(kGrowth * block.rate * p.steepness[k] <= kSafe)) return false;
  if (std::fabs(moved_x) < 0.5 && std::fabs(moved_y) < 0.5) return (base_.smooth(ix, iy) & block.needed) != 0;
  const double jx = ix + moved_x + 0.5, jy = iy + moved_y + 0.5;  // the nearest point is below
  return jx >= -1.0 && jx < g_.nx + 1 && jy >= -1.0 && jy < g_.ny + 1 &&
         (base_.smooth(std::clamp(static_cast<int>(jx), 0, g_.nx - 1), std::clamp(static_cast<int>(jy), 0, g_.ny - 1)) &
          block.needed) != 0;
}

inline void DisplacedBand::write(const Points& p, std::size_t k, int ix, int iy) {
  if (p.d[k] == 0.0 && p.d_u[k] == 0.0 && p.d_y[k] == 0.0) return;  // the base, bit for bit
  const std::size_t i = g_.index(ix, iy);
  out_.z[i] = p.t[k] + p.step[k];
  if (!out_.dzdx.empty()) out_.dzdx[i] = -p.gx[k] / p.gz[k];
  if (!out_.dzdy.empty()) out_.dzdy[i] = -p.gy[k] / p.gz[k];
}

void DisplacedBand::finish(int iy) {
  const double* z = base_.row(iy) + begin_;
  kernel_.solve_moved(axes_, n_, now_.pointers());
  for (std::size_t k = 0; k < n_; ++k) {
    if (std::isnan(z[k])) continue;
    const int ix = begin_ + static_cast<int>(k);
    if (!known_[k])
      asking_.push_back({ix, iy, block_[k], now_.t[k], now_.d[k], now_.d_u[k], now_.d_y[k], now_.sin[k], now_.cos[k],
                         now_.per_r[k], now_.x[k] - now_.back_x[k], g_.y(iy) - now_.back_y[k]});
    else if (is_good(now_, k, ix, iy, block_of(k), along_[k], across_[k]))
      write(now_, k, ix, iy);
    else
      leave(ix, iy);
  }
}

/// Solves the points whose base could not be interpolated.
void DisplacedBand::ask_base() {
  const std::size_t all = asking_.size();
  if (all == 0) return;
  std::vector<Vec2> moved(all);
  std::vector<double> h(all), hx(all), hy(all);
  for (std::size_t i = 0; i < all; ++i) moved[i] = {asking_[i].x, asking_[i].y};
  view_.base.heights_at(view_.X_SP, moved, {h, hx, hy});
  for (std::size_t begin = 0; begin < all; begin += kTogether) {
    const std::size_t n = std::min(kTogether, all - begin);
    Points& p = again_;
    for (std::size_t j = 0; j < n; ++j) {
      const Asking& one = asking_[begin + j];
      p.t[j] = one.t, p.d[j] = one.d, p.d_u[j] = one.d_u, p.d_y[j] = one.d_y;
      p.sin[j] = one.sin, p.cos[j] = one.cos, p.per_r[j] = one.per_r;
      p.h[j] = h[begin + j], p.hx[j] = hx[begin + j], p.hy[j] = hy[begin + j];
    }
    kernel_.solve_moved(axes_, n, p.pointers());
    for (std::size_t j = 0; j < n; ++j) {
      const Asking& one = asking_[begin + j];
      if (!std::isnan(p.h[j]) && (std::isnan(p.hx[j]) || std::isnan(p.hy[j]))) {  // a rim seen edge-on
        for (const auto array : {out_.z, out_.dzdx, out_.dzdy})
          if (!array.empty()) array[g_.index(one.ix, one.iy)] = kNaN;
      } else if (is_good(p, j, one.ix, one.iy, blocks_[one.block], (one.x - g_.x(one.ix)) / g_.dx,
                         (one.y - g_.y(one.iy)) / g_.dy)) {
        write(p, j, one.ix, one.iy);
      } else {
        leave(one.ix, one.iy);
      }
    }
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
