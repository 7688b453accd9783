// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/analysis/measures/comfort.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/analysis/measures/signal.hpp"
#include "treadmark/core/constants.hpp"

namespace treadmark::measures {
namespace {

constexpr TransitionDiscomfort kDiscomforts[] = {{"P_CT_standing", 0.2854, 0.2069, 0.111, 3.64, 2.283},
                                                 {"P_CT_seated", 0.0897, 0.0968, 0.059, 0.916, 1.626}};

}  // namespace

std::vector<double> window_rms(std::span<const double> values, std::size_t samples) {
  std::vector<double> out;
  for (std::size_t first = 0; first + samples <= values.size(); first += samples)
    out.push_back(rms_of(values.subspan(first, samples)));
  return out;
}

std::vector<double> centred_means(std::span<const double> values, std::size_t samples) {
  std::vector<double> out(values.size(), kNaN);
  const std::size_t half = samples / 2;
  double sum = 0.0;
  for (std::size_t end = 0; end < values.size(); ++end) {
    sum += values[end];
    if (end >= samples) sum -= values[end - samples];
    if (end + 1 >= samples) out[end + 1 - half] = sum / static_cast<double>(samples);
  }
  return out;
}

double mean_comfort(double longitudinal, double lateral, double vertical) {
  return 6.0 * std::sqrt(longitudinal * longitudinal + lateral * lateral + vertical * vertical);
}

double TransitionDiscomfort::percentage(const TransitionMotion& motion) const {
  constexpr double kPercent = 100.0;
  const double sideways = by_acceleration * motion.acceleration + by_jerk * motion.jerk - threshold;
  return kPercent * (std::max(sideways, 0.0) + std::pow(by_roll * motion.roll_rate, power));
}

std::span<const TransitionDiscomfort> transition_discomforts() { return kDiscomforts; }

}  // namespace treadmark::measures
