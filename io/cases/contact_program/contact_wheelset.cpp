// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <string_view>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_program/contact_case.hpp"
#include "treadmark/io/files/extension.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

/// Three lengths and three angles, or their rates; greatest: of both in SI units.
void read_six(ContactText& text, const std::array<std::string_view, 6>& names, double greatest, SixMotion& motion) {
  double* const values[] = {&motion.x, &motion.y, &motion.z, &motion.roll, &motion.yaw, &motion.pitch};
  for (std::size_t i = 0; i < 3; ++i) *values[i] = text.real(names[i], greatest / kMillimetre) * kMillimetre;
  for (std::size_t i = 3; i < 6; ++i) *values[i] = text.angle(names[i], greatest);
}

}  // namespace

void read_wheelset(ContactReader& r) {
  ContactText& text = r.text;
  const int e = (*r.model)["EWHEEL"], normal = (*r.problem)["NORM"];
  WheelRailCase& c = r.kept.wheel_rail;
  WheelsetDimensions& w = c.wheelset;
  WheelsetState& s = c.state;
  if (e == 0) {
    if (r.kept.previous_normal >= 0 && r.kept.previous_normal != normal)
      throw Error(ErrorKind::configuration,
                  fmt::format("N (NORM) = {} differs from the previous case: that needs E (EWHEEL) > 0", normal),
                  r.problem->where("NORM"));
    return;
  }
  if (e == 3 || e == 5) {
    text.begin_record("the wheelset line FBDIST");
    w.flange_back_distance = text.real("FBDIST") * kMillimetre;
    w.flange_back_position = text.real("FBPOS") * kMillimetre;
    w.nominal_radius = text.real("NOMRAD") * kMillimetre;
    if (!(w.nominal_radius > 0.0)) text.fail("NOMRAD must be positive");
    constexpr double kUnusedTapeLine = 999.0;
    const auto tape = text.optional_real();
    w.tape_line = tape && std::abs(*tape) < kUnusedTapeLine ? std::optional(*tape * kMillimetre) : std::nullopt;
    c.wheel = read_profile(r, "wheel");
    r.kept.has_wheel = true;
  }
  text.begin_record("the wheelset position line S");
  s.position.x = text.real(r.on_roller() ? "X" : "S") * kMillimetre;
  s.position.y = text.real("Y") * kMillimetre;
  if (normal == 1)
    c.vertical_force = text.real("FZ");
  else
    s.position.z = text.real("Z") * kMillimetre;
  s.position.roll = text.angle("ROLL");
  s.position.yaw = text.angle("YAW");
  s.position.pitch = text.angle("PITCH");
  if (e >= 2) {
    text.begin_record("the wheelset velocity line VS");
    if (r.on_roller())
      r.kept.roller_pitch_rate = text.angle("VPITCH_ROL", kMostSpeed);
    else
      r.kept.forward_velocity = text.real("VS", kMostSpeed / kMillimetre) * kMillimetre;
    s.velocity.y = text.real("VY", kMostSpeed / kMillimetre) * kMillimetre;
    s.velocity.z = text.real("VZ", kMostSpeed / kMillimetre) * kMillimetre;
    s.velocity.roll = text.angle("VROLL", kMostSpeed);
    s.velocity.yaw = text.angle("VYAW", kMostSpeed);
    if ((*r.problem)["FORCE"] == 1)
      r.kept.longitudinal_force = text.real("FX");
    else
      r.kept.pitch_rate = text.angle("VPITCH", kMostSpeed);
  }
  if (e >= 4) {
    text.begin_record("the wheel deviation line DXWHL");
    read_six(text, {"DXWHL", "DYWHL", "DZWHL", "DROLLW", "DYAWW", "DPITCHW"}, kInfinity, s.wheel_offset);
    text.begin_record("the wheel deviation velocity line VXWHL");
    read_six(text, {"VXWHL", "VYWHL", "VZWHL", "VROLLW", "VYAWW", "VPITCHW"}, kMostSpeed, s.wheel_velocity);
  }
}

