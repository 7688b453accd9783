// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/wheelrail/force_iteration.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/wheelrail/force_balance.hpp"
#include "treadmark/solvers/wheelrail/root_search.hpp"

namespace treadmark::wheelrail {
namespace {

/// How far heights may be from one another that are about the same, as a share of the depth.
constexpr double kNearEnough = 5e-3;

/// Simplified theories jump a little with every element that comes into contact: by no more than this share of the load
/// a jump is a balance.
constexpr double kSmallJump = 1e-3;

class Iteration {
 public:
  Iteration(PairStep& step, const Problem& problem, double stiffness, double end_slope, bool known)
      : step_(step), p_(problem), eps_(problem.solver.eps), known_(known) {
    out_.stiffness = stiffness;
    out_.end_slope = end_slope;
    out_.pitch_rate = first_pitch_rate();
  }

  Balance run() {
    if (p_.rail_springs)
      balance_lateral();
    else if (step_.place(0.0))
      balance_vertical();
    else
      off_the_rail();
    if (step_.few_elements_stay())
      fail(Status::not_converged,
           "elements could not be chosen: contact comes out elsewhere, or of another size, each time; give dx and ds");
    const bool on_rail = out_.status != Status::no_contact;
    if (p_.rail_springs && p_.vertical_force && p_.rail_springs->stiffness_z > 0.0 && on_rail)
      out_.rail_dz = (*p_.vertical_force + p_.rail_springs->force_z) / p_.rail_springs->stiffness_z;
    return std::move(out_);
  }

 private:
  void fail(Status status, std::string message) {
    if (out_.status != Status::ok) return;
    out_.status = status;
    out_.message = std::move(message);
  }

  /// No height, deflection or rate belongs to it that was sought at another place.
  void off_the_rail() {
    fail(Status::no_contact,
         "wheel and rail nowhere face each other: the wheel is off the rail" +
             (out_.rail_dy == 0.0 ? std::string()
                                  : fmt::format(", deflected by {:.3g} mm on its springs", 1e3 * out_.rail_dy)));
    out_.z = p_.vertical_force ? 0.0 : p_.state.position.z;
    out_.rail_dy = out_.rail_dz = 0.0;
    out_.pitch_rate = first_pitch_rate();
  }

  double first_pitch_rate() const { return p_.longitudinal_force ? free_rolling_rate() : p_.state.velocity.pitch; }

  double free_rolling_rate() const {
    const double running = p_.roller ? p_.roller->pitch_rate * p_.roller->nominal_radius : p_.state.velocity.x;
    return -running / p_.wheelset.nominal_radius;
  }

  /// Tractions, at the pitch rate that gives the prescribed longitudinal force.
  bool solve_tangential() {
    step_.solve_tangential(out_.pitch_rate, eps_);
    if (!p_.longitudinal_force || step_.normal_force() <= 0.0) return true;
    const double friction = std::max(p_.friction.static_friction(), 1e-6), bound = friction * step_.normal_force();
    const double running = std::abs(free_rolling_rate());
    // Creepages of the order of a ten-thousandth; of a shift, displacements of the order of a thousandth of an element.
    const bool shift = p_.regime == kalker::Regime::shift;
    const double unit = shift ? p_.discretisation.dx / p_.wheelset.nominal_radius : running;
    RootSearch search(
        {.tolerance = eps_ * bound, .first_step = 1e-4 * unit, .reach = 0.5 * unit, .resolution = 1e-14 * unit});
    RootSearch::State state = RootSearch::State::search;
    // A wheel that turns slower, its rate less negative, brakes: it pulls the rail forward.
    constexpr int kMost = 60;
    for (int i = 0; i < kMost; ++i) {
      check_cancelled();
      state = search.add(out_.pitch_rate, step_.longitudinal_force() - *p_.longitudinal_force);
      if (state != RootSearch::State::search) break;
      out_.pitch_rate = search.next();
      step_.solve_tangential(out_.pitch_rate, eps_);
    }
    if (state == RootSearch::State::found) return true;
    fail(Status::not_converged, fmt::format("no longitudinal balance: {:.6g} N are prescribed, the contact gives "
                                            "{:.6g} N at most at this load (friction bound {:.6g} N)",
                                            *p_.longitudinal_force, step_.longitudinal_force(), bound));
    return false;
  }

