// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/implicit_step.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/vehicle/wheel_loop.hpp"

namespace treadmark::vehicle {
namespace {

constexpr double kElementTolerance = 1e-9;  // of the static wheel load

double largest_force(const PairVector& f) {
  double most = 0.0;
  for (int c = 0; c < kPairCoordinates; ++c) {
    const bool is_moment = (c >= 3 && c < 6) || c == 8;
    most = std::max(most, std::abs(f[c]) / (is_moment ? kHalfGauge : 1.0));
  }
  return most;
}

}  // namespace

/// The system without contacts for one step length, and how it gives way to forces at the contacts.
struct ImplicitStep::Factors {
  double length = 0.0;
  Eigen::PartialPivLU<Matrix> lu;
  Matrix by_touched;     ///< accelerations for unit forces at the touched coordinates
  Matrix among_touched;  ///< those of the touched coordinates
  // Accelerations for unit forces along the columns of force elements: all, those of touched coordinates and of
  // columns.
  Matrix by_elements, elements_at_touched, among_elements;
  Matrix touched_at_elements;  ///< of the columns for unit forces at the touched coordinates
};

ImplicitStep::ImplicitStep(const VehicleOnTrack& vehicle, const StepSettings& settings)
    : vehicle_(vehicle), settings_(settings) {
  if (!(settings.spectral_radius >= 0.5 && settings.spectral_radius <= 1.0))
    throw Error(ErrorKind::configuration, "the spectral radius must lie between 0.5 and 1");
  alpha_ = -(1.0 - settings.spectral_radius) / (1.0 + settings.spectral_radius);
  beta_ = 0.25 * (1.0 - alpha_) * (1.0 - alpha_);
  gamma_ = 0.5 - alpha_;
  for (int c = 0; c < vehicle.system.size(); ++c)
    if (ranges::any_of(vehicle.maps, [c](const auto& map) { return !map.col(c).isZero(0.0); })) touched_.push_back(c);
  for (const auto& map : vehicle.maps) {
    const auto& touched = maps_.emplace_back(map(Eigen::all, touched_));
    std::vector<int>& own = own_.emplace_back();
    for (int c = 0; c < touched.cols(); ++c)
      if (!touched.col(c).isZero(0.0)) own.push_back(c);
  }
  force_scale_ = 0.5 * *ranges::max_element(vehicle.system.wheelset_load);
}

ImplicitStep::~ImplicitStep() = default;
ImplicitStep::ImplicitStep(ImplicitStep&&) noexcept = default;

Motion ImplicitStep::start(const SystemState& state, const std::vector<ContactReaction>& reactions) const {
  const Multibody& s = vehicle_.system;
  Motion m;
  m.state = state;
  const std::optional<LineState> line = vehicle_.line_state(state.time);
  m.unbalanced = s.weight - s.stiffness * state.q - s.damping * state.v + vehicle_.other_forces(state, line);
  if (line) m.unbalanced += line->force;
  if (s.elements.size() > 0) {
    ElementResponse at_rest = vehicle_.resting_elements(state, line);
    m.unbalanced += s.elements.on_coordinates(at_rest.force, s.size());
    m.element_force = std::move(at_rest.force);
    m.element_memory = std::move(at_rest.memory);
  }
  for (std::size_t i = 0; i < reactions.size(); ++i) {
    m.contact_force.push_back(generalised_force(reactions[i], vehicle_.motion(i, state)));
    m.unbalanced += vehicle_.maps[i].transpose() * m.contact_force.back();
  }
  m.a = Vector::Zero(s.size());
  for (Eigen::Index i = 0; i < m.a.size(); ++i)
    if (s.mass[i] > 0.0) m.a[i] = m.unbalanced[i] / s.mass[i];
  // What has no mass follows its damper: C v' = f' - K v.
  for (Eigen::Index i = 0; i < m.a.size(); ++i)
    if (!(s.mass[i] > 0.0))
      m.a[i] = ((line ? line->spring_rate[i] : 0.0) - s.stiffness.row(i).dot(state.v)) / s.damping(i, i);
  m.a_before = m.a;
  return m;
}

const ImplicitStep::Factors& ImplicitStep::factors(double h) {
  if (factors_ && factors_->length == h) return *factors_;
  const Multibody& s = vehicle_.system;
  auto fresh = std::make_unique<Factors>();
  fresh->length = h;
  Matrix effective = (1.0 + alpha_) * (gamma_ * h * s.damping + beta_ * h * h * s.stiffness);
  effective.diagonal() += s.mass;
  fresh->lu.compute(effective);
  Matrix unit = Matrix::Zero(s.size(), static_cast<Eigen::Index>(touched_.size()));
  for (std::size_t i = 0; i < touched_.size(); ++i) unit(touched_[i], static_cast<Eigen::Index>(i)) = 1.0;
  fresh->by_touched = fresh->lu.solve(unit);
  fresh->among_touched = fresh->by_touched(touched_, Eigen::all);
  if (s.elements.size() > 0) {
    const Matrix directions = s.elements.directions(s.size());
    fresh->by_elements = fresh->lu.solve(directions.transpose());
    fresh->elements_at_touched = fresh->by_elements(touched_, Eigen::all);
    fresh->among_elements = directions * fresh->by_elements;
    fresh->touched_at_elements = directions * fresh->by_touched;
  }
  factors_ = std::move(fresh);
  return *factors_;
}

Vector ImplicitStep::predicted_acceleration(const Motion& from, double h) const {
  if (!(from.step_before > 0.0)) return from.a;
  return from.a + (h / from.step_before) * (from.a - from.a_before);
}

Step ImplicitStep::take(const Motion& from, double h) {
  const Multibody& s = vehicle_.system;
  const Factors& f = factors(h);
  const std::size_t wheels = vehicle_.wheels.size();
  const Vector q_known = from.state.q + h * from.state.v + h * h * (0.5 - beta_) * from.a;
  const Vector v_known = from.state.v + h * (1.0 - gamma_) * from.a;
  const double of_q = beta_ * h * h, of_v = gamma_ * h;
  const auto state_of = [&](const Vector& a) {
    return SystemState{from.state.time + h, q_known + of_q * a, v_known + of_v * a};
  };
  const std::optional<LineState> line = vehicle_.line_state(from.state.time + h);
  const Vector load = line ? Vector(s.weight + line->force) : s.weight;
  const Vector known = (1.0 + alpha_) * (load - s.damping * v_known - s.stiffness * q_known) - alpha_ * from.unbalanced;

  const ForceElements& elements = s.elements;
  ElementStep element_step;
  if (elements.size() > 0) {
    element_step.displacement = elements.of(q_known);
    element_step.rate = elements.of(v_known);
    if (line) element_step.displacement += line->element_stretch, element_step.rate += line->element_rate;
    element_step.of_displacement = of_q;
    element_step.of_rate = of_v;
    element_step.duration = h;
    element_step.tolerance = kElementTolerance * force_scale_;
  }
  ElementResponse response;

  Step step;
  Vector a = predicted_acceleration(from, h);
  for (; step.iterations < settings_.max_iterations; ++step.iterations) {
    const SystemState at = state_of(a);
    const Vector stops = vehicle_.other_forces(at, line);
    Vector right = known + (1.0 + alpha_) * stops;
    Matrix give = Matrix::Zero(f.among_touched.rows(), f.among_touched.rows());
    std::vector<PairVector> forces;
    std::vector<PairTangent> tangents;
    step.reactions = evaluate_wheels(vehicle_, at);
    for (std::size_t i = 0; i < wheels; ++i) {
      const PairMotion m = vehicle_.motion(i, at);
      const ContactReaction& reaction = step.reactions[i];
      if (is_unsolved(reaction)) {
        step.why_not = fmt::format("{}: {}", vehicle_.wheels[i].name, reaction.message);
        step.derailed = reaction.derailed;
        return step;
      }
      forces.push_back(generalised_force(reaction, m));
      tangents.push_back(vehicle_.tangent(i, reaction, m));
      right += (1.0 + alpha_) * (vehicle_.maps[i].transpose() * forces.back());
      const PairMatrix tangent = (1.0 + alpha_) * (of_q * tangents.back().stiffness + of_v * tangents.back().damping);
      const Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic> map = maps_[i](Eigen::all, own_[i]);
      const Matrix of_wheel = map.transpose() * tangent * map;
      give(own_[i], own_[i]) += of_wheel;
    }
    // Contacts respond to the difference from the state at which they were evaluated; (S + P' D P) x = b by the small
    // system at P.
    const Vector free = f.lu.solve(right) - a;
    const Matrix small = Matrix::Identity(give.rows(), give.rows()) + f.among_touched * give;
    const Eigen::PartialPivLU<Matrix> small_lu(small);
    const Vector change_touched = small_lu.solve(free(touched_));
    Vector change = free - f.by_touched * (give * change_touched);
    if (elements.size() > 0) {
      const Matrix by_contacts = give * small_lu.solve(f.elements_at_touched);
      element_step.free = elements.of(a + change);
      element_step.flexibility = (1.0 + alpha_) * (f.among_elements - f.touched_at_elements * by_contacts);
      element_step.guess = elements.of(a);
      std::optional<ElementResponse> settled = settle(elements, element_step, from.element_memory);
      if (!settled) {
        step.why_not = "forces of dry friction, dampers and air springs did not settle within a step";
        return step;
      }
      response = std::move(*settled);
      change -= (1.0 + alpha_) * (f.by_elements * response.force - f.by_touched * (by_contacts * response.force));
    }
    a += change;

    double most = 0.0;
    for (std::size_t i = 0; i < wheels; ++i) {
      const PairVector moved = maps_[i] * change(touched_);
      const PairVector correction = -(of_q * tangents[i].stiffness + of_v * tangents[i].damping) * moved;
      forces[i] += correction;
      const double scale = std::max(force_scale_, step.reactions[i].normal_force);
      most = std::max(most, std::max(largest_force(correction), step.reactions[i].corrected) / scale);
    }
    if (!a.allFinite()) {
      step.why_not = "the motion has no finite values";
      return step;
    }
    if (most > settings_.force_tolerance) continue;

    step.converged = true;
    ++step.iterations;
    Motion& end = step.end;
    end.state = state_of(a);
    end.a = a;
    end.a_before = from.a;
    end.step_before = h;
    end.contact_force = std::move(forces);
    end.unbalanced = load - s.stiffness * end.state.q - s.damping * end.state.v + stops;
    if (elements.size() > 0) {
      end.unbalanced += elements.on_coordinates(response.force, s.size());
      end.element_force = std::move(response.force);
      end.element_memory = std::move(response.memory);
    }
    for (std::size_t i = 0; i < wheels; ++i) end.unbalanced += vehicle_.maps[i].transpose() * end.contact_force[i];
    for (Eigen::Index i = 0; i < a.size(); ++i)
      if (s.mass[i] > 0.0)
        step.position_error =
            std::max(step.position_error, std::abs(beta_ - 1.0 / 6.0) * h * h * std::abs(a[i] - from.a[i]) *
                                              s.coordinates[static_cast<std::size_t>(i)].arm);
    return step;
  }
  step.why_not = "contact forces and motion did not converge within a step";
  return step;
}

}  // namespace treadmark::vehicle
