// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <filesystem>
#include <iostream>
#include <numbers>
#include <numeric>
#include <string>
#include <vector>

#include <Eigen/Dense>

#include "treadmark/analysis/damage/record.hpp"
#include "treadmark/app/evolve/run_evolution.hpp"
#include "treadmark/io/histories/evolution_store.hpp"
#include "treadmark/io/histories/simulation_store.hpp"
#include "treadmark/io/simulations/read_evolution.hpp"
#include "treadmark/model/contact/hertz_ellipse.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark::testing {
namespace {

constexpr double kOrder = 20.0, kAmplitude = 10e-6, kRadius = 0.46, kSpeed = 20.0, kSmoothing = 10e-3;
using Complex = std::complex<double>;

/// Mean, and amplitude of exp(i order theta), theta the angle of the wheel, of what is known at some angles.
struct Wave {
  double mean = 0.0;
  Complex amplitude;
};

Wave wave_of(const std::vector<Vec2>& at) {
  Eigen::MatrixXd waves(static_cast<Eigen::Index>(at.size()), 3);
  Eigen::VectorXd values(static_cast<Eigen::Index>(at.size()));
  for (std::size_t i = 0; i < at.size(); ++i) {
    const double phase = kOrder * at[i].x();
    waves.row(static_cast<Eigen::Index>(i)) << 1.0, std::cos(phase), std::sin(phase);
    values[static_cast<Eigen::Index>(i)] = at[i].y();
  }
  const Eigen::Vector3d fit = waves.colPivHouseholderQr().solve(values);
  return {fit[0], {fit[1], -fit[2]}};
}

/// Whole waves amid the places, which are from -72 to 0 degrees of theta.
bool amid(double theta) { return theta > -54.0 / 180.0 * std::numbers::pi && theta < -18.0 / 180.0 * std::numbers::pi; }

Wave of_forces(const io::SimulationResult& run) {
  const std::size_t force = io::column_index(run, "Q_N"), pitch = io::column_index(run, "pitch_rad");
  std::vector<Vec2> at;
  for (std::size_t k = 0; k < run.rows(); ++k) {
    const double theta = -run.values[k * run.columns.size() + pitch];
    if (amid(theta)) at.emplace_back(theta, run.values[k * run.columns.size() + force]);
  }
  return wave_of(at);
}

/// Of what is gone all across, over the radius [m2].
Wave of_section(const io::EvolvedBody& wheel) {
  std::vector<Vec2> at;
  for (int i = 0; i < wheel.cells.nu; ++i)
    if (const double theta = wheel.cells.u(i) - 2.0 * std::numbers::pi; amid(theta)) {
      double volume = 0.0;
      for (const auto& [j, row] : wheel.record.volume.rows()) volume += row[static_cast<std::size_t>(i)];
      at.emplace_back(theta, volume / (wheel.cells.du * kRadius));
    }
  return wave_of(at);
}

/// A mass on the linearised spring of its contact, with a damper and a soft spring above: forces follow the radius r by
/// k (s - m w^2 + i w c) / (k + s - m w^2 + i w c). Wear is proportional to the force, so that an update that wears d
/// on the mean takes d F' / F from the polygon: it grows below resonance.
TEST(GrowingPolygon, IsThatOfOneDegreeOfFreedom) {
  constexpr double kMass = 600.0, kDamping = 2.5e5, kSoft = 1e6;  // of a wheel: half of the example's vehicle
  const TemporaryFolder folder;
  const io::EvolutionFile file =
      io::read_evolution_file(std::filesystem::path(TREADMARK_SOURCE_DIR) / "examples/growing-polygon.toml",
                              std::vector<std::string>{"evolve.fields_every=1"});
  const io::EvolutionResult result = app::run_evolution(file, {folder.path() / "out", false, {}});
  ASSERT_EQ(result.status, "complete") << result.message;
  ASSERT_EQ(result.generations.size(), 4u);

  std::vector<Wave> forces, sections;
  for (const io::Generation& g : result.generations) {
    forces.push_back(of_forces(io::read_simulation(folder.path() / "out" / io::simulation_file(g.number, 0, 1))));
    if (g.number > 0)
      sections.push_back(
          of_section(io::read_generation(folder.path() / "out" / io::generation_file(g.number)).bodies.front()));
  }
  const HertzEllipse ellipse = hertz_by_force(0.5 / kRadius, 0.5 / 0.3, forces[0].mean, 82e9 / 0.72);
  const double stiffness = 1.5 * ellipse.force / ellipse.approach, slip = 0.03;
  const double frequency = kOrder * kSpeed * (1.0 - slip) / kRadius;
  const Complex inertia(kSoft - kMass * frequency * frequency, frequency * kDamping);
  // the contact is some length of the wave long: it meets a mean of it (weights of a punch), and wears one (of Hertz)
  const double reach = frequency / (kSpeed * (1.0 - slip)) * ellipse.semi_axis_x;
  const Complex response = stiffness * inertia / (stiffness + inertia) * (1.0 - reach * reach / 6.0);
  const Complex expected_force = response * kAmplitude;
  std::cout << "force by radius [N/um]: " << 1e-6 * forces[0].amplitude / kAmplitude << ", expected " << 1e-6 * response
            << '\n';
  EXPECT_LT(std::abs(forces[0].amplitude - expected_force), 0.05 * std::abs(expected_force));

  // what is worn away follows the force, and the contact dwells on crests, whose curvature moves it less along the
  // wheel
  const Complex share =
      expected_force / forces[0].mean * (1.0 - reach * reach / 10.0) + kAmplitude * kOrder * kOrder / kRadius;
  const Complex smoothed = share * std::exp(-0.5 * std::pow(kOrder * kSmoothing / kRadius, 2));
  std::cout << "share of the wave in what is worn: " << sections[0].amplitude / sections[0].mean << ", expected "
            << share << '\n';
  EXPECT_LT(std::abs(sections[0].amplitude / sections[0].mean - smoothed), 0.05 * std::abs(smoothed));

  Complex polygon = kAmplitude;
  for (std::size_t k = 0; k < sections.size(); ++k) {
    // what is worn is smoothed across, from Hertz's parabola to nearly a bell, and met by the width of the contact
    const double b = ellipse.semi_axis_y, deviation = std::hypot(kSmoothing, b / std::sqrt(5.0));
    const double mean = (sections[k].mean - (k > 0 ? sections[k - 1].mean : 0.0)) /
                        (std::sqrt(2.0 * std::numbers::pi) * deviation) * (1.0 - b * b / (6.0 * deviation * deviation));
    polygon *= 1.0 - mean * smoothed / kAmplitude;
    const Complex found = forces[k + 1].amplitude / forces[0].amplitude;
    std::cout << "generation " << k + 1 << ": mean depth " << 1e6 * mean << " um, force by " << found << ", expected "
              << polygon / kAmplitude << '\n';
    EXPECT_LT(std::abs(found - polygon / kAmplitude), 0.1 * std::abs(polygon / kAmplitude - 1.0));
    EXPECT_NEAR(std::abs(found), std::abs(polygon) / kAmplitude, 0.01);
    EXPECT_GT(std::abs(forces[k + 1].amplitude), std::abs(forces[k].amplitude));
  }
}

}  // namespace
}  // namespace treadmark::testing