  /// Tractions as accurately as the vertical force wants them at first.
  bool estimate_shares() {
    if (p_.longitudinal_force) return solve_tangential();
    constexpr double kLoosest = 1e-2, kPart = 0.3;
    step_.solve_tangential(out_.pitch_rate, std::clamp(kPart * eps_ / step_.friction_share(), eps_, kLoosest));
    return true;
  }

  bool inside_the_rail() {
    if (step_.too_deep() <= 0.0) return false;
    fail(Status::failed,
         fmt::format("the wheel lies {:.3g} mm deep inside the rail: check heights and the placement of both",
                     1e3 * step_.too_deep()));
    return true;
  }

  /// On success the tangential problem is solved as well.
  bool balance_vertical() {
    step_.begin_balance();
    for (;; ++choices_) {
      if (!balance_on_elements()) return false;
      if (!step_.learn_elements()) return true;
    }
  }

  bool balance_on_elements() {
    const std::optional<RailSprings>& springs = p_.rail_springs;
    if (step_.at_given_height()) {
      out_.z = p_.state.position.z;
      if (elements_missing()) {
        step_.evaluate(out_.z);
        step_.learn_elements();
      }
      step_.evaluate(out_.z);
      if (std::isnan(step_.least_gap())) {
        off_the_rail();
        return false;
      }
      return !inside_the_rail() && solve_tangential();
    }
    ForceBalance::Target target;
    if (p_.vertical_force) {
      target.level = *p_.vertical_force;
    } else {
      // k_z dz = F_z + F_external with dz = z_ws - z
      target = {springs->stiffness_z * p_.state.position.z - springs->force_z, springs->stiffness_z};
      const double unloaded = target.level / target.spring;
      if (unloaded <= step_.touching_z()) {
        out_.z = unloaded;
        out_.pitch_rate = first_pitch_rate();
        step_.evaluate(unloaded);
        out_.rail_dz = p_.state.position.z - unloaded;
        return solve_tangential();
      }
    }
    if (elements_missing()) {
      seek_height(target);
      step_.learn_elements();
    }
    const bool found = iterate_height(target);
    if (!p_.vertical_force) out_.rail_dz = p_.state.position.z - out_.z;
    return found;
  }

  /// To start from where none is known: that of the bodies where a stiff contact would have them. Approximate pressures
  /// may fall with depth where parts of the contact go out, and the first balance counts: they start from the stiff
  /// one.
  double stiffness_for(const ForceBalance::Target& target) {
    if (known_ || p_.normal_model != kalker::NormalModel::full) return out_.stiffness;
    const double z = ForceBalance(target, p_.solver.eps, out_.stiffness).first(step_.touching_z());
    if (!guess_) guess_ = step_.stiffness_guess(z);
    return *guess_ > 0.0 ? *guess_ : out_.stiffness;
  }

  bool elements_missing() { return step_.few_elements() && !std::exchange(elements_sought_, true); }

  /// Vertical force on the elements that are there; too deep for contact mechanics, any large one sends the search up.
  double force_at_height() const {
    return step_.too_deep() > 0.0 ? out_.stiffness * std::pow(step_.too_deep(), 1.5) : step_.force_T().z();
  }

  void keep_stiffness(const ForceBalance::Target& target, double z, const ForceBalance* balance = nullptr) {
    const double depth = z - step_.touching_z(), force = target.at(z);
    if (!(depth > 0.0 && force > 0.0)) return;
    out_.stiffness = force / std::pow(depth, 1.5), known_ = true;
    if (balance) out_.end_slope = balance->end_slope(depth);
  }

  bool near(double z, double laid, double share) const {
    return std::abs(z - laid) <= share * (z - step_.touching_z());
  }

  /// Height of a contact that was solved under a load: the one that was found, or, where a spring wants another load
  /// there, the one where both meet. The force is right where it is the target's at this height.
  double height_under_load(const ForceBalance::Target& target) const {
    const double depth = step_.z() - step_.touching_z(), force = step_.force_T().z();
    if (!(target.spring > 0.0 && depth > 0.0 && force > 0.0)) return step_.z();
    return target.met(step_.touching_z(), force / std::pow(depth, 1.5));
  }

  bool reached(const ForceBalance::Target& target, double z) const {
    return std::abs(step_.force_T().z() - target.at(z)) <= eps_ * std::abs(target.at(z));
  }

