// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <sstream>

#include "treadmark/solvers/kalker/normal/normal_solver.hpp"
#include "treadmark/tests/solvers/kalker/owned_problem.hpp"

namespace treadmark::kalker {
namespace {

/// One line of the table in docs/convergence.md: relative errors against Hertz on n elements across 1.2 contact widths.
struct ConvergenceLine {
  std::string contact;  ///< a/b, or "line"
  int n = 0;
  double pressure = 0.0, approach = 0.0, force = 0.0, area = 0.0, field = 0.0;

  std::vector<double> errors() const { return {pressure, approach, force, area, field}; }
};

constexpr double kScale = 1.2;

HertzShape shape_of(const std::string& contact, const CombinedMaterial& material) {
  if (contact == "line") return hertz_line_from_semi_axis(1e-3, 0.1, {true, 35780.0}, material);
  const double ratio = std::stod(contact), c = 5e-3;
  return hertz_from_semi_axes(c * std::sqrt(ratio), c / std::sqrt(ratio), {true, 1e5}, material);
}

ConvergenceLine compute(const std::string& contact, int n) {
  const HertzShape shape = shape_of(contact, combine(Material{}));
  const bool line = is_line_contact(shape);
  const Grid2 grid = hertz_grid(shape, n, line ? 1 : n, kScale);
  testing::OwnedProblem owned = testing::hertzian(shape, grid);
  owned.problem.settings.eps = 1e-7;  // far below the errors of the discretisation
  NormalSolver solver;
  ContactSolution solution;
  solver.solve(owned.problem, solution);

  ConvergenceLine result{contact, n, 0.0, 0.0, 0.0, 0.0, 0.0};
  result.pressure = solution.max_pressure / hertz_max_pressure(shape) - 1.0;
  const double area = line ? 4.0 * shape.semi_axis_x * shape.semi_axis_y : M_PI * shape.semi_axis_x * shape.semi_axis_y;
  result.area = solution.elements_contact * grid.cell_area() / area - 1.0;
  double difference = 0.0, size = 0.0;
  for (int iy = 0; iy < grid.ny; ++iy)
    for (int ix = 0; ix < grid.nx; ++ix) {
      const double exact = hertz_pressure(shape, grid.x(ix), grid.y(iy));
      difference += std::pow(solution.pressure[grid.index(ix, iy)] - exact, 2);
      size += exact * exact;
    }
  result.field = std::sqrt(difference / size);
  // The theory of line contact has no approach; that of a long strip replaces it.
  const CombinedMaterial material = combine(owned.problem.material);
  const double strip = 2.0 * shape.force / (2.0 * shape.semi_axis_y) * (1.0 - material.poisson) /
                       (M_PI * material.shear_modulus) * (std::log(4.0 * shape.semi_axis_y / shape.semi_axis_x) + 0.5);
  const double approach = line ? strip : shape.approach;
  result.approach = solution.approach / approach - 1.0;
  owned.problem.force_prescribed = false;
  owned.problem.approach = approach;
  solver.solve(owned.problem, solution);
  result.force = solution.force_n / shape.force - 1.0;
  return result;
}

std::vector<ConvergenceLine> documented_convergence() {
  std::ifstream file(std::string(TREADMARK_SOURCE_DIR) + "/docs/convergence.md");
  std::vector<ConvergenceLine> lines;
  for (std::string text; std::getline(file, text);) {
    ConvergenceLine line;
    char bar = 0;
    std::istringstream words(text);
    if (words >> bar >> line.contact >> bar >> line.n >> bar >> line.pressure >> bar >> line.approach >> bar >>
        line.force >> bar >> line.area >> bar >> line.field)
      lines.push_back(line);
  }
  return lines;
}

std::string markdown(const ConvergenceLine& line) {
  char text[160];
  std::snprintf(text, sizeof text, "| %s | %d | %.1e | %.1e | %.1e | %.1e | %.1e |", line.contact.c_str(), line.n,
                line.pressure, line.approach, line.force, line.area, line.field);
  return text;
}

TEST(ConvergenceTable, DocumentShowsWhatIsComputed) {
  const auto lines = documented_convergence();
  ASSERT_EQ(lines.size(), 20u) << "docs/convergence.md: 4 contacts on 5 grids";
  for (const ConvergenceLine& printed : lines) {
    const ConvergenceLine computed = compute(printed.contact, printed.n);
    const auto expected = computed.errors(), found = printed.errors();
    for (std::size_t i = 0; i < expected.size(); ++i) {
      // Two digits are shown; a little more than half a unit of the second one, for the last bits of the transforms.
      const double unit = 0.1 * std::pow(10.0, std::floor(std::log10(std::abs(expected[i]))));
      EXPECT_NEAR(found[i], expected[i], 0.52 * unit) << "the table should read\n" << markdown(computed);
    }
  }
}

TEST(ConvergenceTable, ErrorsFallAtTheStatedOrder) {
  // From 21 to 161 elements, a factor 7.7: second order is a factor 59, first order 7.7. The jagged edge of the contact
  // area makes the errors scatter about the trend, so that a good half of the order is required.
  for (const std::string contact : {"1.0", "0.5", "0.1"}) {
    const ConvergenceLine coarse = compute(contact, 21), fine = compute(contact, 161);
    EXPECT_GT(coarse.pressure / fine.pressure, 30.0) << contact;
    EXPECT_GT(coarse.approach / fine.approach, 30.0) << contact;
    EXPECT_GT(coarse.force / fine.force, 30.0) << contact;
    EXPECT_GT(coarse.field / fine.field, 5.0) << contact;
    EXPECT_LT(std::abs(fine.area), 1.0 / 161) << contact;
  }
}

}  // namespace
}  // namespace treadmark::kalker
