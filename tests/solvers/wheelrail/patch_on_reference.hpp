// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <stdexcept>

#include "treadmark/detection/undeformed_distance.hpp"
#include "treadmark/solvers/wheelrail/curved_loads.hpp"
#include "treadmark/solvers/wheelrail/search_window.hpp"
#include "treadmark/solvers/wheelrail/surface_slip.hpp"

namespace treadmark::wheelrail::testing {

/// One contact patch on a reference surface, put together from its parts.
struct PatchOnReference {
  Placement placement;
  detection::BodyPair bodies;
  detection::ContactFrame frame;
  Grid2 grid;
  detection::ReferenceRows reference;
  detection::FacingSurfaces surfaces;
  detection::UndeformedDistance undeformed;
  SurfaceSlip slip;
  kalker::ContactSolution contact;
  Wrench load_C;
  Vec3 force_T = Vec3::Zero();
};

/// The only patch of a right-hand pair at a given position, seen from a contact plane turned further by tilt [rad].
inline PatchOnReference place_patch(const Geometry& geometry, const Problem& p, double tilt = 0.0) {
  PatchOnReference patch;
  patch.placement = place(geometry, p);
  patch.bodies = {geometry.rail.get(), geometry.wheel.get(), patch.placement.X_TS, patch.placement.X_TA};
  const auto found = detection::search_contact(patch.bodies, search_settings(geometry, p, patch.placement));
  if (found.patches.size() != 1)
    throw std::runtime_error("one patch was expected, not " + std::to_string(found.patches.size()));
  patch.frame = detection::contact_frame(patch.bodies, found.patches[0]);
  const Discretisation& d = p.discretisation;
  patch.grid =
      detection::potential_contact_grid(patch.bodies, found.patches[0], patch.frame, {d.dx, d.ds, d.max_elements});
  patch.frame.angle += tilt;
  patch.frame.X_TC.rotation = rotation_x(patch.frame.angle);
  patch.reference = p.reference_surface == ReferenceSurface::curved
                        ? detection::curved_reference(patch.bodies, patch.frame, patch.grid)
                        : detection::plane_reference(patch.grid);
  patch.surfaces = detection::facing_surfaces(patch.bodies, patch.frame.X_TC, patch.grid, patch.reference);
  patch.undeformed = detection::undeformed_distance(patch.surfaces);
  const ContactKinematics at_reference =
      contact_kinematics(p, patch.placement, patch.frame.X_TC, patch.undeformed.approach);
  patch.slip =
      surface_slip(p, patch.placement, patch.frame.X_TC, patch.grid, patch.reference, patch.surfaces, at_reference);
  return patch;
}

inline kalker::ContactProblem contact_problem(const Problem& p, const PatchOnReference& patch) {
  kalker::ContactProblem c;
  c.grid = patch.grid;
  c.gap = patch.undeformed.distance;
  c.material = p.material;
  c.friction = friction_at(p.friction_inclination, p.friction_laws, patch.frame.angle, p.friction);
  c.friction_of_row = friction_on(patch.reference, patch.frame.angle, p);
  c.influence = influence_on(patch.reference, patch.grid, p.influence);
  c.force_prescribed = false;
  c.approach = patch.undeformed.approach;
  c.regime = p.regime;
  const ContactKinematics& k = patch.slip.kinematics;
  c.creepage = {k.xi, k.eta, k.phi, 0.0, 0.0};
  c.rolling.chi = k.chi;
  c.rolling.velocity = k.velocity;
  c.rolling.step = p.discretisation.dq_relative * patch.grid.dx;
  c.extra_slip_x = patch.slip.extra_x;
  c.extra_slip_y = patch.slip.extra_y;
  c.settings = p.solver;
  return c;
}

inline PatchOnReference solve_patch(const Geometry& geometry, const Problem& p, double tilt = 0.0) {
  PatchOnReference patch = place_patch(geometry, p, tilt);
  kalker::ContactSolver solver;
  patch.contact = solver.solve(contact_problem(p, patch));
  patch.load_C = resultant_on(patch.reference, patch.grid, patch.contact);
  patch.force_T = patch.frame.X_TC.rotation * patch.load_C.force;
  return patch;
}

}  // namespace treadmark::wheelrail::testing
