// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/fastsim/kalker_coefficients.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

/// The tables of docs/verification.md: errors of the approximate theories against the exact one.

constexpr std::array<double, 7> kRatios{0.1, 0.2, 0.5, 1.0, 2.0, 5.0, 10.0};  // a/b
using Row = std::array<double, kRatios.size()>;
using Table = std::map<std::string, Row>;

constexpr double kLoad = 80e3, kMu = 0.3;
constexpr int kAcross = 32;  ///< elements across the contact

/// Creepages by what the linear theory needs for the friction bound.
struct Group {
  const char* name;
  std::vector<Creepage> creepages;
};

const std::vector<Group>& groups() {
  static const std::vector<Group> all{
      {"creepage 0.2", {{0.2, 0.0, 0.0}, {0.0, 0.2, 0.0}, {0.14, 0.14, 0.0}}},
      {"creepage 0.5", {{0.5, 0.0, 0.0}, {0.0, 0.5, 0.0}, {0.35, 0.35, 0.0}}},
      {"creepage 1, 2", {{1.0, 0.0, 0.0}, {0.0, 1.0, 0.0}, {0.7, 0.7, 0.0}, {2.0, 0.0, 0.0}, {0.0, 2.0, 0.0}}},
      {"spin 0.25", {{0.0, 0.0, 0.25}, {1.0, 0.0, 0.25}, {2.0, 0.0, 0.25}, {0.0, 1.0, 0.25}, {0.0, -0.5, 0.25}}},
      {"spin 0.5", {{0.0, 0.0, 0.5}, {0.5, 0.0, 0.5}, {0.0, 0.5, 0.5}, {0.0, 1.0, 0.5}, {0.0, -0.5, 0.5}}},
      {"spin 1", {{0.0, 0.0, 1.0}, {0.5, 0.0, 1.0}, {0.0, 0.5, 1.0}, {0.0, -0.5, 1.0}, {0.5, -0.5, 1.0}}},
      {"spin 1.5", {{0.0, 0.0, 1.5}, {0.5, 0.0, 1.5}, {0.0, -1.0, 1.5}, {0.5, -2.0, 1.5}}},
      {"spin 3", {{0.0, 0.0, 3.0}, {0.5, 0.0, 3.0}, {0.0, 0.5, 3.0}, {0.5, -2.0, 3.0}}},
  };
  return all;
}

class SolvedEllipse {
 public:
  explicit SolvedEllipse(double ratio)
      : a_(kScale * std::sqrt(ratio)),
        b_(kScale / std::sqrt(ratio)),
        shape_(hertz_from_semi_axes(a_, b_, {true, kLoad}, combine(Material{}))),
        coefficients_(kalker_coefficients(a_, b_, combine(Material{}).poisson)),
        owned_(testing::hertzian(shape_, hertz_grid(shape_, kAcross + 4, kAcross + 4, 1.0 + 4.0 / kAcross))) {
    owned_.problem.hertz = shape_;
    owned_.problem.regime = Regime::steady;
    owned_.problem.fastsim.flexibility = 8.0 * a_ / (3.0 * coefficients_.c11 * combine(Material{}).shear_modulus);
  }

  Creepage creepage(const Creepage& scaled) const {
    const double unit = kMu * kLoad / (combine(Material{}).shear_modulus * kScale * kScale);
    return {scaled.xi * unit / coefficients_.c11, scaled.eta * unit / coefficients_.c22,
            scaled.phi * unit / (kScale * coefficients_.c23)};
  }
  ContactSolution solve(TangentialModel tangential, const Creepage& scaled, NormalModel normal = NormalModel::full) {
    ContactProblem& p = owned_.problem;
    p.tangential_model = tangential;
    p.normal_model = normal;
    p.creepage = creepage(scaled);
    return solver_.solve(p);
  }
  void press_by_approach() {
    owned_.problem.force_prescribed = false;
    owned_.problem.approach = shape_.approach;
    owned_.problem.hertz.reset();
  }

  static constexpr double kScale = 5e-3;

 private:
  double a_, b_;
  HertzShape shape_;
  KalkerCoefficients coefficients_;
  testing::OwnedProblem owned_;
  ContactSolver solver_;
};

