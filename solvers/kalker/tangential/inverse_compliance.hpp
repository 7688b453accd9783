// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"

namespace treadmark::kalker {

/// Influence of both traction components on both displacements at one offset: symmetric, [m/Pa]; or its inverse.
struct ComplianceBlock {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

using ComplianceKernel = std::function<ComplianceBlock(int dix, int diy)>;

/// Transform of a kernel that is the same at opposite offsets (hence real), on the ring of elements of `fft`, divided
/// by their number. Offsets beyond the active rows of `fft` count as zero; the part that is odd in either direction
/// vanishes half-way round.
std::vector<ComplianceBlock> ring_symbol(const ComplianceKernel& kernel, const RealFft2d& fft);

/// Tractions that cause given displacements in a box of elements, if the box were repeated without end: a cheap
/// approximate inverse, because the exact one decays fast with the distance. Not thread-safe.
class InverseCompliance {
 public:
  InverseCompliance(int nx, int ny, const ComplianceKernel& kernel);

  void apply(std::span<const double> ux, std::span<const double> uy, std::span<double> px, std::span<double> py);

 private:
  void load(std::span<const double> field, Spectrum& spectrum);
  void unload(Spectrum& spectrum, std::span<double> field);

  int nx_, ny_;
  RealFft2d fft_;
  std::vector<ComplianceBlock> symbol_;
  AlignedVector<double> ring_;
  Spectrum spectrum_x_, spectrum_y_;
};

}  // namespace treadmark::kalker
