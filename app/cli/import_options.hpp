// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/app/cli/commands.hpp"

namespace CLI {
class App;
}

namespace treadmark::cli {

/// The options of `treadmark import`.
void add_import_options(CLI::App& verb, ImportOptions& options);

}  // namespace treadmark::cli
