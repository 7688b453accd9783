// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/core/profile.hpp"
#include "treadmark/io/imports/import_settings.hpp"

namespace treadmark::app {

/// Refuses settings that would be ignored because they belong to the other body or to another choice.
/// Errors: Error(configuration) that names the setting.
void check_settings(const io::ImportSettings& settings, Body body);

}  // namespace treadmark::app
