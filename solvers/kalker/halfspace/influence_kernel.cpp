// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/influence_kernel.hpp"

#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/contact_problem.hpp"
#include "treadmark/solvers/kalker/halfspace/angle_corrected_kernel.hpp"
#include "treadmark/solvers/kalker/halfspace/bilinear_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/constant_elements.hpp"
#include "treadmark/solvers/kalker/halfspace/row_inclination.hpp"
#include "treadmark/solvers/kalker/halfspace/tabulated_kernel.hpp"
#include "treadmark/solvers/kalker/halfspace/viscoelastic_kernel.hpp"

namespace treadmark::kalker {

namespace {

using Kind = InfluenceSettings::Kind;

std::shared_ptr<const InfluenceKernel> make_elastic(Kind kind, double dx, double dy, double poisson,
                                                    double difference) {
  if (kind == Kind::bilinear) return std::make_shared<BilinearElements>(dx, dy, poisson, difference);
  return std::make_shared<ConstantElements>(dx, dy, poisson, difference);
}

double direction_along_x(double chi) {
  constexpr double kTolerance = 1e-6;
  if (!(std::abs(std::sin(chi)) < kTolerance))
    throw Error(ErrorKind::configuration,
                "viscoelastic bodies rolling in the direction chi = " + std::to_string(chi) + " rad", {},
                "chi must be 0 or pi");
  return std::cos(chi) > 0.0 ? 1.0 : -1.0;
}

std::shared_ptr<const InfluenceKernel> make_viscoelastic(const Material& m, Kind kind, double dx, double dy,
                                                         double velocity, double chi) {
  const CombinedMaterial combined = combine(m);
  if (kind != Kind::constant && kind != Kind::bilinear)
    throw Error(ErrorKind::configuration,
                "viscoelastic bodies with coefficients of influence other than the half-space's", {},
                "use constant or bilinear elements, or set the creep ratios to zero");
  if (significant_difference(combined.difference) != 0.0)
    throw Error(ErrorKind::configuration,
                "viscoelastic bodies whose normal and tangential displacements are coupled, K = " +
                    std::to_string(combined.difference),
                {}, "(1 - 2 nu) / G must be the same in both bodies");
  if (!(velocity >= 0.0))
    throw Error(ErrorKind::configuration, "viscoelastic bodies need a rolling velocity that is not negative");

  const auto body = [&](double shear_modulus, double poisson, double creep_ratio, double relaxation_time) {
    return ViscoelasticBody{.elastic = make_elastic(kind, dx, dy, poisson, 0.0),
                            .weight = 0.5 * combined.shear_modulus / shear_modulus,
                            .creep_ratio = creep_ratio,
                            .relaxation_distance = velocity * relaxation_time};
  };
  std::vector<ViscoelasticBody> bodies{body(m.shear_modulus_1, m.poisson_1, m.creep_ratio_1, m.relaxation_time_1),
                                       body(m.shear_modulus_2, m.poisson_2, m.creep_ratio_2, m.relaxation_time_2)};
  if (m.creep_ratio_1 == m.creep_ratio_2 && m.relaxation_time_1 == m.relaxation_time_2) {
    bodies.pop_back();
    bodies.front().elastic = make_elastic(kind, dx, dy, combined.poisson, 0.0);
    bodies.front().weight = 1.0;
  }
  KernelBorders borders{.x = {-0.5 * dx, 0.5 * dx}, .y = {-0.5 * dy, 0.5 * dy}};
  if (kind == Kind::bilinear) borders = {.x = {-dx, 0.0, dx}, .y = {-dy, 0.0, dy}};
  return std::make_shared<ViscoelasticKernel>(std::move(bodies), std::move(borders), direction_along_x(chi));
}

std::shared_ptr<const InfluenceKernel> make_angle_corrected(const InfluenceSettings& settings,
                                                            std::shared_ptr<const InfluenceKernel> half_space) {
  const AngleCorrection correction = angle_correction(settings);
  if (!settings.linear)
    throw Error(ErrorKind::configuration,
                "inclinations row by row leave no coefficients that depend on the offset only", {},
                "turn products with the half-space's coefficients, or use the straight line through the inclinations");
  return std::make_shared<AngleCorrectedKernel>(std::move(half_space),
                                                regression_slope(settings.position, settings.inclination), correction);
}

}  // namespace

InfluenceBlock mirrored(const InfluenceBlock& block, bool in_x, bool in_y) {
  const double x = in_x ? -1.0 : 1.0, y = in_y ? -1.0 : 1.0;
  return {.xx = block.xx,
          .xy = x * y * block.xy,
          .xn = x * block.xn,
          .yx = x * y * block.yx,
          .yy = block.yy,
          .yn = y * block.yn,
          .nx = x * block.nx,
          .ny = y * block.ny,
          .nn = block.nn};
}

InfluenceBlock divided(const InfluenceBlock& b, double d) {
  return {.xx = b.xx / d,
          .xy = b.xy / d,
          .xn = b.xn / d,
          .yx = b.yx / d,
          .yy = b.yy / d,
          .yn = b.yn / d,
          .nx = b.nx / d,
          .ny = b.ny / d,
          .nn = b.nn / d};
}

std::shared_ptr<const InfluenceKernel> make_influence_kernel(const Material& material,
                                                             const InfluenceSettings& settings, double dx, double dy,
                                                             double velocity, double chi) {
  const bool elastic_bodies = material.shear_modulus_1 > 0.0 && material.shear_modulus_2 > 0.0;
  const CombinedMaterial combined = combine(elastic_bodies ? material : Material{});
  if (!(elastic_bodies && combined.shear_modulus > 0.0 && std::isfinite(combined.poisson) &&
        std::isfinite(combined.difference)))
    throw Error(ErrorKind::configuration, "elastic bodies need positive shear moduli and finite Poisson's ratios");
  if (material.creep_ratio_1 != 0.0 || material.creep_ratio_2 != 0.0)
    return make_viscoelastic(material, settings.kind, dx, dy, velocity, chi);
  auto elastic = make_elastic(settings.kind, dx, dy, combined.poisson, combined.difference);
  if (settings.kind == Kind::angle_corrected) return make_angle_corrected(settings, std::move(elastic));
  if (settings.kind == Kind::table)
    return std::make_shared<TabulatedKernel>(settings.table, std::move(elastic), dx, dy);
  return elastic;
}

}  // namespace treadmark::kalker
