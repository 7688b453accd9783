// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/model/vehicle/running_limits.hpp"

namespace treadmark::io {

/// A file of limits and its [[limits]].
const KeyTable<RunningLimits>& limit_file_keys();
const KeyTable<RunningLimit>& limit_keys();

}  // namespace treadmark::io
