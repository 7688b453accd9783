// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/influence_operator.hpp"

#include <algorithm>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

namespace {

constexpr std::array kCoefficients{&InfluenceBlock::xx, &InfluenceBlock::xy, &InfluenceBlock::xn,
                                   &InfluenceBlock::yx, &InfluenceBlock::yy, &InfluenceBlock::yn,
                                   &InfluenceBlock::nx, &InfluenceBlock::ny, &InfluenceBlock::nn};

double checked(double shear_modulus) {
  if (!(shear_modulus > 0.0))
    throw Error(ErrorKind::configuration, "influence of elements on each other needs a positive shear modulus");
  return shear_modulus;
}

}  // namespace

InfluenceOperator::InfluenceOperator(int nx, int ny, double dx, double dy, double shear_modulus,
                                     std::shared_ptr<const InfluenceKernel> kernel, double shift_x, double shift_y)
    : shear_modulus_(checked(shear_modulus)),
      transform_(nx, ny),
      table_(std::make_shared<BlockTable>(nx, ny, dx, dy, std::move(kernel), shift_x, shift_y)),
      field_1_(transform_.spectrum_size()),
      field_2_(transform_.spectrum_size()),
      sum_(transform_.spectrum_size()) {}

const Spectrum& InfluenceOperator::spectrum(Coefficient coefficient) {
  if (coefficient == &InfluenceBlock::yx && kernel().symmetric()) coefficient = &InfluenceBlock::xy;
  const auto place = std::find(kCoefficients.begin(), kCoefficients.end(), coefficient) - kCoefficients.begin();
  Spectrum& known = spectra_[static_cast<std::size_t>(place)];
  if (known.empty())
    known = transform_.kernel_spectrum([&](int dix, int diy) { return at(dix, diy).*coefficient / shear_modulus_; });
  return known;
}

void InfluenceOperator::invert(Coefficient first, Coefficient second, std::span<double> result) {
  clear(std::span(sum_));
  add_product(sum_, field_1_, spectrum(first));
  if (second) add_product(sum_, field_2_, spectrum(second));
  transform_.inverse(sum_, result);
}

TurnedProduct& InfluenceOperator::turned() {
  if (!turned_)
    turned_.emplace(
        transform_, [table = table_, g = shear_modulus_](int dix, int diy) { return divided(table->at(dix, diy), g); },
        kernel().coupled());
  return *turned_;
}

void InfluenceOperator::tangential_by_tangential(std::span<const double> px, std::span<const double> py,
                                                 std::span<double> ux, std::span<double> uy,
                                                 const RowInclination* rows) {
  if (rows) return turned().apply(*rows, {.x = px, .y = py, .n = {}}, {.x = ux, .y = uy, .n = {}});
  transform_.forward(px, field_1_);
  transform_.forward(py, field_2_);
  invert(&InfluenceBlock::xx, &InfluenceBlock::xy, ux);
  invert(&InfluenceBlock::yx, &InfluenceBlock::yy, uy);
}

void InfluenceOperator::tangential_by_tangential(std::span<InfluenceOperator* const> nodes,
                                                 std::span<const double> weights, std::span<const double> px,
                                                 std::span<const double> py, std::span<double> ux,
                                                 std::span<double> uy) {
  InfluenceOperator& own = *nodes.front();
  own.transform_.forward(px, own.field_1_);
  own.transform_.forward(py, own.field_2_);
  const auto inverse = [&](Coefficient by_x, Coefficient by_y, std::span<double> result) {
    clear(std::span(own.sum_));
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      add_product(own.sum_, own.field_1_, nodes[k]->spectrum(by_x), weights[k]);
      add_product(own.sum_, own.field_2_, nodes[k]->spectrum(by_y), weights[k]);
    }
    own.transform_.inverse(own.sum_, result);
  };
  inverse(&InfluenceBlock::xx, &InfluenceBlock::xy, ux);
  inverse(&InfluenceBlock::yx, &InfluenceBlock::yy, uy);
}

void InfluenceOperator::tangential_by_normal(std::span<const double> pn, std::span<double> ux, std::span<double> uy,
                                             const RowInclination* rows) {
  if (rows) return turned().apply(*rows, {.x = {}, .y = {}, .n = pn}, {.x = ux, .y = uy, .n = {}});
  if (!coupled({pn.size(), ux.size(), uy.size()})) {
    std::fill(ux.begin(), ux.end(), 0.0);
    std::fill(uy.begin(), uy.end(), 0.0);
    return;
  }
  transform_.forward(pn, field_1_);
  invert(&InfluenceBlock::xn, nullptr, ux);
  invert(&InfluenceBlock::yn, nullptr, uy);
}

void InfluenceOperator::normal_by_tangential(std::span<const double> px, std::span<const double> py,
                                             std::span<double> un, const RowInclination* rows) {
  if (rows) return turned().apply(*rows, {.x = px, .y = py, .n = {}}, {.x = {}, .y = {}, .n = un});
  if (!coupled({px.size(), py.size(), un.size()})) return std::fill(un.begin(), un.end(), 0.0);
  transform_.forward(px, field_1_);
  transform_.forward(py, field_2_);
  invert(&InfluenceBlock::nx, &InfluenceBlock::ny, un);
}

void InfluenceOperator::normal_by_normal(std::span<const double> pn, std::span<double> un, const RowInclination* rows) {
  if (rows) return turned().apply(*rows, {.x = {}, .y = {}, .n = pn}, {.x = {}, .y = {}, .n = un});
  transform_.convolve(spectrum(&InfluenceBlock::nn), pn, un);
}

bool InfluenceOperator::coupled(std::initializer_list<std::size_t> sizes) const {
  for (const std::size_t given : sizes)
    if (given != size())
      throw Error(ErrorKind::configuration,
                  "a box of " + std::to_string(size()) + " elements was given " + std::to_string(given) + " values");
  return kernel().coupled();
}

}  // namespace treadmark::kalker
