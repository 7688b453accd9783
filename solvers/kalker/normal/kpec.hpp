// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <vector>

#include "treadmark/core/material.hpp"
#include "treadmark/solvers/kalker/normal/interpenetration.hpp"

namespace treadmark::kalker {

/// Contact area of KPEC, after Kik & Piotrowski (1996): the interpenetration is cut at a level that varies across the
/// rows such that an elliptic contact comes out as Hertz' ellipse. In each run of elements of a row the distribution is
/// a half ellipse as high as the run is half long. Returned: that distribution [m], of the grid's size, to be scaled so
/// that the half-space's displacement at the deepest element equals the depth. There must be contact.
std::vector<double> kpec_distribution(const Interpenetration& overlap, const CombinedMaterial& material,
                                      bool reference_quirks);

}  // namespace treadmark::kalker
