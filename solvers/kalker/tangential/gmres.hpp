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
  double residual = 0.0;  ///< preconditioned, relative to the preconditioned right-hand side
};

/// Norm to which the preconditioned residual has to fall, by that of the preconditioned right-hand side: about the
/// error of x and the size of x.
using GmresTarget = std::function<double(double size)>;

/// Left-preconditioned GMRES without restart (Saad and Schultz 1986): matrix * x = b, from x = 0, until the residual
/// has fallen to the target or `max_iterations` are done. The basis is kept in single precision, for it is most of the
/// memory of a large problem: residuals fall to about 1e-7 of the first one. Memory is kept between calls.
class Gmres {
 public:
  GmresResult solve(const LinearMap& matrix, const LinearMap& preconditioner, std::span<const double> b,
                    std::span<double> x, const GmresTarget& target, int max_iterations);

 private:
  std::vector<std::vector<float>> basis_;
  std::vector<double> image_, next_;
};

}  // namespace treadmark::kalker
