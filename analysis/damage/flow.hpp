// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <vector>

#include "treadmark/analysis/damage/record.hpp"
#include "treadmark/core/pose.hpp"
#include "treadmark/model/damage/flow_law.hpp"

namespace treadmark::damage {

/// Shear stress on the plane parallel to the surface, below the middle of an element of a patch.
struct PassedShear {
  double u = 0.0;                    ///< x of a rail [m], theta of a wheel [rad]
  double y_low = 0.0, y_high = 0.0;  ///< across, profile coordinate [m]
  std::size_t depth = 0;             ///< its number
  Vec2 stress = Vec2::Zero();        ///< along growing u and y, as the traction that drags at the surface [Pa]
};

/// An element's size on the surface [m].
struct ElementSize {
  double length = 0.0, width = 0.0;
};

/// How material below a surface flows while contacts pass, and the volume that it carries along.
///
/// A layer at a depth strains in a passage by C (s / k - 1), s the largest shear stress that its points meet, k their
/// yield; what points meet in the other direction is taken off, along and across by themselves. The strains g carry
/// q = integral of g z dz over the depths, volume by width; what flows out of a cell but not into it lowers its
/// surface.
class MaterialFlow {
 public:
  /// present: strains that have hardened the material. All of them must outlive it.
  MaterialFlow(const SurfaceCells& cells, const FlowLaw& law, const SurfaceRecord& present);

  /// Stresses that points meet in the passage that goes on; those of a patch move along the stretch with it.
  void meet(const std::vector<PassedShear>& shears, const ElementSize& element, const Stretch& stretch);
  /// The passage ends; it goes by so many times. Adds the strains to a record with as many depths. Errors:
  /// Error(numerical) where the deepest layer flows, below which nothing is known.
  void end_passage(SurfaceRecord& record, double passages);
  /// Moves the volume of all passages between the cells of a record: the sum stays.
  void displace(SurfaceRecord& record) const;

 private:
  /// Largest (stress over yield less 1) along growing u, falling u, growing y and falling y.
  struct Met {
    explicit Met(int nu) : sheets(4, CellSheet(nu)) {}
    std::vector<CellSheet> sheets;
  };
  double weight(std::size_t depth) const;

  const SurfaceCells& cells_;
  const FlowLaw& law_;
  const SurfaceRecord& present_;
  std::vector<Met> met_;      ///< by depth
  CellSheet lean_;            ///< width on the surface over that in the view of the cells
  CellSheet along_, across_;  ///< volume by width that crosses a cell [m2]
};

}  // namespace treadmark::damage
