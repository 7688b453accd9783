// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <memory>
#include <vector>

#include "treadmark/app/surfaces/sampled_surfaces.hpp"
#include "treadmark/backends/create.hpp"
#include "treadmark/detection/contact_search.hpp"
#include "treadmark/io/cases/case_model.hpp"

namespace treadmark::app {

/// A body seen where it carries: planes level with it and tilted (rolled, yawed and pitched), one grid for both, and
/// the heights and slopes of the surface as given.
struct BenchView {
  struct Plane {
    Pose X_SP;
    std::vector<double> z, dzdx, dzdy;
  };
  Plane level, tilted;
  Grid2 grid;
  double largest_curvature = 0.0;  ///< magnitude of the principal curvatures in the view [1/m]
};

/// Wheel and rail as given, pressed on each other by the load of the case.
struct BenchScene {
  std::shared_ptr<const NaturalSurface> rail, wheel;
  std::shared_ptr<const Surface> rail_base,
      wheel_base;  ///< without defects: what offsets lie on; null where it is not known
  double rail_build_seconds = 0.0, wheel_build_seconds = 0.0;  ///< of the surfaces as given
  SampledRegions regions;                                      ///< what has to be sampled
  detection::BodyPair bodies;                                  ///< as given, placed as solved
  detection::SearchSettings search;
  Pose X_TC;           ///< tangent plane of the patch that carries most
  Grid2 contact_grid;  ///< its potential contact area
  BenchView rail_view, wheel_view;

  const NaturalSurface& natural(Body body) const { return body == Body::rail ? *rail : *wheel; }
  const BenchView& view(Body body) const { return body == Body::rail ? rail_view : wheel_view; }
  const Surface* base(Body body) const { return body == Body::rail ? rail_base.get() : wheel_base.get(); }
};

/// Step and number of the points on which heights are measured.
struct BenchGrid {
  double step = 0.2e-3;  ///< [m]
  int points = 150000;   ///< about; across the whole rail head in any case
};

/// Solves the first wheel-rail case of a file with the surfaces as given; a left-hand one as its mirror image.
/// Errors: those of the readers; Error(configuration) without such a case; Error(numerical) without contact.
BenchScene make_bench_scene(const io::CaseFile& file, const BenchGrid& grid = {});

/// A view of a surface round a point of contact, from y_before (negative) to y_after beside it [m].
BenchView make_bench_view(const Surface& surface, const Vec3& contact_S, double y_before, double y_after,
                          const BenchGrid& grid);

}  // namespace treadmark::app
