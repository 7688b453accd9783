// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/elastic_contact.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/solvers/vehicle/contacts/cubic_weights.hpp"

namespace treadmark::vehicle {
namespace {

double two_thirds(double load) { return std::cbrt(load * load); }

/// A number with its derivatives.
struct Mixed {
  double value = 0.0, by_y = 0.0, by_roll = 0.0;
};

/// What a table's curves are at one place: of its sheets round it.
struct LocalCurves {
  bool covered = true;
  Mixed energy_height;
  std::array<Mixed, ContactTable::kMostLevels> compression;
  std::array<double, ContactTable::kMostLevels> area{}, log_aspect{};
  double arm_z = 0.0;
};

/// Each sheet tells of the wheel turned from its own roll to this one, to first order, and cubic weights make one of
/// what they tell: roll counts to second order between them.
LocalCurves local_curves(const ContactTable& table, const RelativePlace& place) {
  LocalCurves out;
  const TableAngles &rolls = table.roll(), &yaws = table.yaw();
  const double nodes_of_roll = rolls.intervals > 0 ? 0.5 * rolls.intervals / rolls.most : 0.0,
               nodes_of_yaw = yaws.intervals > 0 ? yaws.intervals / yaws.most : 0.0;
  const NodeWeights by_roll = node_weights(nodes_of_roll * (place.roll + rolls.most), rolls.intervals, false),
                    by_yaw = node_weights(nodes_of_yaw * std::abs(place.yaw), yaws.intervals, true);
  const std::size_t levels = table.sheets().front().levels.size();
  for (int i = 0; i < by_roll.count; ++i)
    for (int j = 0; j < by_yaw.count; ++j) {
      const auto r = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
      const double weight = by_roll.value[r] * by_yaw.value[q],
                   weight_by_roll = nodes_of_roll * by_roll.slope[r] * by_yaw.value[q];
      const ContactSheet& sheet = table.sheet(by_roll.first + i, by_yaw.first + j);
      const double turned = place.roll - sheet.roll;
      const std::size_t here = sheet.wheel_y.piece(place.y);
      const ShapeCurve::Point arm_y = sheet.wheel_y.at(place.y, here), arm_z = sheet.wheel_z.at(place.y, here);
      // Where the wheel would have to stand at the sheet's roll to have its contact place there.
      const double y = place.y - turned * arm_z.value, y_by_y = 1.0 - turned * arm_z.slope;
      out.covered = out.covered && y >= sheet.y_min && y <= sheet.y_max;
      const std::size_t piece = turned == 0.0 ? here : sheet.energy_height.piece(y);
      const auto add = [&](Mixed& to, const ShapeCurve::Point& p, double lifted, double lifted_by_y,
                           double lifted_by_roll) {
        to.value += weight * (p.value + lifted);
        to.by_y += weight * (p.slope * y_by_y + lifted_by_y);
        to.by_roll += weight * (lifted_by_roll - p.slope * arm_z.value) + weight_by_roll * (p.value + lifted);
      };
      add(out.energy_height, sheet.energy_height.at(y, piece), -turned * arm_y.value, -turned * arm_y.slope,
          -arm_y.value);
      for (std::size_t k = 0; k < levels; ++k) {
        const LoadLevel& level = sheet.levels[k];
        add(out.compression[k], level.compression.at(y, piece), 0.0, 0.0, 0.0);
        out.area[k] += weight * level.area.at(y, piece).value;
        out.log_aspect[k] += weight * level.log_aspect_ratio.at(y, piece).value;
      }
      out.arm_z += weight * arm_z.value;
    }
  return out;
}

/// Vertical force over the displacement at one place.
struct Compression {
  double force = 0.0, stiffness = 0.0, energy = 0.0;
  double by_y = 0.0, by_roll = 0.0;  ///< -dU/dy [N], -dU/droll [N m]
  double area = 0.0, log_aspect = 0.0;
};

/// Marches up the levels. In each the displacement is c u with u = (phi - phi_0) / (phi_1 - phi_0), phi = F^(2/3); its
/// complementary energy is the integral c B(F) of the displacement over the force, and the sum of all by y is the
/// lateral force, by roll the moment (Engesser's theorem).
Compression compress(const std::vector<LoadLevel>& levels, const LocalCurves& curves, const Mixed& touching, double z) {
  Compression out;
  if (!(z > touching.value)) return out;
  // The force first.
  double below = touching.value, phi_0 = 0.0, phi = 0.0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double c = curves.compression[k].value, phi_1 = two_thirds(levels[k].load), steep = (phi_1 - phi_0) / c;
    phi = phi_0 + steep * (z - below);
    out.stiffness = 1.5 * std::sqrt(phi) * steep;
    if (phi <= phi_1) break;
    below += c;
    phi_0 = phi_1;
  }
  out.force = phi * std::sqrt(phi);

