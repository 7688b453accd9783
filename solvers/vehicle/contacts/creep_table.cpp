// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/vehicle/contacts/creep_table.hpp"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <numbers>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/kalker/contact_solver.hpp"
#include "treadmark/solvers/kalker/normal/hertz.hpp"
#include "treadmark/solvers/vehicle/contacts/cubic_weights.hpp"

namespace treadmark::vehicle {
namespace {

using Triple = std::array<double, 3>;

double length(const Triple& v) { return std::hypot(v[0], v[1], v[2]); }

/// Creepages in units in which the linear theory's forces are about mu F_n, for all ratios of the semi-axes alike.
/// Smooth curves near Kalker's coefficients; they decide where the nodes lie, not what is found there.
Triple creepage_scale(double ratio) {
  const double translation = 2.8 + 1.1 * std::pow(ratio, 0.92);
  const double spin = 0.35 * translation * (std::sqrt(ratio) + 1.0 / std::sqrt(ratio));
  return {translation, translation, spin};
}

/// The ball: a scaled creepage of magnitude r lies at the radius q = s r/(1 + s r).
constexpr double kBallSteepness = 0.5;
double magnitude_at(double q) { return q / (kBallSteepness * (1.0 - q)); }

void check_options(double poisson, const CreepTableOptions& o) {
  constexpr int kMostIntervals = 64, kMostElements = 200;
  const bool sensible = o.intervals >= 2 && o.intervals <= kMostIntervals && o.ratio_intervals >= 2 &&
                        o.ratio_intervals <= kMostIntervals && o.greatest_ratio > 1.0 && o.greatest_ratio <= 1e3 &&
                        o.nx >= 2 && o.nx <= kMostElements && o.ny >= 2 && o.ny <= kMostElements;
  if (!sensible || !(poisson >= 0.0 && poisson <= 0.5))
    throw Error(ErrorKind::configuration, "a table of creep forces with such axes or Poisson's ratio makes no sense");
}

int per_ratio(const CreepTableOptions& o) { return (o.intervals + 2) * (2 * o.intervals + 3) * (o.intervals + 2); }

/// Lengths and loads like those of a wheel, for which the solver's limits are made; they cancel out.
constexpr double kPatchSize = 5e-3, kPatchLoad = 8e4, kPatchFriction = 0.3;  // c [m], F_n [N], mu

/// The exact theory on one grid of elements.
class PatchOnGrid {
 public:
  PatchOnGrid(double poisson, double ratio, int nx, int ny) {
    problem_.material.poisson_1 = problem_.material.poisson_2 = poisson;
    const CombinedMaterial material = combine(problem_.material);
    const double size = kPatchSize / std::sqrt(area_of_elements(nx, ny));
    const kalker::HertzShape shape =
        kalker::hertz_from_semi_axes(size * std::sqrt(ratio), size / std::sqrt(ratio), {true, kPatchLoad}, material);
    problem_.grid = kalker::hertz_grid(shape, nx, ny, 1.0);
    gap_ = kalker::hertz_gap(shape, problem_.grid);
    problem_.gap = gap_;
    problem_.friction.kinetic = kPatchFriction;
    problem_.normal_force = shape.force;
    problem_.approach = shape.approach;
    problem_.normal_model = kalker::NormalModel::elliptic;
    problem_.hertz = shape;
    problem_.regime = kalker::Regime::steady;
    unit_ = kPatchFriction * kPatchLoad / (material.shear_modulus * kPatchSize * kPatchSize);
  }

  Triple solve(const Triple& creepage) {
    problem_.creepage.xi = creepage[0] * unit_;
    problem_.creepage.eta = creepage[1] * unit_;
    problem_.creepage.phi = creepage[2] * unit_ / kPatchSize;
    const kalker::ContactSolution s = solver_.solve(problem_);
    if (s.status != Status::ok)
      throw Error(ErrorKind::numerical,
                  "a contact of the table of creep forces has no solution: " + s.tangential.message);
    // Over what the elements can transmit, which is not quite the load.
    const double bound = kPatchFriction * s.force_n;
    return {s.force_x / bound, s.force_y / bound, s.moment_n / (bound * kPatchSize)};
  }

