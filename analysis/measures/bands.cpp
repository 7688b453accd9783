// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/bands.hpp"

#include <array>
#include <cmath>
#include <limits>

namespace treadmark::measures {
namespace {

struct Band {
  double nominal;  // [m]
  double limit;    // ISO 3095:2013 [dB re 1 um]; NaN: none
};

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
constexpr Band kBands[] = {{2.0, kNone},   {1.6, kNone},  {1.25, kNone},  {1.0, kNone},    {0.8, kNone},
                           {0.63, kNone},  {0.5, kNone},  {0.4, 17.1},    {0.315, 15.0},   {0.25, 13.0},
                           {0.2, 11.0},    {0.16, 9.0},   {0.125, 7.0},   {0.1, 4.9},      {0.08, 2.9},
                           {0.063, 0.9},   {0.05, -1.1},  {0.04, -3.2},   {0.0315, -5.0},  {0.025, -5.6},
                           {0.02, -6.2},   {0.016, -6.8}, {0.0125, -7.4}, {0.01, -8.0},    {0.008, -8.6},
                           {0.0063, -9.2}, {0.005, -9.8}, {0.004, -10.4}, {0.00315, -11.0}};

}  // namespace

std::span<const double> third_octaves() {
  static const auto all = [] {
    std::array<double, std::size(kBands)> out{};
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = kBands[i].nominal;
    return out;
  }();
  return all;
}

BandEnds ends_of(double nominal) {
  // exact middles are whole powers of 10^(1/10)
  const double middle = std::pow(10.0, std::round(10.0 * std::log10(nominal)) / 10.0), half = std::pow(10.0, 0.05);
  return {middle / half, middle * half};
}

double level_of(double rms) { return 20.0 * std::log10(rms / 1e-6); }

double iso_3095_limit(double nominal) {
  for (const Band& band : kBands)
    if (std::fabs(band.nominal - nominal) < 1e-6) return band.limit;
  return kNone;
}

}  // namespace treadmark::measures
