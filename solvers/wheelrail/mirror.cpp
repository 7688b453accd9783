// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/mirror.hpp"

#include <algorithm>
#include <utility>

#include "treadmark/core/constants.hpp"

namespace treadmark::wheelrail {
namespace {

void flip(SixMotion& m) {
  m.y = -m.y;
  m.roll = -m.roll;
  m.yaw = -m.yaw;
}

// Reflection of a pose in the plane y = 0: R' = S R S with S = diag(1, -1, 1).
void flip(Pose& pose) {
  pose.origin.y() = -pose.origin.y();
  pose.rotation.row(1) *= -1.0;
  pose.rotation.col(1) *= -1.0;
}

template <class T>
void reverse_all_rows(std::vector<T>& field, const Grid2& g) {
  if (field.size() != g.size()) return;
  for (int low = 0, high = g.ny - 1; low < high; ++low, --high)
    std::swap_ranges(field.begin() + static_cast<std::ptrdiff_t>(g.index(0, low)),
                     field.begin() + static_cast<std::ptrdiff_t>(g.index(0, low)) + g.nx,
                     field.begin() + static_cast<std::ptrdiff_t>(g.index(0, high)));
}

void reverse_rows_and_sign(std::vector<double>& field, const Grid2& g) {
  reverse_all_rows(field, g);
  for (double& value : field) value = -value;
}

void flip_axial(Vec3& moment) {
  moment.x() = -moment.x();
  moment.z() = -moment.z();
}

void flip(detection::PatchExtent& e) {
  std::swap(e.box.y_min, e.box.y_max);
  e.box.y_min = -e.box.y_min;
  e.box.y_max = -e.box.y_max;
  std::swap(e.z_at_y_min, e.z_at_y_max);
  e.y = -e.y;
}

void flip(PatchSolution& p) {
  flip(p.region.extent);
  for (detection::PatchExtent& part : p.region.parts) flip(part);
  p.region.y = -p.region.y;
  p.region.inclination = -p.region.inclination;
  p.region.deepest_T.y() = -p.region.deepest_T.y();
  flip(p.frame.X_TC);
  p.frame.angle = -p.frame.angle;
  p.kinematics.eta = -p.kinematics.eta;
  p.kinematics.phi = -p.kinematics.phi;
  p.reference_rail.y() = -p.reference_rail.y();
  p.reference_wheel.y() = -p.reference_wheel.y();
  p.reference_wheelset.y() = -p.reference_wheelset.y();
  p.reference_s = -p.reference_s;
  p.reference_C.y() = -p.reference_C.y();
  for (double* angle : {&p.angle_rail, &p.angle_wheelset, &p.angle_wheel}) *angle = -*angle;
  for (auto* shape : {&p.rail_shape, &p.wheel_shape})
    if (*shape && (*shape)->angle < 0.5 * kPi) (*shape)->angle = -(*shape)->angle;
  p.force_C.y() = -p.force_C.y();
  flip_axial(p.moment_C);
  p.load = mirrored(p.load);
  if (p.surface_loads)
    for (Wrench* load : {&p.surface_loads->pressure, &p.surface_loads->pressure_on_wheel, &p.surface_loads->rail,
                         &p.surface_loads->wheel}) {
      load->force.y() = -load->force.y();
      flip_axial(load->moment);
    }
  std::reverse(p.row_angle.begin(), p.row_angle.end());
  for (double& angle : p.row_angle) angle = -angle;

  kalker::ContactSolution& c = p.contact;
  for (auto* field : {&p.distance, &c.pressure, &c.traction_x, &c.displacement_n, &c.displacement_x, &c.slip_x,
                      &c.friction, &c.plastic_x, &c.yield_stress, &c.temperature_1, &c.temperature_2, &p.extra_slip_x})
    reverse_all_rows(*field, p.grid);
  for (auto* field : {&c.traction_y, &c.displacement_y, &c.slip_y, &c.plastic_y, &p.extra_slip_y})
    reverse_rows_and_sign(*field, p.grid);
  reverse_all_rows(c.state, p.grid);
  c.creepage.eta = -c.creepage.eta;
  c.creepage.phi = -c.creepage.phi;
  c.creepage.spin_y = -c.creepage.spin_y;
  c.force_y = -c.force_y;
  if (c.sensitivities) {
    auto& by = c.sensitivities->by_creepage;
    by[0][1] = -by[0][1];
    by[1][0] = -by[1][0];
    by[2][0] = -by[2][0];
    c.sensitivities->by_approach[2] = -c.sensitivities->by_approach[2];
  }
  c.moment_x = -c.moment_x;
  c.moment_n = -c.moment_n;
  p.grid.y0 = -p.grid.y(p.grid.ny - 1);
}

}  // namespace

void reverse_rows(std::vector<double>& field, const Grid2& grid) { reverse_all_rows(field, grid); }

Problem mirrored(Problem p) {
  p.side = p.side == Side::left ? Side::right : Side::left;
  Track& t = p.track;
  t.rail_y0 = -t.rail_y0;
  t.dy = -t.dy;
  t.roll = -t.roll;
  t.vy = -t.vy;
  t.vroll = -t.vroll;
  t.curvature = -t.curvature;
  if (p.rail_springs) p.rail_springs->force_y = -p.rail_springs->force_y;
  for (SixMotion* m : {&p.state.position, &p.state.velocity, &p.state.wheel_offset, &p.state.wheel_velocity}) flip(*m);
  return p;
}

PairSolution mirrored(PairSolution s) {
  for (Pose* pose : {&s.placement.X_TR, &s.placement.X_TS, &s.placement.X_TWs, &s.placement.X_TW, &s.placement.X_TA})
    flip(*pose);
  for (PatchSolution& patch : s.patches) flip(patch);
  s.load = mirrored(s.load);
  s.rail_deflection_y = -s.rail_deflection_y;
  return s;
}

}  // namespace treadmark::wheelrail
