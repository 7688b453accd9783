// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <optional>

#include "treadmark/detection/detector.hpp"
#include "treadmark/solvers/wheelrail/placement.hpp"

namespace treadmark::wheelrail {

/// How contact is looked for in Conventions::contact, and what distances are measured on; of right-hand pairs.

/// One grid whose steps follow dx, ds, and the wheel on facets between sections.
Grid2 reference_grid(const Geometry& geometry, const Problem& p, const Placement& placed, const LateralRange& rail,
                     detection::WheelFacets& facets);

/// Rows of the contact locus; none for elements so small that Treadmark's own locus, whose rows follow the contact, has
/// to do.
std::optional<detection::LocusRows> locus_rows(const Problem& p, const LateralRange& rail);

/// The mesh for undeformed distances; none in other conventions.
std::optional<detection::DistanceMesh> distance_mesh(const Problem& p);

}  // namespace treadmark::wheelrail
