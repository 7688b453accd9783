// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include "treadmark/solvers/vehicle/contacts/contact_table.hpp"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "treadmark/core/error.hpp"
#include "treadmark/core/line.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::vehicle {

namespace {

using Columns = std::vector<ContactTableColumn>;

void require(bool holds, const char* message) {
  if (!holds) throw Error(ErrorKind::configuration, message);
}

const Columns& checked(const Columns& columns, const std::vector<double>& loads, std::size_t reference_level) {
  require(columns.size() >= 2, "a contact table needs two lateral positions or more");
  require(!loads.empty() && loads.front() > 0.0 && std::isfinite(loads.back()) &&
              ranges::is_sorted(loads, std::less_equal<>{}),
          "the loads of a contact table must be positive and increase");
  require(reference_level < loads.size(), "a contact table has no such reference level");
  for (const ContactTableColumn& column : columns) {
    require(column.under.size() == loads.size(), "every lateral position of a contact table needs all loads");
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const ContactUnderLoad& c = column.under[k];
      require(c.elastic_energy > 0.0 && c.area > 0.0 && c.aspect_ratio > 0.0,
              "energy, area and aspect ratio of a contact table must be positive");
      require(k == 0 || c.z > column.under[k - 1].z, "the wheel of a contact table must sink as the load grows");
    }
  }
  return columns;
}

template <class Value>
std::vector<double> along(const Columns& columns, Value&& value) {
  std::vector<double> values;
  for (const ContactTableColumn& column : columns) values.push_back(value(column));
  return values;
}

std::vector<double> positions(const Columns& columns) {
  return along(columns, [](const ContactTableColumn& column) { return column.y; });
}

template <class Value>
ShapeCurve curve(const Columns& columns, Value&& value) {
  return ShapeCurve::monotone(positions(columns), along(columns, value));
}

ShapeCurve curve(const Columns& columns, std::size_t level, double ContactUnderLoad::*member) {
  return curve(columns, [&](const ContactTableColumn& column) { return column.under[level].*member; });
}

ShapeCurve heights_less_energy(const Columns& columns, double load) {
  return {positions(columns),
          along(columns, [&](const ContactTableColumn& c) { return c.under[0].z - c.under[0].elastic_energy / load; }),
          along(columns, [](const ContactTableColumn& c) { return c.under[0].slope; })};
}

LoadLevel load_level(const Columns& columns, std::size_t level, double load) {
  const auto compression = [&](const ContactTableColumn& c) {
    // Up to the first load like Hertz: the approach that has this energy.
    return level == 0 ? 2.5 * c.under[0].elastic_energy / load : c.under[level].z - c.under[level - 1].z;
  };
  return {load, curve(columns, compression), curve(columns, level, &ContactUnderLoad::area),
          curve(columns, [&](const ContactTableColumn& c) { return std::log(c.under[level].aspect_ratio); })};
}

}  // namespace

ContactTable::ContactTable(const Columns& columns, const std::vector<double>& loads, std::size_t reference_level,
                           wheelrail::Problem problem, const wheelrail::Placement& nominal)
    : y_min_(checked(columns, loads, reference_level).front().y),
      y_max_(columns.back().y),
      problem_(std::move(problem)),
      nominal_(nominal),
      energy_height_(heights_less_energy(columns, loads.front())),
      wheel_y_(curve(columns, reference_level, &ContactUnderLoad::wheel_y)),
      wheel_z_(curve(columns, reference_level, &ContactUnderLoad::wheel_z)) {
  for (std::size_t k = 0; k < loads.size(); ++k) levels_.push_back(load_level(columns, k, loads[k]));
}

namespace {

[[noreturn]] void refuse(std::string message, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), {}, std::move(advice));
}

void check(const wheelrail::Geometry& geometry, const wheelrail::Problem& p, double load,
           const ContactTableOptions& options) {
  if (!geometry.constant_profiles())
    refuse("a contact table needs a round wheel on a prismatic rail",
           "use an element that solves the contact of these surfaces");
  if (p.side != wheelrail::Side::right)
    refuse("a contact table is made for the right-hand side", "it serves the left-hand side as it is");
  if (p.track.curvature != 0.0) refuse("a contact table is made for straight track");
  if (p.roller) refuse("a contact table knows no rollers");
  if (!(load > 0.0) || !std::isfinite(load))
    refuse("the reference load of a contact table must be positive and finite");
  for (const double length : {options.lateral_range, options.step, options.element_size})
    if (!(length > 0.0) || !std::isfinite(length))
      refuse("range, step and element size of a contact table must be positive and finite");
  const std::vector<double>& loads = options.relative_loads;
  if (loads.empty() || !(loads.front() > 0.0) || !std::isfinite(loads.back()) ||
      !ranges::is_sorted(loads, std::less_equal<>{}))
    refuse("the relative loads of a contact table must be positive and increase");
  constexpr double kMostSteps = 5000.0;
  if (!(options.step <= options.lateral_range) || options.lateral_range / options.step > kMostSteps)
    refuse(fmt::format("a contact table over +-{:.6g} mm cannot have a step of {:.6g} mm", 1e3 * options.lateral_range,
                       1e3 * options.step));
}

