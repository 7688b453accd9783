// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/eigenmodes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>
#include <Eigen/Eigenvalues>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/vehicle/equilibrium.hpp"

namespace treadmark::vehicle {
namespace {

using Index = Eigen::Index;

/// State: displacements and velocities of what has mass, displacements of what has none.
struct FirstOrder {
  std::vector<Index> heavy, light;
  Matrix a;
};

FirstOrder first_order(const VehicleOnTrack& vehicle, const SystemState& state) {
  const Multibody& s = vehicle.system;
  const auto [k, c] = linearised_system(vehicle, state);
  FirstOrder out;
  for (Index i = 0; i < s.mass.size(); ++i) (s.mass[i] > 0.0 ? out.heavy : out.light).push_back(i);
  const auto n = static_cast<Index>(out.heavy.size()), m = static_cast<Index>(out.light.size());
  const Vector by_mass = s.mass(out.heavy).cwiseInverse();
  out.a = Matrix::Zero(2 * n + m, 2 * n + m);
  out.a.block(0, n, n, n).setIdentity();
  out.a.block(n, 0, n, n) = -(by_mass.asDiagonal() * k(out.heavy, out.heavy));
  out.a.block(n, n, n, n) = -(by_mass.asDiagonal() * c(out.heavy, out.heavy));
  if (m == 0) return out;
  const Vector by_damper = Vector(c.diagonal())(out.light).cwiseInverse();
  out.a.block(n, 2 * n, n, m) = -(by_mass.asDiagonal() * k(out.heavy, out.light));
  out.a.block(2 * n, 0, m, n) = -(by_damper.asDiagonal() * k(out.light, out.heavy));
  out.a.block(2 * n, 2 * n, m, m) = -(by_damper.asDiagonal() * k(out.light, out.light));
  return out;
}

}  // namespace

std::vector<Eigenmode> eigenmodes(const VehicleOnTrack& vehicle, const SystemState& state) {
  const FirstOrder system = first_order(vehicle, state);
  const Eigen::EigenSolver<Matrix> solver(system.a);
  if (solver.info() != Eigen::Success)
    throw Error(ErrorKind::numerical, "the eigenvalues of the vehicle did not converge");
  const auto n = static_cast<Index>(system.heavy.size());
  std::vector<Eigenmode> modes;
  for (Index j = 0; j < solver.eigenvalues().size(); ++j) {
    const std::complex<double> value = solver.eigenvalues()[j];
    constexpr double kSlowest = 1e-3;  // [rad/s]
    if (value.imag() < kSlowest) continue;
    Eigenmode mode;
    mode.frequency = value.imag() / (2.0 * std::numbers::pi);
    mode.damping_ratio = -value.real() / std::abs(value);
    const Eigen::VectorXcd full = solver.eigenvectors().col(j);
    mode.shape = Eigen::VectorXcd::Zero(vehicle.system.mass.size());
    for (Index i = 0; i < n; ++i) mode.shape[system.heavy[static_cast<std::size_t>(i)]] = full[i];
    for (std::size_t i = 0; i < system.light.size(); ++i)
      mode.shape[system.light[i]] = full[2 * n + static_cast<Index>(i)];
    const double largest = mode.shape.cwiseAbs().maxCoeff();
    if (!(largest > 0.0)) continue;
    Index at = 0;
    mode.shape.cwiseAbs().maxCoeff(&at);
    mode.shape /= mode.shape[at];
    const Vector energy = vehicle.system.mass.cwiseProduct(mode.shape.cwiseAbs2());
    for (Index i = 0; i < energy.size(); ++i) mode.shares.emplace_back(static_cast<int>(i), energy[i] / energy.sum());
    std::ranges::stable_sort(mode.shares, [](const auto& a, const auto& b) { return a.second > b.second; });
    modes.push_back(std::move(mode));
  }
  std::ranges::stable_sort(modes, {}, &Eigenmode::frequency);
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
