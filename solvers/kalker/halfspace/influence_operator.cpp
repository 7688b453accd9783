// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/influence_operator.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "treadmark/core/error.hpp"

namespace treadmark::kalker {

namespace {

constexpr std::array kCoefficients{&InfluenceBlock::xx, &InfluenceBlock::xy, &InfluenceBlock::xn,
                                   &InfluenceBlock::yx, &InfluenceBlock::yy, &InfluenceBlock::yn,
                                   &InfluenceBlock::nx, &InfluenceBlock::ny, &InfluenceBlock::nn};

/// sum += field * factor. On plain numbers, see multiply().
void add_product(Spectrum& sum, const Spectrum& field, const Spectrum& factor) {
  double* __restrict s = reinterpret_cast<double*>(sum.data());
  const double* __restrict a = reinterpret_cast<const double*>(field.data());
  const double* __restrict b = reinterpret_cast<const double*>(factor.data());
  for (std::size_t k = 0; k < 2 * sum.size(); k += 2) {
    s[k] += a[k] * b[k] - a[k + 1] * b[k + 1];
    s[k + 1] += a[k] * b[k + 1] + a[k + 1] * b[k];
  }
}

std::shared_ptr<const InfluenceKernel> checked(std::shared_ptr<const InfluenceKernel> kernel, double dx, double dy, double modulus) {
  if (!kernel) throw Error(ErrorKind::configuration, "influence of elements on each other needs a kernel");
  if (!(dx > 0.0 && dy > 0.0 && modulus > 0.0))
    throw Error(ErrorKind::configuration, "influence of elements on each other needs positive element sizes and shear modulus");
  return kernel;
}

}  // namespace

InfluenceOperator::InfluenceOperator(int nx, int ny, double dx, double dy, double shear_modulus,
                                     std::shared_ptr<const InfluenceKernel> kernel, double shift_x, double shift_y)
    : dx_(dx), dy_(dy), shear_modulus_(shear_modulus), shift_x_(shift_x), shift_y_(shift_y),
      kernel_(checked(std::move(kernel), dx, dy, shear_modulus)), transform_(nx, ny),
      fold_x_(kernel_->symmetric() && shift_x == 0.0), fold_y_(kernel_->symmetric_in_y() && shift_y == 0.0),
      field_1_(transform_.spectrum_size()), field_2_(transform_.spectrum_size()), sum_(transform_.spectrum_size()) {}

void InfluenceOperator::make_table() {
  const int first_x = fold_x_ ? 0 : 1 - nx(), first_y = fold_y_ ? 0 : 1 - ny();
  table_.reserve(static_cast<std::size_t>(nx() - first_x) * static_cast<std::size_t>(ny() - first_y));
  for (int diy = first_y; diy < ny(); ++diy)
    for (int dix = first_x; dix < nx(); ++dix) table_.push_back(kernel_->at(dix * dx_ + shift_x_, diy * dy_ + shift_y_));
}

InfluenceBlock InfluenceOperator::at(int dix, int diy) {
  if (std::abs(dix) >= nx() || std::abs(diy) >= ny())
    throw Error(ErrorKind::configuration, "no two elements of the box are " + std::to_string(dix) + ", " + std::to_string(diy) + " apart");
  if (table_.empty()) make_table();
  const int columns = fold_x_ ? nx() : 2 * nx() - 1;
  const int column = fold_x_ ? std::abs(dix) : dix + nx() - 1, row = fold_y_ ? std::abs(diy) : diy + ny() - 1;
  const auto index = static_cast<std::size_t>(row) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(column);
  return mirrored(table_[index], fold_x_ && dix < 0, fold_y_ && diy < 0);
}

const Spectrum& InfluenceOperator::spectrum(Coefficient coefficient) {
  if (coefficient == &InfluenceBlock::yx && kernel_->symmetric()) coefficient = &InfluenceBlock::xy;
  const auto place = std::find(kCoefficients.begin(), kCoefficients.end(), coefficient) - kCoefficients.begin();
  Spectrum& known = spectra_[static_cast<std::size_t>(place)];
  if (known.empty())
    known = transform_.kernel_spectrum([&](int dix, int diy) { return at(dix, diy).*coefficient / shear_modulus_; });
  return known;
}

void InfluenceOperator::invert(Coefficient first, Coefficient second, std::span<double> result) {
  std::fill(sum_.begin(), sum_.end(), 0.0);
  add_product(sum_, field_1_, spectrum(first));
  if (second) add_product(sum_, field_2_, spectrum(second));
  transform_.inverse(sum_, result);
}

void InfluenceOperator::tangential_by_tangential(std::span<const double> px, std::span<const double> py, std::span<double> ux,
                                                 std::span<double> uy) {
  transform_.forward(px, field_1_);
  transform_.forward(py, field_2_);
  invert(&InfluenceBlock::xx, &InfluenceBlock::xy, ux);
  invert(&InfluenceBlock::yx, &InfluenceBlock::yy, uy);
}

void InfluenceOperator::tangential_by_normal(std::span<const double> pn, std::span<double> ux, std::span<double> uy) {
  if (!coupled({pn.size(), ux.size(), uy.size()})) {
    std::fill(ux.begin(), ux.end(), 0.0);
    std::fill(uy.begin(), uy.end(), 0.0);
    return;
  }
  transform_.forward(pn, field_1_);
  invert(&InfluenceBlock::xn, nullptr, ux);
  invert(&InfluenceBlock::yn, nullptr, uy);
}

void InfluenceOperator::normal_by_tangential(std::span<const double> px, std::span<const double> py, std::span<double> un) {
  if (!coupled({px.size(), py.size(), un.size()})) return std::fill(un.begin(), un.end(), 0.0);
  transform_.forward(px, field_1_);
  transform_.forward(py, field_2_);
  invert(&InfluenceBlock::nx, &InfluenceBlock::ny, un);
}

void InfluenceOperator::normal_by_normal(std::span<const double> pn, std::span<double> un) {
  transform_.convolve(spectrum(&InfluenceBlock::nn), pn, un);
}

bool InfluenceOperator::coupled(std::initializer_list<std::size_t> sizes) const {
  for (const std::size_t given : sizes)
    if (given != size())
      throw Error(ErrorKind::configuration,
                  "a box of " + std::to_string(size()) + " elements was given " + std::to_string(given) + " values");
  return kernel_->coupled();
}

}  // namespace treadmark::kalker
