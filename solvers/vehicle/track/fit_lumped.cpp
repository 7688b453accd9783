// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/track/fit_lumped.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Dense>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"

namespace treadmark::vehicle {
namespace {

using Complex = std::complex<double>;
using Logarithms = Eigen::VectorXd;  // logarithms of mass, stiffness, damping, layer after layer

constexpr int kOfLayer = 3;

std::vector<LumpedLayer> layers_of(const Logarithms& numbers) {
  std::vector<LumpedLayer> layers;
  for (Eigen::Index i = 0; i < numbers.size(); i += kOfLayer)
    layers.push_back({std::exp(numbers[i]), std::exp(numbers[i + 1]), std::exp(numbers[i + 2])});
  return layers;
}

Logarithms numbers_of(const std::vector<LumpedLayer>& layers) {
  Logarithms numbers(kOfLayer * static_cast<Eigen::Index>(layers.size()));
  for (std::size_t i = 0; i < layers.size(); ++i)
    numbers.segment<kOfLayer>(kOfLayer * static_cast<Eigen::Index>(i)) << std::log(layers[i].mass),
        std::log(layers[i].stiffness), std::log(layers[i].damping);
  return numbers;
}

/// One attempt of the fit.
class Search {
 public:
  Search(std::span<const double> frequency, std::span<const Complex> target) : frequency_(frequency), target_(target) {
    // Lighter masses are not felt, and the search would go on to none.
    constexpr double kFelt = 1e-3;
    const double w = 2.0 * kPi * frequency.back();
    least_mass_ = std::log(kFelt / (std::abs(target.back()) * w * w));
  }

  struct Found {
    Logarithms numbers;
    double squares = kInfinity;
    bool converged = false;
  };

  Found from(const Logarithms& start) const {
    constexpr int kMost = 300;
    constexpr double kLeastGain = 1e-10;
    Found found{start, residual(start).squaredNorm(), false};
    double lambda = 1e-2;
    for (int i = 0; i < kMost && !found.converged; ++i) {
      check_cancelled();
      const Eigen::VectorXd r = residual(found.numbers);
      const Eigen::MatrixXd j = jacobian(found.numbers);
      const Eigen::MatrixXd normal = j.transpose() * j;
      const Eigen::VectorXd slope = j.transpose() * r;
      bool better = false;
      while (!better && lambda < 1e10) {
        Eigen::MatrixXd damped = normal;
        damped.diagonal() += lambda * (normal.diagonal().array() + 1e-12 * normal.diagonal().maxCoeff()).matrix();
        Logarithms next = found.numbers - damped.ldlt().solve(slope);
        for (Eigen::Index m = 0; m < next.size(); m += kOfLayer) next[m] = std::max(next[m], least_mass_);
        // Numbers beyond e^60 belong to no track.
        const double squares =
            next.allFinite() && next.cwiseAbs().maxCoeff() < 60.0 ? residual(next).squaredNorm() : kInfinity;
        if (squares < found.squares) {
          found.converged = found.squares - squares < kLeastGain * found.squares;
          found.numbers = next;
          found.squares = squares;
          lambda = std::max(0.2 * lambda, 1e-12);
          better = true;
        } else {
          lambda *= 4.0;
        }
      }
      if (!better) found.converged = true;  // no direction leads down any more
    }
    return found;
  }

 private:
  Eigen::VectorXd residual(const Logarithms& numbers) const {
    const std::vector<LumpedLayer> layers = layers_of(numbers);
    Eigen::VectorXd r(2 * static_cast<Eigen::Index>(frequency_.size()));
    for (std::size_t i = 0; i < frequency_.size(); ++i) {
      const Complex log = std::log(receptance(layers, frequency_[i]) / target_[i]);
      r[2 * static_cast<Eigen::Index>(i)] = log.real();
      r[2 * static_cast<Eigen::Index>(i) + 1] = log.imag();
    }
    return r;
  }

  Eigen::MatrixXd jacobian(const Logarithms& numbers) const {
    constexpr double kStep = 1e-5;
    Eigen::MatrixXd j(2 * static_cast<Eigen::Index>(frequency_.size()), numbers.size());
    for (Eigen::Index c = 0; c < numbers.size(); ++c) {
      Logarithms up = numbers, down = numbers;
      up[c] += kStep;
      down[c] -= kStep;
      j.col(c) = (residual(up) - residual(down)) / (2.0 * kStep);
    }
    return j;
  }

