// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/core/error.hpp"

namespace treadmark::io {

/// Errors: Error(configuration) for a file whose name ends like those of other programs' drawings, scenes, models and
/// workbooks, which hold no wheel or rail that is read here: what it is, and what to save instead. asked_by: where the
/// file was named.
void refuse_foreign_file(const std::filesystem::path& file, const SourcePosition& asked_by = {});

}  // namespace treadmark::io
