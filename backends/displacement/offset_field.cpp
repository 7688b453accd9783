// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/offset_field.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace treadmark::displacement {
namespace {

class FieldWithMore final : public OffsetField {
 public:
  FieldWithMore(std::shared_ptr<const OffsetField> whole, std::shared_ptr<const OffsetField> more, double amount)
      : whole_(std::move(whole)), more_(std::move(more)), amount_(amount) {}

  OffsetJet jet(double u, double y) const override {
    OffsetJet sum = whole_ ? whole_->jet(u, y) : OffsetJet{};
    const OffsetJet more = more_->jet(u, y);
    sum.value += amount_ * more.value;
    sum.d_u += amount_ * more.d_u, sum.d_y += amount_ * more.d_y;
    sum.d_uu += amount_ * more.d_uu, sum.d_uy += amount_ * more.d_uy, sum.d_yy += amount_ * more.d_yy;
    return sum;
  }

  void evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value, std::span<double> d_u,
                std::span<double> d_y) const override {
    if (whole_)
      whole_->evaluate(u, y, value, d_u, d_y);
    else
      for (const auto array : {value, d_u, d_y}) std::fill(array.begin(), array.end(), 0.0);
    std::vector<double> more(value.size()), more_u(d_u.size()), more_y(d_y.size());
    more_->evaluate(u, y, more, more_u, more_y);
    const auto add = [&](std::span<double> to, const std::vector<double>& from) {
      for (std::size_t i = 0; i < to.size(); ++i) to[i] += amount_ * from[i];
    };
    add(value, more), add(d_u, more_u), add(d_y, more_y);
  }

  OffsetRange range(const Rectangle& uy) const override {
    OffsetRange sum = whole_ ? whole_->range(uy) : OffsetRange{};
    const OffsetRange more = more_->range(uy);
    const auto [low, high] = std::minmax({amount_ * more.low, amount_ * more.high});
    sum.low += low, sum.high += high;
    sum.max_d_u += std::abs(amount_) * more.max_d_u, sum.max_d_y += std::abs(amount_) * more.max_d_y;
    return sum;
  }

  bool constant_along() const override { return (!whole_ || whole_->constant_along()) && more_->constant_along(); }
  std::size_t memory_bytes() const override {
    return sizeof(*this) + (whole_ ? whole_->memory_bytes() : 0) + more_->memory_bytes();
  }

 private:
  std::shared_ptr<const OffsetField> whole_, more_;
  double amount_;
};

}  // namespace

void OffsetField::evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value,
                           std::span<double> d_u, std::span<double> d_y) const {
  for (std::size_t i = 0; i < u.size(); ++i) {
    const OffsetJet j = jet(u[i], y[i]);
    value[i] = j.value;
    if (!d_u.empty()) d_u[i] = j.d_u;
    if (!d_y.empty()) d_y[i] = j.d_y;
  }
}

void OffsetField::pull_back(double u, double y, double weight, std::span<double> sums) const {
  for (std::size_t k = 0; k < sums.size(); ++k) sums[k] += weight * by(k, u, y);
}

std::shared_ptr<const OffsetField> with_more(std::shared_ptr<const OffsetField> whole,
                                             std::shared_ptr<const OffsetField> more, double amount) {
  return std::make_shared<FieldWithMore>(std::move(whole), std::move(more), amount);
}

}  // namespace treadmark::displacement
