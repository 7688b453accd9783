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
template <class Value>
double dot(std::span<const Value> a, std::span<const double> b) {
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

void add_scaled(std::span<double> y, double factor, std::span<const float> x) {
  for_blocks(y.size(), [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) y[i] += factor * x[i];
  });
}

/// y = x / divisor, rounded.
void divide(std::span<const double> x, double divisor, std::span<float> y) {
  for_each_element(y.size(), [&](std::size_t i) { y[i] = static_cast<float>(x[i] / divisor); });
}

}  // namespace

GmresResult Gmres::solve(const LinearMap& matrix, const LinearMap& preconditioner, std::span<const double> b,
                         std::span<double> x, const GmresTarget& target, int max_iterations) {
  GmresResult result;
  std::fill(x.begin(), x.end(), 0.0);
  if (max_iterations < 1) return result;
  const std::size_t n = b.size();
  const auto vector_at = [&](std::size_t j) -> std::vector<float>& {
    if (basis_.size() <= j) basis_.resize(j + 1);
    basis_[j].resize(n);
    return basis_[j];
  };
  image_.resize(n);
  next_.resize(n);
  const std::span<const double> next = next_;
  std::vector<std::vector<double>> triangle;  // column j has j + 1 entries
  preconditioner(b, next_);
  const double first = std::sqrt(dot(next, next));
  if (!(first > 0.0)) return result;
  const double enough = target(first);
  std::vector<double> cosine, sine, projected{first};
  divide(next, first, vector_at(0));
  std::size_t steps = 0;
  while (static_cast<int>(steps) < max_iterations) {
    check_cancelled();
    // Arnoldi step.
    const std::vector<float>& last = basis_[steps];
    for_each_element(n, [&](std::size_t i) { x[i] = last[i]; });
    matrix(x, image_);
    preconditioner(image_, next_);
    std::vector<double> column(steps + 1);
    for (std::size_t j = 0; j <= steps; ++j) {
      column[j] = dot(std::span<const float>(basis_[j]), next);
      add_scaled(next_, -column[j], basis_[j]);
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
    result.residual = std::abs(projected[steps]) / first;
    if (std::abs(projected[steps]) <= enough || !(length > 0.0)) break;
    divide(next, length, vector_at(steps));
  }
  clear(x);
  if (steps == 0) {
    result.residual = 1.0;
    return result;
  }
  for (std::size_t j = steps; j-- > 0;) {
    for (std::size_t k = j + 1; k < steps; ++k) projected[j] -= triangle[k][j] * projected[k];
    projected[j] /= triangle[j][j];
  }
  for (std::size_t j = 0; j < steps; ++j) add_scaled(x, projected[j], basis_[j]);
  result.iterations = static_cast<int>(steps);
  return result;
}

}  // namespace treadmark::kalker
