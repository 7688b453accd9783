// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/elastic_contact.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "treadmark/core/line.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/vehicle/contacts/cubic_weights.hpp"

namespace treadmark::vehicle {
namespace {

double two_thirds(double load) { return std::cbrt(load * load); }

/// Of a node at a distance, in units of nodes, between neighbours.
double linear_weight(double distance) { return std::max(0.0, 1.0 - std::abs(distance)); }

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

  /// turn: of all contact angles; weight: of all parts.
  void put(ElasticContact& c, double turn, double weight) const {
    constexpr double kLeast = 1e-6;  // of the normal force
    const std::size_t first = c.count;
    double pressure = 0.0;
    for (std::size_t i = 0; i < count_; ++i) {
      const ContactPart& s = sums_[i];
      if (!(s.share > kLeast) || !(s.area > 0.0)) continue;
      const double force = s.share * c.normal_force, each = 1.0 / s.share, size = std::sqrt(s.area / std::numbers::pi),
                   elongation = std::exp(0.5 * s.log_aspect * each);
      pressure = std::max(pressure, 1.5 * force / s.area);
      c.area += weight * s.area;
      c.parts[c.count++] = {force,
                            s.angle * each + turn,
                            s.wheel_y * each,
                            s.wheel_z * each,
                            size * elongation,
                            size / elongation,
                            weight,
                            false};
    }
    c.max_pressure += weight * pressure;
    ElasticPart *const begin = c.parts.data() + first, *const end = c.parts.data() + c.count;
    if (begin != end) ranges::max_element(std::span(begin, end), {}, &ElasticPart::normal_force)->strongest = true;
  }

 private:
  std::array<ContactPart, 4 * kMostParts> sums_;
  std::size_t count_ = 0;
};

}  // namespace

LocalContact::LocalContact(const ContactTable& table, const RelativePlace& place, bool heavier)
    : table_(&table), place_(place) {
  covered_ = table.roll().covers(place.roll) && table.yaw().covers(place.yaw) && mix(heavier);
}

