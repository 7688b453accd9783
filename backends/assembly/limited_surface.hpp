// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/core/surface.hpp"

namespace treadmark::assembly {

/// The part of a rail between two positions x [m] of its own frame; the rest may still hide some of it. Never of
/// constant profile. Thread-safe as every Surface. Errors: Error(configuration) without a surface, or unless x_min <
/// x_max.
std::shared_ptr<const Surface> limit_along(std::shared_ptr<const Surface> rail, double x_min, double x_max);

}  // namespace treadmark::assembly
