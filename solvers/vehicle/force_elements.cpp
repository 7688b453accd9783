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

}  // namespace

CurveValue value_at(const ForceCurve& c, double at) {
  if (c.odd) return value_of_odd(c, at);
  const BrokenLine line(c.at, c.force);
  return {line.at(at), line.slope(line.piece(at)), integral_to(c, at) - integral_to(c, 0.0)};
}

Vector ForceElements::fresh_memory() const { return Vector::Zero(size() + static_cast<Index>(frictions.size())); }

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
  for (Index i = 0; i < force.size(); ++i)
    for (const auto& [c, factor] : columns[static_cast<std::size_t>(i)].direction) out[c] -= factor * force[i];
  return out;
}

double ForceElements::energy(const Vector& displacement, const Vector& memory) const {
  double sum = 0.0;
  for (const DryFriction& f : frictions) {
    const auto columns = Eigen::seqN(f.first, f.directions);
    sum += 0.5 * f.stiffness * (displacement(columns) - memory(columns)).squaredNorm();
  }
  return sum;
}

ElementResponse respond(const ForceElements& elements, const Vector& displacement, const Vector& rate,
                        const Vector& memory) {
  const Index n = elements.size();
  ElementResponse r{Vector::Zero(n), Matrix::Zero(n, n), Matrix::Zero(n, n), memory};
  for (std::size_t i = 0; i < elements.frictions.size(); ++i)
    add_friction(elements.frictions[i], static_cast<Index>(i), displacement, rate, r);
  for (const DamperCurve& d : elements.dampers) {
    const CurveValue value = value_at(d.whole, rate[d.column]);
    r.force[d.column] += value.force - d.linear * rate[d.column];
    r.damping(d.column, d.column) += value.slope - d.linear;
  }
  return r;
}

std::optional<ElementResponse> settle(const ForceElements& elements, const ElementStep& step, const Vector& memory) {
  constexpr int kMost = 60, kPlain = 20;
  // Forces of friction have corners, between which whole steps may run in circles.
  constexpr double kPart = 0.6;
  const auto at = [&](const Vector& y) {
    return respond(elements, step.displacement + step.of_displacement * y, step.rate + step.of_rate * y, memory);
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
