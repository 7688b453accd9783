// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/displacement/offset_field.hpp"

namespace treadmark::displacement {

void OffsetField::evaluate(std::span<const double> u, std::span<const double> y, std::span<double> value,
                           std::span<double> d_u, std::span<double> d_y) const {
  for (std::size_t i = 0; i < u.size(); ++i) {
    const OffsetJet j = jet(u[i], y[i]);
    value[i] = j.value;
    if (!d_u.empty()) d_u[i] = j.d_u;
    if (!d_y.empty()) d_y[i] = j.d_y;
  }
}

}  // namespace treadmark::displacement
