// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/stability/straight_vehicle.hpp"

#include <fmt/format.h>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::app {

io::SimulationFile straight_vehicle(const std::filesystem::path& path, std::span<const std::string> overrides) {
  io::SimulationFile file = io::read_simulation_file(path, overrides);
  for (io::WheelContactInput& wheel : file.wheels) {
    if (wheel.model == io::ContactModelInput::full)
      throw Error(
          ErrorKind::configuration,
          fmt::format("wheel {} has full contact, whose elements make forces jump: eigenvalues and responses need "
                      "derivatives",
                      wheel_name(wheel)),
          {}, "give it contact = \"table\", or all of them: --set simulation.wheels=[]");
    wheel.model = io::ContactModelInput::table;  // where it is chosen, too
  }
  if (file.flexible_track)
    throw Error(ErrorKind::configuration, "eigenvalues and responses of a vehicle on rails that bend are not known", {},
                "take a lumped track: treadmark track --fit makes one");
  if (file.contact.friction_variation.kind == io::FrictionVariation::Kind::along_track)
    throw Error(ErrorKind::configuration,
                "friction varies along the track (friction.along_track): eigenvalues and responses are those of a "
                "vehicle that runs steadily, with the same friction everywhere",
                {}, "leave it out (--set friction.along_track=[]) and say how much: friction.coefficient");
  file.torques.clear();
  file.forces.clear();
  file.spring_motions.clear();
  file.rail_shifts.clear();
  file.free_run.reset();
  file.settings.profile = constant_speed(file.settings.speed);
  return file;
}

}  // namespace treadmark::app
