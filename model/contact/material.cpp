// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/contact/material.hpp"

namespace treadmark {

CombinedMaterial combine(const Material& m) {
  CombinedMaterial c;
  const double compliance_1 = 1.0 / m.shear_modulus_1, compliance_2 = 1.0 / m.shear_modulus_2;
  c.shear_modulus = 2.0 / (compliance_1 + compliance_2);
  c.poisson = c.shear_modulus * 0.5 * (m.poisson_1 * compliance_1 + m.poisson_2 * compliance_2);
  c.difference =
      c.shear_modulus * 0.25 * ((1.0 - 2.0 * m.poisson_1) * compliance_1 - (1.0 - 2.0 * m.poisson_2) * compliance_2);
  return c;
}

}  // namespace treadmark
