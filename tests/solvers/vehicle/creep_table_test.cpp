// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/creep_table.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "treadmark/backends/analytic/make.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/vehicle/contacts/full_contact.hpp"
#include "treadmark/solvers/vehicle/contacts/table_contact.hpp"

namespace treadmark::vehicle {
namespace {

using Creepages = std::array<double, 3>;

constexpr double kPoisson = 0.28;

/// A coarse one, for what must hold in any table.
const CreepTable& coarse_table() {
  static const auto table = build_creep_table(kPoisson, {5, 4, 4.0, 10, 8});
  return *table;
}

/// Every size and direction of creepage, some nearly without spin; r: of the linear force over mu F_n, about.
struct AnyCreep {
  double ratio = 1.0, r = 0.0;
  Creepages creepage{};
};
class AnyCreeps {
 public:
  explicit AnyCreeps(double greatest_ratio) : greatest_(greatest_ratio) {}
  AnyCreep next() {
    std::uniform_real_distribution<double> even(-1.0, 1.0);
    std::normal_distribution<double> normal;
    AnyCreep any;
    any.ratio = std::pow(greatest_, even(random_));
    any.r = 0.6 * std::pow(30.0, even(random_));
    Creepages d{normal(random_), normal(random_), normal(random_)};
    if (count_++ % 3 == 0) d[2] *= 0.1;
    const double size = std::hypot(d[0], d[1], d[2]) / any.r;
    const kalker::KalkerCoefficients c = coefficients(any.ratio);
    const double spin = 0.35 * c.c22 * (std::sqrt(any.ratio) + 1.0 / std::sqrt(any.ratio));
    any.creepage = {d[0] / (size * c.c11), d[1] / (size * c.c22), d[2] / (size * spin)};
    return any;
  }
  static kalker::KalkerCoefficients coefficients(double ratio) {
    return kalker::kalker_coefficients(std::sqrt(ratio), 1.0 / std::sqrt(ratio), kPoisson);
  }

