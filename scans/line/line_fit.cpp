// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/scans/line/line_fit.hpp"

#include <Eigen/SparseCholesky>

#include <algorithm>
#include <cmath>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/median.hpp"

namespace treadmark::scans {
namespace {

using Sparse = Eigen::SparseMatrix<double>;
constexpr Eigen::Index kParts = 4;  // position and roll
constexpr int kFitRounds = 12;
// Distances have three parts, so that the usual one is about 1.54 standard deviations (the median of chi with three
// degrees of freedom); beyond 6 a target says nothing.
constexpr double kUsual = 1.5382, kFar = 6.0;
// A target tells nothing of its place along the line, but somewhere the splines' numbers must be: this part of what
// it tells across.
constexpr double kAlong = 1e-6;

/// Coefficients of a line without splines by its free numbers: row of a coefficient, column of a number.
Eigen::MatrixXd numbers_to_coefficients(const LineShape& shape, bool roll, double step) {
  const auto count = static_cast<Eigen::Index>(shape.intervals + 3);
  // blossoms of 1, t and t^2 at the knots of one interval
  const Eigen::Index degree = (shape.kind == LineShape::Kind::straight ? 0 : 1) + (roll ? 0 : 1);
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(count, degree + 1);
  for (Eigen::Index i = 0; i < count; ++i) {
    const double at = static_cast<double>(i) - 1.0;
    out(i, 0) = 1.0;
    if (degree > 0) out(i, 1) = at * step;
    if (degree > 1) out(i, 2) = (at * at - 1.0 / 3.0) * step * step;
  }
  return out;
}

class Fit {
 public:
  Fit(std::span<const LineTarget> targets, const LineShape& shape, double from, double to, double scatter,
      const Vec3& up)
      : targets_(targets),
        from_(from),
        scatter_(scatter),
        up_(up),
        count_(shape.intervals + 3),
        step_((to - from) / static_cast<double>(shape.intervals)) {
    if (shape.kind == LineShape::Kind::splines) {
      // numbers beside each other where their splines are, which keeps the equations banded
      to_coefficients_.resize(kParts * static_cast<Eigen::Index>(count_), kParts * static_cast<Eigen::Index>(count_));
      to_coefficients_.setIdentity();
    } else {
      take_few_numbers(shape);
    }
    // only its basis is used
    basis_ = RailLine(from, step_, straight(), std::vector<double>(count_, 0.0), up_guess());
    weights_.assign(targets.size(), 1.0);
    coefficients_ = Eigen::VectorXd::Zero(to_coefficients_.rows());
  }

  LineFit run(std::span<const double> errors_at) {
    for (int round = 0; round < kFitRounds; ++round) {
      check_cancelled();
      solve();
      // the second one takes away rounding errors
      if (!weigh() && round > 1) break;
    }
    LineFit out;
    std::vector<Vec3> positions(count_);
    std::vector<double> rolls(count_);
    for (std::size_t i = 0; i < count_; ++i) {
      positions[i] = coefficients_.segment<3>(kParts * static_cast<Eigen::Index>(i));
      rolls[i] = coefficients_[kParts * static_cast<Eigen::Index>(i) + 3];
    }
    out.line = RailLine(from_, step_, std::move(positions), std::move(rolls), up_);
    for (const LineTarget& target : targets_) {
      const double u = distance(target) / scatter_;
      out.loss += std::min(u * u, kFar * kFar);
    }
    for (const double along : errors_at) {
      check_cancelled();
      out.errors.push_back(errors(out.line, along));
    }
    return out;
  }

 private:
  void take_few_numbers(const LineShape& shape) {
    const Eigen::MatrixXd place = numbers_to_coefficients(shape, false, step_),
                          roll = numbers_to_coefficients(shape, true, step_);
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::Index column = 0;
    for (Eigen::Index number = 0; number < place.cols(); ++number)
      for (Eigen::Index part = 0; part < kParts; ++part) {
        const Eigen::MatrixXd& by = part < 3 ? place : roll;
        if (number >= by.cols()) continue;
        for (Eigen::Index i = 0; i < by.rows(); ++i)
          if (by(i, number) != 0.0) entries.emplace_back(kParts * i + part, column, by(i, number));
        ++column;
      }
    to_coefficients_.resize(kParts * static_cast<Eigen::Index>(count_), column);
    to_coefficients_.setFromTriplets(entries.begin(), entries.end());
  }