  /// About the height and, of one patch on elements that are given, what tractions add to the force: near enough for
  /// the size of patches, and for the next search to start from.
  void seek_height(const ForceBalance::Target& target) {
    constexpr double kAccuracy = 1e-3;
    constexpr int kMostLooks = 6;
    ForceBalance balance(target, kNearEnough, stiffness_for(target), out_.end_slope);
    double z = balance.first(step_.touching_z());
    // A longitudinal force takes a search of its own, chosen elements follow pressures.
    bool shares_known = p_.longitudinal_force || step_.chooses_elements();
    for (int i = 0; i < p_.max_force_iterations; ++i) {
      check_cancelled();
      step_.evaluate(z, target.at(z));
      if (!step_.few_elements()) {
        laid_ = z;
        return;
      }
      if (step_.carries_load() && !shares_known && near(height_under_load(target), z, kNearEnough)) {
        step_.solve_tangential(out_.pitch_rate, kAccuracy);
        step_.carry(target.at(height_under_load(target)));
        shares_known = true;
      }
      if (step_.carries_load()) {
        const double laid = std::exchange(z, height_under_load(target));
        keep_stiffness(target, z);
        if (i >= kMostLooks || (shares_known && near(z, laid, kNearEnough))) return;
        continue;
      }
      const ForceBalance::State state = balance.add(z, force_at_height(), step_.least_gap());
      if (state == ForceBalance::State::found && step_.too_deep() <= 0.0)
        keep_stiffness(target, balance.next(), &balance);
      if (state != ForceBalance::State::search) return;
      z = balance.next();
    }
  }

  /// One patch: its normal problem finds the height with the pressures. Elements are laid again, and what lies under
  /// them is measured again, until the height stays as it is to the accuracy of forces. Where the load depends on the
  /// height, pressures follow it first, on the elements that are there. Nothing where the height has to be sought, from
  /// z on; evaluated: the step stands there.
  std::optional<bool> iterate_under_load(const ForceBalance::Target& target, double& z, bool& evaluated) {
    constexpr double kDeeper = 2.0;
    constexpr int kMost = 16;
    const double touching = step_.touching_z(), still = 4.0 * eps_;
    double laid = z, asked = z;  // heights for which the elements were laid, and for which they were found to stay
    const auto lies_elsewhere = [&] {
      if (near(z, asked, still)) return false;
      if (!near(z, laid, kNearEnough) || !step_.stays(z, eps_)) return true;
      asked = z;
      return false;
    };
    bool lay = true, shares_known = step_.knows_earlier_shares();
    double load = target.at(z);
    const auto take_height = [&] { z = height_under_load(target), load = target.at(z); };
    for (int i = 0; i < std::min(kMost, p_.max_force_iterations); ++i) {
      check_cancelled();
      if (!lay)
        step_.carry(load);
      else if (laid = asked = z; !std::exchange(evaluated, false))
        step_.evaluate(z, load);
      evaluated = lay && !step_.carries_load();
      if (!step_.carries_load()) return std::nullopt;
      take_height();
      out_.iterations.emplace_back(step_.z(), step_.force_T().z());
      const bool settled = !(target.spring > 0.0) || reached(target, z);
      lay = shares_known && (settled || !near(z, laid, kNearEnough)) && lies_elsewhere();
      // Under far too large a load few elements sink in far too deep.
      z = std::min(z, touching + kDeeper * (laid - touching));
      if (lay || (shares_known && !settled)) continue;
      if (!(shares_known ? solve_tangential() : estimate_shares())) return false;
      if (!std::exchange(shares_known, true)) continue;
      take_height();
      out_.z = z;
      out_.iterations.emplace_back(step_.z(), step_.force_T().z());
      if (!reached(target, z)) continue;
      keep_stiffness(target, z);
      return true;
    }
    return std::nullopt;
  }

