// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/force_elements.hpp"

#include <algorithm>
#include <cmath>

#include "treadmark/core/line.hpp"

namespace treadmark::vehicle {
namespace {

using Index = Eigen::Index;

CurveValue value_of_odd(const ForceCurve& c, double at) {
  const double u = std::abs(at), sign = at < 0.0 ? -1.0 : 1.0;
  CurveValue value;
  for (std::size_t i = 0; i + 1 < c.at.size(); ++i) {
    const double low = c.at[i], high = i + 2 < c.at.size() ? std::min(u, c.at[i + 1]) : u;
    // At rest the first piece counts where it begins there.
    if (u < low || (u == low && (i > 0 || low > 0.0))) break;
    const double slope = (c.force[i + 1] - c.force[i]) / (c.at[i + 1] - low);
    value.integral += (high - low) * (c.force[i] + 0.5 * slope * (high - low));
    value.force = sign * (c.force[i] + slope * (high - low));
    value.slope = slope;
  }
  return value;
}

/// From the first point.
double integral_to(const ForceCurve& c, double at) {
  const BrokenLine line(c.at, c.force);
  const std::size_t piece = line.piece(at);
  double sum = line.integral(piece, at);
  for (std::size_t k = 0; k < piece; ++k) sum += line.integral(k, c.at[k + 1]);
  return sum;
}

/// Normal force of a friction and its derivative by the displacement of its load's column.
CurveValue normal_force(const DryFriction& f, const Vector& displacement) {
  CurveValue normal{f.normal_force, 0.0, 0.0};
  if (f.load >= 0 && f.stop) {
    const CurveValue stop = value_at(*f.stop, displacement[f.load]);
    normal.force += f.by_load * std::abs(stop.force);
    normal.slope = f.by_load * (stop.force < 0.0 ? -stop.slope : stop.slope);
  } else if (f.load >= 0) {
    normal.force += f.by_load * displacement[f.load];
    normal.slope = f.by_load;
  }
  if (normal.force > 0.0) return normal;
  return {};  // parted
}

/// Sticks like a spring from where it has slid to; beyond its bound it slides, so that its force is the bound.
void add_friction(const DryFriction& f, Index number, const Vector& displacement, const Vector& rate,
                  ElementResponse& r) {
  double& slides = r.memory[r.force.size() + number];
  const auto columns = Eigen::seqN(f.first, f.directions);
  const Vector trial = f.stiffness * (displacement(columns) - r.memory(columns)) + f.damping * rate(columns);
  const CurveValue normal = normal_force(f, displacement);
  const double size = trial.norm(), coefficient = f.coefficient[f.directions == 1 && trial[0] < 0.0 ? 1 : 0],
               bound = coefficient * normal.force;
  if (!(bound > 0.0)) {
    r.memory(columns) = displacement(columns);
    slides = 1.0;
    return;
  }
  if (size <= (slides != 0.0 ? bound : f.static_ratio * bound)) {
    r.force(columns) = trial;
    for (Index c = f.first; c < f.first + f.directions; ++c) {
      r.stiffness(c, c) += f.stiffness;
      r.damping(c, c) += f.damping;
    }
    slides = 0.0;
    return;
  }
  const Vector along = trial / size;
  r.force(columns) = bound * along;
  if (f.directions > 1) {
    const Matrix across = bound / size * (Matrix::Identity(f.directions, f.directions) - along * along.transpose());
    r.stiffness(columns, columns) += f.stiffness * across;
    r.damping(columns, columns) += f.damping * across;
  }
  if (f.load >= 0) r.stiffness(columns, f.load) += coefficient * normal.slope * along;
  // Where the damper bears a part it would slide back against its force, and give energy back.
  const Vector slid = displacement(columns) - r.force(columns) / f.stiffness;
  if ((slid - r.memory(columns)).dot(along) > 0.0) r.memory(columns) = slid;
  slides = 1.0;
}

double pressure_at(const AirSpring& a, double at_rest, double volume) {
  return a.pressure * std::pow(at_rest / volume, a.exponent);
}

/// Volume that has gone to the reservoir when the flow of a step agrees with the pressures at its end (backward Euler).
/// Between what empties either side the excess of pressure falls; Newton's method, held there.
double shifted(const AirSpring& a, double compression, double before, double duration) {
  constexpr int kMost = 100;
  double low = a.area * compression - a.bellows, high = a.reservoir;
  if (!(low < high)) return kNaN;
  double q = before > low && before < high ? before : 0.5 * (low + high);
  for (int i = 0; i < kMost; ++i) {
    const double left = a.bellows - a.area * compression + q, right = a.reservoir - q, flow = (q - before) / duration;
    const double p_left = pressure_at(a, a.bellows, left), p_right = pressure_at(a, a.reservoir, right);
    const double excess = p_left - p_right - a.resistance * flow * std::abs(flow);
    (excess > 0.0 ? low : high) = q;
    const double slope =
        a.exponent * (p_left / left + p_right / right) + 2.0 * a.resistance * std::abs(flow) / duration;
    constexpr double kRounding = 1e-15;
    double next = q + excess / slope;
    if (std::abs(next - q) <= kRounding * (a.bellows + a.reservoir)) return q;
    if (!(next > low && next < high)) next = 0.5 * (low + high);
    q = next;
  }
  return q;
}

void add_air(const AirSpring& a, Index memory, double compression, double duration, ElementResponse& r) {
  const double before = r.memory[memory], q = a.reservoir > 0.0 ? shifted(a, compression, before, duration) : 0.0;
  const double left = a.bellows - a.area * compression + q;
  if (!(left > 0.0)) {
    r.force[a.column] = kNaN;
    return;
  }
  const double pressure = pressure_at(a, a.bellows, left), by_volume = a.exponent * pressure / left;
  double kept = 1.0;  // share of a change of volume that the bellows has to take
  if (a.reservoir > 0.0) {
    const double right = a.reservoir - q;
    const double other = a.exponent * pressure_at(a, a.reservoir, right) / right +
                         2.0 * a.resistance * std::abs((q - before) / duration) / duration;
    kept = other / (by_volume + other);
  }
  r.force[a.column] += a.area * (pressure - a.pressure) - a.linear * compression;
  r.stiffness(a.column, a.column) += a.area * a.area * by_volume * kept - a.linear;
  r.memory[memory] = q;
  r.memory[memory + 1] = pressure;
}

/// The damper's force is at most the spring's: it neither pulls where that pushes, nor jumps where the free play ends.
void add_coupler(const Coupler& c, double stretch, double rate, ElementResponse& r) {
  const CurveValue spring = value_at(c.spring, stretch);
  const double most = std::abs(spring.force), damper = c.damping * rate;
  const bool bounded = std::abs(damper) > most;
  r.force[c.column] += spring.force + std::clamp(damper, -most, most);
  if (!bounded) {
    r.stiffness(c.column, c.column) += spring.slope;
    r.damping(c.column, c.column) += most > 0.0 ? c.damping : 0.0;
  } else if ((damper > 0.0) == (spring.force > 0.0)) {
    r.stiffness(c.column, c.column) += 2.0 * spring.slope;
  }
}

/// Work to bring gas from its volume at rest to another one [J].
double energy_of_gas(const AirSpring& a, double at_rest, double volume) {
  const double ratio = at_rest / volume, n = a.exponent;
  return a.pressure * at_rest * (n == 1.0 ? std::log(ratio) : (std::pow(ratio, n - 1.0) - 1.0) / (n - 1.0));
}

}  // namespace

CurveValue value_at(const ForceCurve& c, double at) {
  if (c.odd) return value_of_odd(c, at);
  const BrokenLine line(c.at, c.force);
  return {line.at(at), line.slope(line.piece(at)), integral_to(c, at) - integral_to(c, 0.0)};
}

Index ForceElements::memory_of_air(std::size_t spring) const {
  return size() + static_cast<Index>(frictions.size() + 2 * spring);
}

Vector ForceElements::fresh_memory() const {
  Vector memory = Vector::Zero(memory_of_air(air_springs.size()));
  for (std::size_t i = 0; i < air_springs.size(); ++i) memory[memory_of_air(i) + 1] = air_springs[i].pressure;
  return memory;
}

Vector ForceElements::of(const Vector& coordinates) const {
  Vector out = Vector::Zero(size());
  for (Index i = 0; i < out.size(); ++i)
    for (const auto& [c, factor] : columns[static_cast<std::size_t>(i)].direction) out[i] += factor * coordinates[c];
  return out;
}

Matrix ForceElements::directions(Index coordinates) const {
  Matrix rows = Matrix::Zero(size(), coordinates);
  for (Index i = 0; i < rows.rows(); ++i)
    for (const auto& [c, factor] : columns[static_cast<std::size_t>(i)].direction) rows(i, c) += factor;
  return rows;
}

Vector ForceElements::on_coordinates(const Vector& force, Index coordinates) const {
  Vector out = Vector::Zero(coordinates);
  add_to(out, force, 1.0);
  return out;
}

void ForceElements::add_to(Vector& on_coordinates, const Vector& force, double times) const {
  for (Index i = 0; i < force.size(); ++i)
    for (const auto& [c, factor] : columns[static_cast<std::size_t>(i)].direction)
      on_coordinates[c] -= factor * (times * force[i]);
}

ElementShare share_of(const ForceElements& all, std::vector<int> columns, int first_coordinate) {
  ElementShare share;
  share.columns = share.memory = std::move(columns);
  const auto place = [&](int column) {
    const auto at = std::lower_bound(share.columns.begin(), share.columns.end(), column);
    return at != share.columns.end() && *at == column ? static_cast<int>(at - share.columns.begin()) : -1;
  };
  for (const int c : share.columns) {
    share.elements.columns.push_back(all.columns[static_cast<std::size_t>(c)]);
    for (auto& [coordinate, factor] : share.elements.columns.back().direction) coordinate -= first_coordinate;
  }
  for (std::size_t i = 0; i < all.frictions.size(); ++i) {
    DryFriction f = all.frictions[i];
    if ((f.first = place(f.first)) < 0) continue;
    if (f.load >= 0) f.load = place(f.load);
    share.memory.push_back(all.size() + static_cast<int>(i));
    share.elements.frictions.push_back(std::move(f));
  }
  for (DamperCurve d : all.dampers)
    if ((d.column = place(d.column)) >= 0) share.elements.dampers.push_back(std::move(d));
  for (Coupler c : all.couplers)
    if ((c.column = place(c.column)) >= 0) share.elements.couplers.push_back(std::move(c));
  for (std::size_t i = 0; i < all.air_springs.size(); ++i) {
    AirSpring a = all.air_springs[i];
    if ((a.column = place(a.column)) < 0) continue;
    for (const int more : {0, 1}) share.memory.push_back(static_cast<int>(all.memory_of_air(i)) + more);
    share.elements.air_springs.push_back(std::move(a));
  }
  return share;
}

double ForceElements::energy(const Vector& displacement, const Vector& memory) const {
  double sum = 0.0;
  for (const DryFriction& f : frictions) {
    const auto columns = Eigen::seqN(f.first, f.directions);
    sum += 0.5 * f.stiffness * (displacement(columns) - memory(columns)).squaredNorm();
  }
  for (const Coupler& c : couplers) sum += value_at(c.spring, displacement[c.column]).integral;
  for (std::size_t i = 0; i < air_springs.size(); ++i) {
    const AirSpring& a = air_springs[i];
    const double compression = displacement[a.column], q = memory[memory_of_air(i)];
    sum += energy_of_gas(a, a.bellows, a.bellows - a.area * compression + q) - a.pressure * a.area * compression -
           0.5 * a.linear * compression * compression;
    if (a.reservoir > 0.0) sum += energy_of_gas(a, a.reservoir, a.reservoir - q);
  }
  return sum;
}

ElementResponse respond(const ForceElements& elements, const Vector& displacement, const Vector& rate,
                        const Vector& memory, double duration) {
  const Index n = elements.size();
  ElementResponse r{Vector::Zero(n), Matrix::Zero(n, n), Matrix::Zero(n, n), memory};
  for (std::size_t i = 0; i < elements.frictions.size(); ++i)
    add_friction(elements.frictions[i], static_cast<Index>(i), displacement, rate, r);
  for (const DamperCurve& d : elements.dampers) {
    const CurveValue value = value_at(d.whole, rate[d.column]);
    r.force[d.column] += value.force - d.linear * rate[d.column];
    r.damping(d.column, d.column) += value.slope - d.linear;
  }
  for (std::size_t i = 0; i < elements.air_springs.size(); ++i) {
    const AirSpring& a = elements.air_springs[i];
    add_air(a, elements.memory_of_air(i), displacement[a.column], duration, r);
  }
  for (const Coupler& c : elements.couplers) add_coupler(c, displacement[c.column], rate[c.column], r);
  return r;
}

std::optional<ElementResponse> settle(const ForceElements& elements, const ElementStep& step, const Vector& memory) {
  constexpr int kMost = 60, kPlain = 20;
  // Forces of friction have corners, between which whole steps may run in circles.
  constexpr double kPart = 0.6;
  const auto at = [&](const Vector& y) {
    return respond(elements, step.displacement + step.of_displacement * y, step.rate + step.of_rate * y, memory,
                   step.duration);
  };
  Vector y = step.guess;
  ElementResponse now = at(y);
  for (int i = 0; i < kMost; ++i) {
    const Matrix tangent = step.of_displacement * now.stiffness + step.of_rate * now.damping;
    Matrix slopes = step.flexibility * tangent;
    slopes.diagonal().array() += 1.0;
    const Vector change = slopes.partialPivLu().solve(Vector(step.free - y - step.flexibility * now.force));
    if (!change.allFinite()) return std::nullopt;
    ElementResponse next = at(y + change);
    if ((next.force - now.force - tangent * change).cwiseAbs().maxCoeff() <= step.tolerance) return next;
    const double part = i < kPlain ? 1.0 : kPart;
    y += part * change;
    now = part == 1.0 ? std::move(next) : at(y);
  }
  return std::nullopt;
}

}  // namespace treadmark::vehicle
