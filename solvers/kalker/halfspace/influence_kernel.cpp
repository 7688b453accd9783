// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"

namespace treadmark::kalker {

std::shared_ptr<const InfluenceKernel> make_influence_kernel(const Material& material, const InfluenceSettings& settings, double dx,
                                                             double dy, double, double) {
  const CombinedMaterial combined = combine(material);
  if (settings.kind != InfluenceSettings::Kind::constant || material.creep_ratio_1 != 0.0 || material.creep_ratio_2 != 0.0)
    throw Error(ErrorKind::configuration, "coefficients of influence of this kind are not available", {}, "use constant elements");
  return std::make_shared<ConstantElements>(dx, dy, combined.poisson, combined.difference);
}

}  // namespace treadmark::kalker
