// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
// Bytes of a saved simulation in which five bytes each of the input say where one byte is another one; a first byte
// that is odd cuts the end off.
#include <algorithm>
#include <cstring>
#include <filesystem>
#include <span>
#include <vector>

#include "treadmark/app/simulation/build_vehicle.hpp"
#include "treadmark/core/byte_archive.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"
#include "treadmark/tests/fuzz/fuzz_target.hpp"

namespace {

using namespace treadmark;

/// A wheelset on a track, started, and what is saved of it.
struct Saved {
  io::SimulationFile file;
  app::SurfaceStore store;
  app::BuiltVehicle built;
  vehicle::Equilibrium start;
  std::vector<std::byte> bytes;

  Saved()
      : file(io::read_simulation_file(std::filesystem::path(TREADMARK_SOURCE_DIR) / "examples" / "flat-at-speed.toml")),
        built(app::build_vehicle(file, store)),
        start(vehicle::find_equilibrium(built.vehicle)) {
    vehicle::Simulation simulation = fresh();
    simulation.advance();
    ByteWriter out;
    simulation.save(out);
    bytes = out.bytes();
  }
  vehicle::Simulation fresh() const { return {built.vehicle, start.state, app::integration_settings(file)}; }
};

}  // namespace

TREADMARK_FUZZ_TARGET(fuzz_checkpoint) {
  static const Saved saved;
  std::vector<std::byte> bytes = saved.bytes;
  for (std::size_t at = 1; at + 5 <= size; at += 5) {
    std::uint32_t where = 0;
    std::memcpy(&where, data + at, 4);
    bytes[where % bytes.size()] = static_cast<std::byte>(data[at + 4]);
  }
  if (size > 1 && data[0] % 2 == 1) bytes.resize(bytes.size() - std::min<std::size_t>(bytes.size(), data[1]));
  vehicle::Simulation simulation = saved.fresh();
  try {
    ByteReader in(bytes);
    simulation.restore(in);
    simulation.advance();
  } catch (const Error&) {
  }
  return 0;
}
