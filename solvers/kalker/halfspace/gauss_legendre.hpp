// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>

namespace treadmark::kalker {

/// Nodes and weights of a quadrature rule on -1 .. 1.
struct GaussRule {
  std::span<const double> nodes, weights;
};

inline constexpr int kMostGaussNodes = 16;

/// The Gauss-Legendre rule of 1 <= count <= kMostGaussNodes nodes, kept for the whole run. Thread-safe.
/// Errors: Error(configuration) for other counts.
GaussRule gauss_legendre(int count);

}  // namespace treadmark::kalker