  bool iterate_height(const ForceBalance::Target& target) {
    ForceBalance balance(target, eps_, stiffness_for(target), out_.end_slope);
    double z = balance.first(step_.touching_z());
    bool evaluated = laid_.has_value();
    if (evaluated) z = *std::exchange(laid_, std::nullopt);
    if (const std::optional<bool> done = iterate_under_load(target, z, evaluated)) return *done;
    ForceBalance::State state = ForceBalance::State::search;
    bool tangential_done = false, shares_known = false, exact = false;
    // Where a flange carries load, tractions turn the force: heights and tractions come to terms in rounds, each with
    // iterations of its own. What tractions add to the force is known well enough from a height close to the balance.
    for (int i = 0, round = 0; i < p_.max_force_iterations && round < p_.max_force_iterations; ++i) {
      check_cancelled();
      if (state == ForceBalance::State::search && !tangential_done && !std::exchange(evaluated, false))
        step_.evaluate(z);
      const double force = force_at_height();
      out_.iterations.emplace_back(z, force);
      out_.z = z;
      state = balance.add(z, force, step_.least_gap());
      if (state == ForceBalance::State::no_balance) break;
      const bool found = state == ForceBalance::State::found;
      if (found && (step_.too_deep() > 0.0 || (tangential_done && exact))) break;
      constexpr double kClose = 0.02, kSlight = 0.02;
      const double wanted = balance.wanted();
      const bool close = step_.too_deep() <= 0.0 && std::abs(force - wanted) <= kClose * std::abs(wanted);
      // Where tractions add little, what they added to the contact before does at first.
      const bool vague = close && !shares_known && !(step_.knows_earlier_shares() && step_.friction_share() <= kSlight);
      if (found || vague) {
        if (!(vague ? estimate_shares() : solve_tangential())) return false;
        exact = !vague;
        tangential_done = shares_known = true;
        balance.restart();
        state = ForceBalance::State::search;
        i = -1, ++round;
        constexpr int kMostRounds = 8;
        if (round == kMostRounds && step_.too_deep() <= 0.0) return iterate_with_tractions(target, z);
        continue;
      }
      tangential_done = false;
      z = balance.next();
    }
    if (state == ForceBalance::State::no_balance && to_nearer_side(balance)) tangential_done = false;
    if (inside_the_rail()) return false;
    if (!(tangential_done && exact) && !solve_tangential()) return false;
    if (state == ForceBalance::State::found) {
      out_.z = balance.next();
      keep_stiffness(target, out_.z, &balance);
      return true;
    }
    if (state == ForceBalance::State::no_balance) return no_balance(balance);
    not_reached();
    return false;
  }

  /// Whether the height had to be changed to the side of a jump whose force is nearer to the one prescribed.
  bool to_nearer_side(const ForceBalance& balance) {
    if (balance.nearer_side() == out_.z) return false;
    step_.evaluate(out_.z = balance.nearer_side());
    return true;
  }

  /// With tractions at every height: for forces that they turn so much that rounds go to and fro.
  bool iterate_with_tractions(const ForceBalance::Target& target, double z) {
    ForceBalance balance(target, eps_, out_.stiffness, out_.end_slope);
    balance.restart();
    for (int i = 0; i < p_.max_force_iterations; ++i) {
      check_cancelled();
      step_.evaluate(z);
      if (step_.too_deep() <= 0.0 && !solve_tangential()) return false;
      const double force = force_at_height();
      out_.iterations.emplace_back(z, force);
      out_.z = z;
      const ForceBalance::State state = balance.add(z, force, step_.least_gap());
      const double wanted = balance.wanted();
      const bool small_jump =
          state == ForceBalance::State::no_balance && std::abs(force - wanted) <= kSmallJump * std::abs(wanted);
      if (state == ForceBalance::State::no_balance && !small_jump) {
        if (to_nearer_side(balance) && step_.too_deep() <= 0.0 && !solve_tangential()) return false;
        return no_balance(balance);
      }
      if ((state == ForceBalance::State::found || small_jump) && step_.too_deep() <= 0.0) {
        if (!small_jump) out_.z = balance.next();
        keep_stiffness(target, out_.z, &balance);
        return true;
      }
      z = balance.next();
    }
    if (!inside_the_rail()) not_reached();
    return false;
  }

  bool no_balance(const ForceBalance& balance) {
    fail(Status::not_converged,
         fmt::format("no vertical balance: the contact force jumps from {:.6g} N to {:.6g} N at z = {:.6g} mm, across "
                     "the {:.6g} N {}",
                     balance.force_below(), balance.force_above(), 1e3 * out_.z, balance.wanted(),
                     p_.vertical_force ? "prescribed" : "of the rail's springs"));
    return false;
  }

