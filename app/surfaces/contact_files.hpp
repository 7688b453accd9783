// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// Puts files in the place of the wheels and rails of the cases that input of CONTACT cannot name: formulas, defects,
/// moving sections, parts, triangles, splines, offsets. A section that is the same everywhere becomes a profile, all
/// else slices of the part that the cases can touch, beside `output` and with its name in front. Nothing is written
/// yet: each function returned writes one of them and says what. Errors of this: those of readers; of them: those of
/// backends, writers and require_as_written.
std::vector<std::function<std::string()>> put_contact_files(io::CaseFile& file, const std::filesystem::path& output);

}  // namespace treadmark::app
