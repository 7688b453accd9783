// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/elastic_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "treadmark/core/line.hpp"

namespace treadmark::vehicle {
namespace {

double two_thirds(double load) { return std::cbrt(load * load); }

/// Vertical force over the displacement at one lateral position.
struct Compression {
  double force = 0.0, stiffness = 0.0, energy = 0.0;
  double lateral = 0.0;   ///< -dU/dy [N]
  std::size_t level = 0;  ///< the last one, of which 'share' is reached
  double share = 0.0;
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
  double load_0 = 0.0;
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
    out.level = k, out.share = u;
    load_0 = levels[k].load, phi_0 = phi_1;
  }
  return out;
}

/// Parts between two columns and two loads, with the weights of their shares of the force.
class Mixture {
 public:
  /// weight: of shares and places; of_area: of areas.
  void add(const std::vector<ContactPart>& parts, double weight, double of_area) {
    for (const ContactPart& from : parts) {
      ContactPart* const end = sums_.data() + count_;
      ContactPart* to = std::find_if(sums_.data(), end, [&](const auto& s) { return s.number == from.number; });
      if (to == end) {
        *to = {0.0, 0.0, 0.0, 0.0, 0.0, 0.0, from.number};
        ++count_;
      }
      const double w = weight * from.share;
      to->share += w;
      to->angle += w * from.angle;
      to->wheel_y += w * from.wheel_y;
      to->wheel_z += w * from.wheel_z;
      to->log_aspect += w * from.log_aspect;
      to->area += of_area * from.area;
    }
  }

  /// turn: of all contact angles.
  void put(ElasticContact& c, double turn) const {
    constexpr double kLeast = 1e-6;  // of the normal force
    for (std::size_t i = 0; i < count_; ++i) {
      const ContactPart& s = sums_[i];
      if (!(s.share > kLeast) || !(s.area > 0.0)) continue;
      const double each = 1.0 / s.share, size = std::sqrt(s.area / std::numbers::pi),
                   elongation = std::exp(0.5 * s.log_aspect * each);
      c.parts[c.count++] = {s.share * c.normal_force, s.angle * each + turn, s.wheel_y * each,
                            s.wheel_z * each,         size * elongation,     size / elongation};
    }
  }

 private:
  std::array<ContactPart, 4 * kMostParts> sums_;
  std::size_t count_ = 0;
};

void add_parts(const TableStretch& stretch, double y, const Compression& reached, double turn, ElasticContact& c) {
  const std::size_t i = piece_at(stretch.y, y);
  const double t = std::clamp((y - stretch.y[i]) / (stretch.y[i + 1] - stretch.y[i]), 0.0, 1.0), u = reached.share,
               of_force = reached.level == 0 ? 1.0 : std::min(u, 1.0);
  Mixture mixture;
  const auto add = [&](std::size_t level, double weight, double of_area) {
    const auto& parts = stretch.levels[level].parts;
    mixture.add(parts[i], (1.0 - t) * weight, (1.0 - t) * of_area);
    mixture.add(parts[i + 1], t * weight, t * of_area);
  };
  add(reached.level, of_force, u);
  if (reached.level > 0) add(reached.level - 1, 1.0 - of_force, 1.0 - u);
  mixture.put(c, turn);
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
  Compression vertical = compress(*stretch, y, touching, z);
  if (vertical.force > stretch->levels.back().load)
    if (const TableStretch* pressed_harder = table.heavier(*stretch)) {
      stretch = pressed_harder;
      vertical = compress(*stretch, y, touching, z);
    }
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
  add_parts(*stretch, y, vertical, std::atan(c.slope) - std::atan(upright_slope), c);
  return c;
}

}  // namespace treadmark::vehicle
