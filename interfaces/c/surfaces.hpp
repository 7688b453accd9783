// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>

#include "treadmark/backends/create.hpp"
#include "treadmark/interfaces/c/treadmark.h"

namespace treadmark::c {

/// Errors: BadArgument for a number that is no body.
Body body_of(tm_body body);

/// A surface in its natural representation.
std::unique_ptr<tm_surface> natural_surface(NaturalSurface surface);

}  // namespace treadmark::c
