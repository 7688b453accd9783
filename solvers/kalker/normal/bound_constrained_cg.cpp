// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/bound_constrained_cg.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

namespace {

/// Without a threshold rounding could move an element into the contact and out again for ever.
constexpr double kReleaseShare = 0.01;

/// Sum of term(i) in eight interleaved parts a block: fast, because the additions do not wait for each other, and
/// repeatable.
template <class Term>
double sum_of(std::size_t count, const Term& term) {
  return sum_of_blocks(count, [&](std::size_t begin, std::size_t end) {
    constexpr std::size_t kLanes = 8;
    double lane[kLanes] = {};
    std::size_t i = begin;
    for (; i + kLanes <= end; i += kLanes)
      for (std::size_t k = 0; k < kLanes; ++k) lane[k] += term(i + k);
    for (; i < end; ++i) lane[0] += term(i);
    return ((lane[0] + lane[1]) + (lane[2] + lane[3])) + ((lane[4] + lane[5]) + (lane[6] + lane[7]));
  });
}

double dot(const AlignedVector<double>& a, const AlignedVector<double>& b) {
  const double *x = a.data(), *y = b.data();
  return sum_of(a.size(), [=](std::size_t i) { return x[i] * y[i]; });
}

double sum(std::span<const double> field) {
  return sum_of(field.size(), [x = field.data()](std::size_t i) { return x[i]; });
}

}  // namespace

double BoundConstrainedCg::remove_mean(std::span<double> field) const {
  const double mean = sum(field) / count_;
  const double* inside = inside_.data();
  for_each_element(field.size(), [=, f = field.data()](std::size_t i) { f[i] = inside[i] * (f[i] - mean); });
  return mean;
}

void BoundConstrainedCg::update_displacement(const BoxProblem& problem) {
  problem.op->displacement(p, u);
  ++products;
}

void BoundConstrainedCg::scale_to_sum(const BoxProblem& problem) {
  const double factor = problem.pressure_sum / sum(p);
  for_each_element(p.size(), [=, to = p.data()](std::size_t i) { to[i] *= factor; });
}

void BoundConstrainedCg::start(const BoxProblem& problem) {
  const std::size_t n = p.size();
  for (auto* field : {&u, &inside_, &e_, &r_, &r_previous_, &z_, &v_, &q_}) field->assign(n, 0.0);
  count_ = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    if (problem.gap[i] >= kNeverInContact || !(p[i] > 0.0)) p[i] = 0.0;
    inside_[i] = p[i] > 0.0 ? 1.0 : 0.0;
    count_ += inside_[i];
  }
  if (count_ == 0.0) return;
  if (problem.sum_prescribed) scale_to_sum(problem);
  update_displacement(problem);
  if (problem.sum_prescribed) return;
  // Best multiple of the start values in the sense of the energy.
  double work = 0.0;
  for (std::size_t i = 0; i < n; ++i)
    if (inside_[i] > 0.0) work += p[i] * (approach - problem.gap[i]);
  const double factor = work / dot(p, u);
  if (!(factor > 0.0)) return;
  for (double& value : p) value *= factor;
  for (double& value : u) value *= factor;
}

void BoundConstrainedCg::update_residual(const BoxProblem& problem) {
  if (problem.sum_prescribed) {
    approach = sum_of(p.size(), [in = inside_.data(), h = problem.gap.data(),
                                 w = u.data()](std::size_t i) { return in[i] * (h[i] + w[i]); }) /
               count_;
  }
  for_each_element(p.size(), [e = e_.data(), h = problem.gap.data(), w = u.data(), a = approach](std::size_t i) {
    e[i] = h[i] - a + w[i];
  });
}

double BoundConstrainedCg::negligible_overlap(double eps) const {
  return kReleaseShare * eps * std::sqrt(dot(u, u) / static_cast<double>(u.size()));
}

void BoundConstrainedCg::release(const BoxProblem& problem) {
  const double threshold = -negligible_overlap(problem.eps);
  count_ += sum_of_blocks(p.size(), [&](std::size_t begin, std::size_t end) {
    double more = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      if (inside_[i] > 0.0 || !(e_[i] < threshold)) continue;
      inside_[i] = 1.0;
      more += 1.0;
    }
    return more;
  });
}

