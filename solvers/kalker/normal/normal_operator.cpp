// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/normal/normal_operator.hpp"

#include <algorithm>

namespace treadmark::kalker {

namespace {

/// Boxes kept at the same time; a sequence of similar problems needs a handful.
constexpr std::size_t kMaxOperators = 64;

/// Reciprocal of a symmetric positive kernel's spectrum (Vollebregt 2014): the inverse on a periodic grid.
Spectrum reciprocal(const Spectrum& spectrum, double transform_size) {
  double largest = 0.0;
  for (const auto& value : spectrum) largest = std::max(largest, value.real());
  // The periodic continuation of a slowly decaying kernel may leave values near zero; these must not be amplified.
  const double floor = 1e-8 * largest;
  Spectrum result;
  result.reserve(spectrum.size());
  const double scale = 1.0 / (transform_size * transform_size);
  for (const auto& value : spectrum) result.emplace_back(scale / std::max(value.real(), floor));
  return result;
}

}  // namespace

const NormalOperator& NormalOperatorCache::get(int nx, int ny, const ContactProblem& problem) {
  const CombinedMaterial material = combine(problem.material);
  const double dx = problem.grid.dx, dy = problem.grid.dy, poisson = material.poisson, shear_modulus = material.shear_modulus;
  const double sheet = problem.material.sheet_flexibility;
  const std::shared_ptr<const InfluenceKernel> kernel = kernels_.get(problem).unusual();
  const bool other_elements = !table_ || table_->dx() != dx || table_->dy() != dy || table_->poisson() != poisson;
  if (other_elements || shear_modulus_ != shear_modulus || kernel_ != kernel || sheet_ != sheet) operators_.clear();
  if (other_elements) table_.emplace(Component::nn, dx, dy, poisson);
  shear_modulus_ = shear_modulus;
  kernel_ = kernel;
  sheet_ = sheet;
  if (const auto known = operators_.find({nx, ny}); known != operators_.end()) return *known->second;
  if (operators_.size() >= kMaxOperators) operators_.clear();

  auto made = std::make_unique<NormalOperator>(NormalOperator{ToeplitzTransform(nx, ny), {}, {}});
  if (!kernel) table_->grow(made->transform.padded_nx() / 2 + 1, made->transform.padded_ny() / 2 + 1);
  made->influence = made->transform.wrapped_kernel_spectrum([&](int dix, int diy) {
    const double c = kernel ? kernel->at(dix * dx, diy * dy).nn : (*table_)(dix, diy);
    return c / shear_modulus + (dix == 0 && diy == 0 ? sheet : 0.0);
  });
  // of kernels that are not symmetric the even part
  made->preconditioner =
      reciprocal(made->influence, static_cast<double>(made->transform.padded_nx()) * made->transform.padded_ny());
  return *(operators_[{nx, ny}] = std::move(made));
}

}  // namespace treadmark::kalker
