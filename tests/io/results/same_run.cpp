// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/tests/io/results/same_run.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <span>

#include "treadmark/io/results/field_table.hpp"

namespace treadmark::testing {
namespace {

bool same(double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); }

void expect_same(std::span<const double> read, std::span<const double> written, const char* what) {
  ASSERT_EQ(read.size(), written.size()) << what;
  for (std::size_t i = 0; i < read.size(); ++i)
    ASSERT_TRUE(same(read[i], written[i])) << what << " " << i << ": " << read[i] << " " << written[i];
}

void expect_same(const Vec3& read, const Vec3& written, const char* what) {
  expect_same(std::span(read.data(), 3), std::span(written.data(), 3), what);
}

void expect_same(const Mat3& read, const Mat3& written, const char* what) {
  expect_same(std::span(read.data(), 9), std::span(written.data(), 9), what);
}

void expect_same(const Pose& read, const Pose& written, const char* what) {
  expect_same(read.origin, written.origin, what);
  expect_same(read.rotation, written.rotation, what);
}

void expect_same(const std::optional<io::Loads>& read, const std::optional<io::Loads>& written) {
  ASSERT_EQ(read.has_value(), written.has_value());
  if (!read) return;
  for (const auto member : {&io::Loads::track, &io::Loads::rail, &io::Loads::wheelset, &io::Loads::wheel}) {
    expect_same(((*read).*member).force, ((*written).*member).force, "force");
    expect_same(((*read).*member).moment, ((*written).*member).moment, "moment");
  }
}

void expect_same(const io::PatchFields& read, const io::PatchFields& written) {
  for (const io::FieldColumn& column : io::kFieldColumns)
    expect_same(read.*column.values, written.*column.values, column.name.data());
  expect_same(read.row_angle, written.row_angle, "row_angle");
  EXPECT_EQ(read.state, written.state);
}

void expect_same(const io::SubsurfaceBlock& read, const io::SubsurfaceBlock& written) {
  EXPECT_EQ(read.nx, written.nx);
  EXPECT_EQ(read.ny, written.ny);
  EXPECT_EQ(read.nz, written.nz);
  ASSERT_EQ(read.values.size(), written.values.size());
  for (std::size_t i = 0; i < read.values.size(); ++i) {
    const io::SubsurfaceValue &a = read.values[i], &b = written.values[i];
    expect_same(a.point, b.point, "point");
    expect_same(a.displacement, b.displacement, "displacement");
    expect_same(a.stress, b.stress, "stress");
    expect_same(a.principal, b.principal, "principal");
    EXPECT_EQ(a.hydrostatic, b.hydrostatic);
    EXPECT_EQ(a.von_mises, b.von_mises);
    EXPECT_EQ(a.tresca, b.tresca);
  }
}

void expect_same(const io::PatchResult& read, const io::PatchResult& written) {
  using P = io::PatchResult;
  for (const auto member : {&P::has_reference, &P::has_rolling, &P::shift}) EXPECT_EQ(read.*member, written.*member);
  for (const auto number : {&P::x_tr,
                            &P::y_tr,
                            &P::z_tr,
                            &P::angle,
                            &P::x_rail,
                            &P::y_rail,
                            &P::z_rail,
                            &P::s_rail,
                            &P::x_wheel,
                            &P::y_wheel,
                            &P::z_wheel,
                            &P::x_wheelset,
                            &P::y_wheelset,
                            &P::z_wheelset,
                            &P::angle_rail,
                            &P::angle_wheelset,
                            &P::angle_wheel,
                            &P::reference_x,
                            &P::reference_s,
                            &P::chi,
                            &P::dq,
                            &P::velocity,
                            &P::xi,
                            &P::eta,
                            &P::phi,
                            &P::fn,
                            &P::fx,
                            &P::fs,
                            &P::mn,
                            &P::fx_relative,
                            &P::fs_relative,
                            &P::shear_modulus,
                            &P::elastic_energy,
                            &P::frictional_power,
                            &P::approach,
                            &P::pmax})
    EXPECT_TRUE(same(read.*number, written.*number)) << read.*number << " " << written.*number;
  for (const auto count : {&P::npot, &P::ncon, &P::nadh, &P::nslip}) EXPECT_EQ(read.*count, written.*count);
  EXPECT_EQ(read.id, written.id);
  EXPECT_EQ(read.came_from, written.came_from);
  EXPECT_EQ(read.max_temperature_1, written.max_temperature_1);
  EXPECT_EQ(read.max_temperature_2, written.max_temperature_2);
  expect_same(read.loads, written.loads);
  ASSERT_EQ(read.local.has_value(), written.local.has_value());
  if (read.local)
    expect_same(Vec3(read.local->fx, read.local->fs, read.local->fn),
                Vec3(written.local->fx, written.local->fs, written.local->fn), "local");
  expect_same(read.fields, written.fields);
  ASSERT_EQ(read.subsurface.size(), written.subsurface.size());
  for (std::size_t i = 0; i < read.subsurface.size(); ++i) expect_same(read.subsurface[i], written.subsurface[i]);
}

}  // namespace

