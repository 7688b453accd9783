// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>
#include <span>
#include <string>

#include "treadmark/io/simulations/design_model.hpp"

namespace treadmark::io {

/// Reads a file with [design] (TOML, docs/design.md) with its base, a case file, which is read once for every position.
/// overrides: "key.path=value", of the file ("design.solutions=50") or of the base for all positions. Throws
/// Error(configuration) with file:line:column. Safe to call from several threads.
DesignFile read_design_file(const std::filesystem::path& file, std::span<const std::string> overrides = {});

}  // namespace treadmark::io
