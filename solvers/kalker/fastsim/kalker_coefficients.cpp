// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"

namespace treadmark::kalker {

namespace {

using std::numbers::pi;

/// Values for Poisson's ratio 0, 1/4, 1/2.
using Triple = std::array<double, 3>;

struct Row {
  Triple c11, c22, c23;
};

/// Ratio of the smaller to the larger semi-axis 0.1, 0.2 .. 1.0.
constexpr std::array<Row, 10> kNarrow{{
    // a <= b
    {{2.51, 3.31, 4.85}, {2.51, 2.52, 2.53}, {0.334, 0.473, 0.731}},
    {{2.59, 3.37, 4.81}, {2.59, 2.63, 2.66}, {0.483, 0.603, 0.809}},
    {{2.68, 3.44, 4.80}, {2.68, 2.75, 2.81}, {0.607, 0.715, 0.889}},
    {{2.78, 3.53, 4.82}, {2.78, 2.88, 2.98}, {0.720, 0.823, 0.977}},
    {{2.88, 3.62, 4.83}, {2.88, 3.01, 3.14}, {0.827, 0.929, 1.07}},
    {{2.98, 3.72, 4.91}, {2.98, 3.14, 3.31}, {0.930, 1.03, 1.18}},
    {{3.09, 3.81, 4.97}, {3.09, 3.28, 3.48}, {1.03, 1.14, 1.29}},
    {{3.19, 3.91, 5.05}, {3.19, 3.41, 3.65}, {1.13, 1.25, 1.40}},
    {{3.29, 4.01, 5.12}, {3.29, 3.54, 3.82}, {1.23, 1.36, 1.51}},
    {{3.40, 4.12, 5.20}, {3.40, 3.67, 3.98}, {1.33, 1.47, 1.63}},
}};
constexpr std::array<Row, 10> kLong{{
    // a > b
    {{10.7, 11.7, 12.9}, {10.7, 12.8, 16.0}, {12.2, 14.6, 18.0}},
    {{6.96, 7.78, 8.82}, {6.96, 8.14, 9.79}, {5.72, 6.63, 7.89}},
    {{5.57, 6.34, 7.34}, {5.57, 6.40, 7.51}, {3.79, 4.32, 5.01}},
    {{4.84, 5.57, 6.57}, {4.84, 5.48, 6.31}, {2.88, 3.24, 3.70}},
    {{4.37, 5.10, 6.11}, {4.37, 4.90, 5.56}, {2.35, 2.62, 2.96}},
    {{4.06, 4.78, 5.80}, {4.06, 4.50, 5.04}, {2.01, 2.23, 2.50}},
    {{3.82, 4.54, 5.58}, {3.82, 4.21, 4.67}, {1.76, 1.95, 2.18}},
    {{3.65, 4.36, 5.42}, {3.65, 3.99, 4.39}, {1.58, 1.75, 1.94}},
    {{3.51, 4.22, 5.30}, {3.51, 3.81, 4.16}, {1.44, 1.59, 1.77}},
    {{3.40, 4.12, 5.20}, {3.40, 3.67, 3.98}, {1.33, 1.47, 1.63}},
}};

/// Below this ratio of the semi-axes the asymptotic formulas are used.
constexpr double kLeastTableRatio = 0.101;

KalkerCoefficients asymptotic(bool narrow, double g, double nu) {
  if (narrow)
    return {pi * pi / (4.0 * (1.0 - nu)), pi * pi / 4.0,
            pi * std::sqrt(g) / (3.0 * (1.0 - nu)) * (1.0 + nu * (std::log(16.0 / g) - 5.0))};
  const double l = std::log(16.0 / (g * g)), three = 3.0 - std::log(4.0);
  const double d = (1.0 - nu) * l + 2.0 * nu;
  return {2.0 * pi / ((l - 2.0 * nu) * g) * (1.0 + three / (l - 2.0 * nu)),
          2.0 * pi / (g * d) * (1.0 + (1.0 - nu) * three / d),
          2.0 * pi / (3.0 * g * std::sqrt(g) * ((1.0 - nu) * l - 2.0 + 4.0 * nu))};
}

double interpolate(const Triple& low, const Triple& high, double share, double nu) {
  Triple c;
  for (std::size_t i = 0; i < 3; ++i) c[i] = low[i] + share * (high[i] - low[i]);
  const double compliance =
      8.0 * (nu - 0.25) * (nu - 0.5) / c[0] - 16.0 * nu * (nu - 0.5) / c[1] + 8.0 * nu * (nu - 0.25) / c[2];
  return 1.0 / compliance;
}

}  // namespace

KalkerCoefficients kalker_coefficients(double a, double b, double poisson) {
  if (!(a > 0.0) || !(b > 0.0) || !(poisson >= 0.0 && poisson <= 0.5))
    throw Error(ErrorKind::configuration,
                "Kalker's coefficients need positive semi-axes and Poisson's ratio in 0 .. 0.5");
  const bool narrow = a <= b;
  const double g = narrow ? a / b : b / a;
  if (g < kLeastTableRatio) return asymptotic(narrow, g, poisson);
  const double position = 10.0 * g;
  // Rows count from 1; the offset keeps exact table ratios away from rounding to the row below or above.
  const int row = to_whole<int>(position - 0.005);
  const double share = position - row;
  const auto& table = narrow ? kNarrow : kLong;
  const Row& low = table[static_cast<std::size_t>(row - 1)];
  const Row& high = table[static_cast<std::size_t>(row)];
  return {interpolate(low.c11, high.c11, share, poisson), interpolate(low.c22, high.c22, share, poisson),
          interpolate(low.c23, high.c23, share, poisson)};
}

}  // namespace treadmark::kalker
