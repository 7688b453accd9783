// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/cli/commands.hpp"

namespace CLI {
class App;
}

namespace treadmark::cli {

/// Makes options of a verb; their names are stable.
void add_scan_options(CLI::App& verb, ScanOptions& options);

}  // namespace treadmark::cli
