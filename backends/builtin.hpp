// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>
#include <vector>

#include "treadmark/backends/registry.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark {

/// The rows of the built-in backends, each group in the file of its name.
std::vector<Backend> analytic_backends();
std::vector<Backend> spline_backends();    ///< spline, nurbs, thb
std::vector<Backend> mesh_backends();      ///< mesh, mesh-flat
std::vector<Backend> offset_backends();    ///< offset, offset-quadratic, offset-bilinear
std::vector<Backend> levelset_backends();  ///< level-set
std::vector<Backend> shortcut_backends();  ///< chords, prismatic

/// Whether the shape is a standard profile or a chain of arcs.
bool is_formula(const SurfaceSpec& spec);
/// Flats on a wheel given by a formula have a faster surface of their own.
bool flats_only(const SurfaceSpec& spec);
/// The section of a formula, with points at its own joints, at most step [m] apart; nothing for other shapes.
std::optional<Profile> sampled_formula(const SurfaceSpec& spec, double step);

}  // namespace treadmark