struct PatchShape {
  double area = 0.0, aspect_ratio = 1.0;
};

/// From integrals over the pressures, which do not change in jumps as a count of elements does. For an ellipsoid p_0
/// sqrt(1 - r^2) the squared mean of sqrt(p) is 24/25 of the mean of p, and the second moments are a^2/5 and b^2/5.
PatchShape patch_shape(const wheelrail::PatchSolution& patch) {
  double sum = 0.0, sum_of_roots = 0.0;
  Vec2 centre = Vec2::Zero(), second = Vec2::Zero();
  for (int iy = 0; iy < patch.grid.ny; ++iy)
    for (int ix = 0; ix < patch.grid.nx; ++ix) {
      const double p = patch.contact.pressure[patch.grid.index(ix, iy)];
      const Vec2 place(patch.grid.x(ix), patch.grid.y(iy));
      sum += p;
      sum_of_roots += std::sqrt(p);
      centre += p * place;
      second += p * place.cwiseAbs2();
    }
  centre /= sum;
  second = second / sum - centre.cwiseAbs2();
  // A single row or column of elements has an extent of its own.
  second += Vec2(patch.grid.dx * patch.grid.dx, patch.grid.dy * patch.grid.dy) / 1e3;
  return {25.0 / 24.0 * sum_of_roots * sum_of_roots / sum * patch.grid.cell_area(), std::sqrt(second.x() / second.y())};
}

ContactUnderLoad under_load(double y, double load, const wheelrail::PairSolution& s, const Vec3& wheel_origin) {
  ContactUnderLoad c;
  c.z = s.z;
  double height = 0.0, normal_force = 0.0, log_aspect = 0.0;
  for (const wheelrail::PatchSolution& patch : s.patches) {
    const double force = patch.contact.force_n;
    const PatchShape shape = patch_shape(patch);
    c.elastic_energy += patch.contact.elastic_energy;
    height += force * patch.frame.X_TC.origin.z();
    log_aspect += force * std::log(shape.aspect_ratio);
    normal_force += force;
    c.area += shape.area;
  }
  c.aspect_ratio = std::exp(log_aspect / normal_force);
  const Vec3& force = s.load.track.force;
  const Vec3& marker = s.placement.X_TR.origin;
  c.slope = -force.y() / force.z();
  // On the line of action of the resultant, at the mean height of the patches on the rail; the wheel lies deeper by the
  // approach.
  const double z = height / normal_force;
  const double place_y = marker.y() + (s.load.track.moment.x() + (z - marker.z()) * force.y()) / force.z();
  const double to_wheel = 2.5 * c.elastic_energy / load / (1.0 + c.slope * c.slope);
  c.wheel_y = place_y - c.slope * to_wheel - (wheel_origin.y() + y);
  c.wheel_z = z + to_wheel - (wheel_origin.z() + s.z);
  return c;
}

struct Attempt {
  ContactTableColumn column;
  bool solved = true;
  std::string message;
};

class Builder {
 public:
  Builder(const wheelrail::Geometry& geometry, const wheelrail::Problem& rest, const wheelrail::Placement& nominal,
          std::vector<double> loads)
      : geometry_(geometry), rest_(rest), wheel_origin_(nominal.X_TW.origin), loads_(std::move(loads)) {}

  std::vector<Attempt> solve(const std::vector<double>& y) const {
    std::vector<Attempt> attempts(y.size());
    parallel_for(y.size(), [&](std::size_t i) { attempts[i] = attempt(y[i]); });
    return attempts;
  }

 private:
  Attempt attempt(double y) const {
    Attempt a;
    a.column.y = y;
    wheelrail::Problem p = rest_;
    p.state.position.y = y;
    wheelrail::Pair pair(geometry_);
    for (const double load : loads_) {
      p.vertical_force = load;
      const wheelrail::PairSolution s = pair.solve(p);
      const bool sinks = a.column.under.empty() || s.z > a.column.under.back().z;
      a.solved = s.status == Status::ok && !s.patches.empty() && sinks;
      a.message = s.message;
      if (!a.solved) break;
      a.column.under.push_back(under_load(y, load, s, wheel_origin_));
    }
    return a;
  }