void expect_same_surface(const io::SampledSurface& read, const io::SampledSurface& written) {
  EXPECT_EQ(read.body, written.body);
  EXPECT_EQ(read.name, written.name);
  EXPECT_EQ(read.nu, written.nu);
  EXPECT_EQ(read.nv, written.nv);
  EXPECT_EQ(read.closed, written.closed);
  using S = io::SampledSurface;
  for (const auto list : {&S::u, &S::x, &S::y, &S::z, &S::deviation})
    expect_same(read.*list, written.*list, written.name.c_str());
}

void expect_same_case(const io::CaseResult& read, const io::CaseResult& written, bool seconds) {
  SCOPED_TRACE("case " + std::to_string(written.number));
  using C = io::CaseResult;
  EXPECT_EQ(read.number, written.number);
  EXPECT_EQ(read.status, written.status);
  EXPECT_EQ(read.message, written.message);
  ASSERT_EQ(read.remarks.size(), written.remarks.size());
  for (std::size_t i = 0; i < read.remarks.size(); ++i) {
    EXPECT_EQ(read.remarks[i].kind, written.remarks[i].kind);
    EXPECT_EQ(read.remarks[i].patch, written.remarks[i].patch);
    EXPECT_EQ(read.remarks[i].text, written.remarks[i].text);
  }
  EXPECT_EQ(read.has_wheelset, written.has_wheelset);
  if (seconds) {
    EXPECT_EQ(read.seconds, written.seconds);
  }
  for (const auto number :
       {&C::s, &C::y, &C::z, &C::roll, &C::yaw, &C::pitch, &C::vs, &C::vy, &C::vz, &C::vroll, &C::vyaw, &C::vpitch})
    EXPECT_TRUE(same(read.*number, written.*number)) << read.*number << " " << written.*number;
  for (const auto vector : {&C::force_tr, &C::force_ws, &C::moment_rail, &C::moment_wheel})
    expect_same(read.*vector, written.*vector, "a total");
  expect_same(read.loads, written.loads);
  EXPECT_EQ(read.rail_deflection, written.rail_deflection);
  ASSERT_EQ(read.roller.has_value(), written.roller.has_value());
  if (read.roller) {
    EXPECT_EQ(read.roller->nominal_radius, written.roller->nominal_radius);
    EXPECT_EQ(read.roller->pitch_rate, written.roller->pitch_rate);
  }
  ASSERT_EQ(read.bodies.has_value(), written.bodies.has_value());
  if (read.bodies) {
    expect_same(read.bodies->X_TA, written.bodies->X_TA, "X_TA");
    expect_same(read.bodies->X_TS, written.bodies->X_TS, "X_TS");
  }
  EXPECT_EQ(read.wheel_surface, written.wheel_surface);
  EXPECT_EQ(read.rail_surface, written.rail_surface);
  ASSERT_EQ(read.patches.size(), written.patches.size());
  for (std::size_t i = 0; i < read.patches.size(); ++i) {
    SCOPED_TRACE("patch " + std::to_string(i + 1));
    expect_same(read.patches[i], written.patches[i]);
  }
}

void expect_same_run(const io::RunResult& read, const io::RunResult& written) {
  EXPECT_EQ(read.version, written.version);
  EXPECT_EQ(read.git, written.git);
  EXPECT_EQ(read.threads, written.threads);
  EXPECT_EQ(read.seconds, written.seconds);
  EXPECT_EQ(read.title, written.title);
  EXPECT_EQ(read.input_file, written.input_file);
  EXPECT_EQ(read.input_sha256, written.input_sha256);
  EXPECT_EQ(read.geometry_sha256, written.geometry_sha256);
  EXPECT_EQ(read.inputs, written.inputs);
  EXPECT_EQ(read.settings, written.settings);
  EXPECT_EQ(read.complete, written.complete);
  EXPECT_EQ(read.cases_total, written.cases_total);
  ASSERT_EQ(read.cases.size(), written.cases.size());
  for (std::size_t i = 0; i < read.cases.size(); ++i) expect_same_case(read.cases[i], written.cases[i]);
  ASSERT_EQ(read.sampled.size(), written.sampled.size());
  for (std::size_t i = 0; i < read.sampled.size(); ++i) expect_same_surface(read.sampled[i], written.sampled[i]);
}

std::vector<io::SampledSurface> sample_surfaces() {
  const double none = std::numeric_limits<double>::quiet_NaN();
  io::SampledSurface wheel{"wheel",
                           "wheel_1",
                           3,
                           2,
                           true,
                           {-2.0, 0.1, 2.1},
                           {-0.41, -0.42, 0.04, none, 0.39, 0.4},
                           {-0.03, 0.01, -0.03, none, -0.03, 0.01},
                           {-0.19, -0.2, 0.45, none, -0.22, -0.23},
                           {0.0, 1e-5, -3e-4, none, 1.0 / 3e7, 0.0}};
  io::SampledSurface rail{"rail",
                          "rail_1",
                          2,
                          2,
                          false,
                          {-0.15, 0.15},
                          {-0.15, -0.15, 0.15, 0.15},
                          {-0.03, 0.03, -0.03, 0.03},
                          {2e-3, 3e-3, 2e-3, 3e-3},
                          {}};
  return {wheel, rail};
}

}  // namespace treadmark::testing