  std::vector<Vec3> straight() const {
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < count_; ++i) out.emplace_back(step_ * static_cast<double>(i), 0.0, 0.0);
    return out;
  }
  static Vec3 up_guess() { return -Vec3::UnitZ(); }

  /// Of place along the line, y, z and roll: of which a target knows the last three.
  static Eigen::Matrix4d information(const LineTarget& target, double along) {
    Eigen::Matrix4d local = Eigen::Matrix4d::Zero();
    local.bottomRightCorner<3, 3>() = target.information;
    local(0, 0) = along * std::max(target.information(0, 0), target.information(1, 1));
    Eigen::Matrix4d turn = Eigen::Matrix4d::Zero();
    turn.topLeftCorner<3, 3>() = target.axes.transpose();
    turn(3, 3) = 1.0;
    return turn.transpose() * local * turn;
  }

  Eigen::Vector4d residual(const LineTarget& target) const {
    const LineBasis b = basis_.basis(target.along);
    Eigen::Vector4d out;
    out << target.position, target.roll;
    for (std::size_t i = 0; i < 4; ++i)
      out -= b.value[static_cast<Eigen::Index>(i)] *
             coefficients_.segment<kParts>(kParts * static_cast<Eigen::Index>(b.first + i));
    return out;
  }
  double distance(const LineTarget& target) const {
    const Eigen::Vector4d r = residual(target);
    return std::sqrt(std::max(0.0, r.dot(information(target, 0.0) * r)));
  }

  void solve() {
    std::vector<Eigen::Triplet<double>> entries;
    entries.reserve(targets_.size() * 256);
    Eigen::VectorXd rhs = Eigen::VectorXd::Zero(to_coefficients_.rows());
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      if (!(weights_[k] > 0.0)) continue;
      const LineTarget& target = targets_[k];
      const LineBasis b = basis_.basis(target.along);
      const Eigen::Matrix4d w = weights_[k] * information(target, kAlong);
      const Eigen::Vector4d wa = w * residual(target);
      for (std::size_t i = 0; i < 4; ++i) {
        const double bi = b.value[static_cast<Eigen::Index>(i)];
        const auto row = kParts * static_cast<Eigen::Index>(b.first + i);
        // not segment<4>: GCC 12 loses sums of segments (-O3)
        for (Eigen::Index p = 0; p < kParts; ++p) rhs[row + p] += bi * wa[p];
        for (std::size_t j = 0; j < 4; ++j) {
          const double both = bi * b.value[static_cast<Eigen::Index>(j)];
          const auto column = kParts * static_cast<Eigen::Index>(b.first + j);
          for (Eigen::Index p = 0; p < kParts; ++p)
            for (Eigen::Index q = 0; q < kParts; ++q) entries.emplace_back(row + p, column + q, both * w(p, q));
        }
      }
    }
    Sparse matrix(to_coefficients_.rows(), to_coefficients_.rows());
    matrix.setFromTriplets(entries.begin(), entries.end());
    const Sparse half = matrix * to_coefficients_;
    Sparse reduced = Sparse(to_coefficients_.transpose()) * half;
    // across gaps nothing but smoothness holds the splines
    if (reduced.rows() == matrix.rows()) add_stiffness(reduced);
    solver_.compute(reduced);
    if (solver_.info() != Eigen::Success)
      throw Error(ErrorKind::input_data, "the points leave the line of the rail open");
    // from where the numbers are, so that each round also takes away rounding errors of the one before
    coefficients_ += to_coefficients_ * Eigen::VectorXd(solver_.solve(to_coefficients_.transpose() * rhs));
  }