  const wheelrail::Geometry& geometry_;
  const wheelrail::Problem& rest_;
  Vec3 wheel_origin_;
  std::vector<double> loads_;
};

/// Those round the central one that have a solution, without a gap.
std::vector<ContactTableColumn> connected(const std::vector<Attempt>& attempts, std::size_t centre) {
  if (!attempts[centre].solved)
    throw Error(ErrorKind::numerical,
                "wheel and rail have no contact in their central position: " + attempts[centre].message, {},
                "check gauge, flange-back distance and profiles; smooth those that were measured");
  std::size_t first = centre, last = centre;
  while (first > 0 && attempts[first - 1].solved) --first;
  while (last + 1 < attempts.size() && attempts[last + 1].solved) ++last;
  std::vector<ContactTableColumn> columns;
  for (std::size_t i = first; i <= last; ++i) columns.push_back(attempts[i].column);
  return columns;
}

bool angles_differ_much(const ContactTableColumn& a, const ContactTableColumn& b) {
  constexpr double kMostChange = 0.04;  // of the tangent
  for (std::size_t k = 0; k < a.under.size(); ++k)
    if (std::abs(b.under[k].slope - a.under[k].slope) > kMostChange) return true;
  return false;
}

/// Columns between those whose contact angles differ much.
void refine(const Builder& builder, std::vector<ContactTableColumn>& columns) {
  std::vector<double> between;
  for (std::size_t i = 0; i + 1 < columns.size(); ++i)
    if (angles_differ_much(columns[i], columns[i + 1])) between.push_back(0.5 * (columns[i].y + columns[i + 1].y));
  for (const Attempt& a : builder.solve(between))
    if (a.solved) columns.push_back(a.column);
  ranges::sort(columns, {}, &ContactTableColumn::y);
}

}  // namespace

wheelrail::Problem table_problem(wheelrail::Problem p, const ContactTableOptions& options) {
  p.state = {};
  wheelrail::Track& t = p.track;
  t.dy = t.dz = t.roll = t.vy = t.vz = t.vroll = 0.0;
  p.regime = kalker::Regime::frictionless;
  p.reference_surface = wheelrail::ReferenceSurface::plane;
  p.normal_model = kalker::NormalModel::full;
  p.history = kalker::HistoryUse::start;
  p.longitudinal_force.reset();
  p.rail_springs.reset();
  p.damping.reset();
  p.thermal.reset();
  p.sensitivities = false;
  p.discretisation.dx = p.discretisation.ds = options.element_size;
  return p;
}

namespace {

std::vector<double> loads_of(double reference_load, const ContactTableOptions& options) {
  std::vector<double> loads;
  for (const double relative : options.relative_loads) loads.push_back(relative * reference_load);
  return loads;
}

}  // namespace

std::vector<ContactTableColumn> solve_contact_columns(const wheelrail::Geometry& geometry,
                                                      const wheelrail::Problem& prototype, double reference_load,
                                                      const ContactTableOptions& options) {
  check(geometry, prototype, reference_load, options);
  const wheelrail::Problem rest = table_problem(prototype, options);
  const wheelrail::Placement nominal = wheelrail::place(geometry, rest);
  const Builder builder(geometry, rest, nominal, loads_of(reference_load, options));

  constexpr double kRounding = 1e-9;
  const auto each_way = to_whole<std::size_t>(options.lateral_range / options.step + kRounding);
  std::vector<double> y;
  for (std::size_t i = 0; i <= 2 * each_way; ++i)
    y.push_back(options.step * (static_cast<double>(i) - static_cast<double>(each_way)));
  std::vector<ContactTableColumn> columns = connected(builder.solve(y), each_way);
  constexpr int kRefinements = 3;
  for (int i = 0; i < kRefinements; ++i) refine(builder, columns);
  return columns;
}

std::shared_ptr<const ContactTable> contact_table_of(const std::vector<ContactTableColumn>& columns,
                                                     const wheelrail::Geometry& geometry,
                                                     const wheelrail::Problem& prototype, double reference_load,
                                                     const ContactTableOptions& options) {
  const wheelrail::Problem rest = table_problem(prototype, options);
  const auto nearest =
      ranges::min_element(options.relative_loads, {}, [](double relative) { return std::abs(relative - 1.0); });
  return std::make_shared<ContactTable>(columns, loads_of(reference_load, options),
                                        static_cast<std::size_t>(nearest - options.relative_loads.begin()), rest,
                                        wheelrail::place(geometry, rest));
}

