// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/measured/noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace treadmark::measured {

namespace {

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double profile_noise(const Profile& p) {
  constexpr std::size_t kFewest = 8;
  constexpr double kNormal = 0.6744897501960817;  // median of the size of a standard normal number
  const std::size_t n = p.y.size();
  if (n < kFewest) return 0.0;
  std::vector<double> s(n, 0.0);
  for (std::size_t i = 1; i < n; ++i) s[i] = s[i - 1] + std::hypot(p.y[i] - p.y[i - 1], p.z[i] - p.z[i - 1]);
  std::vector<double> sizes;
  for (std::size_t i = 0; i + 3 < n; ++i) {
    // a divided difference of third order vanishes for parabolas; its weights say what noise makes of it
    double y = 0.0, z = 0.0, squares = 0.0;
    for (std::size_t j = i; j < i + 4; ++j) {
      double weight = 1.0;
      for (std::size_t k = i; k < i + 4; ++k)
        if (k != j) weight /= (s[j] - s[k]) / (s[i + 3] - s[i]);
      y += weight * p.y[j];
      z += weight * p.z[j];
      squares += weight * weight;
    }
    const double ty = p.y[i + 3] - p.y[i], tz = p.z[i + 3] - p.z[i];
    const double length = std::hypot(ty, tz);
    if (length > 0.0 && std::isfinite(squares) && std::isfinite(y) && std::isfinite(z))
      sizes.push_back(std::fabs(z * ty - y * tz) / (length * std::sqrt(squares)));
  }
  return sizes.empty() ? 0.0 : median_of(sizes) / kNormal;
}

}  // namespace treadmark::measured
