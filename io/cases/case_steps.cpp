// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cases/case_steps.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace treadmark::io {

namespace {

using KeyNames = std::array<std::string_view, 2>;  // in two units, or one and none

struct TrackMotion {
  KeyNames keys;
  double Track::*position;
  double Track::*rate;
};

constexpr TrackMotion kTrack[] = {
    {{"track.irregularity_y_mm"}, &Track::dy, &Track::vy},
    {{"track.irregularity_z_mm"}, &Track::dz, &Track::vz},
    {{"track.irregularity_roll_deg", "track.irregularity_roll_rad"}, &Track::roll, &Track::vroll},
};

constexpr double SixMotion::*kAxes[] = {&SixMotion::x,    &SixMotion::y,   &SixMotion::z,
                                        &SixMotion::roll, &SixMotion::yaw, &SixMotion::pitch};
constexpr KeyNames kWheelset[] = {{"wheelset.s_mm"},
                                  {"wheelset.y_mm"},
                                  {"wheelset.z_mm"},
                                  {"wheelset.roll_deg", "wheelset.roll_rad"},
                                  {"wheelset.yaw_deg", "wheelset.yaw_rad"},
                                  {"wheelset.pitch_deg", "wheelset.pitch_rad"}};
constexpr KeyNames kDeviation[] = {{"wheelset.deviation_x_mm"},
                                   {"wheelset.deviation_y_mm"},
                                   {"wheelset.deviation_z_mm"},
                                   {"wheelset.deviation_roll_deg", "wheelset.deviation_roll_rad"},
                                   {"wheelset.deviation_yaw_deg", "wheelset.deviation_yaw_rad"},
                                   {"wheelset.deviation_pitch_deg", "wheelset.deviation_pitch_rad"}};

/// Forward; on a roller that of its surface.
double rolling_velocity(const WheelRailCase& c) {
  return c.roller ? std::abs(c.roller->pitch_rate * c.roller->nominal_radius) : std::abs(c.state.velocity.x);
}

double step_in_time(const WheelRailCase& c, const Case& whole) {
  if (c.regime == Regime::shift) return 1.0;
  if (whole.time_step > 0.0) return whole.time_step;
  const double velocity = rolling_velocity(c);
  if (!(velocity > 0.0))
    throw Error(ErrorKind::configuration, "case.steps needs a velocity to know where the next case is", whole.where,
                "give wheelset.velocity_m_s, roller.pitch_rate_rad_s or case.time_step_s");
  return c.discretisation.dq_relative * c.discretisation.dx / velocity;
}

using Given = std::function<bool(std::string_view)>;

void move(SixMotion& to, const SixMotion& from, const SixMotion& rate, const KeyNames (&keys)[6], double dt,
          const Given& given) {
  for (std::size_t i = 0; i < std::size(kAxes); ++i)
    if (std::ranges::none_of(keys[i], given)) to.*kAxes[i] = from.*kAxes[i] + rate.*kAxes[i] * dt;
}

}  // namespace

void settle_rolling_step(Case& c) {
  auto* rail = std::get_if<WheelRailCase>(&c.content);
  if (rail == nullptr || !(c.time_step > 0.0) || rail->regime != Regime::transient) return;
  const double rolled = rolling_velocity(*rail) * c.time_step;
  if (rolled > 0.0) rail->discretisation.dq_relative = rolled / rail->discretisation.dx;
}

void move_on(Case& next, const Case& previous, const std::function<bool(std::string_view)>& given) {
  auto* to = std::get_if<WheelRailCase>(&next.content);
  const auto* from = std::get_if<WheelRailCase>(&previous.content);
  if (to == nullptr || from == nullptr) return;
  const double dt = step_in_time(*to, next);
  SixMotion rates = to->state.velocity;
  // The rate that a force will ask for is not known yet, but it is close to that of free rolling.
  if (to->longitudinal_force && rates.pitch == 0.0)
    rates.pitch =
        -(to->roller ? to->roller->pitch_rate * to->roller->nominal_radius : rates.x) / to->wheelset.nominal_radius;
  move(to->state.position, from->state.position, rates, kWheelset, dt, given);
  move(to->state.wheel_offset, from->state.wheel_offset, to->state.wheel_velocity, kDeviation, dt, given);
  for (const TrackMotion& m : kTrack)
    if (std::ranges::none_of(m.keys, given)) to->track.*m.position = from->track.*m.position + to->track.*m.rate * dt;
}

}  // namespace treadmark::io
