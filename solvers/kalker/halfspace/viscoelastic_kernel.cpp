// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/viscoelastic_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>
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

/// Fading memory of one body: the coefficients along the path that lies ahead of a point, weighted by
/// exp(-distance / L) / L.
class FadingMemory {
 public:
  FadingMemory(const ViscoelasticBody& body, const KernelBorders& borders, double ahead, double Y)
      : body_(body), borders_(borders), ahead_(ahead), Y_(Y) {
    const auto [lowest, highest] = std::minmax_element(borders.y.begin(), borders.y.end());
    offset_ = std::max({0.0, *lowest - Y, Y - *highest});
    for (const double x : borders.x) size_ = std::max(size_, std::abs(x));
  }

  /// Adds the integral over distances begin to end ahead of X: Gauss' rule on panels that end at borders and are halved
  /// until 16 nodes are enough.
  void integrate(InfluenceBlock& sum, double X, double begin, double end) const {
    double middle = std::midpoint(begin, end);
    int nodes = nodes_for(X, begin, end);
    for (const double x : borders_.x)
      if (const double border = ahead_ * (x - X); begin < border && border < end) {
        middle = border;
        nodes = 0;
      }
    if (nodes == 0) {
      integrate(sum, X, begin, middle);
      return integrate(sum, X, middle, end);
    }
    const GaussRule rule = gauss_legendre(nodes);
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
      const double distance = middle + 0.5 * (end - begin) * rule.nodes[i];
      const double length = 0.5 * (end - begin) * rule.weights[i] / body_.relaxation_distance;
      add_tangential_and_normal(sum, length * std::exp(-distance / body_.relaxation_distance),
                                body_.elastic->at(X + ahead_ * distance, Y_));
    }
  }

 private:
  /// Nodes for 1e-11 on a panel, 0 if these are too many. The error of n nodes is r^-2n times the largest value on the
  /// ellipse of size r about the panel (of complex distances), which must be free of singular points, and on which the
  /// exponential grows (Trefethen 2008).
  int nodes_for(double X, double begin, double end) const {
    constexpr double kAccuracy = 25.0;       // natural logarithm
    constexpr double kSmallestPanel = 1e-3;  // where the path crosses a border or meets a corner; there C is x ln x
    const double middle = std::midpoint(begin, end), half = 0.5 * (end - begin);
    if (end - begin < kSmallestPanel * std::min(size_, body_.relaxation_distance)) return kMostGaussNodes / 2;
    double regular = std::numeric_limits<double>::max();
    for (const double x : borders_.x) {
      const std::complex<double> singular((ahead_ * (x - X) - middle) / half, offset_ / half);
      const std::complex<double> root = std::sqrt(singular * singular - 1.0);
      regular = std::min(regular, std::max(std::abs(singular + root), std::abs(singular - root)));
    }
    const double decay = half / body_.relaxation_distance;
    for (int n = 2; n <= kMostGaussNodes; ++n) {
      const double ellipse = std::min(regular, 4.0 * n / decay);  // beyond the latter the exponential outgrows r^-2n
      if (2.0 * n * std::log(ellipse) - 0.5 * decay * ellipse >= kAccuracy) return n;
    }
    return 0;
  }

  const ViscoelasticBody& body_;
  const KernelBorders& borders_;
  double ahead_, Y_;
  double offset_ = 0.0;  ///< of the path from the loaded area [m]: of singular points from the real axis
  double size_ = 0.0;    ///< of the element along the path [m]
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
  InfluenceBlock block;
  row(0, 1.0, X, Y, {&block, 1});
  return block;
}

void ViscoelasticKernel::row(int first, double step, double shift, double Y, std::span<InfluenceBlock> blocks) const {
  constexpr double kMemory = 36.0;  // exp(-36) is rounding
  std::fill(blocks.begin(), blocks.end(), InfluenceBlock{});
  for (const ViscoelasticBody& body : bodies_) {
    const double L = body.relaxation_distance;
    const bool delayed = body.creep_ratio > 0.0 && L > 0.0;
    const FadingMemory path(body, borders_, ahead_, Y);
    InfluenceBlock memory;
    for (std::size_t i = 0; i < blocks.size(); ++i) {  // from the farthest ahead on
      const std::size_t k = ahead_ > 0.0 ? blocks.size() - 1 - i : i;
      const double X = (first + static_cast<int>(k)) * step + shift;
      add_tangential_and_normal(blocks[k], body.weight * (delayed ? 1.0 : 1.0 + body.creep_ratio),
                                body.elastic->at(X, Y));
      if (!delayed) continue;
      InfluenceBlock here;
      if (i > 0) add_tangential_and_normal(here, std::exp(-step / L), memory);
      path.integrate(here, X, 0.0, i > 0 ? std::min(step, kMemory * L) : kMemory * L);
      memory = here;
      add_tangential_and_normal(blocks[k], body.weight * body.creep_ratio, memory);
    }
  }
}

}  // namespace treadmark::kalker
