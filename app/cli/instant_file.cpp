// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <filesystem>

#include <fmt/format.h>

#include "treadmark/app/cli/verbs.hpp"
#include "treadmark/app/simulation/instant_cases.hpp"
#include "treadmark/app/simulation/result_head.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/read_simulation.hpp"

namespace treadmark::cli {
namespace {

namespace fs = std::filesystem;

/// The simulation file of some results: beside them, beside their folder, or here.
fs::path simulation_of(const fs::path& store, const std::string& name) {
  const fs::path folder = fs::absolute(store).parent_path();
  for (const fs::path& place : {folder, folder.parent_path(), fs::current_path()})
    if (fs::exists(place / name)) return place / name;
  throw Error(ErrorKind::configuration, fmt::format("these results come from {}, which is not found", name),
              {store.string()}, "give it with --simulation FILE");
}

}  // namespace

io::CaseFile cases_of_instant(const std::string& store, const std::string& simulation, double time,
                              const std::vector<std::string>& overrides) {
  const io::SimulationResult result = io::read_simulation(store);
  const fs::path file = simulation.empty() ? simulation_of(store, result.input_file) : fs::path(simulation);
  std::vector<std::string> settings = result.settings;
  settings.insert(settings.end(), overrides.begin(), overrides.end());
  const io::SimulationFile read = io::read_simulation_file(file, settings);
  if (read.sha256 != result.input_sha256)
    throw Error(ErrorKind::configuration, "this is not the file that the results come from, or it has changed since",
                {file.string()}, "give it with --simulation FILE");
  if (overrides.empty() && app::input_hashes(read) != result.geometry_sha256)
    throw Error(ErrorKind::configuration, "a file that the simulation names has changed since the results were made",
                {file.string()}, "run treadmark simulate again");
  return app::cases_at(read, result, time);
}

}  // namespace treadmark::cli
