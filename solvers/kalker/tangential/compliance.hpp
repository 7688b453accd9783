// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/solvers/kalker/halfspace/block_table.hpp"
#include "treadmark/solvers/kalker/halfspace/influence.hpp"
#include "treadmark/solvers/kalker/halfspace/toeplitz_operator.hpp"
#include "treadmark/solvers/kalker/halfspace/turned_product.hpp"

namespace treadmark::kalker {

/// Influence of both traction components on both displacements at one offset: symmetric, [m/Pa]; or its inverse.
struct ComplianceBlock {
  double xx = 0.0, xy = 0.0, yy = 0.0;
};

using ComplianceKernel = std::function<ComplianceBlock(int dix, int diy)>;

/// even_symbol of each component: the one that is odd in both directions vanishes half-way round.
std::vector<ComplianceBlock> ring_symbol(const ComplianceKernel& kernel, const RealFft2d& fft);

/// Tractions that cause given displacements in a box of elements, if the box were repeated without end: a cheap
/// approximate inverse, because the exact one decays fast with the distance. Not thread-safe.
class InverseCompliance {
 public:
  InverseCompliance(int nx, int ny, const ComplianceKernel& kernel);

  void apply(std::span<const double> ux, std::span<const double> uy, std::span<double> px, std::span<double> py);

 private:
  int nx_;
  RealFft2d fft_;
  std::vector<ComplianceBlock> symbol_;
};

/// Where the tractions were one step ago, seen from the contact: rolling carries the material by one element a step.
enum class Transport {
  none,      ///< no history: displacements count in full
  forward,   ///< rolling in +x: the element ahead has the higher x index
  backward,  ///< rolling in -x
};

/// What determines the coefficients of a box of elements. Kernels are the same if they are the same object.
struct ComplianceKey {
  int nx = 0, ny = 0;         ///< elements of the box
  double dx = 0.0, dy = 0.0;  ///< [m]
  double poisson = 0.0, shear_modulus = 0.0;
  double layer = 0.0;                             ///< flexibility of a thin elastic layer [m/Pa]
  std::shared_ptr<const InfluenceKernel> kernel;  ///< none: constant elements on half-spaces
  friend bool operator==(const ComplianceKey&, const ComplianceKey&) = default;
};

/// Tangential displacements of a box of elements under tangential tractions, both components: u = B p, with
/// B = C/G + layer. A step of steady rolling changes the displacement of a particle by u(x) - u(x + dx) = B (p -
/// p_ahead), which is B times a difference along the row, so that all products need the same three transforms. Fields
/// are nx * ny values each [Pa], [m]. Not thread-safe: work arrays are members.
class Compliance {
 public:
  /// known: coefficients of elements of this size, which others may use too; without, its own.
  explicit Compliance(const ComplianceKey& key, UncoupledTable* known = nullptr);
  Compliance(const Compliance&) = delete;
  Compliance& operator=(const Compliance&) = delete;

  const ComplianceKey& key() const { return key_; }
  std::size_t size() const { return transform_.size(); }

  /// Displacement (none) or its change in a step of rolling. rows: inclinations by which the coefficients, then those
  /// of half-spaces, are turned from row to row, or none.
  void apply(Transport transport, std::span<const double> px, std::span<const double> py, std::span<double> ux,
             std::span<double> uy, const RowInclination* rows = nullptr);
  /// Approximately the p with B p = u, no matter how rows are turned.
  InverseCompliance& inverse() { return *inverse_; }

  struct Entry {
    double xx = 0.0, xy = 0.0, yx = 0.0, yy = 0.0;  ///< displacement by traction
  };
  /// Coefficients at an offset "observation minus source", |dix| <= nx, |diy| < ny [m/Pa].
  Entry at(int dix, int diy) const;
  /// The same between a loaded and an observed row of the box that are turned.
  Entry at(int dix, int loaded_row, int observed_row, const RowInclination& rows);

 private:
  using Block = ComplianceBlock;
  bool symmetric() const { return key_.kernel == nullptr || key_.kernel->symmetric(); }
  void tabulate(UncoupledTable* known);
  Entry wide_at(int dix, int diy) const;
  InfluenceBlock half_space_at(int dix, int diy);
  void apply_turned(const RowInclination& rows, Transport transport, std::span<const double> px,
                    std::span<const double> py, std::span<double> ux, std::span<double> uy);

  ComplianceKey key_;
  ToeplitzTransform transform_;
  std::vector<Entry> table_;       ///< offsets 0..padded_nx/2, 0..padded_ny/2; all signs unless symmetric
  std::vector<Block> symbol_;      ///< symmetric kernels
  std::vector<Spectrum> spectra_;  ///< others: xx, xy, yx, yy, in lines of the transform
  std::vector<std::complex<double>> step_, step_back_;  ///< 1 - exp(+-2 pi i k / padded_nx)
  std::optional<BlockTable> half_space_;                ///< all components, for rows that are turned; made when needed
  std::optional<TurnedProduct> turned_;
  std::optional<InverseCompliance> inverse_;
};

}  // namespace treadmark::kalker
