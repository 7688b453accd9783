// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/app/cases/wheelrail_result.hpp"

#include <memory>
#include <numeric>
#include <utility>

#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/io/cases/read_influence.hpp"
#include "treadmark/solvers/kalker/subsurface/subsurface_stress.hpp"

namespace treadmark::app {

namespace {

io::Load to_load(const wheelrail::Wrench& load) { return {load.force, load.moment}; }

io::Loads to_loads(const wheelrail::Wrenches& load) {
  return {to_load(load.track), to_load(load.rail), to_load(load.wheelset), to_load(load.wheel)};
}

void put_reference(const wheelrail::PatchSolution& patch, io::PatchResult& r) {
  r.has_reference = true;
  const Vec3 &track = patch.frame.X_TC.origin, &rail = patch.reference_rail;
  const Vec3 &wheel = patch.reference_wheel, &set = patch.reference_wheelset;
  r.x_tr = track.x();
  r.y_tr = track.y();
  r.z_tr = track.z();
  r.angle = patch.frame.angle;
  r.x_rail = rail.x();
  r.y_rail = rail.y();
  r.z_rail = rail.z();
  r.s_rail = patch.reference_s;
  r.x_wheel = wheel.x();
  r.y_wheel = wheel.y();
  r.z_wheel = wheel.z();
  r.x_wheelset = set.x();
  r.y_wheelset = set.y();
  r.z_wheelset = set.z();
  r.angle_rail = patch.angle_rail;
  r.angle_wheelset = patch.angle_wheelset;
  r.angle_wheel = patch.angle_wheel;
  const auto curvatures = [](const std::optional<wheelrail::ContactShape>& shape) {
    std::optional<io::PatchResult::Curvatures> out;
    if (shape) out = {shape->curvature_1, shape->curvature_2, shape->angle};
    return out;
  };
  r.rail_curvatures = curvatures(patch.rail_shape);
  r.wheel_curvatures = curvatures(patch.wheel_shape);
  // Elements of grids that stay aligned in time have another origin than the contact reference.
  r.reference_x = patch.reference_C.x();
  r.reference_s = patch.reference_C.y();
  r.fields.X_TC = patch.frame.X_TC;
  r.fields.X_TC.origin = patch.frame.X_TC.apply({-patch.reference_C.x(), -patch.reference_C.y(), 0.0});
}

/// What the patch feels as a whole; of a plane without damping these are the sums of the elements.
void put_resultant(const io::WheelRailCase& input, const wheelrail::PatchSolution& patch, io::PatchResult& r) {
  const bool curved = !patch.row_angle.empty();
  if (curved) r.local = {r.fn, r.fx, r.fs};
  if (curved || input.damping) {
    r.fx = patch.force_C.x();
    r.fs = patch.force_C.y();
    r.fn = patch.force_C.z();
  }
  const bool aligned = patch.reference_C != Vec2::Zero();
  if (curved || (aligned && input.conventions != Conventions::contact)) r.mn = patch.moment_C.z();
}

void put_kinematics(const io::WheelRailCase& input, const wheelrail::PatchSolution& patch, io::PatchResult& r) {
  r.has_rolling = input.regime == Regime::steady || input.regime == Regime::transient;
  r.shift = input.regime == Regime::shift;
  r.chi = patch.kinematics.chi;
  r.velocity = patch.kinematics.velocity;
  r.dq = patch.contact.rolling_step;
  r.xi = patch.kinematics.xi;
  r.eta = patch.kinematics.eta;
  r.phi = patch.kinematics.phi;
}

io::PatchResult to_patch(const io::WheelRailCase& input, const wheelrail::PatchSolution& patch) {
  io::PatchResult r =
      patch_result(patch.contact, patch.grid, patch.distance, input.material, friction_of(input, patch.frame.angle));
  r.id = patch.id;
  r.came_from = patch.came_from;
  put_reference(patch, r);
  put_resultant(input, patch, r);
  put_kinematics(input, patch, r);
  r.loads = to_loads(patch.load);
  if (const auto& left = patch.refinement) r.refinement = {left->pressure, left->area, left->force};
  r.fields.row_angle = patch.row_angle;
  r.fields.extra_slip_x = patch.extra_slip_x;
  r.fields.extra_slip_s = patch.extra_slip_y;
  add_dissipation(r);
  add_subsurface(input.subsurface, input.material, patch.grid, patch.contact, r, patch.reference_C);
  return r;
}

}  // namespace

io::CaseResult to_result(const io::WheelRailCase& input, const wheelrail::PairSolution& s) {
  io::CaseResult result;
  result.status = s.status;
  result.message = s.message;
  result.remarks = s.remarks;
  const WheelsetState& w = input.state;
  result.has_wheelset = true;
  result.s = w.position.x;
  result.y = w.position.y;
  result.z = s.z;
  result.roll = w.position.roll;
  result.yaw = w.position.yaw;
  result.pitch = w.position.pitch;
  result.vs = w.velocity.x;
  result.vy = w.velocity.y;
  result.vz = w.velocity.z;
  result.vroll = w.velocity.roll;
  result.vyaw = w.velocity.yaw;
  result.vpitch = input.longitudinal_force ? s.pitch_rate : w.velocity.pitch;
  result.force_tr = s.load.track.force;
  result.force_ws = s.load.wheelset.force;
  result.moment_rail = s.load.track.moment;
  result.moment_wheel = s.load.wheelset.moment;
  result.loads = to_loads(s.load);
  if (input.rail_springs) result.rail_deflection = Vec2(s.rail_deflection_y, s.rail_deflection_z);
  if (input.roller) result.roller = {input.roller->nominal_radius, input.roller->pitch_rate};
  result.bodies = io::CaseResult::Bodies{s.placement.X_TA, s.placement.X_TS};
  result.search_s = s.times.search_s;
  result.distance_s = s.times.distance_s;
  result.normal_s = s.times.normal_s;
  result.tangential_s = s.times.tangential_s;
  result.searches = s.times.searches;
  result.distances = s.times.distances;
  result.normal_solves = s.times.normal_solves;
  result.tangential_solves = s.times.tangential_solves;
  result.force_iterations = s.force_iterations;

  for (const wheelrail::PatchSolution& patch : s.patches) result.patches.push_back(to_patch(input, patch));
  return result;
}

InfluenceSettings to_influence(const io::InfluenceInput& input) {
  InfluenceSettings out = input;
  if (input.kind == InfluenceSettings::Kind::table)
    out.table = std::make_shared<const NumericalInfluence>(io::read_influence(input.file));
  return out;
}

io::PatchResult patch_result(const kalker::ContactSolution& c, const Grid2& grid, const std::vector<double>& gap,
                             const Material& material, const FrictionLaw& friction) {
  io::PatchResult r;
  r.fn = c.force_n;
  r.fx = c.force_x;
  r.fs = c.force_y;
  r.mn = c.moment_n;
  const double bound = friction.static_friction() * c.force_n;
  if (bound > 0.0) {
    r.fx_relative = c.force_x / bound;
    r.fs_relative = c.force_y / bound;
  }
  r.shear_modulus = combine(material).shear_modulus;
  r.elastic_energy = c.elastic_energy;
  r.frictional_power = c.frictional_power;
  r.approach = c.approach;
  r.pmax = c.max_pressure;
  r.npot = static_cast<int>(grid.size());
  r.ncon = c.elements_contact;
  r.nadh = c.elements_adhesion;
  r.nslip = c.elements_slip;

  io::PatchFields& f = r.fields;
  f.grid = grid;
  f.gap = gap;
  f.pressure = c.pressure;
  f.traction_x = c.traction_x;
  f.traction_s = c.traction_y;
  f.displacement_n = c.displacement_n;
  f.displacement_x = c.displacement_x;
  f.displacement_s = c.displacement_y;
  f.slip_x = c.slip_x;
  f.slip_s = c.slip_y;
  f.friction = c.friction;
  f.plastic_x = c.plastic_x;
  f.plastic_s = c.plastic_y;
  f.yield_stress = c.yield_stress;
  f.temperature_1 = c.temperature_1;
  f.temperature_2 = c.temperature_2;
  if (!c.temperature_1.empty()) {
    r.max_temperature_1 = c.max_temperature_1;
    r.max_temperature_2 = c.max_temperature_2;
  }
  if (c.sensitivities) r.sensitivities = {c.sensitivities->by_creepage, c.sensitivities->by_approach};
  f.state.reserve(c.state.size());
  for (const kalker::ElementState state : c.state) f.state.push_back(static_cast<std::uint8_t>(state));
  return r;
}

namespace {

/// Coordinates of chosen columns or rows that exist; none chosen: all.
std::vector<double> coordinates(const std::vector<int>& chosen, int count, double first, double step) {
  std::vector<int> all = chosen;
  if (all.empty()) {
    all.resize(static_cast<std::size_t>(count));
    std::iota(all.begin(), all.end(), 0);
  }
  std::vector<double> out;
  for (const int i : all)
    if (i < count) out.push_back(first + i * step);
  return out;
}

std::vector<double> moved(std::vector<double> positions, double by) {
  for (double& p : positions) p += by;
  return positions;
}

io::SubsurfaceBlock block_result(const io::SubsurfaceInput::Block& input, const kalker::SurfaceTractions& tractions,
                                 const Material& material, const Vec2& origin) {
  const Grid2& grid = tractions.grid;
  const std::vector<double> x = input.at_elements ? coordinates(input.columns, grid.nx, grid.x0, grid.dx)
                                                  : moved(input.x, origin.x()),
                            y = input.at_elements ? coordinates(input.rows, grid.ny, grid.y0, grid.dy)
                                                  : moved(input.y, origin.y());
  const bool whole = input.at_elements && input.columns.empty() && input.rows.empty();
  const std::vector<kalker::SubsurfacePoint> points =
      whole ? kalker::subsurface_stress_on_grid(tractions, material, input.z)
            : kalker::subsurface_stress(tractions, material, kalker::block_of_points(x, y, input.z));
  io::SubsurfaceBlock out;
  out.nx = static_cast<int>(x.size());
  out.ny = static_cast<int>(y.size());
  out.nz = static_cast<int>(input.z.size());
  for (const kalker::SubsurfacePoint& p : points)
    out.values.push_back({p.point, p.displacement, p.stress, p.hydrostatic, p.von_mises, p.tresca, p.principal});
  return out;
}

}  // namespace

void add_subsurface(const io::SubsurfaceInput& input, const Material& material, const Grid2& grid,
                    const kalker::ContactSolution& solution, io::PatchResult& result, const Vec2& origin) {
  const kalker::SurfaceTractions tractions = kalker::surface_tractions(grid, solution);
  for (const io::SubsurfaceInput::Block& block : input.blocks) {
    io::SubsurfaceBlock values = block_result(block, tractions, material, origin);
    if (!values.values.empty()) result.subsurface.push_back(std::move(values));
  }
  result.subsurface_table = input.text_table;
  result.full_tensor = input.full_tensor;
}

void add_dissipation(io::PatchResult& result) {
  io::PatchFields& f = result.fields;
  if (f.traction_x.empty() || f.slip_x.empty() || !f.yield_stress.empty()) return;
  const double velocity = result.shift ? 1.0 : result.velocity;  // in a shift, slip is a distance
  f.dissipation.assign(f.traction_x.size(), 0.0);
  for (std::size_t i = 0; i < f.dissipation.size(); ++i)
    if (f.state[i] != 0)
      f.dissipation[i] = 0.0 - velocity * (f.traction_x[i] * f.slip_x[i] + f.traction_s[i] * f.slip_s[i]);
}

}  // namespace treadmark::app
