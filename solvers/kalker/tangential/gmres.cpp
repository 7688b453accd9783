// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/gmres.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

namespace {

/// Four partial sums a block, so that the loop is not bound by the latency of one addition. Fixed order: repeatable.
double dot(std::span<const double> a, std::span<const double> b) {
  return sum_of_blocks(a.size(), [&](std::size_t begin, std::size_t end) {
    double s0 = 0.0, s1 = 0.0, s2 = 0.0, s3 = 0.0;
    std::size_t i = begin;
    for (; i + 4 <= end; i += 4) {
      s0 += a[i] * b[i];
      s1 += a[i + 1] * b[i + 1];
      s2 += a[i + 2] * b[i + 2];
      s3 += a[i + 3] * b[i + 3];
    }
    for (; i < end; ++i) s0 += a[i] * b[i];
    return (s0 + s1) + (s2 + s3);
  });
}

void add_scaled(std::span<double> y, double factor, std::span<const double> x) {
  for_blocks(y.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) y[i] += factor * x[i];
  });
}

/// y = x / divisor; both may be the same.
void divide(std::span<const double> x, double divisor, std::span<double> y) {
  for_blocks(y.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) y[i] = x[i] / divisor;
  });
}

}  // namespace

GmresResult Gmres::solve(const LinearMap& matrix, const LinearMap& preconditioner, std::span<const double> b,
                         std::span<double> x, double tolerance, int max_iterations) {
  GmresResult result;
  std::fill(x.begin(), x.end(), 0.0);
  const double b_norm = std::sqrt(dot(b, b));
  if (!(b_norm > 0.0) || max_iterations < 1) return result;

  const auto vector_at = [&](std::size_t j) -> std::vector<double>& {
    if (basis_.size() <= j) basis_.resize(j + 1);
    basis_[j].resize(b.size());
    return basis_[j];
  };
  std::vector<std::vector<double>> triangle;  // column j has j + 1 entries
  std::vector<double> cosine, sine, projected{b_norm};
  work_.resize(b.size());
  divide(b, b_norm, vector_at(0));
  std::size_t steps = 0;
  while (static_cast<int>(steps) < max_iterations) {
    check_cancelled();
    // Arnoldi step.
    std::vector<double>& next = vector_at(steps + 1);
    preconditioner(basis_[steps], work_);
    matrix(work_, next);
    std::vector<double> column(steps + 1);
    for (std::size_t j = 0; j <= steps; ++j) {
      column[j] = dot(basis_[j], next);
      add_scaled(next, -column[j], basis_[j]);
    }
    const double length = std::sqrt(dot(next, next));
    // Givens rotations turn the Hessenberg matrix into a triangle.
    for (std::size_t j = 0; j < steps; ++j) {
      const double upper = cosine[j] * column[j] + sine[j] * column[j + 1];
      column[j + 1] = cosine[j] * column[j + 1] - sine[j] * column[j];
      column[j] = upper;
    }
    const double radius = std::hypot(column[steps], length);
    if (!(radius > 0.0)) break;  // singular: no further progress possible
    cosine.push_back(column[steps] / radius);
    sine.push_back(length / radius);
    column[steps] = radius;
    triangle.push_back(std::move(column));
    projected.push_back(-sine[steps] * projected[steps]);
    projected[steps] *= cosine[steps];
    ++steps;
    result.residual = std::abs(projected[steps]) / b_norm;
    if (result.residual <= tolerance || !(length > 0.0)) break;
    divide(next, length, next);
  }
  if (steps == 0) {
    result.residual = 1.0;
    return result;
  }
  for (std::size_t j = steps; j-- > 0;) {
    for (std::size_t k = j + 1; k < steps; ++k) projected[j] -= triangle[k][j] * projected[k];
    projected[j] /= triangle[j][j];
  }
  clear(std::span(work_));
  for (std::size_t j = 0; j < steps; ++j) add_scaled(work_, projected[j], basis_[j]);
  preconditioner(work_, x);
  result.iterations = static_cast<int>(steps);
  return result;
}

}  // namespace treadmark::kalker
