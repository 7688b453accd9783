// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/snapshots.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/app/wheelrail_result.hpp"

namespace treadmark::app {
namespace {

/// Rolling forward lowers the pitch: from above the angle to it or below, within less than half a turn.
bool passed(double before, double now, double angle) {
  const double was = wrap_angle(before - angle), is = wrap_angle(now - angle);
  constexpr double kNear = 0.5 * std::numbers::pi;
  return was > 0.0 && was < kNear && is <= 0.0 && is > -kNear;
}

io::WheelRailCase input_of(const io::SimulationFile& file, std::size_t wheel, const vehicle::PairMotion& m) {
  io::WheelRailCase input = file.contact;
  input.side = file.wheels[wheel].side;
  io::WheelsetInput& w = input.wheelset;
  w.s = m.wheelset.x, w.y = m.wheelset.y, w.z = m.wheelset.z, w.roll = m.wheelset.roll, w.yaw = m.wheelset.yaw, w.pitch = m.wheelset.pitch;
  const auto& v = m.wheelset_velocity;
  w.vs = v.x, w.vy = v.y, w.vz = v.z, w.vroll = v.roll, w.vyaw = v.yaw, w.vpitch = v.pitch;
  io::TrackInput& t = input.track;
  t.dy = m.rail.y, t.dz = m.rail.z, t.roll = m.rail.roll, t.vy = m.rail.vy, t.vz = m.rail.vz, t.vroll = m.rail.vroll;
  input.vertical_force_prescribed = false;
  return input;
}

}  // namespace

void Snapshots::keep(std::size_t wheel) { kept_.push_back({wheel, built_.full[wheel]->accepted()}); }

void Snapshots::take_start(const vehicle::Simulation&) {
  if (!wanted()) return;
  for (std::size_t i = 0; i < built_.full.size(); ++i)
    if (built_.full[i]) keep(i);
}

void Snapshots::take_passed(const vehicle::Simulation& simulation, const vehicle::SystemState& before) {
  if (!wanted()) return;
  for (std::size_t i = 0; i < built_.full.size(); ++i) {
    if (!built_.full[i]) continue;
    const vehicle::PairMotion was = simulation.vehicle().motion(i, before), is = simulation.vehicle().motion(i, simulation.state());
    const bool wanted_now =
        std::ranges::any_of(file_.fields.pitch, [&](double p) { return passed(was.wheelset.pitch, is.wheelset.pitch, p); }) ||
        std::ranges::any_of(file_.fields.position, [&](double x) { return was.wheelset.x < x && x <= is.wheelset.x; });
    if (wanted_now) keep(i);
  }
}

void Snapshots::save(ByteWriter& out) const {
  out.put(kept_.size());
  for (const Kept& k : kept_) {
    out.put(k.wheel);
    vehicle::FullContact::write(k.instant, out);
  }
}

void Snapshots::restore(ByteReader& in) {
  kept_.clear();
  const auto count = in.get<std::size_t>();
  for (std::size_t i = 0; i < count; ++i) {
    const auto wheel = in.get<std::size_t>();
    if (wheel >= built_.full.size() || !built_.full[wheel])
      throw Error(ErrorKind::input_data, "a saved state belongs to another simulation", {}, "start anew");
    kept_.push_back({wheel, vehicle::FullContact::read(in)});
  }
}

io::RunResult Snapshots::results(std::vector<double>& times) const {
  io::RunResult run;
  times.clear();
  for (const Kept& k : kept_) {
    const vehicle::PairMotion& m = k.instant.motion;
    io::CaseResult c = to_result(input_of(file_, k.wheel, m), built_.full[k.wheel]->repeat(k.instant));
    c.number = static_cast<int>(run.cases.size()) + 1;
    c.search_s = c.distance_s = c.normal_s = c.tangential_s = 0.0;
    if (c.message.empty()) c.message = fmt::format("{}, t = {:.6g} s, x = {:.6g} m", wheel_name(file_.wheels[k.wheel]), m.time, m.wheelset.x);
    times.push_back(m.time);
    run.cases.push_back(std::move(c));
  }
  run.cases_total = static_cast<int>(run.cases.size());
  return run;
}

}  // namespace treadmark::app