 private:
  /// Of whole elements over that of the ellipse in which their centres lie. Both are made alike: stiffness goes with
  /// area.
  static double area_of_elements(int nx, int ny) {
    int count = 0;
    for (int iy = 0; iy < ny; ++iy)
      for (int ix = 0; ix < nx; ++ix)
        count += std::hypot((2.0 * ix + 1.0) / nx - 1.0, (2.0 * iy + 1.0) / ny - 1.0) < 1.0 ? 1 : 0;
    return 4.0 * count / (std::numbers::pi * nx * ny);
  }

  kalker::ContactProblem problem_;
  std::vector<double> gap_;
  kalker::ContactSolver solver_;
  double unit_ = 0.0;
};

/// Errors of steady rolling are of first order in the elements' length along x.
class PatchExtrapolated {
 public:
  PatchExtrapolated(double poisson, double ratio, int nx, int ny)
      : coarse_(poisson, ratio, nx, ny), fine_(poisson, ratio, 2 * nx, ny) {}

  Triple solve(const Triple& creepage) {
    const Triple coarse = coarse_.solve(creepage), fine = fine_.solve(creepage);
    Triple f;
    for (std::size_t c = 0; c < 3; ++c) f[c] = 2.0 * fine[c] - coarse[c];
    return f;
  }

