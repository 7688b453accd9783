// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/tangential/interface_layer.hpp"

#include <algorithm>
#include <cmath>

namespace treadmark::kalker {

namespace {

constexpr double kLeastYield = 0.1;  ///< softening ends at this share of the first yield stress

}  // namespace

InterfaceLayer::InterfaceLayer(const Material& material, const Patch& patch)
    : yield_(material.layer_yield), hardening_(material.layer_hardening), patch_(patch) {}

InterfaceLayer::Shear InterfaceLayer::divide(std::span<const double> friction_bound,
                                             std::span<const double> distance) const {
  const std::size_t n = friction_bound.size();
  Shear out{std::vector<double>(n), std::vector<double>(n, yield_), std::vector<char>(n, 0)};
  if (!plastic()) return out;
  const double least = kLeastYield * yield_;
  const bool steady = patch_.transport != Transport::none;
  for (std::size_t i = 0; i < n; ++i) {
    double start = yield_;
    if (!before_.empty())
      start = before_[i];
    else if (steady && patch_.ahead[i] >= 0)
      start = out.yield[static_cast<std::size_t>(patch_.ahead[i])];
    double shear = 0.0;
    if (start < friction_bound[i]) {
      // the layer shears alone until hardening brings it up to friction
      const double most = hardening_ > 0.0 ? (friction_bound[i] - start) / hardening_ : distance[i];
      shear = std::min(distance[i], most);
      out.only[i] = distance[i] <= most;
    }
    out.distance[i] = shear;
    out.yield[i] = std::max(start + hardening_ * shear, std::min(start, least));
  }
  return out;
}

std::vector<double> InterfaceLayer::bound(std::span<const double> friction_bound,
                                          std::span<const double> distance) const {
  std::vector<double> out(friction_bound.begin(), friction_bound.end());
  if (!plastic()) return out;
  const Shear shear = divide(friction_bound, distance);
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = std::min(out[i], shear.yield[i]);
  return out;
}

}  // namespace treadmark::kalker
