// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/elastic_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "treadmark/solvers/vehicle/contacts/cubic_weights.hpp"

namespace treadmark::vehicle {
namespace {

double two_thirds(double load) { return std::cbrt(load * load); }

bool covers(const ContactTable& table, const RelativePlace& place) {
  return place.y >= table.y_min() && place.y <= table.y_max() && table.roll().covers(place.roll) &&
         table.yaw().covers(place.yaw);
}

}  // namespace

LocalContact::LocalContact(const ContactTable& table, const RelativePlace& place)
    : place_(place), covered_(covers(table, place)), levels_(&table.sheets().front().levels) {
  if (covered_) mix(table);
}

/// Each sheet tells of the wheel turned from its own roll to this one, to first order, and cubic weights make one of
/// what they tell: roll counts to second order between them.
void LocalContact::mix(const ContactTable& table) {
  const TableAngles &rolls = table.roll(), &yaws = table.yaw();
  const double nodes_of_roll = rolls.intervals > 0 ? 0.5 * rolls.intervals / rolls.most : 0.0,
               nodes_of_yaw = yaws.intervals > 0 ? yaws.intervals / yaws.most : 0.0;
  const NodeWeights by_roll = node_weights(nodes_of_roll * (place_.roll + rolls.most), rolls.intervals, false),
                    by_yaw = node_weights(nodes_of_yaw * std::abs(place_.yaw), yaws.intervals, true);
  Mixed energy_height;
  for (int i = 0; i < by_roll.count; ++i)
    for (int j = 0; j < by_yaw.count; ++j) {
      const auto r = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
      const double weight = by_roll.value[r] * by_yaw.value[q],
                   weight_by_roll = nodes_of_roll * by_roll.slope[r] * by_yaw.value[q];
      const ContactSheet& sheet = table.sheet(by_roll.first + i, by_yaw.first + j);
      const double turned = place_.roll - sheet.roll;
      const std::size_t here = sheet.wheel_y.piece(place_.y);
      const ShapeCurve::Point arm_y = sheet.wheel_y.at(place_.y, here), arm_z = sheet.wheel_z.at(place_.y, here);
      // Where the wheel would have to stand at the sheet's roll to have its contact place there.
      const double y = place_.y - turned * arm_z.value, y_by_y = 1.0 - turned * arm_z.slope;
      covered_ = covered_ && y >= sheet.y_min && y <= sheet.y_max;
      const std::size_t piece = turned == 0.0 ? here : sheet.energy_height.piece(y);
      const auto add = [&](Mixed& to, const ShapeCurve::Point& p, double lifted, double lifted_by_y,
                           double lifted_by_roll) {
        to.value += weight * (p.value + lifted);
        to.by_y += weight * (p.slope * y_by_y + lifted_by_y);
        to.by_roll += weight * (lifted_by_roll - p.slope * arm_z.value) + weight_by_roll * (p.value + lifted);
      };
      add(energy_height, sheet.energy_height.at(y, piece), -turned * arm_y.value, -turned * arm_y.slope, -arm_y.value);
      for (std::size_t k = 0; k < levels_->size(); ++k) {
        const LoadLevel& level = sheet.levels[k];
        add(compression_[k], level.compression.at(y, piece), 0.0, 0.0, 0.0);
        area_[k] += weight * level.area.at(y, piece).value;
        log_aspect_[k] += weight * level.log_aspect_ratio.at(y, piece).value;
      }
      arm_z_ += weight * arm_z.value;
    }
  // Hertz: 2/5 of the compression under the first load are in its energy height.
  constexpr double kRest = 0.6;
  const Mixed& first = compression_.front();
  touching_ = {energy_height.value - kRest * first.value, energy_height.by_y - kRest * first.by_y,
               energy_height.by_roll - kRest * first.by_roll};
}

/// Marches up the levels. In each the displacement is c u with u = (phi - phi_0) / (phi_1 - phi_0), phi = F^(2/3); its
/// complementary energy is the integral c B(F) of the displacement over the force, and the sum of all by y is the
/// lateral force, by roll the moment (Engesser's theorem).
LocalContact::Compression LocalContact::compress(double z) const {
  Compression out;
  if (!(z > touching_.value)) return out;
  const std::vector<LoadLevel>& levels = *levels_;
  // The force first.
  double below = touching_.value, phi_0 = 0.0, phi = 0.0;
  for (std::size_t k = 0; k < levels.size(); ++k) {
    const double c = compression_[k].value, phi_1 = two_thirds(levels[k].load), steep = (phi_1 - phi_0) / c;
    phi = phi_0 + steep * (z - below);
    out.stiffness = 1.5 * std::sqrt(phi) * steep;
    if (phi <= phi_1) break;
    below += c;
    phi_0 = phi_1;
  }
  out.force = phi * std::sqrt(phi);

  out.by_y = out.force * touching_.by_y, out.by_roll = out.force * touching_.by_roll;
  double load_0 = 0.0, area_0 = 0.0, aspect_0 = 0.0;
  phi_0 = 0.0;
  for (std::size_t k = 0; k < levels.size() && (k == 0 || phi > phi_0); ++k) {
    const double phi_1 = two_thirds(levels[k].load);
    const bool passed = phi > phi_1 && k + 1 < levels.size();
    const double end = passed ? phi_1 : phi, end_load = passed ? levels[k].load : out.force;
    const double u = (end - phi_0) / (phi_1 - phi_0);
    const double phi_integral = 0.6 * (end * end * std::sqrt(end) - phi_0 * phi_0 * std::sqrt(phi_0));
    const double b = (phi_integral - phi_0 * (end_load - load_0)) / (phi_1 - phi_0) + u * (out.force - end_load);
    const Mixed& c = compression_[k];
    out.by_y += b * c.by_y, out.by_roll += b * c.by_roll;
    out.energy += c.value * (out.force * u - b);
    out.area = area_0 + u * (area_[k] - area_0);
    out.log_aspect = k == 0 ? log_aspect_[k] : aspect_0 + std::min(u, 1.0) * (log_aspect_[k] - aspect_0);
    area_0 = area_[k], aspect_0 = log_aspect_[k], load_0 = levels[k].load, phi_0 = phi_1;
  }
  return out;
}

ElasticContact LocalContact::at(double z) const {
  ElasticContact c;
  c.in_table = covered_;
  if (!covered_) return c;
  const Compression vertical = compress(z);
  const bool pressed = vertical.force > 0.0;
  c.slope = pressed ? vertical.by_y / vertical.force : touching_.by_y;
  const double per_vertical = std::sqrt(1.0 + c.slope * c.slope);
  c.penetration = (z - touching_.value) / per_vertical;
  c.arm_z = arm_z_;
  // The line of action is the gradient's by roll.
  c.arm_y = -(pressed ? vertical.by_roll / vertical.force : touching_.by_roll) - c.slope * c.arm_z;
  if (!pressed) return c;

  c.normal_force = vertical.force * per_vertical;
  c.energy = vertical.energy;
  c.stiffness = vertical.stiffness * per_vertical * per_vertical;
  const double size = std::sqrt(vertical.area / std::numbers::pi), elongation = std::exp(0.5 * vertical.log_aspect);
  c.a = size * elongation;
  c.b = size / elongation;
  return c;
}

double LocalContact::height_under_load(double load) const {
  double z = touching_.value, phi_0 = 0.0;
  const double phi = two_thirds(load);
  for (std::size_t k = 0;; ++k) {
    const double phi_1 = two_thirds((*levels_)[k].load), c = compression_[k].value;
    if (phi <= phi_1 || k + 1 == levels_->size()) return z + c * (phi - phi_0) / (phi_1 - phi_0);
    z += c, phi_0 = phi_1;
  }
}

ElasticContact elastic_contact(const ContactTable& table, const RelativePlace& place) {
  return LocalContact(table, place).at(place.z);
}

}  // namespace treadmark::vehicle
