// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <algorithm>
#include <cmath>

#include "treadmark/solvers/vehicle/contact_element.hpp"

namespace treadmark::vehicle {

/// Oracle: a wheel's centre on a rail by F = k d^1.5 along the vertical, d from their heights, contact below the centre
/// at y = side. Linear creep c about the point of contact if asked for. Counts instants, to see that histories are
/// saved and restored.
class HertzSpring : public ContactElement {
 public:
  explicit HertzSpring(double k, double side_y, double radius = 0.46, double creep = 0.0)
      : k_(k), y_(side_y), radius_(radius), creep_(creep) {}

  ContactReaction evaluate(const PairMotion& m) override {
    ContactReaction r;
    // Rail heights in addition: irregularities of the track.
    const double d = m.wheelset.z + m.wheelset.roll * y_ - m.rail.z - (irregularity ? irregularity(m.wheelset.x) : 0.0);
    r.least_gap = -d;
    tried_ = m.wheelset.x;
    if (!(d > 0.0)) {
      r.status = Status::no_contact;
      return r;
    }
    const double f = k_ * std::pow(d, 1.5);
    const Vec3 arm(0.0, y_, radius_);
    const double slip_x = m.wheelset_velocity.x + m.wheelset_velocity.pitch * radius_ - m.wheelset_velocity.yaw * y_;
    const Vec3 on_wheel(-creep_ * slip_x, 0.0, -f);
    r.normal_force = f;
    r.on_rail = {-on_wheel, Vec3::Zero()};
    r.on_wheelset = {on_wheel, arm.cross(on_wheel)};
    r.longitudinal_creep_force = creep_ * slip_x;
    r.elastic_energy = 0.4 * f * d;
    r.frictional_power = creep_ * slip_x * slip_x;
    r.patches = 1;
    PatchTangent t;
    t.X_TC.origin = arm - Vec3(0.0, 0.0, radius_);
    t.stiffness_n = 1.5 * f / d;
    t.damping_x = creep_;
    t.normal_force = f;
    r.tangents = {t};
    return r;
  }
  void accept() override { ++instants, last_x = tried_; }
  void save(ByteWriter& out) const override { out.put(instants), out.put(last_x); }
  void restore(ByteReader& in) override { in.get(instants), in.get(last_x); }

  double (*irregularity)(double x) = nullptr;  ///< height of the rail, down [m]
  int instants = 0;
  double last_x = 0.0;

 private:
  double k_, y_, radius_, creep_, tried_ = 0.0;
};

}  // namespace treadmark::vehicle
