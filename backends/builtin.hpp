// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/backends/registry.hpp"
#include "treadmark/model/profile.hpp"

namespace treadmark {

/// The rows of the built-in backends, each group in the file of its name.
std::vector<Backend> analytic_backends();
std::vector<Backend> spline_backends();    ///< spline, nurbs, thb
std::vector<Backend> mesh_backends();      ///< mesh, mesh-flat
std::vector<Backend> offset_backends();    ///< offset, offset-quadratic, offset-bilinear
std::vector<Backend> shortcut_backends();  ///< chords, prismatic
