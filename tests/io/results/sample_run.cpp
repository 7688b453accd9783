// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/io/results/sample_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>

namespace treadmark::testing {

io::PatchResult ball_patch(int nx, int ny, double pmax) {
  constexpr double kRadius = 4e-3;
  io::PatchResult patch;
  Grid2& grid = patch.fields.grid;
  grid = {0, 0, 10e-3 / nx, 10e-3 / ny, nx, ny};
  grid.x0 = -5e-3 + 0.5 * grid.dx;
  grid.y0 = -5e-3 + 0.5 * grid.dy;
  patch.npot = nx * ny;
  io::PatchFields& fields = patch.fields;
  for (int iy = 0; iy < ny; ++iy)
    for (int ix = 0; ix < nx; ++ix) {
      const double x = grid.x(ix), y = grid.y(iy), rest = 1.0 - (x * x + y * y) / (kRadius * kRadius);
      const double p = rest > 0.0 ? pmax * std::sqrt(rest) : 0.0;
      const bool slip = x < 0.0;
      fields.gap.push_back(rest < -0.4 ? std::numeric_limits<double>::quiet_NaN() : x * x + y * y);
      fields.pressure.push_back(p);
      fields.traction_x.push_back((slip ? 0.3 : 0.1) * p);
      fields.traction_s.push_back(0.05 * p);
      fields.displacement_n.push_back(1e-15 * p);
      fields.displacement_x.push_back(2e-15 * p);
      fields.displacement_s.push_back(3e-15 * p);
      fields.slip_x.push_back(slip && p > 0.0 ? -1e-4 : 0.0);
      fields.slip_s.push_back(0.0);
      fields.friction.push_back(0.3);
      fields.state.push_back(p > 0.0 ? (slip ? 2 : 1) : 0);
      patch.fn += p * grid.cell_area();
      patch.pmax = std::max(patch.pmax, p);
      if (p > 0.0) ++(slip ? patch.nslip : patch.nadh);
    }
  patch.ncon = patch.nadh + patch.nslip;
  return patch;
}

io::RunResult sample_run() {
  io::RunResult run;
  run.version = "0.1.0";
  run.git = "0123abc";
  run.threads = 2;
  run.seconds = 1.25;
  run.title = "A flat, \"fresh\"";
  run.input_file = "flat \"one\".toml";
  run.input_sha256 = "e3b0c442";
  run.geometry_sha256 = {{"a.prr", "11"}, {"b.slcw", "22"}};
  run.inputs = {{"track: gauge", "1435 mm"}, {"track: cant", "1:40"}};
  run.settings = {"wheel.backend=spline", "track.cant=0.05"};
  run.cases_total = 4;

  io::CaseResult rolling;
  rolling.number = 1;
  rolling.seconds = 0.5;
  rolling.has_wheelset = true;
  rolling.s = 0.16;
  rolling.y = -0.002;
  rolling.z = 3.729e-4;
  rolling.roll = 0.01;
  rolling.yaw = 0.02;
  rolling.pitch = -0.4363;
  rolling.vs = 2.0;
  rolling.vpitch = -4.0819068;
  rolling.force_tr = {7499.0, 322.1, 125000.0};
  rolling.force_ws = {7498.0, 321.0, 124999.0};
  rolling.moment_rail = {1.0, 2.0, 3.0};
  rolling.moment_wheel = {4.0, 5.0, 6.0};
  rolling.search_s = 0.1;
  rolling.distance_s = 0.2;
  rolling.normal_s = 0.05;
  rolling.tangential_s = 0.15;
  rolling.searches = 6;
  rolling.distances = 5;
  rolling.normal_solves = 4;
  rolling.tangential_solves = 3;
  rolling.force_iterations = {{2.646e-4, 0.0}, {3.729e-4, 125000.0}};
  for (int i = 0; i < 2; ++i) {
    io::PatchResult patch = ball_patch(24, 20, 1.1e9 - 3e8 * i);
    patch.has_reference = true;
    patch.x_tr = 1e-4;
    patch.y_tr = 0.7593304 + 0.011 * i;
    patch.z_tr = 2.81e-5;
    patch.angle = -0.0137 - 0.3 * i;
    patch.x_rail = 2e-4;
    patch.y_rail = 1.891e-3;
    patch.z_rail = 6e-6;
    patch.s_rail = 1.9e-3;
    patch.x_wheel = 3e-4;
    patch.y_wheel = 9.3304e-3;
    patch.z_wheel = -3.448e-4;
    patch.has_rolling = true;
    patch.dq = 4e-4;
    patch.velocity = 1.99958;
    patch.xi = -4.157e-4;
    patch.eta = 7.918e-11;
    patch.phi = 0.02796;
    patch.fx = 7499.0;
    patch.fs = -1390.0;
    patch.mn = -7.458;
    patch.fx_relative = 0.2;
    patch.fs_relative = -0.03707;
    patch.shear_modulus = 82e9;
    patch.elastic_energy = 5.543;
    patch.frictional_power = -4.846;
    patch.approach = 1.08244e-4;
    patch.fields.X_TC = {{patch.x_tr, patch.y_tr, patch.z_tr}, rotation_x(patch.angle)};
    rolling.patches.push_back(patch);
  }
  run.cases.push_back(rolling);

  io::CaseResult shift;
  shift.number = 2;
  shift.status = Status::not_converged;
  shift.message = "the outer loop stopped after 100 rounds";
  shift.remarks = {{RemarkKind::grid_cuts_contact, 1, "3 of 40 elements"}, {RemarkKind::step_rule, 0, "too long"}};
  io::PatchResult patch = ball_patch(19, 17, 4.393e6);
  patch.shift = true;
  patch.xi = 8.155e-6;
  patch.eta = -1e-6;
  patch.phi = 0.003;
  patch.frictional_power = -2.75e-6;
  patch.shear_modulus = 200e6;
  shift.patches.push_back(patch);
  run.cases.push_back(shift);

  io::CaseResult none;
  none.number = 3;
  none.status = Status::no_contact;
  none.has_wheelset = true;
  run.cases.push_back(none);

  io::CaseResult failed;
  failed.number = 4;
  failed.status = Status::failed;
  failed.has_wheelset = true;
  failed.z = std::numeric_limits<double>::quiet_NaN();
  failed.force_tr = Vec3(0, 0, std::numeric_limits<double>::infinity());
  failed.patches.emplace_back();
  run.cases.push_back(failed);
  return run;
}

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace treadmark::testing
