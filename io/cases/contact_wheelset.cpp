// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <array>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/io/cases/contact_case.hpp"

namespace treadmark::io {

namespace {

/// Three lengths and three angles, or their rates.
void read_six(ContactText& text, const std::array<std::string_view, 6>& names, SixMotion& motion) {
  double* const values[] = {&motion.x, &motion.y, &motion.z, &motion.roll, &motion.yaw, &motion.pitch};
  for (std::size_t i = 0; i < 3; ++i) *values[i] = text.real(names[i]) * kMillimetre;
  for (std::size_t i = 3; i < 6; ++i) *values[i] = text.angle(names[i]);
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
      r.kept.roller_pitch_rate = text.angle("VPITCH_ROL");
    else
      r.kept.forward_velocity = text.real("VS") * kMillimetre;
    s.velocity.y = text.real("VY") * kMillimetre;
    s.velocity.z = text.real("VZ") * kMillimetre;
    s.velocity.roll = text.angle("VROLL");
    s.velocity.yaw = text.angle("VYAW");
    if ((*r.problem)["FORCE"] == 1)
      r.kept.longitudinal_force = text.real("FX");
    else
      r.kept.pitch_rate = text.angle("VPITCH");
  }
  if (e >= 4) {
    text.begin_record("the wheel deviation line DXWHL");
    read_six(text, {"DXWHL", "DYWHL", "DZWHL", "DROLLW", "DYAWW", "DPITCHW"}, s.wheel_offset);
    text.begin_record("the wheel deviation velocity line VXWHL");
    read_six(text, {"VXWHL", "VYWHL", "VZWHL", "VROLLW", "VYAWW", "VPITCHW"}, s.wheel_velocity);
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

}  // namespace treadmark::io
