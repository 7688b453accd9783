// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/viscoelastic_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numeric>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/gauss_legendre.hpp"

namespace treadmark::kalker {

namespace {

void add_tangential_and_normal(InfluenceBlock& sum, double factor, const InfluenceBlock& block) {
  sum.xx += factor * block.xx;
  sum.xy += factor * block.xy;
  sum.yx += factor * block.yx;
  sum.yy += factor * block.yy;
  sum.nn += factor * block.nn;
}

/// Fading memory of one body at one point: the coefficients along the path that lies ahead of the point, weighted by
/// exp(-distance / L) / L. Panels are halved until Gauss' rule converges on each.
class MemoryIntegral {
 public:
  MemoryIntegral(const ViscoelasticBody& body, const KernelBorders& borders, double ahead, double X, double Y)
      : body_(body), borders_(borders), ahead_(ahead), X_(X), Y_(Y) {
    const auto [lowest, highest] = std::minmax_element(borders.y.begin(), borders.y.end());
    offset_ = std::max({0.0, *lowest - Y, Y - *highest});
    for (const double x : borders.x) size_ = std::max(size_, std::abs(x));
  }

  InfluenceBlock compute() {
    constexpr double kMemory = 36.0;  // exp(-36) is rounding
    integrate(0.0, kMemory * body_.relaxation_distance);
    return sum_;
  }

 private:
  static constexpr int kNodes = 12;
  /// Errors fall as this number to the power -2 kNodes: the size of the ellipse about a panel (of complex distances)
  /// that is free of singular points.
  static constexpr double kSmallestEllipse = 3.0;

  void integrate(double begin, double end) {
    if (!converges(begin, end)) {
      const double middle = 0.5 * (begin + end);
      integrate(begin, middle);
      return integrate(middle, end);
    }
    static const GaussRule rule = gauss_legendre(kNodes);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double distance = std::midpoint(begin, end) + 0.5 * (end - begin) * rule.nodes[i];
      const double length = 0.5 * (end - begin) * rule.weights[i] / body_.relaxation_distance;
      add_tangential_and_normal(sum_, length * std::exp(-distance / body_.relaxation_distance),
                                body_.elastic->at(X_ + ahead_ * distance, Y_));
    }
  }

  bool converges(double begin, double end) const {
    constexpr double kLongestPanel = 4.0;    // relaxation distances
    constexpr double kSmallestPanel = 1e-6;  // of the element, where the path crosses a border or meets a corner
    if (end - begin > kLongestPanel * body_.relaxation_distance) return false;
    if (end - begin < kSmallestPanel * size_) return true;
    const double middle = 0.5 * (begin + end), half = 0.5 * (end - begin);
    return std::all_of(borders_.x.begin(), borders_.x.end(), [&](double x) {
      const std::complex<double> singular((ahead_ * (x - X_) - middle) / half, offset_ / half);
      const std::complex<double> root = std::sqrt(singular * singular - 1.0);
      return std::max(std::abs(singular + root), std::abs(singular - root)) >= kSmallestEllipse;
    });
  }

  const ViscoelasticBody& body_;
  const KernelBorders& borders_;
  double ahead_, X_, Y_;
  double offset_ = 0.0;  ///< of the path from the loaded area [m]: of singular points from the real axis
  double size_ = 0.0;    ///< of the element along the path [m]
  InfluenceBlock sum_;
};

}  // namespace

ViscoelasticKernel::ViscoelasticKernel(std::vector<ViscoelasticBody> bodies, KernelBorders borders, double ahead)
    : bodies_(std::move(bodies)), borders_(std::move(borders)), ahead_(ahead) {
  const auto is_zero = [](double x) { return x == 0.0; };
  if (std::all_of(borders_.x.begin(), borders_.x.end(), is_zero) || borders_.y.empty())
    throw Error(ErrorKind::configuration, "the borders of an element without width are no basis for an integration");
  for (const ViscoelasticBody& body : bodies_) {
    if (!body.elastic || body.elastic->coupled() || !body.elastic->symmetric())
      throw Error(ErrorKind::configuration,
                  "viscoelastic bodies need the coefficients of uncoupled elastic half-spaces");
    if (!(body.relaxation_distance >= 0.0 && std::isfinite(body.relaxation_distance) && body.creep_ratio >= 0.0))
      throw Error(ErrorKind::configuration,
                  "creep ratios and relaxation distances of viscoelastic bodies must not be negative");
  }
}

InfluenceBlock ViscoelasticKernel::at(double X, double Y) const {
  InfluenceBlock sum;
  for (const ViscoelasticBody& body : bodies_) {
    const bool delayed = body.creep_ratio > 0.0 && body.relaxation_distance > 0.0;
    add_tangential_and_normal(sum, body.weight * (delayed ? 1.0 : 1.0 + body.creep_ratio), body.elastic->at(X, Y));
    if (delayed)
      add_tangential_and_normal(sum, body.weight * body.creep_ratio,
                                MemoryIntegral(body, borders_, ahead_, X, Y).compute());
  }
  return sum;
}

}  // namespace treadmark::kalker
