// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/error_spread.hpp"

#include <cmath>
#include <cstddef>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"

namespace treadmark::wheelrail {
namespace {

constexpr int kEnough = 48;  // along and across: pressures change alike on finer ones

/// Every n-th of count elements, among them one that is kept.
struct Some {
  int step, first, count;

  Some(int elements, int kept)
      : step((elements + kEnough - 1) / kEnough), first(kept % step), count((elements - 1 - first) / step + 1) {}
};

/// What is looked at of a solution.
struct Numbers {
  double pressure = 0.0, area = 0.0, force = 0.0, approach = 0.0, place = 0.0;
};

/// A patch that is solved again and again.
class Again {
 public:
  Again(const UncertainPatch& patch, const Material& material) : patch_(patch) {
    const Grid2& g = patch.grid;
    std::size_t lowest = 0;
    for (std::size_t i = 0; i < patch.gap.size(); ++i)
      if (patch.gap[i] < patch.gap[lowest] || std::isnan(patch.gap[lowest])) lowest = i;
    const auto nx = static_cast<std::size_t>(g.nx);
    const Some x(g.nx, static_cast<int>(lowest % nx)), y(g.ny, static_cast<int>(lowest / nx));
    problem_.grid = {g.x(x.first), g.y(y.first), x.step * g.dx, y.step * g.dy, x.count, y.count};
    for (int iy = 0; iy < y.count; ++iy) {
      rows_.push_back(static_cast<std::size_t>(y.first + iy * y.step));
      for (int ix = 0; ix < x.count; ++ix)
        gap_.push_back(patch.gap[g.index(x.first + ix * x.step, y.first + iy * y.step)]);
    }
    problem_.material = material;
    problem_.material.creep_ratio_1 = problem_.material.creep_ratio_2 = 0.0;
    put_errors(nullptr);
    base_ = at(0.0);
  }

  const Numbers& base() const { return base_; }
  /// Whether what is solved here is the patch; of coupled or cut off parts it may be another one.
  bool is_patch() const {
    constexpr double kNear = 0.5;
    return std::fabs(base_.force - patch_.normal_force) < kNear * patch_.normal_force;
  }
  double vertical_per_normal() const { return patch_.vertical_force / patch_.normal_force; }
  /// Change of the vertical force as the wheel comes down, as between spheres [N/m].
  double stiffness() const {
    return patch_.approach > 0.0 ? 1.5 * vertical_per_normal() * base_.force * patch_.lowering / patch_.approach : 0.0;
  }

  void take_draw(std::size_t draw) { put_errors(&patch_.errors[draw]); }
  /// With the wheel lowered by dz [m].
  Numbers at(double dz) {
    problem_.force_prescribed = false;
    problem_.approach = patch_.approach + patch_.lowering * dz;
    return solved();
  }
  /// Under the force that it had without errors.
  Numbers under_its_force() {
    problem_.force_prescribed = true;
    problem_.normal_force = base_.force;
    Numbers out = solved();
    out.force = base_.force;  // but for rounding
    return out;
  }

  void add(const Numbers& now) {
    const auto relative = [](double a, double b) { return std::pow(a / b - 1.0, 2); };
    squares_.pressure += relative(now.pressure, base_.pressure);
    squares_.area += relative(now.area, base_.area);
    squares_.force += relative(now.force, base_.force);
    squares_.approach += std::pow(now.approach - base_.approach, 2);
    if (now.force > 0.0) squares_.place += std::pow(now.place - base_.place, 2);
  }
  ErrorSpread spread() const {
    ErrorSpread out = squares_;
    for (double* square : {&out.pressure, &out.area, &out.force, &out.approach, &out.place})
      *square = std::sqrt(*square / static_cast<double>(patch_.errors.size()));
    return out;
  }

 private:
  void put_errors(const std::vector<double>* rows) {
    moved_ = gap_;
    const auto nx = static_cast<std::size_t>(problem_.grid.nx);
    for (std::size_t i = 0; rows != nullptr && i < moved_.size(); ++i) moved_[i] += (*rows)[rows_[i / nx]];
    problem_.gap = moved_;
    least_ = kInfinity;
    for (const double h : moved_) least_ = std::fmin(least_, h);
  }

  Numbers solved() {
    check_cancelled();
    const kalker::ContactSolution s = solver_.solve_normal(problem_);
    Numbers out{s.max_pressure, static_cast<double>(s.elements_contact), s.force_n, s.approach - least_, 0.0};
    if (!(s.force_n > 0.0)) return out;
    double moment = 0.0, sum = 0.0;
    for (int iy = 0; iy < problem_.grid.ny; ++iy)
      for (int ix = 0; ix < problem_.grid.nx; ++ix) {
        const double p = s.pressure[problem_.grid.index(ix, iy)];
        sum += p, moment += p * problem_.grid.y(iy);
      }
    out.place = moment / sum;
    return out;
  }

  const UncertainPatch& patch_;
  kalker::ContactSolver solver_;
  kalker::ContactProblem problem_;
  std::vector<std::size_t> rows_;  ///< of the patch's grid
  std::vector<double> gap_, moved_;
  double least_ = 0.0;
  Numbers base_;
  ErrorSpread squares_;
};

/// All patches with the same errors and, together, the vertical force that they had.
void add_balanced(std::span<Again* const> patches) {
  constexpr int kMost = 6;
  constexpr double kSame = 1e-5;
  double target = 0.0, stiffness = 0.0;
  for (const Again* patch : patches)
    target += patch->vertical_per_normal() * patch->base().force, stiffness += patch->stiffness();
  std::vector<Numbers> now(patches.size());
  const auto lacking = [&](double dz) {
    double force = target;
    for (std::size_t k = 0; k < patches.size(); ++k) {
      now[k] = patches[k]->at(dz);
      force -= patches[k]->vertical_per_normal() * now[k].force;
    }
    return force;
  };
  double dz = 0.0, force = lacking(dz);
  for (int turn = 0; turn < kMost && std::fabs(force) > kSame * std::fabs(target) && stiffness > 0.0; ++turn) {
    const double step = force / stiffness, next = lacking(dz + step);
    // along the secant, which what goes out of contact may turn
    if (const double secant = (force - next) / step; secant > 0.0) stiffness = secant;
    dz += step, force = next;
  }
  for (std::size_t k = 0; k < patches.size(); ++k) patches[k]->add(now[k]);
}

}  // namespace

std::vector<std::optional<ErrorSpread>> error_spread(std::span<const UncertainPatch> patches, const Material& material,
                                                     bool force_given) {
  std::vector<Again> all;
  all.reserve(patches.size());
  for (const UncertainPatch& patch : patches) all.emplace_back(patch, material);
  std::vector<Again*> known;
  for (Again& one : all)
    if (one.is_patch()) known.push_back(&one);
  const std::size_t draws = patches.empty() ? 0 : patches.front().errors.size();
  for (std::size_t draw = 0; draw < draws; ++draw) {
    for (Again* one : known) one->take_draw(draw);
    if (force_given && known.size() > 1)
      add_balanced(known);
    else
      for (Again* one : known) one->add(force_given ? one->under_its_force() : one->at(0.0));
  }
  std::vector<std::optional<ErrorSpread>> out;
  out.reserve(all.size());
  for (const Again& one : all) out.push_back(one.is_patch() && draws > 0 ? std::optional(one.spread()) : std::nullopt);
  return out;
}

}  // namespace treadmark::wheelrail
