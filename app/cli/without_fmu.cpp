// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cli/verbs.hpp"

namespace treadmark::cli {

Command add_fmu(CLI::App& verb) { return add_left_out(verb); }

}  // namespace treadmark::cli
