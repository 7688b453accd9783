// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/section_offsets.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::displacement {
namespace {

/// B-splines, so that their coefficients bound values and slopes (de Boor 1978).
class SectionOffsets final : public OffsetField {
 public:
  SectionOffsets(double first, double step, std::vector<double> values) : first_(first), step_(step) {
    const std::size_t n = values.size();
    // c[k] + 4 c[k + 1] + c[k + 2] = 6 values[k], without curvature at the ends
    c_.assign(n + 2, 0.0);
    std::vector<double> factor(n, 0.0);
    c_[1] = values.front();
    for (std::size_t k = 1; k + 1 < n; ++k) {
      factor[k] = 1.0 / (4.0 - factor[k - 1]);
      c_[k + 1] = (6.0 * values[k] - c_[k]) * factor[k];
    }
    c_[n] = values.back();
    for (std::size_t k = n - 1; k-- > 1;) c_[k + 1] -= factor[k] * c_[k + 2];
    c_[0] = 2.0 * c_[1] - c_[2];
    c_[n + 1] = 2.0 * c_[n] - c_[n - 1];
  }

  OffsetJet jet(double, double y) const override {
    const double x = (y - first_) / step_, last = static_cast<double>(c_.size() - 3);
    const double at = x > 0.0 ? std::min(x, last) : 0.0, cell = std::min(std::floor(at), last - 1.0);
    const double t = at - cell, u = 1.0 - t;
    const double* c = c_.data() + to_whole<std::size_t>(cell);
    OffsetJet out;
    out.value = (u * u * u * c[0] + (3.0 * t * t * t - 6.0 * t * t + 4.0) * c[1] +
                 (-3.0 * t * t * t + 3.0 * t * t + 3.0 * t + 1.0) * c[2] + t * t * t * c[3]) /
                6.0;
    if (x != at) return out;
    out.d_y = (-u * u * c[0] + (3.0 * t * t - 4.0 * t) * c[1] + (-3.0 * t * t + 2.0 * t + 1.0) * c[2] + t * t * c[3]) /
              (2.0 * step_);
    out.d_yy = (u * c[0] + (3.0 * t - 2.0) * c[1] + (1.0 - 3.0 * t) * c[2] + t * c[3]) / (step_ * step_);
    return out;
  }

  OffsetRange range(const Rectangle& uy) const override {
    const double last = static_cast<double>(c_.size() - 3);
    const auto cell = [&](double y) {
      const double x = (y - first_) / step_;
      return to_whole<std::size_t>(x > 0.0 ? std::min(std::floor(x), last - 1.0) : 0.0);
    };
    const auto from = c_.begin() + static_cast<std::ptrdiff_t>(cell(uy.y_min)),
               to = c_.begin() + static_cast<std::ptrdiff_t>(cell(uy.y_max)) + 4;
    const auto [low, high] = std::minmax_element(from, to);
    OffsetRange out{*low, *high, 0.0, 0.0};
    for (auto k = from; k + 1 != to; ++k) out.max_d_y = std::max(out.max_d_y, std::abs(k[1] - k[0]) / step_);
    return out;
  }

  bool constant_along() const override { return true; }
  std::size_t memory_bytes() const override { return sizeof(*this) + c_.size() * sizeof(double); }

 private:
  double first_, step_;
  std::vector<double> c_;  ///< of the B-splines, one beyond each end
};

}  // namespace

std::shared_ptr<const OffsetField> section_offsets(double first, double step, std::vector<double> values) {
  if (values.size() < 2 || !(step > 0.0) || !std::isfinite(first + step))
    throw Error(ErrorKind::configuration, "offsets across a section need two places and a positive step");
  return std::make_shared<SectionOffsets>(first, step, std::move(values));
}

}  // namespace treadmark::displacement