 private:
  PatchOnGrid coarse_, fine_;
};

/// Everything slides, in the direction of the creepage: a sum over the ellipse by the midpoint rule.
Triple sliding(double ratio, const Triple& creepage) {
  constexpr int kPoints = 128;
  const double a = std::sqrt(ratio), b = 1.0 / a;
  Triple sum{};
  double pressures = 0.0;
  for (int iy = 0; iy < kPoints; ++iy)
    for (int ix = 0; ix < kPoints; ++ix) {
      const double u = (2.0 * ix + 1.0) / kPoints - 1.0, v = (2.0 * iy + 1.0) / kPoints - 1.0, w = 1.0 - u * u - v * v;
      if (!(w > 0.0)) continue;
      const double p = std::sqrt(w), x = a * u, y = b * v;
      const double slip_x = creepage[0] - creepage[2] * y, slip_y = creepage[1] + creepage[2] * x;
      const double slip = std::hypot(slip_x, slip_y);
      pressures += p;
      if (!(slip > 0.0)) continue;
      sum[0] -= p * slip_x / slip;
      sum[1] -= p * slip_y / slip;
      sum[2] -= p * (x * slip_y - y * slip_x) / slip;
    }
  for (double& value : sum) value /= pressures;
  return sum;
}

double ratio_at(const CreepTableOptions& o, int i) {
  return std::pow(o.greatest_ratio, 2.0 * i / o.ratio_intervals - 1.0);
}

/// Of the creepages from which slopes without creepage are found, in the ball.
constexpr double kVanishing = 1e-3;

}  // namespace

std::array<double, 3> solved_creep(double poisson, double ratio, const std::array<double, 3>& creepage, int nx,
                                   int ny) {
  return PatchExtrapolated(poisson, ratio, nx, ny).solve(creepage);
}

std::shared_ptr<const CreepTable> build_creep_table(
    double poisson, const CreepTableOptions& options,
    const std::function<void(std::size_t finished, std::size_t all)>& report) {
  check_options(poisson, options);
  const int n = options.intervals, layers = n + 2;
  const std::size_t per_layer = static_cast<std::size_t>(per_ratio(options) / layers);
  const std::size_t parts = static_cast<std::size_t>((options.ratio_intervals + 1) * layers);
  std::vector<double> values(3 * per_layer * parts), slopes(9 * static_cast<std::size_t>(options.ratio_intervals + 1));
  std::mutex mutex;
  std::size_t finished = 0;
  // A layer of one spin has solvers of its own: their start values do not depend on threads.
  parallel_for(parts, [&](std::size_t part) {
    const int spin = static_cast<int>(part) % layers;
    const double ratio = ratio_at(options, static_cast<int>(part) / layers);
    const Triple scale = creepage_scale(ratio);
    PatchExtrapolated patch(poisson, ratio, options.nx, options.ny);
    std::size_t at = 3 * per_layer * part;
    for (int lateral = -n - 1; lateral <= n + 1; ++lateral)
      for (int longitudinal = 0; longitudinal <= n + 1; ++longitudinal) {
        check_cancelled();
        Triple place{longitudinal / double(n), lateral / double(n), spin / double(n)}, force{};
        const double q = length(place);
        constexpr double kSurface = 1.0 - 1e-9;
        const double r = q > 0.0 && q < kSurface ? magnitude_at(q) / q : 1.0;
        for (std::size_t c = 0; c < 3; ++c) place[c] *= r / scale[c];
        if (q >= kSurface)
          force = sliding(ratio, place);
        else if (q > 0.0)
          force = patch.solve(place);
        for (const double value : force) values[at++] = value;
      }
    if (spin == 0) {
      auto to = slopes.begin() + 9 * (static_cast<std::ptrdiff_t>(part) / layers);
      for (std::size_t by = 0; by < 3; ++by) {
        Triple place{};
        place[by] = magnitude_at(kVanishing) / scale[by];
        for (const double value : patch.solve(place)) *to++ = value / (kVanishing * n);
      }
    }
    const std::lock_guard lock(mutex);
    ++finished;
    if (report) report(finished, parts);
  });
  return std::make_shared<const CreepTable>(poisson, options, std::move(values), std::move(slopes));
}

std::size_t CreepTable::node(int ratio, int k, int j, int i) const {
  const int n = options_.intervals, across = n + 3;
  return 3 * static_cast<std::size_t>((((ratio + 1) * across + k + 1) * (2 * n + 3) + j + n + 1) * across + i + 1);
}

CreepTable::CreepTable(double poisson, const CreepTableOptions& options, std::vector<double> values,
                       std::vector<double> slopes)
    : poisson_(poisson), options_(options), values_(std::move(values)), slopes_(std::move(slopes)) {
  check_options(poisson, options);
  const int n = options.intervals, ratios = options.ratio_intervals + 1;
  if (values_.size() != static_cast<std::size_t>(3 * per_ratio(options) * ratios) ||
      slopes_.size() != static_cast<std::size_t>(9 * ratios))
    refuse_saved_state("a table of creep forces lacks values");
  for (const std::vector<double>* numbers : {&values_, &slopes_})
    if (!ranges::all_of(*numbers, [](double v) { return std::isfinite(v); }))
      refuse_saved_state("a table of creep forces holds what is no number");
  nodes_.resize(node(ratios + 1, -1, -n - 1, -1));
  std::size_t from = 0;
  for (int ratio = 0; ratio < ratios; ++ratio) {
    for (int k = 0; k <= n + 1; ++k)
      for (int j = -n - 1; j <= n + 1; ++j)
        for (int i = 0; i <= n + 1; ++i)
          for (std::size_t c = 0; c < 3; ++c) nodes_[node(ratio, k, j, i) + c] = values_[from++];
    // Mirror images: the longitudinal creepage turned round, or lateral creepage and spin.
    const auto copy = [&](std::size_t to, std::size_t source, double x, double y) {
      for (std::size_t c = 0; c < 3; ++c) nodes_[to + c] = (c == 0 ? x : y) * nodes_[source + c];
    };
    for (int k = 0; k <= n + 1; ++k)
      for (int j = -n - 1; j <= n + 1; ++j) copy(node(ratio, k, j, -1), node(ratio, k, j, 1), -1.0, 1.0);
    for (int j = -n - 1; j <= n + 1; ++j)
      for (int i = -1; i <= n + 1; ++i) copy(node(ratio, -1, j, i), node(ratio, 1, -j, i), 1.0, -1.0);
  }
  // What the slopes without creepage are above those of the cubic curves.
  corrections_.resize(static_cast<std::size_t>(9 * (ratios + 2)));
  for (int ratio = 0; ratio < ratios; ++ratio)
    for (int by = 0; by < 3; ++by)
      for (int c = 0; c < 3; ++c) {
        const auto i = static_cast<std::size_t>(3 * by + c), at = static_cast<std::size_t>(9 * ratio) + i;
        const bool has = (by == 0) == (c == 0);  // the others vanish by symmetry
        corrections_[at + 9] =
            has ? slopes_[at] - nodes_[node(ratio, by == 2, by == 1, by == 0) + static_cast<std::size_t>(c)] : 0.0;
      }
  // Beyond the ends of the ratios the parabola through the last three.
  const auto extend = [&](std::vector<double>& numbers) {
    const std::size_t block = numbers.size() / static_cast<std::size_t>(ratios + 2);
    for (std::size_t i = 0; i < block; ++i) {
      const auto at = [&](int ratio) -> double& { return numbers[static_cast<std::size_t>(ratio + 1) * block + i]; };
      at(-1) = 3.0 * (at(0) - at(1)) + at(2);
      at(ratios) = 3.0 * (at(ratios - 1) - at(ratios - 2)) + at(ratios - 3);
    }
  };
  extend(nodes_);
  extend(corrections_);
}

NormalisedCreep CreepTable::at(double ratio, const std::array<double, 3>& creepage) const {
  const int n = options_.intervals;
  const double g = std::clamp(ratio, 1.0 / options_.greatest_ratio, options_.greatest_ratio);
  const Triple scale = creepage_scale(g);
  // Solved are longitudinal creepages and spins of one sign.
  const double flip_x = creepage[0] < 0.0 ? -1.0 : 1.0, flip_y = creepage[2] < 0.0 ? -1.0 : 1.0;
  const Triple scaled{flip_x * creepage[0] * scale[0], flip_y * creepage[1] * scale[1],
                      flip_y * creepage[2] * scale[2]};
  const double r = length(scaled);
  // The place in the ball, and how it moves with the scaled creepages: along them by q', across by q/r.
  const double across = kBallSteepness / (1.0 + kBallSteepness * r), along = across * across / kBallSteepness;

  std::array<Weights, 3> w;
  std::array<int, 3> cell{};
  for (std::size_t c = 0; c < 3; ++c) {
    const auto [first, t] = cell_of(n * across * scaled[c], c == 1 ? -n : 0, n - 1);
    cell[c] = first;
    w[c] = weights_at(t);
  }
  const auto [first_ratio, t_ratio] =
      cell_of(0.5 * options_.ratio_intervals * (1.0 + std::log(g) / std::log(options_.greatest_ratio)), 0,
              options_.ratio_intervals - 1);
  const Weights by_ratio = weights_at(t_ratio);

  // Value and derivatives by the three places, of all three forces.
  std::array<Triple, 4> sum{};
  const std::size_t block = node(1, 0, 0, 0) - node(0, 0, 0, 0);
  for (int k = 0; k < 4; ++k) {
    std::array<Triple, 3> in_layer{};
    for (int j = 0; j < 4; ++j) {
      Triple value{}, slope{};
      for (int i = 0; i < 4; ++i) {
        const double* from = &nodes_[node(first_ratio - 1, cell[2] + k - 1, cell[1] + j - 1, cell[0] + i - 1)];
        for (std::size_t c = 0; c < 3; ++c) {
          double f = 0.0;
          for (std::size_t l = 0; l < 4; ++l) f += by_ratio.value[l] * from[l * block + c];
          value[c] += w[0].value[static_cast<std::size_t>(i)] * f;
          slope[c] += w[0].slope[static_cast<std::size_t>(i)] * f;
        }
      }
      for (std::size_t c = 0; c < 3; ++c) {
        in_layer[0][c] += w[1].value[static_cast<std::size_t>(j)] * value[c];
        in_layer[1][c] += w[1].value[static_cast<std::size_t>(j)] * slope[c];
        in_layer[2][c] += w[1].slope[static_cast<std::size_t>(j)] * value[c];
      }
    }
    for (std::size_t c = 0; c < 3; ++c) {
      for (std::size_t d = 0; d < 3; ++d) sum[d][c] += w[2].value[static_cast<std::size_t>(k)] * in_layer[d][c];
      sum[3][c] += w[2].slope[static_cast<std::size_t>(k)] * in_layer[0][c];
    }
  }

  // Forces grow like r - Q r |r|, whose bend in the origin cubic curves between nodes at -1, 0, 1 miss by exactly this.
  const Triple place{n * across * scaled[0], n * across * scaled[1], n * across * scaled[2]};
  if (const double s = length(place); s < 1.0) {
    const double left = (1.0 - s) * (1.0 - s), bend = s > 0.0 ? -2.0 * (1.0 - s) / s : 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      Triple slope{};
      for (std::size_t by = 0; by < 3; ++by)
        for (std::size_t l = 0; l < 4; ++l)
          slope[by] += by_ratio.value[l] * corrections_[9 * (static_cast<std::size_t>(first_ratio) + l) + 3 * by + c];
      const double linear = slope[0] * place[0] + slope[1] * place[1] + slope[2] * place[2];
      sum[0][c] += left * linear;
      for (std::size_t by = 0; by < 3; ++by) sum[by + 1][c] += left * slope[by] + bend * linear * place[by];
    }
  }

