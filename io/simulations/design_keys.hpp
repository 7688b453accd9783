// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/io/simulations/design_model.hpp"

namespace treadmark::io {

/// [design].
struct DesignInput {
  DesignFile file;
  DesignDepth depth;
};

/// [design] of files of `treadmark design`, and its tables.
const KeyTable<DesignInput>& design_keys();
const KeyTable<DesignDepth>& design_depth_keys();
const KeyTable<DesignParameter>& design_parameter_keys();
const KeyTable<DesignGoal>& design_goal_keys();
const KeyTable<DesignLimit>& design_limit_keys();

}  // namespace treadmark::io
