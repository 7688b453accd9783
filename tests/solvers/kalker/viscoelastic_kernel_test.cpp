// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/viscoelastic_kernel.hpp"

#include <gtest/gtest.h>

#include "point_solutions.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/bilinear_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"

namespace treadmark::kalker {
namespace {

constexpr double kRubberDx = 1e-3, kRubberDy = 1.5e-3, kCreepRatio = 0.8;
using Kind = InfluenceSettings::Kind;

Material rubber(double relaxation_distance) {
  Material m;
  m.shear_modulus_1 = m.shear_modulus_2 = 1e6;
  m.poisson_1 = m.poisson_2 = 0.4;
  m.creep_ratio_1 = m.creep_ratio_2 = kCreepRatio;
  m.relaxation_time_1 = m.relaxation_time_2 = relaxation_distance;  // at 1 m/s
  return m;
}

std::shared_ptr<const InfluenceKernel> make_viscoelastic(const Material& m, double chi = 0.0,
                                                         Kind kind = Kind::constant) {
  InfluenceSettings settings;
  settings.kind = kind;
  return make_influence_kernel(m, settings, kRubberDx, kRubberDy, 1.0, chi);
}

/// Many equal steps: midpoints of the path ahead, the last term the rest of the exponential.
InfluenceBlock brute_force(const InfluenceKernel& elastic, double X, double Y, double L, double ahead) {
  const int steps = 20000;
  const double step = 25.0 * L / steps;
  InfluenceBlock sum = elastic.at(X, Y);
  for (int i = 0; i < steps; ++i) {
    const double weight = std::exp(-i * step / L) - std::exp(-(i + 1) * step / L);
    add(sum, kCreepRatio * weight, elastic.at(X + ahead * (i + 0.5) * step, Y));
  }
  return sum;
}

void expect_near(const InfluenceBlock& found, const InfluenceBlock& expected, double relative, double X, double L) {
  for (const auto& [name, c] : kAllCoefficients)
    EXPECT_NEAR(found.*c, expected.*c, relative * expected.nn) << name << ' ' << X << ' ' << L;
}

TEST(ViscoelasticKernel, MatchesBruteForce) {
  constexpr double kSteps = 3e-6;  // accuracy of brute force
  const ConstantElements constant(kRubberDx, kRubberDy, 0.4, 0.0);
  const BilinearElements bilinear(kRubberDx, kRubberDy, 0.4, 0.0);
  for (const double L : {0.3 * kRubberDx, 7.0 * kRubberDx})
    for (const double ahead : {1.0, -1.0})
      for (const auto& [X, Y] :
           {std::pair{0.0, 0.0}, {-3.0 * kRubberDx, kRubberDy}, {0.5 * kRubberDx, 0.5 * kRubberDy}}) {
        const double chi = ahead > 0.0 ? 0.0 : kPi;
        const InfluenceBlock c = make_viscoelastic(rubber(L), chi)->at(X, Y),
                             b = make_viscoelastic(rubber(L), chi, Kind::bilinear)->at(X, Y);
        const InfluenceBlock c_expected = brute_force(constant, X, Y, L, ahead);
        expect_near(c, c_expected, kSteps, X, L);
        if (ahead > 0.0) expect_near(b, brute_force(bilinear, X, Y, L, ahead), kSteps, X, L);
      }
}

TEST(ViscoelasticKernel, SatisfiesTheRelaxationOverOneStep) {
  // Memory fades: I(X) = integral over the next stretch + exp(-stretch / L) I(X + stretch); whatever the relaxation
  // distance. Stretches are short and away from borders, so that one panel of five nodes integrates them.
  const ConstantElements elastic(kRubberDx, kRubberDy, 0.4, 0.0);
  for (const double L :
       {1e-4 * kRubberDx, 0.01 * kRubberDx, kRubberDx, 100.0 * kRubberDx, 1e4 * kRubberDx, 1e6 * kRubberDx}) {
    const auto kernel = make_viscoelastic(rubber(L));
    const auto memory = [&](double X, double Y) {
      InfluenceBlock block = kernel->at(X, Y);
      add(block, -1.0, elastic.at(X, Y));
      return block;
    };
    const double stretch = std::min(0.1 * kRubberDx, 0.1 * L);
    for (const auto& [X, Y] : {std::pair{0.0, 0.0},
                               {-20.3 * kRubberDx, 0.0},
                               {-1.9 * kRubberDx, 0.5 * kRubberDy},
                               {2.0 * kRubberDx, -3.0 * kRubberDy},
                               {300.0 * kRubberDx, kRubberDy}}) {
      InfluenceBlock expected;
      for_gauss_nodes(0.0, stretch, 0.0, 1.0, 1, [&](double t, double, double weight) {
        add(expected, kCreepRatio * weight * std::exp(-t / L) / L, elastic.at(X + t, Y));
      });
      add(expected, std::exp(-stretch / L), memory(X + stretch, Y));
      expect_near(memory(X, Y), expected, 1e-9, X, L);
    }
  }
}

/// Elastic coefficients that count how often they are asked for.
struct CountedElements final : InfluenceKernel {
  InfluenceBlock at(double X, double Y) const override {
    ++calls;
    return elements.at(X, Y);
  }
  bool symmetric() const override { return true; }
  bool coupled() const override { return false; }

