// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/core/vehicle_model.hpp"
#include "treadmark/io/simulations/table_reader.hpp"

namespace treadmark::io {

/// The parts that vehicle and track files share. One table may stand for several equal parts at different places, which
/// are then called by its name and their number from 1. Error(configuration) at the place of what is wrong.

std::vector<BodySpec> read_bodies(const TableReader& document);
/// bodies: those that can be connected, beside the ground.
std::vector<SpringSpec> read_springs(const TableReader& document, const std::vector<BodySpec>& bodies);
std::vector<BumpStopSpec> read_bump_stops(const TableReader& document, const std::vector<BodySpec>& bodies);

std::vector<std::string> names_of(const std::vector<BodySpec>& bodies);

/// Names of parts start with a letter and go on with letters, digits, '_' and '-'.
std::string part_name(const TableReader& part);

/// The word of a direction: "x" ... "yaw".
std::string_view freedom_word(int freedom);

}  // namespace treadmark::io
