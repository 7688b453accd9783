// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/import/layout_line.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::app {

LayoutLine layout_line(const std::filesystem::path&) { left_out("vehicle", "lines of tracks"); }

}  // namespace treadmark::app
