// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "treadmark/detection/contact_frame.hpp"
#include "treadmark/detection/detector.hpp"
#include "treadmark/detection/undeformed_distance.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/wheelrail/configuration.hpp"
#include "treadmark/solvers/wheelrail/element_choice.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"
#include "treadmark/solvers/wheelrail/patch_memory.hpp"

namespace treadmark::wheelrail {

class RailMemory;

/// How a patch lies: its contact plane, and the gap of the bodies over elements that are given.
struct LaidPatch {
  detection::ContactPatch region;
  detection::ContactFrame frame;
  std::vector<double> gap;   ///< rail over wheel along n [m], negative: penetration; NaN where a surface is missing
  double reference_s = 0.0;  ///< PatchSolution::reference_s [m]
};

/// A pair of bodies at one instant, while forces are being balanced: a contact search per lateral position of the rail,
/// patches with their normal problems per height of the wheel over the rail, tangential problems per pitch rate. A
/// right-hand problem. The references must outlive this.
class PairStep {
 public:
  PairStep(const Geometry& geometry, const Problem& right_hand_problem, const Instant& previous,
           std::vector<kalker::ContactSolver>& solvers, std::vector<kalker::ContactSolver>& few_solvers,
           PhaseTimes& times, detection::BodyPair bodies, RailMemory& rail_memory);

  /// Puts the rail aside by rail_dy [m]; of what was found at another place start values are left. False: wheel and
  /// rail nowhere face each other; at a given height evaluate() finds that out, its least_gap() is no number then.
  bool place(double rail_dy);
  /// No force asks for another height of the wheelset than that of its state.
  bool at_given_height() const;
  /// Wheelset height z [m] at which the bodies touch; not known at a given height.
  double touching_z() const { return touching_z_; }

  /// Vertical force of paraboloids that interpenetrate as the bodies do with the wheelset at height z, over the depth
  /// there to the power 1.5 [N/m^1.5]; 0: nothing interpenetrates. A guess, without patches or pressures.
  double stiffness_guess(double z);
  /// Of a step that carries its load: whether its elements lie where those laid for height z would, as far as forces
  /// of relative accuracy eps can tell.
  bool stays(double z, double eps);
  /// Whether elements are chosen by the contact.
  bool chooses_elements() const { return elements_.active(); }
  /// Whether elements are few: evaluate() before learn_elements() is a first guess.
  bool few_elements() const { return elements_.few(); }
  /// As ElementChoice.
  void begin_balance() { elements_.begin_balance(); }
  /// Chooses elements by the contact of the last evaluate(). False: they stay.
  bool learn_elements();
  /// As ElementChoice::few_stay().
  bool few_elements_stay() const { return elements_.few_stay(); }
  /// Patches and pressures with the wheelset at height z over the undeflected rail. One patch on a plane is solved
  /// under the load, if given: force_T() has this vertical part [N], on elements that were laid for height z.
  void evaluate(double z, std::optional<double> load = {});
  /// How these patches lie with the wheelset at height z, on planes of their own there and on the elements that they
  /// have, without pressures. Fewer than these where contact is found at fewer places. Not for curved references.
  std::vector<LaidPatch> lay(double z, std::span<const PatchSolution> patches);
  /// How the reference of a patch that lay(z) has found follows from the surfaces; nothing: not known.
  std::optional<detection::ReferenceChange> reference_change(double z, const detection::ContactPatch& region) {
    return search_->reference_change(z - start_z_, region);
  }
  /// Whether the last evaluate() found pressures under its load; then all but the elements' place is that of z().
  bool carries_load() const { return carries_load_; }
  double z() const { return z_; }
  /// The same under another load, or with tractions found since; of a step that carries its load.
  void carry(double load);
  /// Tractions at a pitch rate of the wheelset. eps: relative accuracy.
  void solve_tangential(double pitch_rate, double eps);
  /// Tractions were found before, in this step or at the instant before.
  bool knows_earlier_shares() const { return !tangential_share_.empty(); }
  /// Greatest share of the normal forces by which friction can change the vertical force.
  double friction_share() const;
  /// How deep the wheel lies in the rail where that is beyond all contact mechanics [m], else 0.
  double too_deep() const { return too_deep_; }

