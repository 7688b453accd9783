// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "chebyshev_backend.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "chebyshev_series.hpp"
#include "treadmark/backends/displacement/displaced_surface.hpp"
#include "treadmark/backends/registry.hpp"
#include "treadmark/backends/undamaged_base.hpp"
#include "treadmark/core/error.hpp"

namespace {

using namespace treadmark;

constexpr const char* kName = "chebyshev";
constexpr double kTurn = 2.0 * std::numbers::pi;

/// Sum of products a(u) b(y): the offsets that are added to z of a rail, to the radius of a wheel.
class SeriesField final : public displacement::OffsetField {
 public:
  struct Term {
    ChebyshevSeries along, across;
  };
  explicit SeriesField(std::vector<Term> terms) : terms_(std::move(terms)) {}

  displacement::OffsetJet jet(double u, double y) const override {
    displacement::OffsetJet sum;
    for (const Term& term : terms_) {
      const auto a = term.along.jet(u), b = term.across.jet(y);
      sum.value += a.value * b.value;
      sum.d_u += a.slope * b.value;
      sum.d_y += a.value * b.slope;
      sum.d_uu += a.bend * b.value;
      sum.d_uy += a.slope * b.slope;
      sum.d_yy += a.value * b.bend;
    }
    return sum;
  }

  displacement::OffsetRange range(const Rectangle& uy) const override {
    displacement::OffsetRange sum;
    for (const Term& term : terms_) {
      const auto a = term.along.range(uy.x_min, uy.x_max), b = term.across.range(uy.y_min, uy.y_max);
      const auto [low, high] = std::minmax({a.low * b.low, a.low * b.high, a.high * b.low, a.high * b.high});
      sum.low += low;
      sum.high += high;
      sum.max_d_u += a.steepest * std::max(std::fabs(b.low), std::fabs(b.high));
      sum.max_d_y += b.steepest * std::max(std::fabs(a.low), std::fabs(a.high));
    }
    return sum;
  }

  std::size_t memory_bytes() const override {
    std::size_t sum = sizeof(*this);
    for (const Term& term : terms_) sum += term.along.memory_bytes() + term.across.memory_bytes();
    return sum;
  }

