// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/bench/instructions/paths.hpp"

namespace treadmark {
class Surface;
}

namespace treadmark::bench {

/// Endings of the files that scans are imported into here; none where scans are left out of the build.
std::vector<std::string> import_kinds();

/// Import of a scan of a rail into such a file.
MeasuredPath import_path(const Surface& rail, const std::string& kind);

}  // namespace treadmark::bench