  /// On the rail [N]: after evaluate() with the share of tangential forces as it was found last, after
  /// solve_tangential() as it is.
  Vec3 force_T() const;
  double longitudinal_force() const { return (placement_.X_TWs.rotation.transpose() * force_T()).x(); }
  double normal_force() const;
  /// Patches of the last evaluate() that were found but cannot be measured: along their normal another part of a
  /// section comes first.
  int hidden_patches() const { return hidden_; }
  /// The deepest region of the last evaluate() in which no element lies in the other body; nothing if there is none.
  const std::optional<detection::ContactPatch>& between_elements() const { return between_; }
  double least_gap() const { return least_gap_; }
  /// Likewise, between the points of the search grids as well; NaN before evaluate().
  double closest() const { return closest_; }
  /// At the height that was searched last; none before place().
  std::optional<detection::WrongLocus> wrong_locus() const { return search_ ? search_->wrong_locus() : std::nullopt; }

  /// Of each patch, after tractions were found.
  void estimate_refinement(kalker::ContactSolver& coarse);
  /// Likewise.
  void find_surface_loads();
  std::vector<PatchSolution> take_patches();
  const Placement& placement() const { return placement_; }
  /// Names the patches and returns what they leave to the next instant; before take_patches().
  Instant finish();

 private:
  struct Patch {
    PatchSolution solution;
    std::vector<double> gap;  ///< undeformed distance, NaN where another patch may touch
    std::vector<const PatchMemory*> before;
    std::optional<kalker::ContactHistory> history;
    Rectangle box;  ///< in the axes of the grid [m]
    kalker::SubPatches parts;
    /// Where the rigid slip is that of the surfaces: what elements lie on, and the surfaces over them.
    std::optional<detection::ReferenceRows> reference;
    detection::FacingSurfaces surfaces;
    SlipHeights slip_heights;
    bool part_hidden = false;  ///< elements were left out because another part of a section lies over them
    kalker::ContactSolution normal;
    Vec3 normal_force_C = Vec3::Zero();  ///< resultant of the pressures
    Vec3 predicted_force_C = Vec3::Zero();
  };
  bool aligned() const;
  bool parts_creep_apart() const;
  Vec3 share_near(const Rectangle& box) const;
  void locate(const detection::ContactPatch& region, const detection::BodyPair& bodies, Patch& patch);
  void link(const Rectangle& box, Patch& patch) const;
  void take_over(const std::vector<Patch>& patches, Patch& patch) const;
  void measure_distance(const detection::BodyPair& bodies, Patch& patch) const;
  std::vector<Vec2> places_on_rail(const detection::BodyPair& bodies, const Patch& patch) const;
  double deepest() const;
  void move(Patch& patch) const;
  std::optional<double> normal_load(const Patch& patch, double load) const;
  void press(std::size_t i, Patch& patch, std::optional<double> load);
  void lower(double dz);
  kalker::ContactProblem contact_problem(const Patch& patch) const;
  kalker::ContactSolver& solver(std::size_t i, const Patch& patch);
  void resolve_forces(Patch& patch) const;

  const Geometry& geometry_;
  Problem problem_;
  const Instant& previous_;
  std::vector<kalker::ContactSolver>&solvers_, &few_solvers_;
  PhaseTimes& times_;
  RailMemory& rail_memory_;

  Placement start_, placement_;  ///< at z = start_z_, and as it is
  double start_z_ = 0.0, z_ = 0.0, touching_z_ = 0.0, least_gap_ = 0.0, too_deep_ = 0.0;
  bool carries_load_ = false;
  double closest_ = std::numeric_limits<double>::quiet_NaN();
  detection::BodyPair bodies_;  ///< at z = start_z_
  std::unique_ptr<detection::Detector> search_;
  std::vector<Patch> patches_;
  std::vector<TangentialShare> tangential_share_;
  ElementChoice elements_;
  int hidden_ = 0;
  std::optional<detection::ContactPatch> between_;
  std::vector<char> warm_, few_warm_;  ///< solvers that have started, from the previous instant or anew
};

/// Loads of solved patches and their sum, and where they lie in the axes of the bodies.
void resolve_loads(PairSolution& solution);

/// What is given of a patch that lies where it does, but for its gap, parts, history and what follows from rows of
/// elements.
kalker::ContactProblem contact_problem_of(const Problem& problem, const PatchSolution& patch);

/// The part of a patch that each element belongs to, the nearest one, and how much the parts feel of each other.
/// places: where the elements lie on the rail, in T [m].
kalker::SubPatches sub_patches(const Discretisation& discretisation, const detection::ContactPatch& region,
                               std::span<const Vec2> places);

}  // namespace treadmark::wheelrail
