// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <list>
#include <vector>

#include "treadmark/solvers/kalker/tangential/compliance.hpp"
#include "treadmark/solvers/kalker/tangential/friction_solve.hpp"
#include "treadmark/solvers/kalker/tangential/interface_layer.hpp"
#include "treadmark/solvers/kalker/tangential/rigid_slip.hpp"
#include "treadmark/solvers/kalker/tangential/slip_friction.hpp"

namespace treadmark::kalker {

/// The coefficients used last. References stay valid until kCapacity other boxes were asked for.
class ComplianceCache {
 public:
  static constexpr std::size_t kCapacity = 12;

  Compliance& get(const ComplianceKey& key) {
    for (auto it = boxes_.begin(); it != boxes_.end(); ++it)
      if (it->key() == key) {
        boxes_.splice(boxes_.begin(), boxes_, it);
        return boxes_.front();
      }
    boxes_.emplace_front(key, key.kernel == nullptr ? &coefficients_of(key) : nullptr);
    if (boxes_.size() > kCapacity) boxes_.pop_back();
    return boxes_.front();
  }

 private:
  static constexpr std::size_t kMostTables = 4;  ///< a grid, those of its start values, and that of a refinement

  UncoupledTable& coefficients_of(const ComplianceKey& key) {
    for (UncoupledTable& table : tables_)
      if (table.is_for(key.dx, key.dy, key.poisson)) return table;
    if (tables_.size() >= kMostTables) tables_.pop_back();
    return tables_.emplace_front(key.dx, key.dy, key.poisson);
  }

  std::list<Compliance> boxes_;
  std::list<UncoupledTable> tables_;
};

/// What a patch has to go by, per element of the patch.
struct PatchConditions {
  std::vector<double> pressure;  ///< [Pa]
  KnownSlip known_slip;
  std::vector<double> friction_before;  ///< transient: coefficients of the material a step ago; else empty
  std::vector<double> temperature;      ///< of body 1's surface [deg C], for friction that depends on it; else empty
  std::vector<double> yield_before;     ///< likewise the yield stress of the layer [Pa]
  std::shared_ptr<const InfluenceKernel> kernel;  ///< none: constant elements on half-spaces
  std::optional<RowInclination> rows;             ///< of the patch's box where coefficients are turned row by row
};

/// The friction problem of one patch at creepages that may change from call to call; starts from the last solution.
class PatchSolver {
 public:
  /// problem, patch and cache must outlive the solver.
  PatchSolver(const ContactProblem& problem, const Patch& patch, PatchConditions conditions, ComplianceCache& cache);

  /// Start values: tractions [Pa] and slip speeds [m/s], the latter for friction that depends on them. Plastic shear
  /// counts as slip.
  void start_from(Field2 traction, std::vector<double> slip_speed);
  /// Slip speed of all elements to start from [m/s].
  void set_slip_speed(double speed) { slip_speed_.assign(slip_speed_.size(), speed); }

  /// Tractions for given creepages to a relative accuracy eps, with friction that fits the slip; by the linear theory
  /// those without any slip, whatever friction carries. False if the accuracy was not reached.
  bool solve(const Creepage& creepage, double eps);

  /// Sum of tractions relative to the static bound: x, y.
  std::array<double, 2> relative_force() const;
  /// Change of relative_force per unit of creepage xi (component 0) or eta (1), at unchanged friction coefficients.
  std::array<double, 2> relative_stiffness(int component);
  /// Takes tractions and friction coefficients of a solution over, per element of the patch.
  void take(const Creepage& creepage, Field2 traction, std::vector<double> friction);
  /// Change of tractions with creepage [Pa per unit], and with pressures that grow everywhere in proportion to `more`
  /// [Pa]: both by the linearised system, accurate to a share of 1e-6.
  Field2 change_by_creepage(const Creepage& unit);
  Field2 change_by_pressure(std::span<const double> more);
  /// Every element slides against a given direction.
  void slide(std::array<double, 2> direction);
  bool sliding() const;

  PatchOperator& matrix() { return matrix_; }
  const FrictionState& state() const { return state_; }
  const std::vector<double>& friction() const { return friction_; }
  const std::vector<double>& bound() const { return problem_.bound; }
  const std::vector<double>& slip_speed() const { return slip_speed_; }
  const RollingStep& step() const { return conditions_.known_slip.step; }
  /// Plastic shear of the layer in this step.
  InterfaceLayer::Shear layer_shear() const;
  /// Violation of the conditions relative to the bound, both rms.
  double residual() const;
  int steps() const { return steps_; }
  int sweeps() const { return sweeps_; }
  /// The last call ended because friction and slip did not come to terms.
  bool friction_unsettled() const { return friction_unsettled_; }

 private:
  void set_bound();
  bool adhere(double eps);
  bool solve_at_fixed_friction(double eps, bool updated = false);
  std::vector<double> new_slip_speed() const;
  std::vector<double> friction_bound() const;
  std::vector<double> slip_distance() const;
  double time_step() const { return step().time; }

  const ContactProblem& input_;
  const Patch& patch_;
  PatchConditions conditions_;
  FrictionOfPatch laws_;
  InterfaceLayer layer_;
  double static_bound_ = 0.0;  ///< sum of static friction times pressure
  ComplianceCache& cache_;
  ComplianceKey key_;
  PatchOperator matrix_;
  FrictionSolve friction_solve_;
  FrictionProblem problem_;
  FrictionState state_;
  Creepage creepage_;
  std::vector<double> friction_, slip_speed_;
  std::array<Field2, 2> predicted_;  ///< change of tractions per unit of creepage, by relative_stiffness
  bool started_ = false, friction_unsettled_ = false;
  int steps_ = 0, sweeps_ = 0;
};

/// Coefficients that a patch needs. kernel: none for constant elements on half-spaces.
ComplianceKey compliance_key(const Patch& patch, const Material& material,
                             std::shared_ptr<const InfluenceKernel> kernel = {});

}  // namespace treadmark::kalker
