// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark {

/// Whose rules hold where Treadmark and the reference program (CONTACT, by Vollebregt) differ by choice. contact: for
/// results that are compared with that program's, as those of its input files and of callers of its library are; for
/// nothing else, as it costs accuracy. What differs, by which member and key, and where:
///
/// kalker::SolverSettings, of a pair discretisation.reference_search_mesh, of a patch case.reference_ways:
/// * contact is looked for on one coarse grid that follows dx, ds, the wheel on facets, or on the rows of a locus
///   (Discretisation::search); undeformed distances come from a mesh of the wheel and sections of the rail
///   (solvers/wheelrail/contact_program, detection/contact_program);
/// * all parts of a patch have one creepage (solvers/wheelrail/pair_step.cpp), their displacements and elastic energy
///   are those of full elastic influence, and KPEC and ANALYN take them for one (sub_patch_solver.cpp);
/// * KPEC has its ellipse and its scale from whole elements (solvers/kalker/normal/contact_program), and ends of rows
///   that lie further out than the ellipse reaches run on; ANALYN takes the deepest element of a row for its deepest
///   point.
///
/// Thermal, case.reference_ways (surface_temperature.cpp):
/// * bodies of unequal effusivity: the temperature of conduction in the contact, the relaxation behind it and the
///   frictional rise of body 1 are computed with the shares of the two bodies exchanged;
/// * heat of an element counts twice at its own centre;
/// * rolling direction 0: behind the contact the distance from it is one element too large.
///
/// io::WheelRailCase, case.reference_ways:
/// * the spin moment of grids that are aligned in time is about their origin instead of the contact reference
///   (wheelrail_result.cpp); steps of transient rolling may be longer than dt = 2 dx / V.
///
/// Input files of that program set FastsimSettings::first_step, Track::gauge_at_innermost, SliceSet::open_seam and
/// io::ProfileOptions::Placement::reference, too.
enum class Conventions : bool { treadmark, contact };

}  // namespace treadmark
