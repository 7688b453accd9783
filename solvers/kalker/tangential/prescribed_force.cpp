// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/prescribed_force.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace treadmark::kalker {

namespace {

using Pair = std::array<double, 2>;

constexpr double kLargestGrowth = 4.0;  ///< of the creepage in one step of one unknown
constexpr double kShortestForceStep = 1.0 / 64.0;

double deviation(const ForceSearchSettings& s, const ForceSample& f) {
  double worst = 0.0;
  for (int k = 0; k < s.count; ++k) {
    const auto c = static_cast<std::size_t>(k);
    const double d = std::abs(f.force[c] - s.target[c]);
    if (std::isnan(d)) return d;
    worst = std::max(worst, d);
  }
  return worst;
}

ForceSearchResult find_one(const ForceSearchSettings& s, const std::function<ForceSample(Pair)>& evaluate) {
  ForceSearchResult result;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  double low = -infinity, high = infinity;  // force above the target at low, below it at high
  double x = s.start[0], last_x = 0.0, last_force = 0.0, scale = 0.0;
  for (;;) {
    const ForceSample sample = evaluate({x, 0.0});
    ++result.iterations;
    result.creepage = {x, 0.0};
    result.residual = deviation(s, sample);
    result.converged = result.residual <= s.tolerance;
    if (result.converged || !std::isfinite(result.residual) || result.iterations >= s.max_iterations) return result;
    const double excess = sample.force[0] - s.target[0];
    (excess > 0.0 ? low : high) = x;
    double slope = sample.derivative[0][0];
    if (!s.exact_derivatives && result.iterations > 1 && x != last_x)
      slope = (sample.force[0] - last_force) / (x - last_x);
    last_x = x;
    last_force = sample.force[0];
    double next = slope < 0.0 ? x - excess / slope : (excess > 0.0 ? infinity : -infinity);
    if (std::isfinite(next)) scale = std::max(scale, std::abs(next - x));
    if (!(next > low && next < high) || (sample.sliding && std::isfinite(low) && std::isfinite(high))) {
      if (std::isfinite(low) && std::isfinite(high)) {
        next = 0.5 * (low + high);
      } else {
        const double reach = std::max({kLargestGrowth * std::abs(x), scale, 1e-12});
        next = excess > 0.0 ? x + reach : x - reach;
      }
    }
    // Sliding far outside: the derivative is next to nothing, the step would be next to infinite.
    const double limit = kLargestGrowth * std::max(std::abs(x), 1e-12);
    if (result.iterations > 1) next = std::clamp(next, x - limit, x + limit);
    x = next;
  }
}

/// Solves the 2x2 system derivative * step = -residual; nothing if it is singular.
bool newton_step(const std::array<Pair, 2>& j, const Pair& residual, Pair& step) {
  const double det = j[0][0] * j[1][1] - j[0][1] * j[1][0];
  const double size = std::hypot(j[0][0], j[0][1]) * std::hypot(j[1][0], j[1][1]);
  if (!(std::abs(det) > 1e-10 * size)) return false;
  step = {-(residual[0] * j[1][1] - residual[1] * j[0][1]) / det,
          -(residual[1] * j[0][0] - residual[0] * j[1][0]) / det};
  return true;
}

ForceSearchResult find_two(const ForceSearchSettings& s, const std::function<ForceSample(Pair)>& evaluate) {
  ForceSearchResult result;
  const auto finish = [&](const Pair& x, const ForceSample& sample) {
    result.creepage = x;
    result.residual = deviation(s, sample);
    result.converged = result.residual <= s.tolerance;
    return result.converged || !std::isfinite(result.residual) || result.iterations >= s.max_iterations;
  };
  Pair x = s.start;
  ForceSample here = evaluate(x);
  ++result.iterations;
  if (finish(x, here)) return result;
  // From a sliding state there is no way to tell how far; go back towards rest.
  while (here.sliding && std::hypot(x[0], x[1]) > 0.0) {
    x = result.iterations < 4 ? Pair{0.25 * x[0], 0.25 * x[1]} : Pair{0.0, 0.0};
    here = evaluate(x);
    ++result.iterations;
    if (finish(x, here)) return result;
  }
  std::array<Pair, 2> j = here.derivative;
  for (;;) {
    const Pair residual{here.force[0] - s.target[0], here.force[1] - s.target[1]};
    const double size = std::hypot(residual[0], residual[1]);
    Pair step{};
    if (!newton_step(j, residual, step)) return result;
    const double reach = std::hypot(step[0], step[1]);
    const double limit = kLargestGrowth * std::hypot(x[0], x[1]);
    if (limit > 0.0 && reach > limit) step = {step[0] * limit / reach, step[1] * limit / reach};
    ForceSample there;
    Pair y{};
    double length = 1.0;
    for (;; length *= 0.5) {
      y = {x[0] + length * step[0], x[1] + length * step[1]};
      there = evaluate(y);
      ++result.iterations;
      if (finish(y, there)) return result;
      if (std::hypot(there.force[0] - s.target[0], there.force[1] - s.target[1]) < size || length <= kShortestForceStep)
        break;
    }
    if (s.exact_derivatives) {
      j = there.derivative;
    } else {
      const Pair d{y[0] - x[0], y[1] - x[1]};
      const double square = d[0] * d[0] + d[1] * d[1];
      for (std::size_t k = 0; k < 2; ++k) {
        const double miss = there.force[k] - here.force[k] - j[k][0] * d[0] - j[k][1] * d[1];
        j[k][0] += miss * d[0] / square;
        j[k][1] += miss * d[1] / square;
      }
    }
    x = y;
    here = there;
  }
}

}  // namespace

ForceSearchResult find_creepage(const ForceSearchSettings& settings, const std::function<ForceSample(Pair)>& evaluate) {
  return settings.count == 1 ? find_one(settings, evaluate) : find_two(settings, evaluate);
}

}  // namespace treadmark::kalker
