// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <string>

#include "treadmark/io/results/result_model.hpp"

namespace treadmark::testing {

/// A patch with a half-ellipsoid of pressure over a circle of radius 4 mm, its trailing half in slip.
io::PatchResult ball_patch(int nx, int ny, double pmax);

/// One case with a wheelset and two patches on a rolled contact plane (rolling), one shift case without a wheelset,
/// one case without contact and one that failed with numbers that are not finite.
io::RunResult sample_run();

std::string read_text(const std::filesystem::path& path);

}  // namespace treadmark::testing