  NormalisedCreep out;
  const Triple sign{flip_x, flip_y, flip_y};
  for (std::size_t c = 0; c < 3; ++c) out.force[c] = sign[c] * sum[0][c];
  const Triple direction = r > 0.0 ? Triple{scaled[0] / r, scaled[1] / r, scaled[2] / r} : Triple{};
  for (std::size_t c = 0; c < 2; ++c) {
    double along_creepage = 0.0;
    for (std::size_t d = 0; d < 3; ++d) along_creepage += sum[d + 1][c] * direction[d];
    for (std::size_t d = 0; d < 3; ++d)
      out.slope[c][d] = sign[c] * sign[d] * n * scale[d] *
                        (across * sum[d + 1][c] + (along - across) * along_creepage * direction[d]);
  }
  // Interpolated unit vectors are not quite of unit length.
  const double transmitted = std::hypot(out.force[0], out.force[1]);
  if (transmitted > 1.0) out.force[0] /= transmitted, out.force[1] /= transmitted;
  return out;
}

void CreepTable::save(ByteWriter& out) const {
  out.put(poisson_);
  for (const int count : {options_.intervals, options_.ratio_intervals, options_.nx, options_.ny}) out.put(count);
  out.put(options_.greatest_ratio);
  out.put(values_);
  out.put(slopes_);
}