  ConstantElements elements{kRubberDx, kRubberDy, 0.4, 0.0};
  mutable int calls = 0;
};

TEST(ViscoelasticKernel, FadesFromPointToPointAlongARow) {
  constexpr int kCount = 241, kFirst = -120, kMostCallsEach = 12;
  for (const double ahead : {1.0, -1.0})
    for (const double L : {0.01 * kRubberDx, kRubberDx, 50.0 * kRubberDx, 1e4 * kRubberDx})
      for (const double Y : {0.0, 0.5 * kRubberDy, 3.0 * kRubberDy}) {
        const auto counted = std::make_shared<CountedElements>();
        const ViscoelasticKernel kernel(
            {{counted, 1.0, kCreepRatio, L}},
            {.x = {-0.5 * kRubberDx, 0.5 * kRubberDx}, .y = {-0.5 * kRubberDy, 0.5 * kRubberDy}}, ahead);
        for (const double shift : {0.0, 0.3 * kRubberDx}) {
          std::vector<InfluenceBlock> row(kCount);
          counted->calls = 0;
          kernel.row(kFirst, kRubberDx, shift, Y, row);
          if (L >= kRubberDx) {
            EXPECT_LT(counted->calls, kMostCallsEach * kCount) << L << ' ' << Y;
          }
          for (const int k : {kFirst, -3, -1, 0, 1, 2, kFirst + kCount - 1})
            expect_near(row[static_cast<std::size_t>(k - kFirst)], kernel.at(k * kRubberDx + shift, Y), 1e-10,
                        k * kRubberDx + shift, L);
        }
      }
}

TEST(ViscoelasticKernel, IsRubberyWhenSlowAndGlassyWhenFast) {
  const ConstantElements elastic(kRubberDx, kRubberDy, 0.4, 0.0);
  for (const auto& [X, Y] : {std::pair{0.0, 0.0}, {2.0 * kRubberDx, -kRubberDy}, {-5.0 * kRubberDx, 0.0}}) {
    const InfluenceBlock c = elastic.at(X, Y), at_rest = make_viscoelastic(rubber(0.0))->at(X, Y),
                         slow = make_viscoelastic(rubber(1e-7 * kRubberDx))->at(X, Y),
                         fast = make_viscoelastic(rubber(1e9 * kRubberDx))->at(X, Y);
    for (const auto& [name, k] : kAllCoefficients) {
      EXPECT_DOUBLE_EQ(at_rest.*k, (1.0 + kCreepRatio) * (c.*k)) << name;
      EXPECT_NEAR(slow.*k, (1.0 + kCreepRatio) * (c.*k), 1e-6 * c.nn) << name;
      EXPECT_NEAR(fast.*k, c.*k, 1e-6 * c.nn) << name;
    }
  }
}

TEST(ViscoelasticKernel, SurfaceStaysDeformedBehindTheLoad) {
  const auto forward = make_viscoelastic(rubber(3.0 * kRubberDx)),
             backward = make_viscoelastic(rubber(3.0 * kRubberDx), kPi);
  EXPECT_GT(forward->at(-2.0 * kRubberDx, 0.0).nn, 1.05 * forward->at(2.0 * kRubberDx, 0.0).nn);
  EXPECT_GT(backward->at(2.0 * kRubberDx, 0.0).nn, 1.05 * backward->at(-2.0 * kRubberDx, 0.0).nn);
  EXPECT_NEAR(forward->at(-2.0 * kRubberDx, kRubberDy).xy, -backward->at(2.0 * kRubberDx, kRubberDy).xy,
              1e-12 * kRubberDx);
  EXPECT_FALSE(forward->symmetric());
  ASSERT_TRUE(forward->symmetric_in_y());
  expect_near(forward->at(-2.0 * kRubberDx, -kRubberDy),
              mirrored(forward->at(-2.0 * kRubberDx, kRubberDy), false, true), 1e-14, -2.0 * kRubberDx,
              3.0 * kRubberDx);
}

TEST(ViscoelasticKernel, DifferentBodiesContributeByCompliance) {
  // Body 2 is elastic, stiffer, and with the same (1 - 2 nu) / G.
  Material m = rubber(2.0 * kRubberDx);
  m.shear_modulus_2 = 2e6;
  m.poisson_2 = 0.3;
  m.creep_ratio_2 = 0.0;
  m.relaxation_time_2 = 1.0;
  const double G = combine(m).shear_modulus, X = -kRubberDx, Y = kRubberDy;
  const InfluenceBlock found = make_viscoelastic(m)->at(X, Y);
  const ConstantElements elastic_2(kRubberDx, kRubberDy, m.poisson_2, 0.0);
  InfluenceBlock expected;
  add(expected, 0.5 * G / m.shear_modulus_1, make_viscoelastic(rubber(2.0 * kRubberDx))->at(X, Y));
  add(expected, 0.5 * G / m.shear_modulus_2, elastic_2.at(X, Y));
  for (const auto& [name, k] : kAllCoefficients) EXPECT_NEAR(found.*k, expected.*k, 1e-14 * expected.nn) << name;

  // Two bodies that both creep a little differently are nearly two equal ones.
  Material near_equal = rubber(2.0 * kRubberDx);
  near_equal.relaxation_time_2 *= 1.0 + 1e-9;
  const InfluenceBlock equal = make_viscoelastic(rubber(2.0 * kRubberDx))->at(X, Y),
                       nearly = make_viscoelastic(near_equal)->at(X, Y);
  for (const auto& [name, k] : kAllCoefficients) EXPECT_NEAR(nearly.*k, equal.*k, 1e-8 * equal.nn) << name;
}

TEST(ViscoelasticKernel, RefusesWhatHasNoMeaning) {
  Material coupled = rubber(kRubberDx);
  coupled.poisson_2 = 0.3;
  EXPECT_THROW(make_viscoelastic(coupled), Error);
  EXPECT_THROW(make_viscoelastic(rubber(kRubberDx), 0.5 * kPi), Error);
  EXPECT_THROW(make_viscoelastic(rubber(kRubberDx), 0.0, Kind::angle_corrected), Error);
  EXPECT_THROW(make_viscoelastic(rubber(kRubberDx), 0.0, Kind::table), Error);
  EXPECT_THROW(make_viscoelastic(rubber(-kRubberDx)), Error);
  Material swelling = rubber(kRubberDx);
  swelling.creep_ratio_1 = -0.5;
  EXPECT_THROW(make_viscoelastic(swelling), Error);
}

}  // namespace
}  // namespace treadmark::kalker
