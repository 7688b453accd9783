// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/elastic_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace treadmark::vehicle {
namespace {

double two_thirds(double load) { return std::cbrt(load * load); }

/// Vertical force over the displacement at one lateral position.
struct Compression {
  double force = 0.0, stiffness = 0.0, energy = 0.0;
  double lateral = 0.0;  ///< -dU/dy [N]
  double area = 0.0, log_aspect = 0.0;
};

/// Marches up the levels. In each the displacement is c u with u = (phi - phi_0) / (phi_1 - phi_0), phi = F^(2/3); its
/// complementary energy is the integral c B(F) of the displacement over the force, and the sum of all by y is the
/// lateral force (Engesser's theorem).
Compression compress(const TableStretch& stretch, double y, const ShapeCurve::Point& touching, double z) {
  Compression out;
  if (!(z > touching.value)) return out;
  const std::vector<LoadLevel>& levels = stretch.levels;
  // The force first.
  double below = touching.value, phi_0 = 0.0, phi = 0.0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double c = levels[k].compression.at(y).value, phi_1 = two_thirds(levels[k].load), steep = (phi_1 - phi_0) / c;
    phi = phi_0 + steep * (z - below);
    out.stiffness = 1.5 * std::sqrt(phi) * steep;
    if (phi <= phi_1) break;
    below += c;
    phi_0 = phi_1;
  }
  out.force = phi * std::sqrt(phi);

  out.lateral = out.force * touching.slope;
  double load_0 = 0.0, area_0 = 0.0, aspect_0 = 0.0;
  phi_0 = 0.0;
  for (std::size_t k = 0; k < levels.size() && (k == 0 || phi > phi_0); ++k) {
    const double phi_1 = two_thirds(levels[k].load);
    const bool passed = phi > phi_1 && k + 1 < levels.size();
    const double end = passed ? phi_1 : phi, end_load = passed ? levels[k].load : out.force;
    const double u = (end - phi_0) / (phi_1 - phi_0);
    const double phi_integral = 0.6 * (end * end * std::sqrt(end) - phi_0 * phi_0 * std::sqrt(phi_0));
    const double b = (phi_integral - phi_0 * (end_load - load_0)) / (phi_1 - phi_0) + u * (out.force - end_load);
    const ShapeCurve::Point c = levels[k].compression.at(y);
    out.lateral += b * c.slope;
    out.energy += c.value * (out.force * u - b);
    const double area = levels[k].area.at(y).value, aspect = levels[k].log_aspect_ratio.at(y).value;
    out.area = area_0 + u * (area - area_0);
    out.log_aspect = k == 0 ? aspect : aspect_0 + std::min(u, 1.0) * (aspect - aspect_0);
    area_0 = area, aspect_0 = aspect, load_0 = levels[k].load, phi_0 = phi_1;
  }
  return out;
}

}  // namespace

ElasticContact elastic_contact(const ContactTable& table, const RelativePlace& place) {
  ElasticContact c;
  const TableStretch* stretch = table.at(place.y);
  c.in_table = stretch != nullptr;
  if (!c.in_table) return c;
  const ShapeCurve::Point arm_y = stretch->wheel_y.at(place.y), arm_z = stretch->wheel_z.at(place.y);
  // Where the wheel would have to stand upright to have its contact place there.
  const double y = place.y - place.roll * arm_z.value, z = place.z + place.roll * arm_y.value;
  stretch = table.at(y);
  c.in_table = stretch != nullptr;
  if (!c.in_table) return c;

  const ShapeCurve::Point height = stretch->energy_height.at(y), first = stretch->levels.front().compression.at(y);
  // Hertz: 2/5 of the compression under the first load are in its energy height.
  const ShapeCurve::Point touching{height.value - 0.6 * first.value, height.slope - 0.6 * first.slope};
  const Compression vertical = compress(*stretch, y, touching, z);
  const double upright_slope = vertical.force > 0.0 ? vertical.lateral / vertical.force : touching.slope;
  c.slope = upright_slope * (1.0 - place.roll * arm_z.slope) - place.roll * arm_y.slope;
  const double per_vertical = std::sqrt(1.0 + c.slope * c.slope);
  c.penetration = (z - touching.value) / per_vertical;
  c.arm_z = arm_z.value;
  // The line of action is the gradient's by roll.
  c.arm_y = arm_y.value + (upright_slope - c.slope) * arm_z.value;
  if (!(vertical.force > 0.0)) return c;

  c.normal_force = vertical.force * per_vertical;
  c.energy = vertical.energy;
  c.stiffness = vertical.stiffness * per_vertical * per_vertical;
  const double size = std::sqrt(vertical.area / std::numbers::pi), elongation = std::exp(0.5 * vertical.log_aspect);
  c.a = size * elongation;
  c.b = size / elongation;
  return c;
}

}  // namespace treadmark::vehicle
