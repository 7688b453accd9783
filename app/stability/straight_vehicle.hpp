// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "treadmark/io/simulations/simulation_model.hpp"

namespace treadmark::app {

/// A simulation file whose vehicle is to be linearised on straight, even track: without what acts from outside; its
/// layout and irregularities stay for who asks. Errors: Error(configuration) for wheels with full contact (differences
/// over a discretised contact are no derivatives) and rails that bend; those of the file.
io::SimulationFile straight_vehicle(const std::filesystem::path& file, std::span<const std::string> overrides);

}  // namespace treadmark::app
