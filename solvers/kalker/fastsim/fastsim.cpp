// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/fastsim/fastsim.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <string>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/model/contact/theories.hpp"
#include "treadmark/solvers/kalker/fastsim/flexibilities.hpp"
#include "treadmark/solvers/kalker/fastsim/strip_theory.hpp"

namespace treadmark::kalker {

namespace {

[[noreturn]] void refuse(const std::string& message, const std::string& advice = {}) {
  throw Error(ErrorKind::configuration, "FASTSIM: " + message, {}, advice);
}

/// +1 for rolling along +x, -1 along -x.
double rolling_sign(const ContactProblem& problem) {
  constexpr double kTolerance = 1e-6;
  const double cosine = std::cos(problem.rolling.chi);
  if (std::abs(std::abs(cosine) - 1.0) > kTolerance)
    refuse("the direction of rolling is " + std::to_string(problem.rolling.chi) + " rad", "use 0 or pi");
  return cosine > 0.0 ? 1.0 : -1.0;
}

void check(const ContactProblem& problem, const ContactSolution& solution) {
  const bool steady_only = theory(problem.tangential_model).limits.steady_only;
  if (problem.regime != Regime::steady && (steady_only || problem.regime != Regime::transient))
    refuse(steady_only ? "only steady rolling is possible" : "only rolling is possible, steady or transient",
           "use the full tangential model");
  if (problem.regime == Regime::transient && !(problem.rolling.step > 0.0)) refuse("the rolling step must be positive");
  if (solution.pressure.size() != problem.grid.size()) refuse("there are no pressures on this grid");
  if (!(problem.rolling.velocity > 0.0)) refuse("the rolling velocity must be positive");
  if (!(problem.fastsim.k0 > 0.0) || !(problem.fastsim.alpha > 0.0 && problem.fastsim.alpha <= 1.0) ||
      !(problem.fastsim.beta >= 0.0))
    refuse("the slope reduction needs k0 > 0, 0 < alpha <= 1, beta >= 0");
  if (!problem.friction_of_row.empty() || problem.friction.kind == FrictionLaw::Kind::temperature)
    refuse("friction is the same everywhere", "use the full tangential model for friction by row or by temperature");
  const bool extra = !problem.extra_slip_x.empty() || !problem.extra_slip_y.empty();
  if (extra && problem.tangential_model == TangentialModel::fastrip)
    refuse("strip theory does not take slip given for every element into account",
           "use the full tangential model, or FASTSIM");
  for (const auto& slip : {problem.extra_slip_x, problem.extra_slip_y})
    if (!slip.empty() && slip.size() != problem.grid.size()) refuse("slip is not given for every element");
  const double flexibility = problem.fastsim.flexibility;
  if (problem.tangential_model == TangentialModel::fastsim_one_flexibility &&
      !(flexibility > 0.0 && std::isfinite(flexibility)))
    refuse("the one flexibility is " + std::to_string(flexibility) + " m/Pa", "it must be positive");
}

/// Traction row by row, from the leading edge backwards: what the material brings along, changed by the rigid slip,
/// unless friction bounds it. In steady rolling it comes from the element ahead, else from where it was a step ago.
class Sweep {
 public:
  Sweep(const ContactProblem& problem, ContactSolution& solution, const ContactHistory& previous)
      : problem_(problem),
        solution_(solution),
        previous_(previous),
        steady_(problem.regime == Regime::steady),
        halved_(problem.fastsim.first_step == FastsimSettings::FirstStep::half),
        sign_(steady_ ? rolling_sign(problem) : 1.0),
        dq_(steady_ ? problem.grid.dx : problem.rolling.step),
        shift_x_(dq_ * (steady_ ? sign_ : std::cos(problem.rolling.chi))),
        shift_y_(steady_ ? 0.0 : dq_ * std::sin(problem.rolling.chi)),
        equivalent_(equivalent_ellipse(problem.grid, solution.pressure)) {
    normal_force_ = std::accumulate(solution.pressure.begin(), solution.pressure.end(), 0.0) * problem.grid.cell_area();
    const double columns = std::abs(shift_x_) / problem.grid.dx, rows = std::abs(shift_y_) / problem.grid.dy;
    const double stretch = 1.0 / std::min(1.0, std::max(columns, rows));
    ahead_x_ = to_whole<int>(std::copysign(std::round(stretch * columns), shift_x_));
    ahead_y_ = to_whole<int>(std::copysign(std::round(stretch * rows), shift_y_));
  }

  double normal_force() const { return normal_force_; }

  /// Fills the fields for one creepage; returns the force on body 1 [N].
  Vec2 run(const Creepage& creepage, bool blended);

