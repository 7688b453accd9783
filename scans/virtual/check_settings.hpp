// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/scans/virtual/virtual_scanner.hpp"

namespace treadmark::scans::scanner {

inline constexpr double kMostPoints = 2e8;

/// Errors: Error(configuration) for settings that make no sense for any surface.
void check_settings(const ScannerSettings& settings);

}  // namespace treadmark::scans::scanner
