// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/solvers/kalker/halfspace/turned_product.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/solvers/kalker/halfspace/element_blocks.hpp"

namespace treadmark::kalker {

namespace {

/// What of the half-space's coefficients is convolved. mean, difference: halves of yy + nn and yy - nn; skew: of yn -
/// ny.
enum class Combination { xx, xy, xn, yx, yy, yn, nx, ny, nn, mean, difference, skew };

double value(const InfluenceBlock& a, Combination combination) {
  switch (combination) {
    case Combination::xx:
      return a.xx;
    case Combination::xy:
      return a.xy;
    case Combination::xn:
      return a.xn;
    case Combination::yx:
      return a.yx;
    case Combination::yy:
      return a.yy;
    case Combination::yn:
      return a.yn;
    case Combination::nx:
      return a.nx;
    case Combination::ny:
      return a.ny;
    case Combination::nn:
      return a.nn;
    case Combination::mean:
      return 0.5 * (a.yy + a.nn);
    case Combination::difference:
      return 0.5 * (a.yy - a.nn);
    case Combination::skew:
      return 0.5 * (a.yn - a.ny);
  }
  return 0.0;
}

bool couples(Combination combination) {
  using enum Combination;
  return combination == xn || combination == yn || combination == nx || combination == ny || combination == skew;
}

enum Axis : std::size_t { kX, kY, kN };

/// Part of a coefficient: a combination times a function of the difference of inclinations.
struct Part {
  Axis displacement, traction;
  Combination combination;
  RowFactor function;
  double weight = 1.0;
};

/// A part, its function of a difference of angles written as products of functions of both.
struct Term {
  Axis displacement;
  RowFactor observed;
  Axis traction;
  RowFactor loaded;
  std::size_t combination;
  double weight;
};

std::vector<Part> parts_of_rotated_loads(bool but_xn) {
  using enum Combination;
  using enum RowFactor;
  std::vector<Part> parts{{kX, kX, xx, one},       {kX, kY, xy, cosine}, {kX, kY, xn, sine},   {kY, kX, yx, one},
                          {kY, kY, yy, cosine},    {kY, kY, yn, sine},   {kY, kN, yn, cosine}, {kY, kN, yy, sine, -1.0},
                          {kN, kX, nx, one},       {kN, kY, ny, cosine}, {kN, kY, nn, sine},   {kN, kN, nn, cosine},
                          {kN, kN, ny, sine, -1.0}};
  if (but_xn)
    parts.push_back({kX, kN, xn, one});
  else
    parts.insert(parts.end(), {{kX, kN, xn, cosine}, {kX, kN, xy, sine, -1.0}});
  return parts;
}

std::vector<Part> parts_of_rotated_displacements() {
  using enum Combination;
  using enum RowFactor;
  return {{kX, kX, xx, one},        {kX, kY, xy, one},    {kX, kN, xn, one},        {kY, kX, yx, cosine},
          {kY, kX, nx, sine, -1.0}, {kY, kY, yy, cosine}, {kY, kY, ny, sine, -1.0}, {kY, kN, yn, cosine},
          {kY, kN, nn, sine, -1.0}, {kN, kX, nx, cosine}, {kN, kX, yx, sine},       {kN, kY, ny, cosine},
          {kN, kY, yy, sine},       {kN, kN, nn, cosine}, {kN, kN, yn, sine}};
}

std::vector<Part> parts_of_half_and_half() {
  using enum Combination;
  using enum RowFactor;
  return {{kX, kX, xx, one},
          {kX, kY, xy, half_cosine},
          {kX, kY, xn, half_sine},
          {kX, kN, xn, half_cosine},
          {kX, kN, xy, half_sine, -1.0},
          {kY, kX, yx, half_cosine},
          {kY, kX, nx, half_sine, -1.0},
          {kN, kX, nx, half_cosine},
          {kN, kX, yx, half_sine},
          {kY, kY, difference, one},
          {kY, kY, mean, cosine},
          {kY, kY, skew, sine},
          {kN, kN, difference, one, -1.0},
          {kN, kN, mean, cosine},
          {kN, kN, skew, sine},
          {kY, kN, skew, cosine},
          {kY, kN, mean, sine, -1.0},
          {kN, kY, skew, cosine, -1.0},
          {kN, kY, mean, sine}};
}

std::vector<Part> parts_of(AngleCorrection correction) {
  switch (correction) {
    case AngleCorrection::rotated_loads:
      return parts_of_rotated_loads(false);
    case AngleCorrection::rotated_loads_but_xn:
      return parts_of_rotated_loads(true);
    case AngleCorrection::rotated_displacements:
      return parts_of_rotated_displacements();
    case AngleCorrection::half_and_half:
      break;
  }
  return parts_of_half_and_half();
}

/// The difference is the loaded row's angle minus that of the observed one.
std::vector<Term> terms_of(const std::vector<Part>& parts) {
  std::vector<Term> terms;
  for (const Part& part : parts) {
    const auto add = [&](RowFactor observed, RowFactor loaded, double sign) {
      terms.push_back({part.displacement, observed, part.traction, loaded, static_cast<std::size_t>(part.combination),
                       sign * part.weight});
    };
    using enum RowFactor;
    switch (part.function) {
      case one:
        add(one, one, 1.0);
        break;
      case cosine:
        add(cosine, cosine, 1.0), add(sine, sine, 1.0);
        break;
      case sine:
        add(cosine, sine, 1.0), add(sine, cosine, -1.0);
        break;
      case half_cosine:
        add(half_cosine, half_cosine, 1.0), add(half_sine, half_sine, 1.0);
        break;
      case half_sine:
        add(half_cosine, half_sine, 1.0), add(half_sine, half_cosine, -1.0);
        break;
    }
  }
  return terms;
}

}  // namespace

TurnedProduct::TurnedProduct(ToeplitzTransform transform, HalfSpace half_space, bool coupled)
    : transform_(std::move(transform)),
      half_space_(std::move(half_space)),
      coupled_(coupled),
      sum_(transform_.spectrum_size()),
      result_(transform_.rows_size()) {}

const Spectrum& TurnedProduct::kernel(std::size_t combination) {
  Spectrum& known = kernels_[combination];
  if (known.empty())
    known = transform_.kernel_spectrum(
        [&](int dix, int diy) { return value(half_space_(dix, diy), static_cast<Combination>(combination)); });
  return known;
}

void TurnedProduct::load(const TractionFields& p, std::span<const std::complex<double>> along_rows) {
  const std::array<std::span<const double>, 3> fields{p.x, p.y, p.n};
  for (std::size_t axis = 0; axis < fields.size(); ++axis) {
    if (fields[axis].empty()) continue;
    Spectrum& rows = rows_[axis];
    rows.resize(transform_.rows_size());
    transform_.forward_rows(fields[axis], rows);
    for (std::size_t first = 0; first < rows.size() && !along_rows.empty(); first += along_rows.size())
      multiply(std::span(rows).subspan(first, along_rows.size()), along_rows);
  }
}

void TurnedProduct::apply(const RowInclination& rows, const TractionFields& p, const DisplacementFields& u,
                          std::span<const std::complex<double>> along_rows) {
  if (rows.size() != static_cast<std::size_t>(transform_.ny()))
    throw Error(ErrorKind::configuration, "a box of " + std::to_string(transform_.ny()) + " rows was given " +
                                              std::to_string(rows.size()) + " inclinations");
  const std::array<std::span<double>, 3> wanted{u.x, u.y, u.n};
  const std::array<bool, 3> given{!p.x.empty(), !p.y.empty(), !p.n.empty()};
  std::vector<Part> parts = parts_of(rows.correction());
  std::erase_if(parts, [&](const Part& part) {
    return !given[part.traction] || wanted[part.displacement].empty() || (!coupled_ && couples(part.combination));
  });
  const std::vector<Term> terms = terms_of(parts);

  load(p, along_rows);
  std::array<std::array<bool, kRowFactors>, 3> loaded{};
  for (const Term& term : terms) {
    const auto factor = static_cast<std::size_t>(term.loaded);
    if (std::exchange(loaded[term.traction][factor], true)) continue;
    Spectrum& spectrum = loads_[term.traction][factor];
    spectrum.resize(transform_.spectrum_size());
    transform_.forward_columns(rows_[term.traction], rows.values(term.loaded), spectrum);
  }
  for (const Axis axis : {kX, kY, kN}) {
    if (wanted[axis].empty()) continue;
    clear(std::span(result_));
    for (std::size_t factor = 0; factor < kRowFactors; ++factor) {
      bool any = false;
      for (const Term& term : terms) {
        if (term.displacement != axis || static_cast<std::size_t>(term.observed) != factor) continue;
        if (!std::exchange(any, true)) clear(std::span(sum_));
        add_product(sum_, loads_[term.traction][static_cast<std::size_t>(term.loaded)], kernel(term.combination),
                    term.weight);
      }
      if (any) transform_.add_inverse_columns(sum_, rows.values(static_cast<RowFactor>(factor)), result_);
    }
    transform_.inverse_rows(result_, wanted[axis]);
  }
}

}  // namespace treadmark::kalker
