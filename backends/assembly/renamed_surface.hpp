// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <string>

#include "treadmark/core/surface.hpp"

namespace treadmark::assembly {

/// The same surface as one of another backend, which made it of what there is. Errors: Error(configuration) without a
/// surface.
std::shared_ptr<const Surface> rename_surface(std::shared_ptr<const Surface> surface, std::string backend);

}  // namespace treadmark::assembly
