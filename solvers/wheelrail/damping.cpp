// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/damping.hpp"

#include <algorithm>
#include <cstddef>

namespace treadmark::wheelrail {

void add_damping(const Problem& p, const Instant& previous, const Instant& now, std::span<PatchSolution> patches) {
  if (!p.damping || p.history == kalker::HistoryUse::start) return;
  const auto successors = [&](std::uint64_t id) {
    return std::count_if(patches.begin(), patches.end(), [&](const PatchSolution& s) {
      return std::find(s.came_from.begin(), s.came_from.end(), id) != s.came_from.end();
    });
  };
  for (std::size_t i = 0; i < patches.size(); ++i) {
    PatchSolution& patch = patches[i];
    if (patch.came_from.empty() || !(patch.kinematics.velocity > 0.0)) continue;
    Vec3 before = Vec3::Zero();
    for (const PatchMemory& m : previous.patches)
      if (std::find(patch.came_from.begin(), patch.came_from.end(), m.id) != patch.came_from.end())
        before += m.force_C / static_cast<double>(successors(m.id));
    const bool shift = p.regime == kalker::Regime::shift;
    const double dt = shift ? 1.0 : p.discretisation.dq_relative * p.discretisation.dx / patch.kinematics.velocity;
    const Vec3 rate = (now.patches[i].force_C - before) / dt;
    const auto damped = [](double c, double value, double most) { return c * std::clamp(value, -most, most); };
    const Damping& d = *p.damping;
    const Vec3 damping(damped(d.tangential, rate.x(), d.max_rate_tangential),
                       damped(d.tangential, rate.y(), d.max_rate_tangential),
                       damped(d.normal, rate.z(), d.max_rate_normal));
    patch.force_C += damping;
    if (!patch.surface_loads) continue;
    patch.surface_loads->rail.force += damping;
    patch.surface_loads->wheel += {damping, Vec3(0.0, 0.0, patch.approach).cross(damping)};
  }
}

}  // namespace treadmark::wheelrail
