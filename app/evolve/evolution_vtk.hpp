// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/core/surface.hpp"
#include "treadmark/io/histories/evolution_model.hpp"

namespace treadmark::app {

/// The rows of a body that contacts have reached, as VTK XML structured grid (.vts) in the body's own axes [m]: cells
/// as the evolution has them (of a body that is the same all along a turn of the wheel in 72 parts, or a metre of
/// rail), with what they have endured as cell data named with SI units; volume as depth, work by area. surface: as the
/// record leaves it. Empty where no row has been reached. Errors: those of the surface.
std::string evolved_surface_vts(const Surface& surface, const io::EvolvedBody& body);

}  // namespace treadmark::app
