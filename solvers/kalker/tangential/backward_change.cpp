// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/backward_change.hpp"

#include <algorithm>

#include "treadmark/solvers/kalker/tangential/friction_newton.hpp"

namespace treadmark::kalker {

namespace {

constexpr double kOfOneRound = 1e-5, kSmallCorrection = 1e-8;
constexpr int kMostRefinements = 8, kMostOfOneRound = 200;

/// The patch that rolls the other way: its elements in reverse order.
Patch turned_round(const Patch& patch) {
  Patch out = patch;
  if (patch.transport != Transport::none)
    out.transport = patch.transport == Transport::forward ? Transport::backward : Transport::forward;
  std::reverse(out.column.begin(), out.column.end());
  std::reverse(out.row.begin(), out.row.end());
  std::reverse(out.cell.begin(), out.cell.end());
  std::fill(out.ahead.begin(), out.ahead.end(), -1);
  for (int i = 0; i < patch.size(); ++i)
    if (const int ahead = patch.ahead[static_cast<std::size_t>(i)]; ahead >= 0)
      out.ahead[static_cast<std::size_t>(patch.size() - 1 - ahead)] = patch.size() - 1 - i;
  return out;
}

template <class Field>
void reverse_elements(Field& field, std::size_t components) {
  const auto n = static_cast<std::ptrdiff_t>(field.size() / components);
  for (auto begin = field.begin(); begin != field.end(); begin += n) std::reverse(begin, begin + n);
}

}  // namespace

/// With S = W + A p the transposed of A, whose coefficients are symmetric, is that of rolling the other way; the rest
/// of the linearised equations is symmetric.
BackwardChange backward_change(const Patch& patch, Compliance& compliance, std::vector<double> bound,
                               FrictionState state, Field2 by_traction, Field2 by_slip) {
  const Patch back = turned_round(patch);
  const std::size_t n = bound.size();
  for (Field2* field : {&state.traction, &state.slip, &state.direction, &by_traction, &by_slip})
    reverse_elements(*field, 2);
  reverse_elements(state.slipping, 1);
  reverse_elements(state.excess, 1);
  reverse_elements(bound, 1);
  PatchOperator matrix(back, compliance);
  FrictionProblem problem;
  problem.matrix = &matrix;
  problem.bound = std::move(bound);

  BackwardChange out;
  Field2 image(2 * n), left(2 * n);
  matrix.slip(by_slip, image);
  for (std::size_t k = 0; k < 2 * n; ++k) by_traction[k] += image[k];
  Field2 change(2 * n, 0.0);
  left = by_traction;
  FrictionNewton newton;
  for (int round = 0; round < kMostRefinements && !out.converged; ++round) {
    const Field2 more = newton.sensitivity(problem, state, left, {}, kOfOneRound, kMostOfOneRound);
    for (std::size_t k = 0; k < 2 * n; ++k) change[k] += more[k];
    matrix.slip(change, image);
    for (std::size_t i = 0; i < n; ++i) {
      const double stiffness =
          state.slipping[i] && problem.bound[i] > 0.0 ? state.excess[i] / problem.bound[i] * matrix.diagonal() : 0.0;
      for (const std::size_t k : {i, n + i}) left[k] = by_traction[k] + image[k] + stiffness * change[k];
    }
    const double size = rms(change);
    out.residual = size > 0.0 ? rms(more) / size : 0.0;
    out.converged = out.residual <= kSmallCorrection;
    ++out.products;
  }
  out.products += newton.sensitivity_products();
  out.by_rigid_slip = std::move(by_slip);
  out.by_bound.assign(n, 0.0);
  for (std::size_t i = 0; i < n; ++i) {
    for (const std::size_t k : {i, n + i}) out.by_rigid_slip[k] += change[k];
    if (state.slipping[i])
      out.by_bound[i] = state.direction[i] * (by_traction[i] + image[i]) +
                        state.direction[n + i] * (by_traction[n + i] + image[n + i]);
  }
  reverse_elements(out.by_rigid_slip, 2);
  reverse_elements(out.by_bound, 1);
  return out;
}

}  // namespace treadmark::kalker
