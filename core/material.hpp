// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark {

/// Homogeneous isotropic elastic bodies; body 1 is the rail, body 2 the wheel.
struct Material {
  double shear_modulus_1 = 82e9, shear_modulus_2 = 82e9;  ///< G [Pa]
  double poisson_1 = 0.28, poisson_2 = 0.28;              ///< nu [-]
  /// Elastic interface (third body) layer: tangential flexibility h3/G3 [m/Pa], 0 = none.
  double layer_flexibility = 0.0;
};

/// The pair of half-spaces seen as one (Kalker 1990): displacement difference u = u_1 - u_2 = (1/G) C p.
struct CombinedMaterial {
  double shear_modulus = 0.0;  ///< G [Pa]
  double poisson = 0.0;        ///< nu [-]
  double difference = 0.0;     ///< K [-], 0 for equal materials: then normal and tangential problem are independent
};
CombinedMaterial combine(const Material& material);

}  // namespace treadmark