  std::span<const double> frequency_;
  std::span<const Complex> target_;
  double least_mass_ = 0.0;
};

/// Where searches start: layers that together are as soft as the receptance at the lowest frequency.
std::vector<std::vector<LumpedLayer>> starts(double stiffness, int layers) {
  const double k = stiffness * layers;
  constexpr double kMasses[] = {0.05, 0.5};               // over those of the layer below
  constexpr double kCorners[] = {60.0, 200.0, 600.0};     // where damper and spring are alike [Hz]
  constexpr double kResonances[] = {60.0, 150.0, 400.0};  // of the lowest mass [Hz]
  std::vector<std::vector<LumpedLayer>> all;
  for (const double ratio : kMasses)
    for (const double corner : kCorners)
      for (const double resonance : kResonances) {
        const double w = 2.0 * kPi * resonance;
        std::vector<LumpedLayer> one;
        for (int i = 0; i < layers; ++i)
          one.push_back({k / (w * w) * std::pow(ratio, layers - 1 - i), k, k / (2.0 * kPi * corner)});
        all.push_back(std::move(one));
      }
  return all;
}

}  // namespace

Complex receptance(std::span<const LumpedLayer> layers, double frequency) {
  const double w = 2.0 * kPi * frequency;
  Complex below = 0.0;  // dynamic stiffness of what lies below a layer's spring
  for (std::size_t i = layers.size(); i-- > 0;) {
    const Complex spring(layers[i].stiffness, w * layers[i].damping);
    const Complex support = i + 1 == layers.size() ? spring : spring * below / (spring + below);
    below = support - w * w * layers[i].mass;
  }
  return 1.0 / below;
}

ReceptanceError receptance_error(std::span<const LumpedLayer> layers, std::span<const double> frequency,
                                 std::span<const Complex> target) {
  ReceptanceError error;
  for (std::size_t i = 0; i < frequency.size(); ++i) {
    const double off = std::abs(std::log(receptance(layers, frequency[i]) / target[i]));
    error.rms += off * off / static_cast<double>(frequency.size());
    if (off > error.worst) error.worst = off, error.worst_frequency = frequency[i];
  }
  error.rms = std::sqrt(error.rms);
  return error;
}

LumpedFit fit_lumped(std::span<const double> frequency, std::span<const Complex> target, int layers) {
  if (layers < 1 || layers > kMostLumpedLayers)
    throw Error(ErrorKind::configuration,
                fmt::format("a lumped track is fitted with 1 to {} layers", kMostLumpedLayers));
  if (frequency.size() != target.size() || 2 * frequency.size() < static_cast<std::size_t>(kOfLayer * layers))
    throw Error(ErrorKind::configuration, "there are fewer frequencies than numbers to fit");
  for (std::size_t i = 0; i < frequency.size(); ++i)
    if (!(frequency[i] > 0.0) || !(std::abs(target[i]) > 0.0) || !std::isfinite(std::abs(target[i])))
      throw Error(ErrorKind::configuration, "a receptance to fit must be finite and not zero, at positive frequencies");

  const Search search(frequency, target);
  Search::Found best;
  const auto attempt = [&](const std::vector<LumpedLayer>& start) {
    Search::Found found = search.from(numbers_of(start));
    if (found.squares < best.squares) best = std::move(found);
  };
  for (const std::vector<LumpedLayer>& start : starts(1.0 / std::abs(target[0]), layers)) attempt(start);
  if (layers > 1) {
    // A light mass upon the best of one layer less.
    const std::vector<LumpedLayer> fewer = fit_lumped(frequency, target, layers - 1).layers;
    for (const double share : {0.01, 0.1}) {
      std::vector<LumpedLayer> start = fewer;
      start.insert(start.begin(), {share * fewer[0].mass, 3.0 * fewer[0].stiffness, 3.0 * fewer[0].damping});
      attempt(start);
    }
  }

  LumpedFit fit;
  fit.layers = layers_of(best.numbers);
  fit.error = receptance_error(fit.layers, frequency, target);
  if (!best.converged) fit.report = {Status::not_converged, 0, 0.0, "the fit of a lumped track did not settle"};
  return fit;
}

}  // namespace treadmark::vehicle