std::shared_ptr<const ContactTable> build_contact_table(const wheelrail::Geometry& geometry,
                                                        const wheelrail::Problem& prototype, double reference_load,
                                                        const ContactTableOptions& options) {
  return contact_table_of(solve_contact_columns(geometry, prototype, reference_load, options), geometry, prototype,
                          reference_load, options);
}

void write_columns(const std::vector<ContactTableColumn>& columns, ByteWriter& out) {
  out.put(columns.size());
  for (const auto& [y, under] : columns) {
    out.put(y);
    out.put(under.size());
    for (const auto& [z, energy, slope, wheel_y, wheel_z, area, aspect_ratio] : under)
      for (const double value : {z, energy, slope, wheel_y, wheel_z, area, aspect_ratio}) out.put(value);
  }
}

std::vector<ContactTableColumn> read_columns(ByteReader& in) {
  std::vector<ContactTableColumn> columns;
  for (auto count = in.get<std::size_t>(); count > 0; --count) {
    ContactTableColumn& column = columns.emplace_back();
    in.get(column.y);
    for (auto loads = in.get<std::size_t>(); loads > 0; --loads) {
      ContactUnderLoad& c = column.under.emplace_back();
      for (double* value : {&c.z, &c.elastic_energy, &c.slope, &c.wheel_y, &c.wheel_z, &c.area, &c.aspect_ratio})
        in.get(*value);
    }
  }
  return columns;
}

namespace {

void require_points(const std::vector<double>& x, std::size_t values) {
  if (x.size() < 2 || values != x.size() || ranges::adjacent_find(x, std::greater_equal<>{}) != x.end())
    throw Error(ErrorKind::configuration, "a curve needs two points or more, in increasing order");
}

/// Harmonic mean of the neighbouring chords' slopes, weighted by their lengths; 0 at an extremum.
double mean_slope(double before, double after, double length_before, double length_after) {
  if (!(before * after > 0.0)) return 0.0;
  const double share = (length_before + 2.0 * length_after) / (3.0 * (length_before + length_after));
  return before * after / (share * after + (1.0 - share) * before);
}

}  // namespace

ShapeCurve::ShapeCurve(std::vector<double> x, std::vector<double> value, std::vector<double> slope)
    : x_(std::move(x)), value_(std::move(value)), slope_(std::move(slope)) {
  require_points(x_, value_.size());
  require_points(x_, slope_.size());
}

ShapeCurve ShapeCurve::monotone(std::vector<double> x, std::vector<double> value) {
  require_points(x, value.size());
  const std::size_t last = x.size() - 1;
  const auto chord = [&](std::size_t i) { return (value[i + 1] - value[i]) / (x[i + 1] - x[i]); };
  std::vector<double> slope(x.size());
  slope.front() = chord(0);
  slope.back() = chord(last - 1);
  for (std::size_t i = 1; i < last; ++i)
    slope[i] = mean_slope(chord(i - 1), chord(i), x[i] - x[i - 1], x[i + 1] - x[i]);
  return {std::move(x), std::move(value), std::move(slope)};
}

ShapeCurve::Point ShapeCurve::at(double x) const {
  if (x <= x_.front()) return {value_.front() + slope_.front() * (x - x_.front()), slope_.front()};
  if (x >= x_.back()) return {value_.back() + slope_.back() * (x - x_.back()), slope_.back()};
  const std::size_t i = piece_at(x_, x);
  const double length = x_[i + 1] - x_[i], chord = (value_[i + 1] - value_[i]) / length, first = slope_[i],
               last = slope_[i + 1];
  // The slope runs straight from its first value to 'middle' at the share 'knot' of the way, and on to its last value;
  // the area below it is the chord's.
  double knot = 0.5, middle = 2.0 * chord - 0.5 * (first + last);
  if ((first - chord) * (last - chord) < 0.0) {
    knot = (last - chord) / (last - first);
    middle = chord;
  }
  const double share = (x - x_[i]) / length;
  if (share <= knot) {
    const double slope = first + (middle - first) * share / knot;
    return {value_[i] + 0.5 * (first + slope) * share * length, slope};
  }
  const double rest = 1.0 - share, slope = last + (middle - last) * rest / (1.0 - knot);
  return {value_[i + 1] - 0.5 * (last + slope) * rest * length, slope};
}

}  // namespace treadmark::vehicle
