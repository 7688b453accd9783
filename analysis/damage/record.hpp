// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

#include "treadmark/analysis/damage/passed_patch.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/model/damage/surface_record.hpp"
#include "treadmark/model/damage/wear_law.hpp"
#include "treadmark/model/shape/offset_map.hpp"

namespace treadmark::damage {

/// How finely a body is looked at.
struct CellSettings {
  bool uniform = true;              ///< the same all along the body
  double du = 1e-3, dy = 0.5e-3;    ///< [m]; du at the nominal radius of a wheel
  double u_min = 0.0, u_max = 0.0;  ///< of a rail that is not the same everywhere [m]
};

/// Cells over a surface, with the radii of its rows. Errors: Error(configuration) for steps that make no sense or more
/// than 20 million cells; Error(input_data) where there is no surface.
SurfaceCells make_cells(const Surface& surface, Body body, double nominal_radius, const CellSettings& settings);

/// Where a patch is while it passes: it moves from begin to end as rigid, element by element. Uniform cells need none.
struct Stretch {
  double middle = 0.0;            ///< u at which the patch was solved [m] or [rad]
  double begin = 0.0, end = 0.0;  ///< [m] or [rad]
};

/// Adds what a patch does in so many seconds: work, sliding and the volume that the law removes, split over cells by
/// overlap so that sums are kept, the largest pressure, traction, T gamma,
/// surface index and stresses, and the damage of passages. count: passages over every cell of the stretch
/// in that time. Errors: Error(input_data) where the patch lies beside the surface.
void add_patch(SurfaceRecord& record, const SurfaceCells& cells, const WearLaw& law, const PassedPatch& patch,
               const Stretch& stretch, double seconds, double count);

/// Adds so many times another record with as many depths; of what is a largest value the larger ones are kept.
void add_times(SurfaceRecord& record, const SurfaceRecord& other, double times);

/// Spreads every value over its neighbours with Gaussian weights of this standard deviation [m], cut off at four of
/// them, so that sums are kept; 0: nothing.
void smooth(CellSheet& sheet, const SurfaceCells& cells, double deviation);

/// Depth removed from a cell, along z of a rail, along the radius of a wheel (exactly: r d - d^2/2) [m]. Errors:
/// Error(numerical) where more is removed than there is.
double depth_of(const SurfaceCells& cells, double volume, int row);
/// Of a sheet of volumes: the largest depth and the largest height above the surface as it was [m], and the largest
/// slopes of the depth across and along [-].
struct DepthExtent {
  double depth = 0.0, raised = 0.0, slope = 0.0, slope_along = 0.0;
  double change() const { return depth > raised ? depth : raised; }
};
DepthExtent depth_extent(const SurfaceCells& cells, const CellSheet& volume);

/// The depths as offsets over the surface that the cells lie on. Uniform cells become several columns that are alike: a
/// turn of a wheel, half_length to both sides of a rail [m].
OffsetMap offsets_of(const SurfaceCells& cells, const CellSheet& volume, double half_length, std::string name);

}  // namespace treadmark::damage