/// Each sheet tells of the wheel turned from its own roll to this one, to first order, and cubic weights make one of
/// what they tell: roll counts to second order between them. Where contacts are and how large is read from the sheets
/// next to the place, with weights of straight lines, which are never negative.
bool LocalContact::mix(bool heavier) {
  const TableAngles &rolls = table_->roll(), &yaws = table_->yaw();
  const double nodes_of_roll = rolls.intervals > 0 ? 0.5 * rolls.intervals / rolls.most : 0.0,
               nodes_of_yaw = yaws.intervals > 0 ? yaws.intervals / yaws.most : 0.0,
               roll = nodes_of_roll * (place_.roll + rolls.most), yaw = nodes_of_yaw * std::abs(place_.yaw);
  const NodeWeights by_roll = node_weights(roll, rolls.intervals, false),
                    by_yaw = node_weights(yaw, yaws.intervals, true);
  Mixed energy_height;
  for (int i = 0; i < by_roll.count; ++i)
    for (int j = 0; j < by_yaw.count; ++j) {
      const auto r = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
      const double weight = by_roll.value[r] * by_yaw.value[q],
                   weight_by_roll = nodes_of_roll * by_roll.slope[r] * by_yaw.value[q];
      const std::size_t sheet = table_->sheet(by_roll.first + i, by_yaw.first + j);
      const TableStretch* stretch = table_->at(place_.y, sheet);
      end_ = {sheet, place_.y};
      if (!stretch) return false;
      const double turned = place_.roll - table_->turn(sheet).roll;
      const std::size_t here = piece_at(stretch->y, place_.y);
      const ShapeCurve::Point arm_y = stretch->wheel_y.at(place_.y, here), arm_z = stretch->wheel_z.at(place_.y, here);
      // Where the wheel would have to stand at the sheet's roll to have its contact place there.
      const double y = place_.y - turned * arm_z.value, y_by_y = 1.0 - turned * arm_z.slope;
      stretch = table_->at(y, sheet);
      end_ = {sheet, y};
      if (stretch && heavier) stretch = table_->heavier(*stretch, sheet);
      if (!stretch) return false;
      end_.reset();
      const std::size_t column = turned == 0.0 ? here : piece_at(stretch->y, y);
      const auto add = [&](Mixed& to, const ShapeCurve::Point& p, double lifted, double lifted_by_y,
                           double lifted_by_roll) {
        to.value += weight * (p.value + lifted);
        to.by_y += weight * (p.slope * y_by_y + lifted_by_y);
        to.by_roll += weight * (lifted_by_roll - p.slope * arm_z.value) + weight_by_roll * (p.value + lifted);
      };
      const ShapeCurve::Point height = stretch->energy_height.at(y, column);
      add(energy_height, height, -turned * arm_y.value, -turned * arm_y.slope, -arm_y.value);
      levels_ = &stretch->levels;
      for (std::size_t k = 0; k < levels_->size(); ++k)
        add(compression_[k], (*levels_)[k].compression.at(y, column), 0.0, 0.0, 0.0);
      arm_z_ += weight * arm_z.value;

      const double of_sheet = linear_weight(roll - by_roll.first - i) * linear_weight(yaw - by_yaw.first - j);
      if (!(of_sheet > 0.0)) continue;
      const double before = stretch->y[column], behind = stretch->y[column + 1];
      cells_[cell_count_++] = {stretch, column, std::clamp((y - before) / (behind - before), 0.0, 1.0), of_sheet,
                               std::atan(height.slope * y_by_y - turned * arm_y.slope) - std::atan(height.slope)};
    }
  // Some cubic weights are negative: of sheets that differ much nothing may be left.
  for (std::size_t k = 0; k < levels_->size(); ++k)
    if (!(compression_[k].value > 0.0)) return false;
  // Hertz: 2/5 of the compression under the first load are in its energy height.
  constexpr double kRest = 0.6;
  const Mixed& first = compression_.front();
  touching_ = {energy_height.value - kRest * first.value, energy_height.by_y - kRest * first.by_y,
               energy_height.by_roll - kRest * first.by_roll};
  return true;
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
  double load_0 = 0.0;
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
    out.level = k, out.share = u;
    load_0 = levels[k].load, phi_0 = phi_1;
  }
  return out;
}

void LocalContact::add_parts(const Compression& reached, ElasticContact& c) const {
  // Beyond the last load areas grow like Hertz's: a part that shrank towards it would vanish on a straight line.
  const double u = std::min(reached.share, 1.0), of_force = reached.level == 0 ? 1.0 : u,
               grown = reached.share > 1.0 ? two_thirds(reached.force / (*levels_)[reached.level].load) : 1.0;
  for (std::size_t i = 0; i < cell_count_; ++i) {
    const Cell& cell = cells_[i];
    Mixture mixture;
    const auto add = [&](std::size_t level, double weight, double of_area) {
      const auto& parts = cell.stretch->levels[level].parts;
      mixture.add(parts[cell.column], (1.0 - cell.share) * weight, (1.0 - cell.share) * of_area);
      mixture.add(parts[cell.column + 1], cell.share * weight, cell.share * of_area);
    };
    add(reached.level, of_force, u * grown);
    if (reached.level > 0) add(reached.level - 1, 1.0 - of_force, 1.0 - u);
    mixture.put(c, cell.turn, cell.weight);
  }
}

ElasticContact LocalContact::at(double z) const {
  ElasticContact c;
  c.in_table = covered_, c.end = end_;
  if (!covered_) return c;
  const Compression vertical = compress(z);
  if (lacks(vertical.force)) return LocalContact(*table_, place_, true).at(z);
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
  add_parts(vertical, c);
  return c;
}

double LocalContact::height_under_load(double load) const {
  if (lacks(load)) return LocalContact(*table_, place_, true).height_under_load(load);
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