 private:
  void bring_along(const Flexibilities& flex);
  bool comes_in(int ix, int iy) const;
  void row(int iy, const Creepage& creepage, double mu, const Flexibilities& flex);
  void element(std::size_t i, double x, double y, double share, const Creepage& creepage, double mu,
               const Flexibilities& flex, Vec2& u);

  const ContactProblem& problem_;
  ContactSolution& solution_;
  const ContactHistory& previous_;
  bool steady_, halved_;
  double sign_, dq_, shift_x_, shift_y_;
  int ahead_x_ = 0, ahead_y_ = 0;            ///< where material comes from, at least an element further on
  std::vector<double> before_x_, before_y_;  ///< displacement of the material a step ago [m]; empty: none
  EquivalentEllipse equivalent_;
  double normal_force_ = 0.0;
};

Vec2 Sweep::run(const Creepage& creepage, bool blended) {
  const Grid2& grid = problem_.grid;
  const double mu = problem_.friction.at(problem_.rolling.velocity * std::hypot(creepage.xi, creepage.eta));
  const Flexibilities flex = flexibilities(problem_, creepage, mu, normal_force_, equivalent_, blended);
  for (auto* field : {&solution_.traction_x, &solution_.traction_y, &solution_.displacement_x,
                      &solution_.displacement_y, &solution_.slip_x, &solution_.slip_y})
    field->assign(grid.size(), 0.0);
  solution_.friction.assign(grid.size(), mu);
  solution_.state.assign(grid.size(), ElementState::exterior);

  if (!steady_) bring_along(flex);
  for (int iy = 0; iy < grid.ny; ++iy) {
    check_cancelled();
    row(iy, creepage, mu, flex);
  }
  if (problem_.tangential_model == TangentialModel::fastrip && mu * normal_force_ > 0.0)
    apply_strip_theory(problem_, StripTheory(problem_, creepage, mu, normal_force_, equivalent_, sign_), solution_);
  const auto sum = [](const std::vector<double>& field) { return std::accumulate(field.begin(), field.end(), 0.0); };
  return Vec2(sum(solution_.traction_x), sum(solution_.traction_y)) * grid.cell_area();
}

void Sweep::bring_along(const Flexibilities& flex) {
  if (previous_.empty()) return;
  const Grid2& grid = problem_.grid;
  const auto moved = [&](const std::vector<double>& displacement, const std::vector<double>& traction, double l) {
    std::vector<double> u = displacement;
    if (u.empty()) {
      u = traction;
      for (double& value : u) value *= l / flex.slope;
    }
    return u.empty() ? u : carried(grid, u, shift_x_, shift_y_, 0.0);
  };
  before_x_ = moved(previous_.layer_x, previous_.traction_x, flex.lx);
  before_y_ = moved(previous_.layer_y, previous_.traction_y, flex.ly);
}

void Sweep::row(int iy, const Creepage& creepage, double mu, const Flexibilities& flex) {
  const Grid2& grid = problem_.grid;
  Vec2 u = Vec2::Zero();
  for (int step = 0; step < grid.nx; ++step) {
    const int ix = sign_ > 0.0 ? grid.nx - 1 - step : step;
    const std::size_t i = grid.index(ix, iy);
    if (!steady_) u = before_x_.empty() || before_y_.empty() ? Vec2(0.0, 0.0) : Vec2(before_x_[i], before_y_[i]);
    if (solution_.pressure[i] > 0.0)
      element(i, grid.x(ix), grid.y(iy), halved_ && comes_in(ix, iy) ? 0.5 : 1.0, creepage, mu, flex, u);
    else
      u.setZero();
  }
}

/// The material of an element was not in contact a step ago: on average it has been for half of the step.
bool Sweep::comes_in(int ix, int iy) const {
  const Grid2& grid = problem_.grid;
  const int jx = ix + ahead_x_, jy = iy + ahead_y_;
  if (jx < 0 || jy < 0 || jx >= grid.nx || jy >= grid.ny) return true;
  const std::vector<double>& pressure = steady_ || previous_.empty() ? solution_.pressure : previous_.pressure;
  return !(pressure[grid.index(jx, jy)] > 0.0);
}

/// share: of the step during which the material has been in contact.
void Sweep::element(std::size_t i, double x, double y, double share, const Creepage& creepage, double mu,
                    const Flexibilities& flex, Vec2& u) {
  const double midway = halved_ ? 0.5 * share : problem_.rolling.spin_offset_factor, way = share * dq_;
  const double lever_x = x - creepage.spin_x + midway * shift_x_;
  const double lever_y = y - creepage.spin_y + midway * shift_y_;
  const auto extra = [i](const auto& slip) { return slip.empty() ? 0.0 : slip[i]; };
  const Vec2 rigid(creepage.xi - flex.spin_x * creepage.phi * lever_y + extra(problem_.extra_slip_x),
                   creepage.eta + flex.spin_y * creepage.phi * lever_x + extra(problem_.extra_slip_y));
  const Vec2 ahead = u;
  const Vec2 flexibility(flex.lx / flex.slope, flex.ly / flex.slope);
  u = ahead - way * rigid;
  Vec2 traction = u.cwiseQuotient(flexibility);
  const double bound = mu * solution_.pressure[i], size = traction.norm();
  solution_.state[i] = ElementState::adhesion;
  if (size > bound) {
    traction *= bound / size;
    u = traction.cwiseProduct(flexibility);
    solution_.state[i] = ElementState::slip;
    const Vec2 slip = (u - ahead) / way + rigid;
    solution_.slip_x[i] = slip.x();
    solution_.slip_y[i] = slip.y();
  }
  solution_.traction_x[i] = traction.x();
  solution_.traction_y[i] = traction.y();
  solution_.displacement_x[i] = u.x();
  solution_.displacement_y[i] = u.y();
}

/// Creepages for prescribed forces: damped Newton iterations with differences, in units of full-slip creepage.
void find_creepage(const ContactProblem& problem, Sweep& sweep, ContactSolution& solution) {
  const double full = problem.friction.static_friction() * sweep.normal_force();
  const bool find_x = problem.fx_relative.has_value(), find_y = problem.fy_relative.has_value();
  Creepage creepage = problem.creepage;
  const CombinedMaterial material = combine(problem.material);
  const EquivalentEllipse ellipse = equivalent_ellipse(problem.grid, solution.pressure);
  const double unit = full / (material.shear_modulus * ellipse.a * ellipse.b * 4.0);
  if (find_x) creepage.xi = -*problem.fx_relative * unit;
  if (find_y) creepage.eta = -*problem.fy_relative * unit;

  const auto mismatch = [&](const Creepage& c) {
    const Vec2 force = sweep.run(c, false) / full;
    return Vec2(find_x ? force.x() - *problem.fx_relative : 0.0, find_y ? force.y() - *problem.fy_relative : 0.0);
  };
  Report& report = solution.tangential;
  Vec2 residual = mismatch(creepage);
  for (report.iterations = 0; report.iterations < problem.settings.max_force; ++report.iterations) {
    if (residual.lpNorm<Eigen::Infinity>() <= problem.settings.eps) break;
    const double h = 1e-4 * unit;
    Eigen::Matrix2d jacobian = Eigen::Matrix2d::Identity();
    for (int k = 0; k < 2; ++k) {
      if (!(k == 0 ? find_x : find_y)) continue;
      Creepage moved = creepage;
      (k == 0 ? moved.xi : moved.eta) += h;
      jacobian.col(k) = (mismatch(moved) - residual) / h;
    }
    if (!find_x) jacobian.row(0) << 1.0, 0.0;
    if (!find_y) jacobian.row(1) << 0.0, 1.0;
    const double determinant = jacobian.determinant();
    if (determinant == 0.0 || !std::isfinite(determinant)) break;
    const Vec2 step(-(jacobian(1, 1) * residual.x() - jacobian(0, 1) * residual.y()) / determinant,
                    -(jacobian(0, 0) * residual.y() - jacobian(1, 0) * residual.x()) / determinant);
    double damping = 1.0;
    for (int halving = 0; halving < 20; ++halving, damping *= 0.5) {
      Creepage trial = creepage;
      if (find_x) trial.xi += damping * step.x();
      if (find_y) trial.eta += damping * step.y();
      const Vec2 next = mismatch(trial);
      if (!(next.norm() < residual.norm()) && halving < 19) continue;
      creepage = trial;
      residual = next;
      break;
    }
  }
  sweep.run(creepage, false);
  solution.creepage = creepage;
  report.residual = residual.lpNorm<Eigen::Infinity>();
  if (report.residual <= problem.settings.eps) return;
  report.status = solution.status = Status::not_converged;
  report.message = "no creepage was found for the prescribed tangential force";
}

}  // namespace

void solve_fastsim(const ContactProblem& problem, ContactSolution& solution, const ContactHistory& previous) {
  check(problem, solution);
  solution.tangential = Report();
  solution.rolling_step = problem.regime == Regime::steady ? problem.grid.dx : problem.rolling.step;
  solution.creepage = problem.creepage;
  Sweep sweep(problem, solution, previous);
  if (problem.fx_relative || problem.fy_relative)
    find_creepage(problem, sweep, solution);
  else
    sweep.run(problem.creepage, true);
}

}  // namespace treadmark::kalker
