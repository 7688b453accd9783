// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <vector>

#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::io {

/// The keys of [rail.shape] or [wheel.shape] that differ from their defaults, by their names there ("mirror_y"),
/// without those that name the shape itself (file, standard, arcs, solids). Of a part of a rail alike.
std::vector<std::string> given_shape_keys(const SurfaceSource& source, Body body);

}  // namespace treadmark::io