 private:
  double greatest_;
  int count_ = 0;
  std::mt19937 random_{11};
};

double apart(const Creepages& a, const Creepages& b) { return std::hypot(a[0] - b[0], a[1] - b[1]); }

/// The solver of contacts, asked apart from the table: another size, load, coefficient of friction and grid.
Creepages solved(double ratio, const Creepages& creepage, int elements) {
  constexpr double kForce = 6e4, kMu = 0.4, kSize = 4.2e-3;
  kalker::ContactProblem p;
  p.material.poisson_1 = p.material.poisson_2 = kPoisson;
  const CombinedMaterial material = combine(p.material);
  const kalker::HertzShape shape =
      kalker::hertz_from_semi_axes(kSize * std::sqrt(ratio), kSize / std::sqrt(ratio), {true, kForce}, material);
  p.grid = kalker::hertz_grid(shape, elements, elements, 1.1);
  const std::vector<double> gap = kalker::hertz_gap(shape, p.grid);
  p.gap = gap;
  p.hertz = shape;
  p.friction.kinetic = kMu;
  p.normal_force = kForce;
  p.regime = kalker::Regime::steady;
  const double unit = kMu * kForce / (material.shear_modulus * kSize * kSize);
  p.creepage = {creepage[0] * unit, creepage[1] * unit, creepage[2] * unit / kSize};
  const kalker::ContactSolution s = kalker::ContactSolver().solve(p);
  EXPECT_EQ(s.status, Status::ok);
  const double bound = kMu * s.force_n;
  return {s.force_x / bound, s.force_y / bound, s.moment_n / (bound * kSize)};
}

// The table as simulations have it, against what docs/vehicle-simulation.md says of its error.
TEST(CreepTable, ErrorsAreAsStated) {
  const auto table = build_creep_table(kPoisson);
  const CreepTableOptions options;

  // Between the nodes: against solutions on the elements of the nodes.
  constexpr double kWorstBetween = 0.02, kMeanSquareBetween = 0.0025;
  AnyCreeps creeps(options.greatest_ratio);
  double squares = 0.0;
  constexpr int kCount = 600;
  for (int i = 0; i < kCount; ++i) {
    const AnyCreep c = creeps.next();
    const double error = apart(table->at(c.ratio, c.creepage).force,
                               solved_creep(kPoisson, c.ratio, c.creepage, options.nx, options.ny));
    EXPECT_LE(error, kWorstBetween) << c.ratio << ' ' << c.r;
    squares += error * error;
  }
  EXPECT_LE(std::sqrt(squares / kCount), kMeanSquareBetween);

  // In all: against the contact problem with its normal solution on fine grids, 60 elements each way, whose own error
  // is of the order of half a per cent.
  constexpr double kWorst = 0.025, kMeanSquare = 0.01;
  squares = 0.0;
  constexpr int kFine = 30;
  for (int i = 0; i < kFine; ++i) {
    const AnyCreep c = creeps.next();
    const double error = apart(table->at(c.ratio, c.creepage).force, solved(c.ratio, c.creepage, 60));
    EXPECT_LE(error, kWorst) << c.ratio << ' ' << c.r;
    squares += error * error;
  }
  EXPECT_LE(std::sqrt(squares / kFine), kMeanSquare);

  // Kalker's coefficients (1990, app. E), where they are tabulated: his own digits and straight lines between.
  for (const double ratio : {0.2, 0.5, 1.0, 2.0, 5.0}) {
    const kalker::KalkerCoefficients c = AnyCreeps::coefficients(ratio);
    const NormalisedCreep f = table->at(ratio, {0.0, 0.0, 0.0});
    EXPECT_NEAR(-f.slope[0][0] / c.c11, 1.0, 0.02) << ratio;
    EXPECT_NEAR(-f.slope[1][1] / c.c22, 1.0, 0.02) << ratio;
    EXPECT_NEAR(-f.slope[1][2] / c.c23, 1.0, 0.03) << ratio;
    // Spin and lateral creepage act on each other alike (Kalker 1967: C32 = -C23).
    const double small = 1e-5, moment = table->at(ratio, {0.0, small, 0.0}).force[2] / small;
    EXPECT_NEAR(moment / c.c23, 1.0, 0.03) << ratio;
  }
}

TEST(CreepTable, SlidesWhereCreepageIsLarge) {
  for (const double angle : {0.0, 0.4, 1.3, 2.5, 4.0}) {
    const double xi = std::cos(angle), eta = std::sin(angle);
    const NormalisedCreep f = coarse_table().at(1.3, {300.0 * xi, 300.0 * eta, 0.0});
    EXPECT_NEAR(f.force[0], -xi, 5e-3);
    EXPECT_NEAR(f.force[1], -eta, 5e-3);
    EXPECT_LE(std::hypot(f.force[0], f.force[1]), 1.0 + 1e-15);
  }
  // Spin alone turns everything about the middle: of mu F_n there is only the moment, on a circle 3 pi/16 mu F_n a.
  const NormalisedCreep spin = coarse_table().at(1.0, {0.0, 0.0, 1e4});
  EXPECT_NEAR(std::hypot(spin.force[0], spin.force[1]), 0.0, 5e-3);
  EXPECT_NEAR(spin.force[2], -3.0 * std::numbers::pi / 16.0, 5e-3);
}

TEST(CreepTable, MirrorImagesHaveMirroredForces) {
  AnyCreeps creeps(4.0);
  for (int i = 0; i < 500; ++i) {
    const AnyCreep c = creeps.next();
    const auto [xi, eta, phi] = c.creepage;
    const auto at = [&](double x, double y, double spin) { return coarse_table().at(c.ratio, {x, y, spin}).force; };
    const Creepages f = at(xi, eta, phi);
    EXPECT_EQ(at(xi, -eta, -phi), (Creepages{f[0], -f[1], -f[2]}));
    EXPECT_EQ(at(-xi, eta, phi), (Creepages{-f[0], f[1], f[2]}));
    EXPECT_EQ(at(-xi, -eta, -phi), (Creepages{-f[0], -f[1], -f[2]}));
  }
}

// The exact theory's own mirror symmetry, which the table takes for granted.
TEST(CreepTable, SolutionsHaveTheSymmetriesOfTheTable) {
  AnyCreeps creeps(4.0);
  for (int i = 0; i < 10; ++i) {
    const AnyCreep c = creeps.next();
    const auto [xi, eta, phi] = c.creepage;
    const Creepages f = solved(c.ratio, {xi, eta, phi}, 20);
    const Creepages across = solved(c.ratio, {xi, -eta, -phi}, 20), along = solved(c.ratio, {-xi, eta, phi}, 20);
    constexpr double kSolver = 1e-4;
    for (std::size_t k = 0; k < 3; ++k) {
      EXPECT_NEAR(across[k], k == 0 ? f[k] : -f[k], kSolver);
      EXPECT_NEAR(along[k], k == 0 ? -f[k] : f[k], kSolver);
    }
  }
}

TEST(CreepTable, GrowsWithCreepageAlone) {
  for (const double ratio : {0.3, 1.0, 3.5})
    for (const std::size_t along : {std::size_t{0}, std::size_t{1}}) {
      double before = 0.0;
      for (double size = 1e-3; size < 50.0; size *= 1.05) {
        Creepages creepage{};
        creepage[along] = size;
        const double force = -coarse_table().at(ratio, creepage).force[along];
        EXPECT_GE(force, before - 2e-3) << ratio << ' ' << size;  // error of so coarse a table
        before = std::max(before, force);
      }
    }
}

TEST(CreepTable, SlopesAreThoseOfTheForcesWithoutAJump) {
  AnyCreeps creeps(4.0);
  for (int i = 0; i < 2000; ++i) {
    const AnyCreep c = creeps.next();
    const NormalisedCreep f = coarse_table().at(c.ratio, c.creepage);
    if (std::hypot(f.force[0], f.force[1]) > 1.0 - 1e-6) continue;  // where the bound holds it
    for (std::size_t by = 0; by < 3; ++by) {
      const double h = 1e-6 * (1.0 + c.r) / AnyCreeps::coefficients(c.ratio).c11;
      Creepages more = c.creepage, less = c.creepage;
      more[by] += h, less[by] -= h;
      const NormalisedCreep above = coarse_table().at(c.ratio, more), below = coarse_table().at(c.ratio, less);
      for (std::size_t k = 0; k < 2; ++k) {
        const double scale = 0.2 + std::abs(f.slope[k][by]);
        EXPECT_NEAR((above.force[k] - below.force[k]) / (2.0 * h), f.slope[k][by], 1e-4 * scale);
        EXPECT_NEAR(above.slope[k][by], below.slope[k][by], 1e-3 * scale * (1.0 + c.r));
      }
    }
  }
}

TEST(CreepTable, PowerIsThatOfTheForcesAndNeverNegative) {
  const CombinedMaterial steel = combine({});
  AnyCreeps creeps(4.0);
  for (int i = 0; i < 20000; ++i) {
    const AnyCreep c = creeps.next();
    const double size = 5e-3, bound = 2e4, unit = bound / (steel.shear_modulus * size * size);
    const wheelrail::ContactKinematics k{c.creepage[0] * unit, c.creepage[1] * unit, c.creepage[2] * unit / size, 20.0,
                                         i % 2 ? std::numbers::pi : 0.0};
    const CreepForce f =
        creep_force(coarse_table(), {size * std::sqrt(c.ratio), size / std::sqrt(c.ratio), bound}, steel, k);
    const double power = -k.velocity * (f.force.x() * k.xi + f.force.y() * k.eta + f.moment * k.phi);
    ASSERT_GE(f.power, 0.0);
    ASSERT_NEAR(f.power, power, 1e-12 * f.power) << c.ratio << ' ' << c.r;
    ASSERT_LE(f.force.norm(), bound * (1.0 + 1e-12));
    ASSERT_GE(f.damping.minCoeff(), 0.0);
  }
}

TEST(CreepTable, ForcesHaveTheUnitsOfTheContact) {
  const CombinedMaterial steel = combine({});
  const CreepContact contact{6e-3, 4e-3, 0.3 * 8e4};
  const wheelrail::ContactKinematics k{7e-4, -4e-4, 0.2, 20.0, 0.0};
  const CreepForce f = creep_force(coarse_table(), contact, steel, k);
  const double size = std::sqrt(24e-6), unit = contact.friction_bound / (steel.shear_modulus * 24e-6);
  const Creepages at{k.xi / unit, k.eta / unit, k.phi * size / unit};
  const Creepages direct = solved(1.5, at, 50);
  constexpr double kCoarse = 0.03;  // of the friction bound
  EXPECT_NEAR(f.force.x(), contact.friction_bound * direct[0], kCoarse * contact.friction_bound);
  EXPECT_NEAR(f.force.y(), contact.friction_bound * direct[1], kCoarse * contact.friction_bound);
  EXPECT_NEAR(f.moment, contact.friction_bound * size * direct[2], kCoarse * contact.friction_bound * size);

  // Damping is the slope by the velocities.
  const double h = 1e-8;
  const auto force = [&](double dx, double ds) {
    return creep_force(coarse_table(), contact, steel, {k.xi + dx, k.eta + ds, k.phi, k.velocity, k.chi}).force;
  };
  EXPECT_NEAR(f.damping.x(), -(force(h, 0.0) - force(-h, 0.0)).x() / (2.0 * h * k.velocity), 1e-4 * f.damping.x());
  EXPECT_NEAR(f.damping.y(), -(force(0.0, h) - force(0.0, -h)).y() / (2.0 * h * k.velocity), 1e-4 * f.damping.y());

  // Backward is forward turned about the normal.
  const CreepForce b = creep_force(coarse_table(), contact, steel, {-k.xi, -k.eta, k.phi, 20.0, std::numbers::pi});
  EXPECT_EQ(b.force, -f.force);
  EXPECT_EQ(b.moment, f.moment);

  // What stands still, or has no friction, transmits nothing.
  EXPECT_EQ(creep_force(coarse_table(), contact, steel, {0.01, 0.0, 0.1, 0.0, 0.0}).force.norm(), 0.0);
  EXPECT_EQ(creep_force(coarse_table(), {6e-3, 4e-3, 0.0}, steel, k).force.norm(), 0.0);
}

// On the tread, where patches are nearly ellipses, real profiles have the table's forces more nearly than those of
// Kalker's coefficients.
TEST(CreepTable, ATreadContactIsThatSolvedInFull) {
  constexpr double kRadius = 0.46, kSpeed = 20.0;
  const wheelrail::Geometry bodies{analytic::make_standard_surface({"60E1"}, Body::rail, 0.0),
                                   analytic::make_standard_surface({"S1002"}, Body::wheel, kRadius), true, true};
  wheelrail::Problem problem;
  problem.track.cant = 1.0 / 40.0;
  const auto table = build_contact_table(bodies, problem, 5.5e4, {.lateral_range = 7e-3, .step = 0.5e-3});
  TableContact linear(table, wheelrail::Side::right),
      exact(table, wheelrail::Side::right, build_creep_table(combine(problem.material).poisson, {8, 4, 4.0, 24, 16}));
  problem.discretisation.dx = problem.discretisation.ds = 0.3e-3;
  FullContact full(bodies, problem);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> even(-1.0, 1.0);
  double of_linear = 0.0, of_exact = 0.0;
  constexpr int kCount = 12;
  for (int i = 0; i < kCount; ++i) {
    PairMotion m;
    m.wheelset.y = -3e-3 + 2.5e-3 * even(random);
    const double compression = table->central().levels.front().compression.at(m.wheelset.y).value;
    m.wheelset.z = table->central().energy_height.at(m.wheelset.y).value + (1.2 + 0.6 * even(random)) * compression;
    m.wheelset.yaw = 2e-3 * even(random);
    m.wheelset_velocity.x = kSpeed;
    m.wheelset_velocity.pitch = -kSpeed / kRadius * (1.0 + 1.5e-3 * even(random));
    const auto relative = [&](ContactElement& element) -> Vec2 {
      const ContactReaction r = element.evaluate(m);
      EXPECT_EQ(r.status, Status::ok) << r.message;
      return Vec2(r.longitudinal_creep_force, r.lateral_creep_force) / (0.3 * r.normal_force);
    };
    const Vec2 solved_forces = relative(full);
    of_linear += (relative(linear) - solved_forces).squaredNorm();
    of_exact += (relative(exact) - solved_forces).squaredNorm();
  }
  constexpr double kPatchesAreNoEllipses = 0.02;  // of mu F_n
  EXPECT_LT(std::sqrt(of_exact / kCount), kPatchesAreNoEllipses);
  EXPECT_LT(of_exact, 0.5 * of_linear);
}

TEST(CreepTable, RatiosBeyondTheLastAreTheLast) {
  const Creepages creepage{0.05, -0.1, 0.08};
  for (const auto& [beyond, last] : {std::pair{9.0, 4.0}, std::pair{0.1, 0.25}})
    EXPECT_EQ(coarse_table().at(beyond, creepage).force, coarse_table().at(last, creepage).force);
}

TEST(CreepTable, ThreadsMakeTheSameTable) {
  const auto bytes = [](int threads) {
    const ThreadLimit limit(threads);
    ByteWriter out;
    build_creep_table(0.25, {3, 2, 2.0, 8, 6})->save(out);
    return out.bytes();
  };
  EXPECT_EQ(bytes(1), bytes(3));
}

TEST(CreepTable, ReadsBackAsItWas) {
  ByteWriter out;
  coarse_table().save(out);
  ByteReader in(out.bytes());
  const auto read = CreepTable::read(in);
  EXPECT_TRUE(in.at_end());
  EXPECT_EQ(read->poisson(), kPoisson);
  AnyCreeps creeps(4.0);
  for (int i = 0; i < 100; ++i) {
    const AnyCreep c = creeps.next();
    EXPECT_EQ(read->at(c.ratio, c.creepage).force, coarse_table().at(c.ratio, c.creepage).force);
  }
  for (const std::size_t length : {std::size_t{0}, std::size_t{20}, out.bytes().size() - 1}) {
    ByteReader cut(std::span(out.bytes()).first(length));
    EXPECT_THROW(CreepTable::read(cut), Error) << length;
  }
  std::vector<std::byte> damaged = out.bytes();
  std::fill(damaged.end() - 8, damaged.end(), std::byte{0xff});  // not a number
  ByteReader bad(damaged);
  EXPECT_THROW(CreepTable::read(bad), Error);
}

TEST(CreepTable, RefusesWhatItIsNotFor) {
  EXPECT_THROW(build_creep_table(0.6, {3, 2, 2.0, 8, 6}), Error);
  EXPECT_THROW(build_creep_table(0.28, {1, 2, 2.0, 8, 6}), Error);
  EXPECT_THROW(build_creep_table(0.28, {3, 2, 1.0, 8, 6}), Error);
  EXPECT_NO_THROW(require_tabulated({}));
  Material soft, layer, viscous;
  soft.shear_modulus_1 = 1e9;
  layer.layer_flexibility = 1e-14;
  viscous.creep_ratio_2 = 0.5;
  for (const Material& other : {soft, layer, viscous}) EXPECT_THROW(require_tabulated(other), Error);
}

}  // namespace
}  // namespace treadmark::vehicle
