// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/model/contact/conventions.hpp"

namespace treadmark {

/// Homogeneous isotropic elastic bodies; body 1 is the rail, body 2 the wheel.
struct Material {
  double shear_modulus_1 = 82e9, shear_modulus_2 = 82e9;  ///< G [Pa]
  double poisson_1 = 0.28, poisson_2 = 0.28;              ///< nu [-]
  /// Elastic interface (third body) layer: tangential flexibility h3/G3 [m/Pa], 0 = none.
  double layer_flexibility = 0.0;
  /// Shear stress at which the layer yields [Pa], 0 = never, and its change per distance of plastic shear [Pa/m].
  double layer_yield = 0.0, layer_hardening = 0.0;
  /// Thin compressible sheet: normal flexibility [m/Pa], 0 = none.
  double sheet_flexibility = 0.0;
  /// Standard linear solid: ratio of the delayed to the immediate compliance, 0 = elastic, and relaxation time [s].
  double creep_ratio_1 = 0.0, creep_ratio_2 = 0.0;
  double relaxation_time_1 = 0.0, relaxation_time_2 = 0.0;  ///< [s]
  friend bool operator==(const Material&, const Material&) = default;
};

/// Heat in the surface of a body.
struct ThermalProperties {
  double bulk_temperature = 0.0;  ///< [deg C]
  double heat_capacity = 450.0;   ///< [J/(kg K)]
  double conductivity = 50.0;     ///< [W/(m K)]
  double density = 7850.0;        ///< [kg/m^3]
  friend bool operator==(const ThermalProperties&, const ThermalProperties&) = default;
};
/// Heat in the surfaces of rail (1) and wheel (2).
struct Thermal {
  ThermalProperties body_1, body_2;
  double plastic_fraction = 1.0;                     ///< of plastic work that becomes heat
  Conventions conventions = Conventions::treadmark;  ///< of the temperatures
  friend bool operator==(const Thermal&, const Thermal&) = default;
};

/// The pair of half-spaces seen as one (Kalker 1990): displacement difference u = u_1 - u_2 = (1/G) C p.
struct CombinedMaterial {
  double shear_modulus = 0.0;  ///< G [Pa]
  double poisson = 0.0;        ///< nu [-]
  double difference = 0.0;     ///< K [-], 0 for equal materials: then normal and tangential problem are independent
};
/// Of any two bodies.
CombinedMaterial combine(const Material& material);

}  // namespace treadmark
