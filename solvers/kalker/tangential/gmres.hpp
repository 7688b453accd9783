// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <span>
#include <vector>

namespace treadmark::kalker {

/// out = operator(in).
using LinearMap = std::function<void(std::span<const double> in, std::span<double> out)>;

struct GmresResult {
  int iterations = 0;
  double residual = 0.0;  ///< relative to the right-hand side
};

/// Right-preconditioned GMRES without restart (Saad and Schultz 1986): matrix * x = b, from x = 0, until the residual
/// has fallen to `tolerance` times |b| or `max_iterations` are done. Memory for the basis is kept between calls.
class Gmres {
 public:
  GmresResult solve(const LinearMap& matrix, const LinearMap& preconditioner, std::span<const double> b,
                    std::span<double> x, double tolerance, int max_iterations);

 private:
  std::vector<std::vector<double>> basis_;
  std::vector<double> work_;
};

}  // namespace treadmark::kalker
