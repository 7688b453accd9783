// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/stability/eigenmodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"

namespace treadmark::vehicle {
namespace {

using Index = Eigen::Index;

/// State: displacements and velocities of what has mass, displacements of what has none.
struct FirstOrder {
  std::vector<Index> heavy, light;
  std::vector<Index> placed;  ///< of the heavy ones: those whose displacement forces depend on
  Matrix a;
};

/// Of a part that moves by itself.
FirstOrder first_order(const Multibody& s, const LinearSystem& linear, const Multibody::Range& part) {
  const auto& [k, c] = linear;
  FirstOrder out;
  for (Index i = part.first; i < part.first + part.size; ++i) {
    (s.mass[i] > 0.0 ? out.heavy : out.light).push_back(i);
    if (s.mass[i] > 0.0 && !k.col(i).isZero(0.0)) out.placed.push_back(i);
  }
  const auto n = static_cast<Index>(out.heavy.size()), m = static_cast<Index>(out.light.size()),
             p = static_cast<Index>(out.placed.size());
  const Vector by_mass = s.mass(out.heavy).cwiseInverse();
  out.a = Matrix::Zero(p + n + m, p + n + m);
  for (Index row = 0, i = 0; i < n; ++i)
    if (row < p && out.placed[static_cast<std::size_t>(row)] == out.heavy[static_cast<std::size_t>(i)])
      out.a(row++, p + i) = 1.0;
  out.a.block(p, 0, n, p) = -(by_mass.asDiagonal() * k(out.heavy, out.placed));
  out.a.block(p, p, n, n) = -(by_mass.asDiagonal() * c(out.heavy, out.heavy));
  if (m == 0) return out;
  const Vector by_damper = Vector(c.diagonal())(out.light).cwiseInverse();
  out.a.block(p, p + n, n, m) = -(by_mass.asDiagonal() * k(out.heavy, out.light));
  out.a.block(p + n, 0, m, p) = -(by_damper.asDiagonal() * k(out.light, out.placed));
  out.a.block(p + n, p + n, m, m) = -(by_damper.asDiagonal() * k(out.light, out.light));
  return out;
}

constexpr double kSlowest = 1e-3;  // vibrations [rad/s]

}  // namespace

namespace {

void add_modes(const Multibody& whole, const FirstOrder& system, std::vector<Eigenmode>& modes) {
  const Eigen::EigenSolver<Matrix> solver(system.a);
  if (solver.info() != Eigen::Success)
    throw Error(ErrorKind::numerical, "the eigenvalues of the vehicle did not converge");
  const auto n = static_cast<Index>(system.heavy.size()), p = static_cast<Index>(system.placed.size());
  for (Index j = 0; j < solver.eigenvalues().size(); ++j) {
    Eigenmode mode;
    mode.value = solver.eigenvalues()[j];
    if (mode.value.imag() < 0.0) continue;
    if (mode.value.imag() >= kSlowest) mode.frequency = mode.value.imag() / (2.0 * std::numbers::pi);
    const double magnitude = std::abs(mode.value);
    mode.damping_ratio = magnitude > 0.0 ? -mode.value.real() / magnitude : 0.0;
    const Eigen::VectorXcd full = solver.eigenvectors().col(j);
    mode.shape = Eigen::VectorXcd::Zero(whole.mass.size());
    // What no force depends on has velocities alone.
    if (magnitude > 0.0)
      for (Index i = 0; i < n; ++i) mode.shape[system.heavy[static_cast<std::size_t>(i)]] = full[p + i] / mode.value;
    for (Index i = 0; i < p; ++i) mode.shape[system.placed[static_cast<std::size_t>(i)]] = full[i];
    for (std::size_t i = 0; i < system.light.size(); ++i)
      mode.shape[system.light[i]] = full[p + n + static_cast<Index>(i)];
    Index at = 0;
    if (!(mode.shape.cwiseAbs().maxCoeff(&at) > 0.0)) continue;
    mode.shape /= mode.shape[at];
    const Vector energy = whole.mass.cwiseProduct(mode.shape.cwiseAbs2());
    if (energy.sum() > 0.0)
      for (Index i = 0; i < energy.size(); ++i) mode.shares.emplace_back(static_cast<int>(i), energy[i] / energy.sum());
    ranges::stable_sort(mode.shares, [](const auto& a, const auto& b) { return a.second > b.second; });
    modes.push_back(std::move(mode));
  }
}

}  // namespace

std::vector<Eigenmode> all_eigenmodes(const VehicleOnTrack& vehicle, const SystemState& state) {
  const LinearSystem linear = linearised_system(vehicle, state);
  std::vector<Eigenmode> modes;
  for (const Multibody::Range& part : independent_parts(vehicle.system, linear.stiffness, linear.damping))
    add_modes(vehicle.system, first_order(vehicle.system, linear, part), modes);
  ranges::stable_sort(modes, {}, &Eigenmode::frequency);
  return modes;
}

std::vector<Eigenmode> eigenmodes(const VehicleOnTrack& vehicle, const SystemState& state) {
  std::vector<Eigenmode> modes = all_eigenmodes(vehicle, state);
  std::erase_if(modes, [](const Eigenmode& mode) { return mode.frequency == 0.0; });
  return modes;
}

std::string describe(const Eigenmode& mode, const Multibody& system, std::size_t most) {
  constexpr double kWorthNaming = 0.03;
  std::string text;
  for (std::size_t i = 0; i < std::min(most, mode.shares.size()); ++i) {
    const auto& [coordinate, share] = mode.shares[i];
    if (share < kWorthNaming) break;
    if (!text.empty()) text += ", ";
    text += fmt::format("{} {:.0f} %", system.coordinates[static_cast<std::size_t>(coordinate)].name, 100.0 * share);
  }
  return text;
}

}  // namespace treadmark::vehicle
