// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/kernel_store.hpp"

namespace treadmark::kalker {

namespace {

constexpr std::size_t kMostKernels = 8;

bool viscoelastic(const Material& m) { return m.creep_ratio_1 != 0.0 || m.creep_ratio_2 != 0.0; }

std::vector<double> all_numbers(const ContactProblem& p, const InfluenceSettings& influence) {
  const Material& m = p.material;
  std::vector<double> out{static_cast<double>(influence.kind),
                          p.grid.dx,
                          p.grid.dy,
                          m.shear_modulus_1,
                          m.shear_modulus_2,
                          m.poisson_1,
                          m.poisson_2};
  if (viscoelastic(m))
    out.insert(out.end(), {m.creep_ratio_1, m.creep_ratio_2, m.relaxation_time_1, m.relaxation_time_2,
                           p.rolling.velocity, p.rolling.chi});
  if (influence.kind == InfluenceSettings::Kind::angle_corrected) {
    out.push_back(influence.variant);
    out.insert(out.end(), influence.position.begin(), influence.position.end());
    out.insert(out.end(), influence.inclination.begin(), influence.inclination.end());
  }
  return out;
}

}  // namespace

KernelChoice KernelStore::get(const ContactProblem& problem) {
  const InfluenceSettings& wanted = problem.influence;
  if (wanted.kind != InfluenceSettings::Kind::angle_corrected || wanted.linear) return kernel_of(problem, wanted);
  if (viscoelastic(problem.material)) return kernel_of(problem, wanted);  // refuses
  if (!inclination_ || last_.variant != wanted.variant || last_.position != wanted.position ||
      last_.inclination != wanted.inclination) {
    inclination_ = std::make_shared<InclinationTable>(wanted);
    last_ = wanted;
  }
  KernelChoice choice = kernel_of(problem, {});
  choice.standard = false;
  choice.coupled = true;
  choice.inclination = inclination_;
  return choice;
}

KernelChoice KernelStore::kernel_of(const ContactProblem& problem, const InfluenceSettings& settings) {
  const std::vector<double> numbers = all_numbers(problem, settings);
  for (auto it = entries_.begin(); it != entries_.end(); ++it)
    if (it->numbers == numbers && it->table == settings.table) {
      entries_.splice(entries_.begin(), entries_, it);
      return entries_.front().choice;
    }
  KernelChoice choice;
  choice.kernel = make_influence_kernel(problem.material, settings, problem.grid.dx, problem.grid.dy,
                                        problem.rolling.velocity, problem.rolling.chi);
  choice.standard = settings.kind == InfluenceSettings::Kind::constant && !viscoelastic(problem.material);
  choice.coupled = choice.kernel->coupled();
  entries_.push_front({numbers, settings.table, choice});
  if (entries_.size() > kMostKernels) entries_.pop_back();
  return choice;
}

}  // namespace treadmark::kalker