bool BoundConstrainedCg::touches_open_side(const BoxProblem& problem) const {
  const int nx = problem.nx, ny = problem.ny;
  const auto inside = [&](int ix, int iy) { return inside_[static_cast<std::size_t>(ix + nx * iy)] > 0.0; };
  for (int iy = 0; iy < ny; ++iy)
    if ((problem.open_left && inside(0, iy)) || (problem.open_right && inside(nx - 1, iy))) return true;
  for (int ix = 0; ix < nx; ++ix)
    if ((problem.open_low && inside(ix, 0)) || (problem.open_high && inside(ix, ny - 1))) return true;
  return false;
}

bool BoundConstrainedCg::clip() {
  const double left = sum_of_blocks(p.size(), [&](std::size_t begin, std::size_t end) {
    double fewer = 0.0;
    for (std::size_t i = begin; i < end; ++i) {
      if (!(p[i] < 0.0)) continue;
      p[i] = 0.0;
      inside_[i] = 0.0;
      fewer += 1.0;
    }
    return fewer;
  });
  count_ -= left;
  return left > 0.0;
}

BoundConstrainedCg::Outcome BoundConstrainedCg::solve(const BoxProblem& problem) {
  start(problem);
  if (problem.sum_prescribed && count_ == 0.0) return Outcome::no_contact;
  bool clipped = false, have_direction = false;
  double zr_previous = 0.0;
  for (int iteration = 0;; ++iteration) {
    check_cancelled();
    update_residual(problem);
    release(problem);
    if (count_ == 0.0) return Outcome::no_contact;
    if (touches_open_side(problem)) return Outcome::box_too_small;

    // Residual in the contact and, from it, an estimate of the error of p.
    const std::size_t n = p.size();
    const double* inside = inside_.data();
    for_each_element(n, [=, r = r_.data(), e = e_.data()](std::size_t i) { r[i] = inside[i] * e[i]; });
    if (problem.sum_prescribed) approach += remove_mean(r_);
    problem.op->precondition(r_, z_);
    ++products;
    for_each_element(n, [=, z = z_.data()](std::size_t i) { z[i] *= inside[i]; });
    if (problem.sum_prescribed) remove_mean(z_);
    const double p_norm = std::sqrt(dot(p, p));
    residual = p_norm > 0.0 ? std::sqrt(dot(z_, z_)) / p_norm : 1.0;
    if (residual <= problem.eps && !clipped) return Outcome::converged;
    if (iteration >= problem.max_iterations) return Outcome::iteration_limit;

    // Polak-Ribiere direction, restricted to the elements in contact now.
    const double zr = dot(z_, r_), zr_old = have_direction ? dot(z_, r_previous_) : 0.0;
    const double beta = have_direction && zr_previous > 0.0 ? std::max(0.0, (zr - zr_old) / zr_previous) : 0.0;
    for_each_element(n, [=, v = v_.data(), z = z_.data()](std::size_t i) { v[i] = inside[i] * (z[i] + beta * v[i]); });
    if (problem.sum_prescribed) remove_mean(v_);
    zr_previous = zr;
    copy_by_blocks(std::span<const double>(r_), std::span<double>(r_previous_));
    have_direction = true;

    problem.op->displacement(v_, q_);
    ++products;
    const double curvature = dot(v_, q_);
    if (!(curvature > 0.0)) return Outcome::iteration_limit;
    const double step = dot(r_, v_) / curvature;
    for_each_element(n, [=, to_p = p.data(), to_u = u.data(), v = v_.data(), q = q_.data()](std::size_t i) {
      to_p[i] -= step * v[i];
      to_u[i] -= step * q[i];
    });
    ++iterations;

    clipped = clip();
    if (clipped) {
      if (problem.sum_prescribed) scale_to_sum(problem);
      update_displacement(problem);
    }
  }
}

}  // namespace treadmark::kalker