/// Difference of the tangential forces over the friction bound.
double force_error(const ContactSolution& found, const ContactSolution& exact) {
  return std::hypot(found.force_x - exact.force_x, found.force_y - exact.force_y) / (kMu * exact.force_n);
}

constexpr std::array<std::pair<TangentialModel, const char*>, 4> kTheories{
    {{TangentialModel::fastsim, "FASTSIM"},
     {TangentialModel::fastsim_one_flexibility, "FASTSIM, one flexibility"},
     {TangentialModel::fastrip, "FaStrip"},
     {TangentialModel::linear, "linear"}}};

void add_tangential(SolvedEllipse& ellipse, std::size_t column, Table& table) {
  for (const Group& group : groups())
    for (const Creepage& scaled : group.creepages) {
      const ContactSolution exact = ellipse.solve(TangentialModel::full, scaled);
      EXPECT_EQ(exact.status, Status::ok);
      for (const auto& [model, name] : kTheories) {
        const ContactSolution found = ellipse.solve(model, scaled);
        EXPECT_TRUE(found.status == Status::ok || model == TangentialModel::linear) << name;
        double& force = table["| " + std::string(name) + " | " + group.name + " |"][column];
        force = std::max(force, force_error(found, exact));
        if (scaled.phi == 0.0) continue;
        double& moment = table["| " + std::string(name) + " | spin moment |"][column];
        moment =
            std::max(moment, std::abs(found.moment_n - exact.moment_n) / (kMu * exact.force_n * SolvedEllipse::kScale));
      }
    }
}

void add_normal(SolvedEllipse& ellipse, std::size_t column, Table& table) {
  ellipse.press_by_approach();
  for (const auto& [model, name] : {std::pair{NormalModel::kpec, "KPEC"}, std::pair{NormalModel::analyn, "ANALYN"}})
    for (const Creepage& scaled : {Creepage{0.5, 0.0, 0.0}, Creepage{0.0, 1.0, 0.0}, Creepage{0.0, 0.5, 0.5}}) {
      const ContactSolution exact = ellipse.solve(TangentialModel::full, scaled),
                            found = ellipse.solve(TangentialModel::full, scaled, model);
      EXPECT_EQ(found.status, Status::ok);
      const auto put = [&](const char* what, double error) {
        double& value = table["| " + std::string(name) + " | " + what + " |"][column];
        value = std::max(value, error);
      };
      put("normal force", std::abs(found.force_n / exact.force_n - 1.0));
      put("largest pressure", std::abs(found.max_pressure / exact.max_pressure - 1.0));
      put("tangential force", force_error(found, exact));
    }
}

const Table& computed() {
  static const Table table = [] {
    Table all;
    for (std::size_t column = 0; column < kRatios.size(); ++column) {
      SolvedEllipse ellipse(kRatios[column]);
      add_tangential(ellipse, column, all);
      add_normal(ellipse, column, all);
    }
    return all;
  }();
  return table;
}

std::string markdown(const std::string& head, const Row& row) {
  std::string text = head;
  for (const double error : row) {
    char number[16];
    std::snprintf(number, sizeof number, " %.3f |", error);
    text += number;
  }
  return text;
}

TEST(TheoryErrors, DocumentShowsWhatIsComputed) {
  std::ifstream file(std::string(TREADMARK_SOURCE_DIR) + "/docs/verification.md");
  std::vector<std::string> lines;
  for (std::string line; std::getline(file, line);) lines.push_back(line);
  for (const auto& [head, row] : computed()) {
    const auto line = ranges::find_if(lines, [&](const std::string& text) { return text.starts_with(head); });
    if (line == lines.end()) {
      ADD_FAILURE() << "docs/verification.md lacks\n" << markdown(head, row);
      continue;
    }
    Row printed{};
    std::istringstream words(line->substr(head.size()));
    char bar = 0;
    for (double& value : printed) words >> value >> bar;
    for (std::size_t i = 0; i < row.size(); ++i)  // three digits are shown
      EXPECT_NEAR(printed[i], row[i], 6e-4) << "docs/verification.md should read\n" << markdown(head, row);
  }
}

}  // namespace
}  // namespace treadmark::kalker
