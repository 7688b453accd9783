// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/bench/instructions/import_paths.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::bench {

std::vector<std::string> import_kinds() { return {}; }
MeasuredPath import_path(const Surface&, const std::string&) { left_out("scans", "imports"); }

}  // namespace treadmark::bench