/// What the digits take of the kept motion.
void put_motion(ContactReader& r, WheelRailCase& c) {
  const ContactSequence& kept = r.kept;
  const ControlWord& problem = *r.problem;
  const auto need = [&](const std::optional<double>& value, std::string_view digit, std::string_view name) {
    if (!value)
      r.fail_at(problem, digit, fmt::format("needs {} of the velocity line, but no case has given it", name),
                "use E (EWHEEL) = 2 or more");
    return *value;
  };
  c.roller.reset();
  if (r.on_roller()) {
    if (!kept.roller_radius)
      r.fail_at(problem, "CONFIG", "needs NOMRAD of the roller, but no case has given it", "use Z (ZTRACK) = 3");
    c.roller = {*kept.roller_radius, need(kept.roller_pitch_rate, "CONFIG", "the roller's pitch rate")};
    c.state.velocity.x = 0.0;
  } else {
    c.state.velocity.x = need(kept.forward_velocity, "CONFIG", "VS");
  }
  c.longitudinal_force.reset();
  if (problem["FORCE"] == 1) {
    c.longitudinal_force = need(kept.longitudinal_force, "FORCE", "FX");
    c.state.velocity.pitch = kept.pitch_rate.value_or(0.0);
  } else {
    c.state.velocity.pitch = need(kept.pitch_rate, "FORCE", "VPITCH");
  }
  c.rail_springs.reset();
  if (problem["FORCE"] != 3) return;
  if (!kept.rail_springs)
    r.fail_at(problem, "FORCE", "needs the line KYRAIL, but no case has given it", "use Z (ZTRACK) = 2 or 3");
  c.rail_springs = kept.rail_springs;
}

namespace {

void read_placement(ContactReader& r) {
  ContactText& text = r.text;
  Track& t = r.kept.wheel_rail.track;
  text.begin_record("the track line GAUGHT");
  const double height = text.real("GAUGHT");
  t.gauge_based = height > 0.0;
  t.gauge_at_innermost = true;
  if (t.gauge_based) {
    t.gauge_height = height * kMillimetre;
    const double which = text.real("GAUGSQ");
    if (which != 0.0 && which != 1.0)
      r.note(fmt::format("GAUGSQ = {} at {}: only the first gauge point is known", which, text.where().to_string()));
    t.gauge_width = text.real("GAUGWD") * kMillimetre;
    if (!(t.gauge_width > 0.0)) text.fail("GAUGWD must be positive");
  } else {
    t.rail_y0 = text.real("RAILY0") * kMillimetre;
    t.rail_z0 = text.real("RAILZ0") * kMillimetre;
  }
  if (r.on_roller()) {
    r.kept.roller_radius = text.real("NOMRAD") * kMillimetre;
    if (*r.kept.roller_radius == 0.0) text.fail("NOMRAD of a roller must not be 0");
    t.cant = 0.0;
  } else {
    t.cant = text.angle("CANT");
  }
  t.curvature = text.optional_real().value_or(0.0) * kMilli;
  r.kept.wheel_rail.rail = read_profile(r, "rail");
  r.kept.has_rail = true;
  const auto& file = std::get<GeometryFile>(r.kept.wheel_rail.rail.geometry).file;
  if (extension_of(file) == ".slcs" && t.gauge_based)
    throw Error(ErrorKind::configuration, "a rail given by slices has no gauge point: it needs GAUGHT <= 0",
                r.kept.wheel_rail.rail.where, "give RAILY0 and RAILZ0");
}

void read_springs(ContactReader& r) {
  ContactText& text = r.text;
  text.begin_record("the massless rail line KYRAIL");
  RailSprings springs;
  springs.stiffness_y = text.real("KYRAIL") * kMilli;
  springs.force_y = text.real("FYRAIL");
  springs.stiffness_z = text.real("KZRAIL") * kMilli;
  springs.force_z = text.real("FZRAIL");
  if (const auto step = text.optional_real()) {
    springs.first_step_y = *step * kMillimetre;
    if (!(springs.first_step_y > 0.0)) text.fail("DYSTEP0 must be positive");
  }
  r.kept.rail_springs = springs;
}

}  // namespace

void read_track(ContactReader& r) {
  ContactText& text = r.text;
  const int z = (*r.model)["ZTRACK"];
  Track& t = r.kept.wheel_rail.track;
  if (z == 1 || z == 3) read_placement(r);
  if (z < 2) return;
  text.begin_record("the track deviation line DY");
  t.dy = text.real("DY") * kMillimetre;
  t.dz = text.real("DZ") * kMillimetre;
  t.roll = text.angle("ROLL");
  t.vy = text.real("VY", kMostSpeed / kMillimetre) * kMillimetre;
  t.vz = text.real("VZ", kMostSpeed / kMillimetre) * kMillimetre;
  t.vroll = text.angle("VROLL", kMostSpeed);
  if ((*r.problem)["FORCE"] == 3) read_springs(r);
}

}  // namespace treadmark::io
