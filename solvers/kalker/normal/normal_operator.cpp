// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

#include <algorithm>

#include "treadmark/solvers/kalker/halfspace/block_table.hpp"

namespace treadmark::kalker {

namespace {

/// Boxes kept at the same time; a sequence of similar problems needs a handful.
constexpr std::size_t kMaxOperators = 64;

/// Reciprocal of a symmetric positive kernel's symbol (Vollebregt 2014): the inverse on a periodic grid.
std::vector<double> reciprocal(std::vector<double> symbol, const RealFft2d& ring) {
  // The periodic continuation of a slowly decaying kernel may leave values near zero; these must not be amplified.
  const double floor = 1e-8 * *std::max_element(symbol.begin(), symbol.end());
  const double size = static_cast<double>(ring.nx()) * ring.ny(), scale = 1.0 / (size * size);
  for (double& value : symbol) value = scale / std::max(value, floor);
  return symbol;
}

}  // namespace

NormalOperator NormalOperatorCache::get(int nx, int ny, int first_row, const ContactProblem& problem) {
  const CombinedMaterial material = combine(problem.material);
  const double dx = problem.grid.dx, dy = problem.grid.dy, poisson = material.poisson,
               shear_modulus = material.shear_modulus;
  const double sheet = problem.material.sheet_flexibility;
  const KernelChoice choice = kernels_.get(problem);
  const std::shared_ptr<const InfluenceKernel> kernel = choice.unusual();
  const bool turned = choice.inclination != nullptr;
  const bool other_elements = !table_ || table_->dx() != dx || table_->dy() != dy || table_->poisson() != poisson;
  if (other_elements || shear_modulus_ != shear_modulus || kernel_ != kernel || sheet_ != sheet || turned_ != turned)
    operators_.clear();
  if (other_elements) table_.emplace(Component::nn, dx, dy, poisson);
  shear_modulus_ = shear_modulus;
  kernel_ = kernel;
  sheet_ = sheet;
  turned_ = turned;
  auto known = operators_.find({nx, ny});
  if (known == operators_.end()) {
    if (operators_.size() >= kMaxOperators) operators_.clear();
    known = operators_.emplace(std::pair{nx, ny}, make(nx, ny)).first;
  }
  return {known->second, choice.rows(problem.grid, first_row, ny)};
}

const InfluenceTable* NormalOperatorCache::half_spaces(int nx, int ny) {
  if (kernel_ || !table_) return nullptr;
  table_->grow(nx, ny);
  return &*table_;
}

std::shared_ptr<NormalInfluence> NormalOperatorCache::make(int nx, int ny) {
  const double dx = table_->dx(), dy = table_->dy();
  auto made =
      std::make_shared<NormalInfluence>(NormalInfluence{ToeplitzTransform(nx, ny), {}, {}, ring_about(nx, ny), {}, {}});
  std::shared_ptr<BlockTable> blocks;
  if (kernel_) {
    blocks = std::make_shared<BlockTable>(std::max(nx, made->ring.nx() / 2 + 1), ny, dx, dy, kernel_);
    blocks->at(0, 0);  // filled before threads ask
  }
  const auto coefficient = [&](int dix, int diy) {
    const double c = blocks ? blocks->at(dix, diy).nn : (*table_)(dix, diy);
    return c / shear_modulus_ + (dix == 0 && diy == 0 ? sheet_ : 0.0);
  };
  if (kernel_) {
    made->influence = made->transform.kernel_spectrum(coefficient);
  } else {
    // the ring of a single column is larger than its padded box
    table_->grow(std::max(made->transform.padded_nx(), made->ring.nx()) / 2 + 1, ny);
    made->symbol = even_symbol(made->transform.fft(), coefficient);
  }
  // of kernels that are not symmetric what is even in both directions
  const auto even = [&](int dix, int diy) {
    if (!kernel_) return coefficient(dix, diy);
    return 0.25 * (coefficient(dix, diy) + coefficient(-dix, diy) + coefficient(dix, -diy) + coefficient(-dix, -diy));
  };
  made->inverse_symbol = reciprocal(even_symbol(made->ring, even), made->ring);
  if (turned_)
    made->turned.emplace(
        made->transform,
        [blocks, g = shear_modulus_, sheet = sheet_](int dix, int diy) {
          InfluenceBlock block = divided(blocks->at(dix, diy), g);
          if (dix == 0 && diy == 0) block.nn += sheet;
          return block;
        },
        kernel_->coupled());
  return made;
}

}  // namespace treadmark::kalker
