// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <CLI/CLI.hpp>

#include <vector>

#include "treadmark/io/settings/given_settings.hpp"

namespace treadmark::cli {

/// Options for the settings of a verb: "--gauge-mm MM" for gauge_mm, with the limits, words and default of its key.
/// given: gets those that the command line has; both must live as long as the verb.
void add_settings(CLI::App& verb, const io::TableKeys& keys, std::vector<io::CaseOverride>& given);

}  // namespace treadmark::cli
