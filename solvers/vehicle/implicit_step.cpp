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

/// A vehicle without contacts for one step length, and how it gives way to forces at the contacts.
struct ImplicitStep::PartFactors {
  Eigen::PartialPivLU<Matrix> lu;
  Matrix by_touched;     ///< accelerations for unit forces at the touched coordinates
  Matrix among_touched;  ///< those of the touched coordinates
  // Accelerations for unit forces along the columns of force elements: all, those of touched coordinates and of
  // columns.
  Matrix by_elements, elements_at_touched, among_elements;
  Matrix touched_at_elements;  ///< of the columns for unit forces at the touched coordinates
};

struct ImplicitStep::Factors {
  double length = 0.0;
  std::vector<PartFactors> parts;
};

ImplicitStep::ImplicitStep(const VehicleOnTrack& vehicle, const StepSettings& settings)
    : vehicle_(vehicle), settings_(settings) {
  if (!(settings.spectral_radius >= 0.5 && settings.spectral_radius <= 1.0))
    throw Error(ErrorKind::configuration, "the spectral radius must lie between 0.5 and 1");
  alpha_ = -(1.0 - settings.spectral_radius) / (1.0 + settings.spectral_radius);
  beta_ = 0.25 * (1.0 - alpha_) * (1.0 - alpha_);
  gamma_ = 0.5 - alpha_;
  const Multibody& s = vehicle.system;
  const auto columns_of = [&](auto&& wanted) {
    std::vector<int> columns;
    for (int c = 0; c < s.elements.size(); ++c)
      if (wanted(s.elements.columns[static_cast<std::size_t>(c)])) columns.push_back(c);
    return columns;
  };
  for (const Multibody::Range& range : s.vehicles) {
    const int number = static_cast<int>(parts_.size());
    Part& part = parts_.emplace_back(Part{range, {}, {}});
    for (int c = 0; c < range.size; ++c)
      for (std::size_t i = 0; i < vehicle.wheels.size(); ++i)
        if (vehicle.vehicle_of(i) == number && !vehicle.maps[i].col(c).isZero(0.0)) {
          part.touched.push_back(c);
          break;
        }
    part.elements =
        share_of(s.elements, columns_of([&](const ElementColumn& c) { return c.vehicle == number; }), range.first);
  }
  for (int link = 0; link < static_cast<int>(s.links.size()); ++link)
    if (auto columns = columns_of([&](const ElementColumn& c) { return c.vehicle < 0 && c.link == link; });
        !columns.empty())
      couplers_.push_back(share_of(s.elements, std::move(columns), 0));
  for (std::size_t i = 0; i < vehicle.wheels.size(); ++i) {
    const std::vector<int>& of_vehicle = parts_[static_cast<std::size_t>(vehicle.vehicle_of(i))].touched;
    const auto& touched = maps_.emplace_back(vehicle.maps[i](Eigen::all, of_vehicle));
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
  m.unbalanced =
      s.weight - s.times(s.stiffness, state.q) - s.times(s.damping, state.v) + vehicle_.other_forces(state, line);
  if (line) m.unbalanced += line->force;
  if (s.elements.size() > 0) {
    ElementResponse at_rest = vehicle_.resting_elements(state, line);
    m.unbalanced += s.elements.on_coordinates(at_rest.force, s.size());
    if (line) line->add_couplers_aside(at_rest.force, 1.0, m.unbalanced);
    m.element_force = std::move(at_rest.force);
    m.element_memory = std::move(at_rest.memory);
  }
  for (std::size_t i = 0; i < reactions.size(); ++i) {
    m.contact_force.push_back(generalised_force(reactions[i], vehicle_.motion(i, state)));
    vehicle_.add_force(i, m.contact_force.back(), m.unbalanced);
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

ImplicitStep::PartFactors ImplicitStep::factorised(const Part& part, double h) const {
  const Multibody& s = vehicle_.system;
  PartFactors fresh;
  const Eigen::Index size = part.range.size;
  Matrix effective = (1.0 + alpha_) *
                     (gamma_ * h * block_of(s.damping, part.range) + beta_ * h * h * block_of(s.stiffness, part.range));
  effective.diagonal() += part_of(s.mass, part.range);
  fresh.lu.compute(effective);
  Matrix unit = Matrix::Zero(size, static_cast<Eigen::Index>(part.touched.size()));
  for (std::size_t i = 0; i < part.touched.size(); ++i) unit(part.touched[i], static_cast<Eigen::Index>(i)) = 1.0;
  fresh.by_touched = fresh.lu.solve(unit);
  fresh.among_touched = fresh.by_touched(part.touched, Eigen::all);
  if (part.elements.elements.size() > 0) {
    const Matrix directions = part.elements.elements.directions(size);
    fresh.by_elements = fresh.lu.solve(directions.transpose());
    fresh.elements_at_touched = fresh.by_elements(part.touched, Eigen::all);
    fresh.among_elements = directions * fresh.by_elements;
    fresh.touched_at_elements = directions * fresh.by_touched;
  }
  return fresh;
}

const ImplicitStep::Factors& ImplicitStep::factors(double h) {
  if (factors_ && factors_->length == h) return *factors_;
  auto fresh = std::make_unique<Factors>();
  fresh->length = h;
  for (const Part& part : parts_) fresh->parts.push_back(factorised(part, h));
  factors_ = std::move(fresh);
  return *factors_;
}

std::size_t ImplicitStep::factorised_numbers() const {
  Eigen::Index sum = 0;
  if (factors_)
    for (const PartFactors& f : factors_->parts)
      sum += f.lu.matrixLU().size() + f.by_touched.size() + f.among_touched.size() + f.by_elements.size() +
             f.elements_at_touched.size() + f.among_elements.size() + f.touched_at_elements.size();
  return static_cast<std::size_t>(sum);
}

Vector ImplicitStep::predicted_acceleration(const Motion& from, double h) const {
  if (!(from.step_before > 0.0)) return from.a;
  return from.a + (h / from.step_before) * (from.a - from.a_before);
}

ElementStep ImplicitStep::element_step(const Part& part, const Vector& q, const Vector& v,
                                       const std::optional<LineState>& line, double h) const {
  const ForceElements& elements = part.elements.elements;
  ElementStep step;
  if (elements.size() == 0) return step;
  step.displacement = elements.of(part_of(q, part.range));
  step.rate = elements.of(part_of(v, part.range));
  if (line) {
    step.displacement += line->element_stretch(part.elements.columns);
    step.rate += line->element_rate(part.elements.columns);
  }
  step.of_displacement = beta_ * h * h;
  step.of_rate = gamma_ * h;
  step.duration = h;
  step.tolerance = kElementTolerance * force_scale_;
  return step;
}

/// Contacts respond to the difference from the state at which they were evaluated; (S + P' D P) x = b by the small
/// system at P. None: force elements do not settle.
std::optional<Vector> ImplicitStep::change_of(const Part& part, const PartFactors& f, const Vector& right,
                                              const Vector& a, const Matrix& give, ElementStep& step,
                                              const Vector& memory, ElementResponse& response) const {
  const Vector now = part_of(a, part.range);
  const Vector free = f.lu.solve(part_of(right, part.range)) - now;
  const Matrix small = Matrix::Identity(give.rows(), give.rows()) + f.among_touched * give;
  const Eigen::PartialPivLU<Matrix> small_lu(small);
  const Vector change_touched = small_lu.solve(free(part.touched));
  Vector change = free - f.by_touched * (give * change_touched);
  const auto& [elements, columns, places] = part.elements;
  if (elements.size() == 0) return change;
  const Matrix by_contacts = give * small_lu.solve(f.elements_at_touched);
  step.free = elements.of(now + change);
  step.flexibility = (1.0 + alpha_) * (f.among_elements - f.touched_at_elements * by_contacts);
  step.guess = elements.of(now);
  const std::optional<ElementResponse> settled = settle(elements, step, memory(places));
  if (!settled) return std::nullopt;
  change -= (1.0 + alpha_) * (f.by_elements * settled->force - f.by_touched * (by_contacts * settled->force));
  response.force(columns) = settled->force;
  response.memory(places) = settled->memory;
  return change;
}

/// Forces of the elements between vehicles in a state.
void ImplicitStep::couple(const SystemState& at, const std::optional<LineState>& line, const Motion& from, double h,
                          ElementResponse& response) const {
  for (const auto& [elements, columns, places] : couplers_) {
    Vector displacement = elements.of(at.q), rate = elements.of(at.v);
    if (line) displacement += line->element_stretch(columns), rate += line->element_rate(columns);
    const ElementResponse r = respond(elements, displacement, rate, from.element_memory(places), h);
    response.force(columns) = r.force;
    response.memory(places) = r.memory;
  }
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
  const Vector known =
      (1.0 + alpha_) * (load - s.times(s.damping, v_known) - s.times(s.stiffness, q_known)) - alpha_ * from.unbalanced;

  const ForceElements& elements = s.elements;
  std::vector<ElementStep> element_steps;
  for (const Part& part : parts_) element_steps.push_back(element_step(part, q_known, v_known, line, h));
  ElementResponse response{Vector::Zero(elements.size()), {}, {}, from.element_memory};

  Step step;
  Vector a = predicted_acceleration(from, h);
  couple(state_of(a), line, from, h, response);
  for (; step.iterations < settings_.max_iterations; ++step.iterations) {
    const SystemState at = state_of(a);
    const Vector stops = vehicle_.other_forces(at, line);
    Vector right = known + (1.0 + alpha_) * stops;
    for (const ElementShare& c : couplers_) c.elements.add_to(right, response.force(c.columns), 1.0 + alpha_);
    if (line) line->add_couplers_aside(response.force, 1.0 + alpha_, right);
    std::vector<Matrix> give;
    for (const Part& part : parts_) {
      const auto touched = static_cast<Eigen::Index>(part.touched.size());
      give.emplace_back(Matrix::Zero(touched, touched));
    }
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
      part_of(right, vehicle_.range(i)) += (1.0 + alpha_) * (vehicle_.maps[i].transpose() * forces.back());
      const PairMatrix tangent = (1.0 + alpha_) * (of_q * tangents.back().stiffness + of_v * tangents.back().damping);
      const Eigen::Matrix<double, kPairCoordinates, Eigen::Dynamic> map = maps_[i](Eigen::all, own_[i]);
      const Matrix of_wheel = map.transpose() * tangent * map;
      give[static_cast<std::size_t>(vehicle_.vehicle_of(i))](own_[i], own_[i]) += of_wheel;
    }
    Vector change(a.size());
    for (std::size_t p = 0; p < parts_.size(); ++p) {
      const std::optional<Vector> own =
          change_of(parts_[p], f.parts[p], right, a, give[p], element_steps[p], from.element_memory, response);
      if (!own) {
        step.why_not = "forces of dry friction, dampers and air springs did not settle within a step";
        return step;
      }
      part_of(change, parts_[p].range) = *own;
    }
    a += change;

    double most = 0.0;
    for (std::size_t i = 0; i < wheels; ++i) {
      const Part& part = parts_[static_cast<std::size_t>(vehicle_.vehicle_of(i))];
      const Vector touched = part_of(change, part.range)(part.touched);
      const PairVector moved = maps_[i] * touched;
      const PairVector correction = -(of_q * tangents[i].stiffness + of_v * tangents[i].damping) * moved;
      forces[i] += correction;
      const double scale = std::max(force_scale_, step.reactions[i].normal_force);
      most = std::max(most, std::max(largest_force(correction), step.reactions[i].corrected) / scale);
    }
    if (!a.allFinite()) {
      step.why_not = "the motion has no finite values";
      return step;
    }
    if (!couplers_.empty()) {
      const Vector before = response.force;
      couple(state_of(a), line, from, h, response);
      most = std::max(most, (response.force - before).cwiseAbs().maxCoeff() / force_scale_);
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
    end.unbalanced = load - s.times(s.stiffness, end.state.q) - s.times(s.damping, end.state.v) + stops;
    if (elements.size() > 0) {
      end.unbalanced += elements.on_coordinates(response.force, s.size());
      if (line) line->add_couplers_aside(response.force, 1.0, end.unbalanced);
      end.element_force = std::move(response.force);
      end.element_memory = std::move(response.memory);
    }
    for (std::size_t i = 0; i < wheels; ++i) vehicle_.add_force(i, end.contact_force[i], end.unbalanced);
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
