// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "treadmark/core/surface.hpp"

namespace treadmark::displacement {

/// An offset and its derivatives by u and y.
struct OffsetJet {
  double value = 0.0;                         ///< [m]
  double d_u = 0.0, d_y = 0.0;                ///< per metre or radian of u, per metre of y
  double d_uu = 0.0, d_uy = 0.0, d_yy = 0.0;  ///< likewise
};

/// Range of an offset, and Lipschitz constants of it, over some (u, y) rectangle. Conservative.
struct OffsetRange {
  double low = 0.0, high = 0.0;         ///< [m]
  double max_d_u = 0.0, max_d_y = 0.0;  ///< of the sizes of the first derivatives
  /// Whether there is no offset anywhere over the rectangle.
  bool zero() const { return low == 0.0 && high == 0.0; }
};

/// Offsets over a base surface: dz(x, y) added to a rail's z (u = x [m]), or dr(theta, y) added to a wheel's radius
/// (u = theta [rad], any branch: the field takes care of the period). Defined everywhere; 0 outside its support.
/// Immutable, thread-safe, deterministic.
class OffsetField {
 public:
  virtual ~OffsetField() = default;

  /// At one point.
  virtual OffsetJet jet(double u, double y) const = 0;

  /// Values and first derivatives at many points (neighbours in the list are usually neighbours on the surface).
  /// d_u and d_y may be empty. All spans otherwise of one size.
  virtual void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value,
                        std::span<double> d_u, std::span<double> d_y) const;

  /// Conservative range over a rectangle (x = u, y = y of the rectangle).
  virtual OffsetRange range(const Rectangle& uy) const = 0;

  /// Whether it is the same at every u.
  virtual bool constant_along() const { return false; }

  /// Numbers that the field follows from, as Surface::parameters.
  virtual std::vector<ShapeParameter> parameters() const { return {}; }
  /// How many parameters() has.
  virtual std::size_t parameter_count() const { return parameters().size(); }
  /// The field with one of them changed; null: there is no such field.
  virtual std::shared_ptr<const OffsetField> changed(std::size_t parameter, double amount) const {
    static_cast<void>(parameter), static_cast<void>(amount);
    return nullptr;
  }
  /// Derivative by one of them, exact [m per unit].
  virtual double by(std::size_t parameter, double u, double y) const {
    static_cast<void>(parameter), static_cast<void>(u), static_cast<void>(y);
    return 0.0;
  }

  /// Adds to each of sums a weight times the derivative by that parameter.
  virtual void pull_back(double u, double y, double weight, std::span<double> sums) const;

  /// Memory taken by the field.
  virtual std::size_t memory_bytes() const = 0;
};

/// A field, which may be null, and an amount of another one.
std::shared_ptr<const OffsetField> with_more(std::shared_ptr<const OffsetField> whole,
                                             std::shared_ptr<const OffsetField> more, double amount);

}  // namespace treadmark::displacement
