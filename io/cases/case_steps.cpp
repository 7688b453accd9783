// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/case_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace treadmark::io {

namespace {

template <class Part>
struct Motion {
  std::array<std::string_view, 2> keys;  // in two units, or one and none
  double Part::*position;
  double Part::*rate;
};

const Motion<WheelsetInput> kWheelset[] = {
    {{"wheelset.s_mm"}, &WheelsetInput::s, &WheelsetInput::vs},
    {{"wheelset.y_mm"}, &WheelsetInput::y, &WheelsetInput::vy},
    {{"wheelset.z_mm"}, &WheelsetInput::z, &WheelsetInput::vz},
    {{"wheelset.roll_deg", "wheelset.roll_rad"}, &WheelsetInput::roll, &WheelsetInput::vroll},
    {{"wheelset.yaw_deg", "wheelset.yaw_rad"}, &WheelsetInput::yaw, &WheelsetInput::vyaw},
    {{"wheelset.pitch_deg", "wheelset.pitch_rad"}, &WheelsetInput::pitch, &WheelsetInput::vpitch},
    {{"wheelset.deviation_x_mm"}, &WheelsetInput::dx, &WheelsetInput::dvx},
    {{"wheelset.deviation_y_mm"}, &WheelsetInput::dy, &WheelsetInput::dvy},
    {{"wheelset.deviation_z_mm"}, &WheelsetInput::dz, &WheelsetInput::dvz},
    {{"wheelset.deviation_roll_deg", "wheelset.deviation_roll_rad"}, &WheelsetInput::droll, &WheelsetInput::dvroll},
    {{"wheelset.deviation_yaw_deg", "wheelset.deviation_yaw_rad"}, &WheelsetInput::dyaw, &WheelsetInput::dvyaw},
    {{"wheelset.deviation_pitch_deg", "wheelset.deviation_pitch_rad"}, &WheelsetInput::dpitch, &WheelsetInput::dvpitch},
};
const Motion<TrackInput> kTrack[] = {
    {{"track.irregularity_y_mm"}, &TrackInput::dy, &TrackInput::vy},
    {{"track.irregularity_z_mm"}, &TrackInput::dz, &TrackInput::vz},
    {{"track.irregularity_roll_deg", "track.irregularity_roll_rad"}, &TrackInput::roll, &TrackInput::vroll},
};

/// Forward; on a roller that of its surface.
double rolling_velocity(const WheelRailCase& c) {
  return c.roller ? std::abs(c.roller->pitch_rate * c.roller->nominal_radius) : std::abs(c.wheelset.vs);
}

double step_in_time(const WheelRailCase& c, const Case& whole) {
  if (c.regime == RegimeInput::shift) return 1.0;
  if (whole.time_step > 0.0) return whole.time_step;
  const double velocity = rolling_velocity(c);
  if (!(velocity > 0.0))
    throw Error(ErrorKind::configuration, "case.steps needs a velocity to know where the next case is", whole.where,
                "give wheelset.velocity_m_s, roller.pitch_rate_rad_s or case.time_step_s");
  return c.discretisation.dq_relative * c.discretisation.dx / velocity;
}

template <class Part, class Motions>
void move(Part& part, const Part& before, const Part& rates, const Motions& motions, double dt,
          const std::function<bool(std::string_view)>& given) {
  for (const auto& m : motions)
    if (std::none_of(m.keys.begin(), m.keys.end(), given)) part.*m.position = before.*m.position + rates.*m.rate * dt;
}

}  // namespace

void settle_rolling_step(Case& c) {
  auto* rail = std::get_if<WheelRailCase>(&c.content);
  if (rail == nullptr || !(c.time_step > 0.0) || rail->regime != RegimeInput::transient) return;
  const double rolled = rolling_velocity(*rail) * c.time_step;
  if (rolled > 0.0) rail->discretisation.dq_relative = rolled / rail->discretisation.dx;
}

void move_on(Case& next, const Case& previous, const std::function<bool(std::string_view)>& given) {
  auto* to = std::get_if<WheelRailCase>(&next.content);
  const auto* from = std::get_if<WheelRailCase>(&previous.content);
  if (to == nullptr || from == nullptr) return;
  const double dt = step_in_time(*to, next);
  WheelsetInput rates = to->wheelset;
  // The rate that a force will ask for is not known yet, but it is close to that of free rolling.
  if (to->longitudinal_force && rates.vpitch == 0.0)
    rates.vpitch =
        -(to->roller ? to->roller->pitch_rate * to->roller->nominal_radius : rates.vs) / rates.nominal_radius;
  move(to->wheelset, from->wheelset, rates, kWheelset, dt, given);
  move(to->track, from->track, TrackInput(to->track), kTrack, dt, given);
}

}  // namespace treadmark::io
