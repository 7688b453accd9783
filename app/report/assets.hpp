// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::app::report {

/// Style sheet of the pages.
const std::string& page_style();

/// The script that makes views live; empty where Treadmark was built without Node.js.
const std::string& page_script();

}  // namespace treadmark::app::report