  /// A little of the squared third differences, which no even bend has.
  void add_stiffness(Sparse& matrix) const {
    constexpr double kStiffness = 1e-9;
    double largest[kParts] = {};
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
      largest[i % kParts] = std::max(largest[i % kParts], matrix.coeff(i, i));
    const double differences[] = {-1.0, 3.0, -3.0, 1.0};
    std::vector<Eigen::Triplet<double>> entries;
    for (std::size_t i = 0; i + 3 < count_; ++i)
      for (std::size_t j = 0; j < 4; ++j)
        for (std::size_t k = 0; k < 4; ++k)
          for (Eigen::Index p = 0; p < kParts; ++p)
            entries.emplace_back(kParts * static_cast<Eigen::Index>(i + j) + p,
                                 kParts * static_cast<Eigen::Index>(i + k) + p,
                                 kStiffness * largest[p] * differences[j] * differences[k]);
    Sparse more(matrix.rows(), matrix.cols());
    more.setFromTriplets(entries.begin(), entries.end());
    matrix += more;
  }

  /// Whether the weights have changed.
  bool weigh() {
    std::vector<double> distances;
    for (const LineTarget& target : targets_) distances.push_back(distance(target));
    std::vector<double> sorted = distances;
    const double scale = std::max(scatter_, median_of(sorted) / kUsual);
    double most = 0.0;
    for (std::size_t k = 0; k < targets_.size(); ++k) {
      const double x = distances[k] / (kFar * scale);
      const double weight = x < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0;
      most = std::max(most, std::fabs(weight - weights_[k]));
      weights_[k] = weight;
    }
    constexpr double kSame = 1e-3;
    return most > kSame;
  }

  LineTurn errors(const RailLine& line, double along) const {
    const LineBasis b = basis_.basis(along);
    const Mat3 axes = line.at(along).rotation;
    const auto error = [&](const Eigen::Vector4d& of_part, const Eigen::Vector4d& by) {
      Eigen::VectorXd row = Eigen::VectorXd::Zero(to_coefficients_.rows());
      for (std::size_t i = 0; i < 4; ++i)
        for (Eigen::Index p = 0; p < kParts; ++p)
          row[kParts * static_cast<Eigen::Index>(b.first + i) + p] = by[static_cast<Eigen::Index>(i)] * of_part[p];
      const Eigen::VectorXd reduced = to_coefficients_.transpose() * row;
      return scatter_ * std::sqrt(std::max(0.0, reduced.dot(solver_.solve(reduced))));
    };
    const auto across = [&](Eigen::Index axis) {
      Eigen::Vector4d out = Eigen::Vector4d::Zero();
      out.head<3>() = axes.col(axis);
      return out;
    };
    return {error(across(1), b.bend), error(across(2), b.bend), error(Eigen::Vector4d::Unit(3), b.slope)};
  }

  std::span<const LineTarget> targets_;
  double from_, scatter_;
  Vec3 up_;
  std::size_t count_;
  double step_;
  Sparse to_coefficients_;
  RailLine basis_;
  std::vector<double> weights_;
  Eigen::VectorXd coefficients_;
  Eigen::SimplicialLDLT<Sparse, Eigen::Lower, Eigen::NaturalOrdering<int>> solver_;
};

}  // namespace

double LineShape::numbers() const {
  if (kind == Kind::straight) return 5.0;   // y and z with their slopes, a roll
  if (kind == Kind::even_bend) return 8.0;  // and bends and a twist
  return 3.0 * static_cast<double>(intervals + 3);
}

LineFit fit_line(std::span<const LineTarget> targets, const LineShape& shape, double from, double to, double scatter,
                 const Vec3& up, std::span<const double> errors_at) {
  constexpr std::size_t kFewest = 3;
  if (targets.size() < kFewest || !(to > from))
    throw Error(ErrorKind::input_data, "too little of the rail was scanned to find its line");
  return Fit(targets, shape, from, to, scatter, up).run(errors_at);
}

}  // namespace treadmark::scans
