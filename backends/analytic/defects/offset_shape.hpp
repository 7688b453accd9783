// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <memory>
#include <numbers>
#include <span>
#include <utility>

#include "treadmark/backends/analytic/defects/offset_functions.hpp"
#include "treadmark/backends/displacement/offset_field.hpp"

namespace treadmark::analytic {

/// One shape of a DefectField, with everything in closed form. Immutable and thread-safe.
class OffsetShape {
 public:
  virtual ~OffsetShape() = default;
  virtual displacement::OffsetJet jet(double u, double y) const = 0;
  /// Adds values and, where wanted, first derivatives at many points.
  virtual void add(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                   std::span<double> d_y) const = 0;
  /// Conservative range over a rectangle of (u, y).
  virtual displacement::OffsetRange range(const Rectangle& uy) const = 0;
  /// Where it is not 0: (u, y), infinite where it has no end.
  virtual Rectangle support() const = 0;
  virtual std::size_t memory_bytes() const = 0;
};

/// scale along(u) across(y) over [u_min, u_max] x [y_min, y_max], 0 outside.
template <class Along, class Across>
class ProductShape final : public OffsetShape {
 public:
  ProductShape(double scale, Along along, Across across, const Rectangle& support)
      : scale_(scale), along_(std::move(along)), across_(std::move(across)), support_(support) {}

  displacement::OffsetJet jet(double u, double y) const override {
    if (outside(u, y)) return {};
    const Jet a = along_.jet(u), b = across_.jet(y);
    return {scale_ * a.h * b.h,   scale_ * a.dh * b.h,  scale_ * a.h * b.dh,
            scale_ * a.ddh * b.h, scale_ * a.dh * b.dh, scale_ * a.h * b.ddh};
  }

  void add(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
           std::span<double> d_y) const override {
    Many a, da, b, db;
    for (std::size_t begin = 0; begin < u.size(); begin += kMany) {
      const std::size_t n = std::min(kMany, u.size() - begin);
      const double *u_n = u.data() + begin, *y_n = y.data() + begin;
      bool any = false;
      for (std::size_t i = 0; i < n; ++i) any |= !outside(u_n[i], y_n[i]);
      if (!any) continue;
      evaluate(along_, u_n, n, a, da);
      evaluate(across_, y_n, n, b, db);
      for (std::size_t i = 0; i < n; ++i) {
        // selected, not multiplied: what lies outside may be NaN
        const bool in = !outside(u_n[i], y_n[i]);
        value[begin + i] += in ? scale_ * a[i] * b[i] : 0.0;
        if (!d_u.empty()) d_u[begin + i] += in ? scale_ * da[i] * b[i] : 0.0;
        if (!d_y.empty()) d_y[begin + i] += in ? scale_ * a[i] * db[i] : 0.0;
      }
    }
  }

  displacement::OffsetRange range(const Rectangle& r) const override {
    if (r.x_max <= support_.x_min || r.x_min >= support_.x_max || r.y_max <= support_.y_min ||
        r.y_min >= support_.y_max)
      return {};
    const FunctionRange a = along_.range(r.x_min, r.x_max), b = across_.range(r.y_min, r.y_max);
    const auto size = [](const FunctionRange& f) { return std::max(std::fabs(f.low), std::fabs(f.high)); };
    const auto [low, high] = std::minmax(
        {scale_ * a.low * b.low, scale_ * a.low * b.high, scale_ * a.high * b.low, scale_ * a.high * b.high});
    return {low, high, std::fabs(scale_) * a.max_d * size(b), std::fabs(scale_) * size(a) * b.max_d};
  }

  Rectangle support() const override { return support_; }
  std::size_t memory_bytes() const override { return sizeof(*this); }

 private:
  /// Negated, so that NaN counts as outside.
  bool outside(double u, double y) const {
    return !(u > support_.x_min && u < support_.x_max && y > support_.y_min && y < support_.y_max);
  }

  template <class Function>
  static void evaluate(const Function& f, const double* x, std::size_t n, Many& h, Many& dh) {
    // neighbours often share a coordinate: a row along the rail has one y
    if (std::all_of(x, x + n, [first = x[0]](double one) { return one == first; })) {
      const Jet all = f.jet(x[0]);
      std::fill_n(h.begin(), n, all.h);
      std::fill_n(dh.begin(), n, all.dh);
    } else {
      f.many(x, n, h, dh);
    }
  }

  double scale_;
  Along along_;
  Across across_;
  Rectangle support_;
};

template <class Along, class Across>
std::unique_ptr<const OffsetShape> product_shape(double scale, Along along, Across across, const Rectangle& support) {
  return std::make_unique<ProductShape<Along, Across>>(scale, std::move(along), std::move(across), support);
}

/// A shape of a wheel that it repeats every turn; its support is less than a turn about `center`.
class WoundShape final : public OffsetShape {
 public:
  WoundShape(double center, std::unique_ptr<const OffsetShape> shape) : center_(center), shape_(std::move(shape)) {}

  displacement::OffsetJet jet(double u, double y) const override { return shape_->jet(near_center(u), y); }

  void add(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
           std::span<double> d_y) const override {
    Many turned;
    for (std::size_t begin = 0; begin < u.size(); begin += kMany) {
      const std::size_t n = std::min(kMany, u.size() - begin);
      for (std::size_t i = 0; i < n; ++i) turned[i] = near_center(u[begin + i]);
      const auto part = [&](std::span<double> all) { return all.empty() ? all : all.subspan(begin, n); };
      shape_->add({turned.data(), n}, y.subspan(begin, n), part(value), part(d_u), part(d_y));
    }
  }

  displacement::OffsetRange range(const Rectangle& r) const override {
    const double length = r.x_max - r.x_min, first = near_center(r.x_min);
    if (!(length < kTurn)) return shape_->range({center_ - 0.5 * kTurn, center_ + 0.5 * kTurn, r.y_min, r.y_max});
    const displacement::OffsetRange here = shape_->range({first, first + length, r.y_min, r.y_max});
    if (first + length <= center_ + 0.5 * kTurn) return here;
    const displacement::OffsetRange next = shape_->range({first - kTurn, first + length - kTurn, r.y_min, r.y_max});
    return {std::min(here.low, next.low), std::max(here.high, next.high), std::max(here.max_d_u, next.max_d_u),
            std::max(here.max_d_y, next.max_d_y)};
  }

  Rectangle support() const override { return shape_->support(); }
  std::size_t memory_bytes() const override { return sizeof(*this) + shape_->memory_bytes(); }

 private:
  static constexpr double kTurn = 2.0 * std::numbers::pi;
  double near_center(double u) const { return u - kTurn * std::round((u - center_) / kTurn); }

  double center_;
  std::unique_ptr<const OffsetShape> shape_;
};

/// The least rectangle round both.
inline Rectangle enclosing(const Rectangle& a, const Rectangle& b) {
  return {std::min(a.x_min, b.x_min), std::max(a.x_max, b.x_max), std::min(a.y_min, b.y_min),
          std::max(a.y_max, b.y_max)};
}

inline constexpr double kEverywhere = std::numeric_limits<double>::infinity();

/// The lateral fading that flats, waves and polygons share; width 0 = everywhere.
inline CosineBump lateral_fading(double y_center, double width) { return {y_center, 0.5 * width}; }
/// Support of a shape with that fading.
inline Rectangle faded_support(double u_min, double u_max, double y_center, double width) {
  const double half = width > 0.0 ? 0.5 * width : kEverywhere;
  return {u_min, u_max, y_center - half, y_center + half};
}

}  // namespace treadmark::analytic
