// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/simulation/snapshots.hpp"

#include <cmath>
#include <numbers>

#include <fmt/format.h>

#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::app {
namespace {

/// Rolling forward lowers the pitch: from above the angle to it or below, within less than half a turn.
bool passed(double before, double now, double angle) {
  const double was = wrap_angle(before - angle), is = wrap_angle(now - angle);
  constexpr double kNear = 0.5 * std::numbers::pi;
  return was > 0.0 && was < kNear && is <= 0.0 && is > -kNear;
}

/// Where the depth of defects is looked for, about the most loaded patch.
Grid2 depth_window(const wheelrail::PairSolution& s) {
  constexpr double kStep = 1e-3;           // [m]
  constexpr int kAhead = 60, kAside = 35;  // steps
  const auto most_loaded =
      ranges::max_element(s.patches, {}, [](const wheelrail::PatchSolution& p) { return p.contact.force_n; });
  const double y = most_loaded != s.patches.end() ? most_loaded->frame.X_TC.origin.y() : s.placement.X_TR.origin.y();
  return {-kAhead * kStep, y - kAside * kStep, kStep, kStep, 2 * kAhead + 1, 2 * kAside + 1};
}

}  // namespace

io::WheelRailCase input_of(const io::SimulationFile& file, std::size_t wheel, const vehicle::PairMotion& m) {
  io::WheelRailCase input = contact_input(file, file.wheels[wheel]);
  input.state.position = m.wheelset;
  input.state.position.x += rail_place(file, file.wheels[wheel].wheelset);
  input.state.velocity = m.wheelset_velocity;
  Track& t = input.track;
  t.dy = m.rail.y, t.dz = m.rail.z, t.roll = m.rail.roll, t.vy = m.rail.vy, t.vz = m.rail.vz, t.vroll = m.rail.vroll;
  input.vertical_force_prescribed = false;
  return input;
}

void Snapshots::take_start() {
  if (!wanted()) return;
  for (std::size_t i = 0; i < built_.full.size(); ++i)
    if (built_.full[i] && built_.full[i]->holds(0.0)) kept_.push_back({i, {}, false, built_.full[i]->accepted()});
}

void Snapshots::take_passed(const vehicle::Simulation& simulation, const vehicle::SystemState& before) {
  if (!wanted()) return;
  for (std::size_t i = 0; i < built_.full.size(); ++i) {
    if (!built_.full[i] || !built_.full[i]->holds(simulation.state().time)) continue;
    const vehicle::PairMotion was = simulation.vehicle().motion(i, before),
                              is = simulation.vehicle().motion(i, simulation.state());
    std::vector<std::size_t> angles;
    for (std::size_t k = 0; k < file_.fields.pitch.size(); ++k)
      if (passed(was.wheelset.pitch, is.wheelset.pitch, file_.fields.pitch[k])) angles.push_back(k);
    const bool at_position =
        ranges::any_of(file_.fields.position, [&](double x) { return was.wheelset.x < x && x <= is.wheelset.x; });
    if (!angles.empty() || at_position)
      kept_.push_back({i, std::move(angles), at_position, built_.full[i]->accepted()});
  }
}

void Snapshots::save(ByteWriter& out) const {
  out.put(kept_.size());
  for (const Kept& k : kept_) {
    out.put(k.wheel);
    out.put(std::span<const std::size_t>(k.angles));
    out.put(k.at_position);
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
    Kept& k = kept_.emplace_back();
    k.wheel = wheel;
    in.get(k.angles);
    in.get(k.at_position);
    k.instant = vehicle::FullContact::read(in);
  }
}

/// Which instants a picture shows: the first of the first wheel is where it has not come to its defects yet.
void Snapshots::describe_scenes(io::SimulationResult& result) const {
  result.snapshot_scenes.assign(kept_.size(), {});
  std::vector<bool> seen(file_.fields.pitch.size(), false);
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    io::SnapshotScene& scene = result.snapshot_scenes[i];
    scene.wheel = kept_[i].wheel;
    if (scene.wheel != kept_.front().wheel) continue;
    scene.nominal = i == 0;
    scene.drawn = kept_[i].at_position;
    for (const std::size_t angle : kept_[i].angles) {
      scene.drawn = scene.drawn || !seen.at(angle);
      seen.at(angle) = true;
    }
  }
}

std::vector<double> Snapshots::depth_of(const Kept& kept, const Grid2& grid,
                                        const wheelrail::PairSolution& solution) const {
  const auto& depth = built_.defect_depth[kept.wheel];
  return depth ? depth->over(grid, solution.placement, file_.wheels[kept.wheel].side) : std::vector<double>();
}

void Snapshots::put_results(io::SimulationResult& result) const {
  io::RunResult run;
  std::vector<double>& times = result.snapshot_times;
  times.clear();
  describe_scenes(result);
  Grid2 around;
  for (std::size_t i = 0; i < kept_.size(); ++i) {
    const Kept& k = kept_[i];
    const vehicle::PairMotion& m = k.instant.motion;
    const wheelrail::PairSolution solution = built_.full[k.wheel]->repeat(k.instant);
    io::SnapshotScene& scene = result.snapshot_scenes[i];
    if (scene.nominal) around = depth_window(solution);
    if (scene.drawn) {
      scene.depth_grid = around;
      scene.depth = depth_of(k, around, solution);
    }
    io::CaseResult c = to_result(input_of(file_, k.wheel, m), solution);
    c.number = static_cast<int>(run.cases.size()) + 1;
    c.search_s = c.distance_s = c.normal_s = c.tangential_s = 0.0;
    if (c.message.empty())
      c.message =
          fmt::format("{}, t = {:.6g} s, x = {:.6g} m", wheel_name(file_.wheels[k.wheel]), m.time, m.wheelset.x);
    times.push_back(m.time);
    run.cases.push_back(std::move(c));
  }
  run.cases_total = static_cast<int>(run.cases.size());
  std::vector<UsedBodies> used;
  for (const Kept& k : kept_) used.push_back(built_.bodies[k.wheel]);
  run.sampled = sample_surfaces(run.cases, used);
  result.snapshots = std::move(run);
}

}  // namespace treadmark::app