 private:
  std::vector<Term> terms_;
};

/// The plane in which the section at u is a row along x, and heights are z of a rail or the radius of a wheel.
Pose section_plane(Body body, double u) {
  const double sine = body == Body::wheel ? std::sin(u) : 0.0, cosine = body == Body::wheel ? std::cos(u) : 1.0;
  Pose X_SP;
  X_SP.origin = body == Body::wheel ? Vec3::Zero() : Vec3(u, 0.0, 0.0);
  X_SP.rotation.col(0) = Vec3::UnitY();
  X_SP.rotation.col(1) = Vec3(-cosine, 0.0, sine);
  X_SP.rotation.col(2) = Vec3(sine, 0.0, cosine);
  return X_SP;
}

/// Differences of two surfaces, row by row; index = iu * number of y + iy.
struct Differences {
  std::vector<double> u, y, values;
};

Differences sample(const Surface& surface, const Surface& base, Body body, std::vector<double> u,
                   std::vector<double> y) {
  Differences d{std::move(u), std::move(y), {}};
  std::vector<Vec2> row;
  for (const double v : d.y) row.push_back({v, 0.0});
  std::vector<double> top(row.size()), below(row.size());
  std::size_t missing = 0;
  for (const double station : d.u) {
    const Pose X_SP = section_plane(body, station);
    surface.heights_at(X_SP, row, {top, {}, {}});
    base.heights_at(X_SP, row, {below, {}, {}});
    const auto known = [&](std::size_t j) { return !std::isnan(top[j] - below[j]); };
    for (std::size_t j = 0; j < row.size(); ++j) {
      // at the rim, where one of the two may end a little earlier, the nearest difference goes on
      std::size_t k = 0;
      while (k < row.size() && !(j >= k && known(j - k)) && !(j + k < row.size() && known(j + k))) ++k;
      missing += k > 0 ? 1 : 0;
      const std::size_t nearest = k == row.size() ? j : j >= k && known(j - k) ? j - k : j + k;
      d.values.push_back(k == row.size() ? 0.0 : top[nearest] - below[nearest]);
    }
  }
  constexpr double kMostMissing = 0.02;
  if (static_cast<double>(missing) > kMostMissing * static_cast<double>(d.values.size()))
    throw Error(ErrorKind::input_data, "a Chebyshev series cannot represent surfaces with gaps", {},
                "use the backend 'mesh'");
  return d;
}

/// Cross approximation with full pivoting: Gaussian elimination stopped when nothing is left (A. Townsend and
/// L. N. Trefethen, An extension of Chebfun to two dimensions, 2013). rest: the largest difference that is left [m].
std::vector<SeriesField::Term> low_rank(Differences d, const Rectangle& region, double period, double& rest) {
  constexpr double kNothing = 1e-8, kNegligible = 1e-9;  // [m]
  constexpr std::size_t kMostTerms = 24;
  const std::size_t rows = d.u.size(), columns = d.y.size();
  std::vector<SeriesField::Term> terms;
  const auto smaller = [](double a, double b) { return std::fabs(a) < std::fabs(b); };
  while (true) {
    const auto pivot = std::max_element(d.values.begin(), d.values.end(), smaller);
    rest = std::fabs(*pivot);
    if (rest <= kNothing || terms.size() == kMostTerms) return terms;
    const auto at = static_cast<std::size_t>(pivot - d.values.begin());
    const double divisor = *pivot;
    std::vector<double> along(rows), across(columns);
    for (std::size_t i = 0; i < rows; ++i) along[i] = d.values[i * columns + at % columns];
    for (std::size_t j = 0; j < columns; ++j) across[j] = d.values[at - at % columns + j] / divisor;
    for (std::size_t i = 0; i < rows; ++i)
      for (std::size_t j = 0; j < columns; ++j) d.values[i * columns + j] -= along[i] * across[j];
    terms.push_back({ChebyshevSeries(region.x_min, region.x_max, along, period, kNegligible),
                     ChebyshevSeries(region.y_min, region.y_max, across, 0.0, kNegligible / std::fabs(divisor))});
  }
}

/// So many nodes that none are farther apart than the resolution: in the middle they are pi/2 times as far as on
/// average.
std::size_t node_count(double length, double resolution) {
  return 8 + static_cast<std::size_t>(std::ceil(0.5 * std::numbers::pi * length / resolution));
}

std::shared_ptr<const Surface> as_chebyshev(Resampling& resampling) {
  const SurfaceSpec& spec = resampling.spec();
  const bool wheel = spec.body == Body::wheel;
  const UndamagedBase base = undamaged_base(resampling);
  Rectangle region = base.region_uy;
  const Box3 box = base.surface->bounds();
  region.y_min = std::max(region.y_min, box.min.y());
  region.y_max = std::min(region.y_max, box.max.y());
  const double length = region.x_max - region.x_min, width = region.y_max - region.y_min;
  if (!std::isfinite(length) || (wheel && !(length < kTurn)))
    throw Error(ErrorKind::configuration, "a Chebyshev series cannot go all round a wheel", {},
                "limit the region, or use the backend 'offset'");
  constexpr double kMostNodes = 2e7;
  const std::size_t n_u = node_count(wheel ? length * spec.nominal_radius : length, resampling.resolution());
  const std::size_t n_y = node_count(std::max(0.0, width), resampling.resolution());
  if (static_cast<double>(n_u) * static_cast<double>(n_y) > kMostNodes)
    throw Error(ErrorKind::configuration, "a Chebyshev series of so many nodes is not of use", {},
                "choose a larger resolution or a smaller region");
  std::vector<SeriesField::Term> terms;
  if (length > 0.0 && width > 0.0) {
    double rest = 0.0;
    terms = low_rank(
        sample(resampling.surface(), *base.surface, spec.body, ChebyshevSeries::nodes(region.x_min, region.x_max, n_u),
               ChebyshevSeries::nodes(region.y_min, region.y_max, n_y)),
        region, wheel ? kTurn : 0.0, rest);
    resampling.add_note(std::to_string(terms.size()) + " Chebyshev terms leave " + std::to_string(1e6 * rest) +
                        " um at the nodes. ");
  }
  return displacement::make_displaced_surface(base.surface, std::make_shared<const SeriesField>(std::move(terms)),
                                              spec.body, kName);
}

}  // namespace

void register_chebyshev() {
  Backend row;
  row.name = kName;
  row.summary = "the undamaged surface and a truncated Chebyshev series of low rank";
  row.order = 3.0;  // of defects that end smoothly; more where nothing ends
  row.over_base = true;
  row.resample = as_chebyshev;
  register_backend(std::move(row));
}