  void not_reached() {
    fail(Status::not_converged,
         fmt::format("the vertical force was not reached within {} iterations", p_.max_force_iterations));
  }

  /// What forces are exact to eps of [N]: the load that is prescribed, else the one that the contact carries. Where
  /// there is none the springs' own.
  double load_scale() const {
    if (p_.vertical_force) return *p_.vertical_force;
    const double carried = step_.force_T().norm();
    return carried > 0.0 ? carried : std::abs(p_.rail_springs->force_y) + p_.rail_springs->stiffness_y * 1e-3;
  }

  void balance_lateral() {
    const RailSprings& k = *p_.rail_springs;
    constexpr double kReach = 0.1;         // a rail does not give way farther [m]
    constexpr double kResolution = 1e-12;  // no contact changes with less [m]
    const double eps = p_.solver.eps;
    // Far from the balance of the springs that of the other forces need not be more exact than it makes a difference.
    constexpr double kPart = 0.1;
    double loosest = 100.0 * eps;
    eps_ = loosest;
    std::optional<RootSearch> search;
    double dy = 0.0, slope = k.stiffness_y, dy_before = 0.0, residual_before = 0.0;
    const auto residual_there = [&] { return k.stiffness_y * dy - step_.force_T().y() - k.force_y; };
    constexpr int kMost = 60;
    for (int i = 0; i < kMost; ++i) {
      check_cancelled();
      out_.rail_dy = dy;
      const int choices = choices_;
      if (!step_.place(dy)) return off_the_rail();
      if (!balance_vertical()) return;
      double residual = residual_there();
      if (std::abs(residual) <= eps * load_scale() && std::exchange(eps_, eps) > eps) {
        if (!balance_vertical()) return;
        residual = residual_there();
      }
      const double scale = load_scale();
      if (std::abs(residual) <= eps * scale) return;
      eps_ = std::clamp(kPart * std::abs(residual) / scale, eps, loosest);
      if (search && dy != dy_before) slope = std::max(k.stiffness_y, (residual - residual_before) / (dy - dy_before));
      dy_before = dy, residual_before = residual;
      // What was found on other elements is no bracket for these.
      const bool anew = !search || choices != choices_;
      // The springs alone give the first step where it is not known what the contact adds to them.
      const double step = std::clamp(-residual / slope, -k.first_step_y, k.first_step_y);
      if (anew)
        search.emplace(RootSearch::Settings{.first_step = std::abs(step),
                                            .reach = kReach - std::abs(dy),
                                            .resolution = std::min(kResolution, kPart * eps * scale / k.stiffness_y)});
      switch (search->add(dy, residual)) {
        case RootSearch::State::found:
          return;
        case RootSearch::State::search:
          dy = anew ? dy + step : search->next();
          break;
        case RootSearch::State::jump:
          if (loosest > eps) {  // an end of the bracket may be on the wrong side, as inexact as it is
            loosest = eps_ = eps;
            search.reset();
            break;
          }
          if (search->residual_above() - search->residual_below() <= kSmallJump * scale) return;
          return fail(Status::not_converged,
                      fmt::format("no lateral balance: the force on the rail's springs jumps from {:.6g} N to {:.6g} N "
                                  "at a deflection of {:.6g} mm",
                                  search->residual_below(), search->residual_above(), 1e3 * dy));
        case RootSearch::State::nowhere:
          return fail(
              Status::not_converged,
              fmt::format("no lateral balance of the rail's springs within a deflection of {:.3g} mm", 1e3 * kReach));
      }
    }
    fail(Status::not_converged, fmt::format("the rail's springs were not in balance at any of {} deflections", kMost));
  }

  PairStep& step_;
  const Problem& p_;
  double eps_;  ///< of forces, relative
  bool known_;  ///< the stiffness, from a balance
  bool elements_sought_ = false;
  int choices_ = 0;              ///< how often elements were chosen by a balance
  std::optional<double> guess_;  ///< of the stiffness, before any balance
  std::optional<double> laid_;   ///< where the step stands that was to have few elements, but has those that are given
  Balance out_;
};

}  // namespace

Balance find_balance(PairStep& step, const Problem& problem, double stiffness, double end_slope, bool known) {
  return Iteration(step, problem, stiffness, end_slope, known).run();
}

}  // namespace treadmark::wheelrail
