// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/byte_archive.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::wheelrail {

/// Every number of a solution but the time it took: solutions with the same bytes are the same to the last bit.
class SolutionBytes {
 public:
  static std::vector<std::byte> of(const PairSolution& s) {
    SolutionBytes b;
    b.add(s);
    return b.out_.bytes();
  }

 private:
  template <class... Values>
  void put(const Values&... values) {
    (out_.put(values), ...);
  }
  void add(const Vec3& v) { put(v.x(), v.y(), v.z()); }
  void add(const Pose& x) {
    add(x.origin);
    for (int i = 0; i < 3; ++i) add(Vec3(x.rotation.row(i)));
  }
  void add(const Grid2& g) { put(g.x0, g.y0, g.dx, g.dy, g.nx, g.ny); }
  void add(const Report& r) { put(r.status, r.iterations, r.residual, r.message); }
  void add(const Wrenches& w) {
    for (const Wrench* one : {&w.track, &w.rail, &w.wheelset, &w.wheel}) {
      add(one->force);
      add(one->moment);
    }
  }
  void add(const kalker::ContactSolution& c) {
    put(c.status);
    add(c.normal);
    add(c.tangential);
    put(c.pressure, c.traction_x, c.traction_y, c.displacement_n, c.displacement_x, c.displacement_y, c.slip_x,
        c.slip_y, c.friction, c.plastic_x, c.plastic_y, c.yield_stress, c.temperature_1, c.temperature_2,
        std::span<const kalker::ElementState>(c.state));
    put(c.approach, c.creepage.xi, c.creepage.eta, c.creepage.phi, c.rolling_step, c.force_n, c.force_x, c.force_y,
        c.moment_x, c.moment_y, c.moment_n, c.max_pressure, c.elastic_energy, c.frictional_power, c.elements_contact,
        c.elements_adhesion, c.elements_slip);
  }
  void add(const PatchSolution& p) {
    add(p.frame.X_TC);
    add(p.grid);
    put(p.distance, p.row_angle, p.extra_slip_x, p.extra_slip_y);
    put(p.approach, p.kinematics.xi, p.kinematics.eta, p.kinematics.phi, p.kinematics.chi, p.kinematics.velocity);
    add(p.contact);
    for (const Vec3* v : {&p.force_C, &p.moment_C, &p.reference_rail, &p.reference_wheel, &p.reference_wheelset})
      add(*v);
    add(p.load);
    put(p.id, p.reference_s, p.reference_C.x(), p.reference_C.y(), p.angle_rail, p.angle_wheelset, p.angle_wheel);
    put(std::span<const std::uint64_t>(p.came_from));
  }
  void add(const PairSolution& s) {
    put(s.status, s.message, s.z, s.least_gap, s.pitch_rate, s.rail_deflection_y, s.rail_deflection_z,
        s.patches.size());
    for (const PatchSolution& p : s.patches) add(p);
    for (const auto& [z, force] : s.force_iterations) put(z, force);
    add(s.load);
  }

  ByteWriter out_;
};

}  // namespace treadmark::wheelrail