  out.by_y = out.force * touching.by_y, out.by_roll = out.force * touching.by_roll;
  double load_0 = 0.0, area_0 = 0.0, aspect_0 = 0.0;
  phi_0 = 0.0;
  for (std::size_t k = 0; k < levels.size() && (k == 0 || phi > phi_0); ++k) {
    const double phi_1 = two_thirds(levels[k].load);
    const bool passed = phi > phi_1 && k + 1 < levels.size();
    const double end = passed ? phi_1 : phi, end_load = passed ? levels[k].load : out.force;
    const double u = (end - phi_0) / (phi_1 - phi_0);
    const double phi_integral = 0.6 * (end * end * std::sqrt(end) - phi_0 * phi_0 * std::sqrt(phi_0));
    const double b = (phi_integral - phi_0 * (end_load - load_0)) / (phi_1 - phi_0) + u * (out.force - end_load);
    const Mixed& c = curves.compression[k];
    out.by_y += b * c.by_y, out.by_roll += b * c.by_roll;
    out.energy += c.value * (out.force * u - b);
    const double area = curves.area[k], aspect = curves.log_aspect[k];
    out.area = area_0 + u * (area - area_0);
    out.log_aspect = k == 0 ? aspect : aspect_0 + std::min(u, 1.0) * (aspect - aspect_0);
    area_0 = area, aspect_0 = aspect, load_0 = levels[k].load, phi_0 = phi_1;
  }
  return out;
}

/// Hertz: 2/5 of the compression under the first load are in its energy height.
Mixed touching_height(const LocalCurves& curves) {
  const Mixed &height = curves.energy_height, &first = curves.compression.front();
  return {height.value - 0.6 * first.value, height.by_y - 0.6 * first.by_y, height.by_roll - 0.6 * first.by_roll};
}

bool covers(const ContactTable& table, const RelativePlace& place) {
  return place.y >= table.y_min() && place.y <= table.y_max() && table.roll().covers(place.roll) &&
         table.yaw().covers(place.yaw);
}

}  // namespace

ElasticContact elastic_contact(const ContactTable& table, const RelativePlace& place) {
  ElasticContact c;
  c.in_table = covers(table, place);
  if (!c.in_table) return c;
  const LocalCurves curves = local_curves(table, place);
  c.in_table = curves.covered;
  if (!c.in_table) return c;

  const Mixed touching = touching_height(curves);
  const Compression vertical = compress(table.sheets().front().levels, curves, touching, place.z);
  const bool pressed = vertical.force > 0.0;
  c.slope = pressed ? vertical.by_y / vertical.force : touching.by_y;
  const double per_vertical = std::sqrt(1.0 + c.slope * c.slope);
  c.penetration = (place.z - touching.value) / per_vertical;
  c.arm_z = curves.arm_z;
  // The line of action is the gradient's by roll.
  c.arm_y = -(pressed ? vertical.by_roll / vertical.force : touching.by_roll) - c.slope * c.arm_z;
  if (!pressed) return c;

  c.normal_force = vertical.force * per_vertical;
  c.energy = vertical.energy;
  c.stiffness = vertical.stiffness * per_vertical * per_vertical;
  const double size = std::sqrt(vertical.area / std::numbers::pi), elongation = std::exp(0.5 * vertical.log_aspect);
  c.a = size * elongation;
  c.b = size / elongation;
  return c;
}

std::optional<double> height_under_load(const ContactTable& table, const RelativePlace& place, double load) {
  if (!covers(table, place)) return std::nullopt;
  const LocalCurves curves = local_curves(table, place);
  if (!curves.covered) return std::nullopt;
  double z = touching_height(curves).value, phi_0 = 0.0;
  const std::vector<LoadLevel>& levels = table.sheets().front().levels;
  const double phi = two_thirds(load);
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double phi_1 = two_thirds(levels[k].load), c = curves.compression[k].value;
    if (phi <= phi_1 || k + 1 == levels.size()) return z + c * (phi - phi_0) / (phi_1 - phi_0);
    z += c, phi_0 = phi_1;
  }
  return z;
}

}  // namespace treadmark::vehicle