std::shared_ptr<const CreepTable> CreepTable::read(ByteReader& in) {
  const auto poisson = in.get<double>();
  CreepTableOptions options;
  for (int* count : {&options.intervals, &options.ratio_intervals, &options.nx, &options.ny}) in.get(*count);
  in.get(options.greatest_ratio);
  std::vector<double> values, slopes;
  in.get(values);
  in.get(slopes);
  try {
    return std::make_shared<const CreepTable>(poisson, options, std::move(values), std::move(slopes));
  } catch (const Error&) {
    refuse_saved_state("it is no table of creep forces");
  }
}

CreepForce creep_force(const CreepTable& table, const CreepContact& contact, const CombinedMaterial& material,
                       const wheelrail::ContactKinematics& k) {
  if (!(contact.a > 0.0) || !(contact.b > 0.0))
    throw Error(ErrorKind::configuration, "creep forces need positive semi-axes");
  CreepForce out;
  if (!(k.velocity > 0.0) || !(contact.friction_bound > 0.0)) return out;
  const double size = std::sqrt(contact.a * contact.b),
               unit = contact.friction_bound / (material.shear_modulus * size * size);
  // Backwards is forwards turned about n: creepages change sign, spin does not.
  const double turn = std::cos(k.chi) < 0.0 ? -1.0 : 1.0;
  const NormalisedCreep f =
      table.at(contact.a / contact.b, {turn * k.xi / unit, turn * k.eta / unit, size * k.phi / unit});
  const double bound = contact.friction_bound;
  out.force = turn * bound * Vec2(f.force[0], f.force[1]);
  out.moment = bound * size * f.force[2];
  out.power = std::max(0.0, -k.velocity * (out.force.x() * k.xi + out.force.y() * k.eta + out.moment * k.phi));
  out.damping = -bound / (unit * k.velocity) * Vec2(f.slope[0][0], f.slope[1][1]);
  out.damping = out.damping.cwiseMax(0.0);
  return out;
}

void require_tabulated(const Material& m) {
  const auto refuse = [](const std::string& what) {
    throw Error(ErrorKind::configuration, "creep forces from the table of the exact theory are for " + what, {},
                "leave out simulation.creep_forces, or give the wheels contact = \"full\"");
  };
  constexpr double kAlike = 0.01;
  if (const double difference = combine(m).difference; std::abs(difference) > kAlike)
    refuse(fmt::format("bodies of like elasticity, these differ by K = {:.3g}", difference));
  if (m.layer_flexibility > 0.0 || m.layer_yield > 0.0) refuse("contacts without an interface layer");
  if (m.creep_ratio_1 > 0.0 || m.creep_ratio_2 > 0.0) refuse("elastic bodies");
}

}  // namespace treadmark::vehicle
