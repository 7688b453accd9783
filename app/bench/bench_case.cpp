// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/bench/bench_case.hpp"

#include <utility>

namespace treadmark::app {

io::CaseFile bench_case() {
  io::Case only;
  only.number = 1;
  auto& c = only.content.emplace<io::WheelRailCase>();
  c.wheel.geometry = StandardProfile{"S1002"};
  WheelFlat flat;
  flat.length = 0.16;
  flat.depth = 1.4e-3;
  flat.y_center = 6e-3;
  flat.width = 60e-3;
  c.wheel.defects.flats = {flat};
  c.rail.geometry = StandardProfile{"60E1"};
  Squat squat;
  squat.length = 40e-3;
  squat.width = 30e-3;
  squat.depth = 0.5e-3;
  c.rail.defects.squats = {squat};
  c.track.cant = 1.0 / 40.0;
  c.wheelset.nominal_radius = 0.49;
  c.state.position.pitch = 0.06;
  c.state.velocity.x = 2.0;
  c.state.velocity.pitch = -2.0 / 0.49;
  c.vertical_force = 1.25e5;
  c.discretisation.dx = c.discretisation.ds = 0.4e-3;

  io::CaseFile file;
  file.title = "wheel with a flat on a rail with a squat";
  file.cases.push_back(std::move(only));
  return file;
}

}  // namespace treadmark::app
