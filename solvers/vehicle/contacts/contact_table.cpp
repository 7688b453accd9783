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

#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parallel.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/solvers/wheelrail/pair.hpp"

namespace treadmark::vehicle {

namespace {

using Columns = ContactTableColumns;

constexpr const char* kTooManyLoads = "a contact table has eight loads at most";

void require(bool holds, const char* message) {
  if (!holds) throw Error(ErrorKind::configuration, message);
}

constexpr double ContactUnderLoad::*kNumbers[] = {&ContactUnderLoad::z, &ContactUnderLoad::elastic_energy,
                                                  &ContactUnderLoad::slope, &ContactUnderLoad::wheel_y,
                                                  &ContactUnderLoad::wheel_z};
constexpr double ContactPart::*kPartNumbers[] = {&ContactPart::share,   &ContactPart::angle, &ContactPart::wheel_y,
                                                 &ContactPart::wheel_z, &ContactPart::area,  &ContactPart::log_aspect};

bool is_finite(const ContactUnderLoad& c) {
  return ranges::all_of(kNumbers, [&](auto number) { return std::isfinite(c.*number); }) &&
         ranges::all_of(c.parts, [](const ContactPart& part) {
           return ranges::all_of(kPartNumbers, [&](auto number) { return std::isfinite(part.*number); });
         });
}

constexpr double kSteepest = 100.0;  // tangent of a contact angle

bool is_a_contact(const ContactPart& part) {
  constexpr double kLongest = 1e4;  // of a semi-axis over the other one
  return std::abs(std::tan(part.angle)) <= kSteepest && std::abs(part.angle) < 0.5 * kPi &&
         std::abs(part.log_aspect) <= std::log(kLongest);
}

void check(const Columns& columns, const std::vector<double>& loads, std::size_t reference_level) {
  require(columns.size() >= 2, "a contact table needs two lateral positions or more");
  require(!loads.empty() && loads.front() > 0.0 && std::isfinite(loads.back()) &&
              ranges::is_sorted(loads, std::less_equal<>{}),
          "the loads of a contact table must be positive and increase");
  require(reference_level < loads.size(), "a contact table has no such reference level");
  for (const ContactTableColumn& column : columns) {
    require(column.under.size() == loads.size(), "every lateral position of a contact table needs all loads");
    require(std::isfinite(column.y) && ranges::all_of(column.under, is_finite),
            "a contact table holds what is no number");
    for (std::size_t k = 0; k < loads.size(); ++k) {
      const ContactUnderLoad& c = column.under[k];
      require(c.elastic_energy > 0.0 && !c.parts.empty() && c.parts.size() <= kMostParts &&
                  ranges::all_of(c.parts, [](const ContactPart& part) { return part.area > 0.0 && part.share > 0.0; }),
              "energies, areas and shares of a contact table must be positive");
      require(std::abs(c.slope) <= kSteepest && ranges::all_of(c.parts, is_a_contact),
              "a contact of a contact table is steeper or longer than any");
      require(k == 0 || c.z > column.under[k - 1].z, "the wheel of a contact table must sink as the load grows");
    }
  }
}

bool make_sense(const TableAngles& angles, int fewest) {
  constexpr int kMost = 64;
  if (angles.intervals == 0) return true;
  return angles.intervals >= fewest && angles.intervals <= kMost && angles.most > 0.0 &&
         angles.most <= TableAngles::kSmall;
}

void check(const TableAngles& roll, const TableAngles& yaw) {
  require(make_sense(roll, 2) && make_sense(yaw, 1),
          "a contact table needs rolls and yaws up to 200 mrad, with two intervals of roll and one of yaw at least");
}

template <class Value>
std::vector<double> along(const Columns& columns, Value&& value) {
  std::vector<double> values;
  values.reserve(columns.size());
  for (const ContactTableColumn& column : columns) values.push_back(value(column));
  return values;
}

std::vector<double> positions(const Columns& columns) {
  return along(columns, [](const ContactTableColumn& column) { return column.y; });
}

template <class Value>
ShapeCurve curve(const Columns& columns, const ShapeCurve* beside, Value&& value) {
  return ShapeCurve::monotone(positions(columns), along(columns, value), beside);
}

ShapeCurve curve(const Columns& columns, const ShapeCurve* beside, std::size_t level,
                 double ContactUnderLoad::*member) {
  return curve(columns, beside, [&](const ContactTableColumn& column) { return column.under[level].*member; });
}

ShapeCurve heights_less_energy(const Columns& columns, double load) {
  return {positions(columns),
          along(columns, [&](const ContactTableColumn& c) { return c.under[0].z - c.under[0].elastic_energy / load; }),
          along(columns, [](const ContactTableColumn& c) { return c.under[0].slope; })};
}

LoadLevel load_level(const Columns& columns, std::size_t level, double load, const LoadLevel* beside) {
  const auto compression = [&](const ContactTableColumn& c) {
    // Up to the first load like Hertz: the approach that has this energy.
    return level == 0 ? 2.5 * c.under[0].elastic_energy / load : c.under[level].z - c.under[level - 1].z;
  };
  return {load, curve(columns, beside ? &beside->compression : nullptr, compression), {}};
}

using Parts = std::vector<ContactPart>;

/// Parts get the numbers of those near them on the wheel, known from the load next to theirs towards the reference
/// load, or from the place before; none twice.
void number_parts(Parts& parts, const Parts* at_other_load, const Parts* at_place_before, int& next) {
  constexpr double kNear = 5e-3;  // [m]
  struct Link {
    double distance;
    ContactPart* part;
    int number;
  };
  std::vector<Link> links;
  for (const Parts* known : {at_other_load, at_place_before})
    for (const ContactPart& one : known ? *known : Parts())
      for (ContactPart& part : parts)
        if (const double d = std::abs(one.wheel_y - part.wheel_y); d < kNear) links.push_back({d, &part, one.number});
  ranges::stable_sort(links, {}, &Link::distance);
  for (const Link& link : links)
    if (link.part->number < 0 && ranges::find(parts, link.number, &ContactPart::number) == parts.end())
      link.part->number = link.number;
  for (ContactPart& part : parts)
    if (part.number < 0) part.number = next++;
}

void add_parts(const Columns& columns, std::size_t reference, std::vector<LoadLevel>& levels) {
  int next = 0;
  for (std::size_t i = 0; i < columns.size(); ++i) {
    for (std::size_t k = 0; k < levels.size(); ++k) levels[k].parts.push_back(columns[i].under[k].parts);
    const auto number = [&](std::size_t k, const Parts* at_other_load) {
      number_parts(levels[k].parts[i], at_other_load, i > 0 ? &levels[k].parts[i - 1] : nullptr, next);
    };
    number(reference, nullptr);
    for (std::size_t k = reference; k-- > 0;) number(k, &levels[k + 1].parts[i]);
    for (std::size_t k = reference + 1; k < levels.size(); ++k) number(k, &levels[k - 1].parts[i]);
  }
}

/// beside: the stretch that it goes on from, or null.
TableStretch stretch_of(Columns columns, const std::vector<double>& loads, std::size_t reference,
                        const TableStretch* beside) {
  const auto of = [&](ShapeCurve TableStretch::*member) { return beside ? &(beside->*member) : nullptr; };
  check(columns, loads, reference);
  TableStretch out{columns.front().y,
                   columns.back().y,
                   positions(columns),
                   heights_less_energy(columns, loads.front()),
                   curve(columns, of(&TableStretch::wheel_y), reference, &ContactUnderLoad::wheel_y),
                   curve(columns, of(&TableStretch::wheel_z), reference, &ContactUnderLoad::wheel_z),
                   {},
                   {}};
  for (std::size_t k = 0; k < loads.size(); ++k)
    out.levels.push_back(load_level(columns, k, loads[k], beside ? &beside->levels[k] : nullptr));
  add_parts(columns, reference, out.levels);
  out.columns = std::move(columns);
  return out;
}

}  // namespace

std::vector<TableTurn> table_turns(const TableAngles& roll, const TableAngles& yaw) {
  check(roll, yaw);
  const auto angle = [](const TableAngles& angles, double share) {
    return angles.intervals == 0 ? 0.0 : angles.most * share / angles.intervals;
  };
  std::vector<TableTurn> turns;
  for (int i = 0; i <= roll.intervals; ++i)
    for (int j = 0; j <= yaw.intervals; ++j) turns.push_back({angle(roll, 2.0 * i - roll.intervals), angle(yaw, j)});
  return turns;
}

ContactTable::ContactTable(std::vector<Columns> sheets, Loads loads, wheelrail::Problem problem,
                           const wheelrail::Placement& nominal, const TableAngles& roll, const TableAngles& yaw,
                           Growth growth)
    : loads_(std::move(loads)),
      problem_(std::move(problem)),
      nominal_(nominal),
      roll_(roll),
      yaw_(yaw),
      growth_(std::move(growth)) {
  if (!growth_.heavier) loads_.heavier.clear();
  require(loads_.first.size() + loads_.heavier.size() <= kMostLevels, kTooManyLoads);
  const std::vector<TableTurn> turns = table_turns(roll, yaw);
  require(sheets.size() == turns.size(), "a contact table needs a sheet for every roll and yaw");
  sheets_.reserve(sheets.size());
  double highest = 0.0;  // of contact places [m]
  for (std::size_t i = 0; i < sheets.size(); ++i) {
    sheets_.push_back({turns[i], stretch_of(std::move(sheets[i]), loads_.first, loads_.reference, nullptr)});
    const TableStretch& central = sheets_.back().central;
    y_min_ = std::max(y_min_, central.y_min), y_max_ = std::min(y_max_, central.y_max);
    for (const ContactTableColumn& column : central.columns)
      highest = std::max(highest, std::abs(column.under[loads_.reference].wheel_z));
  }
  // A place between two rolls is looked up in up to four sheets, aside by the turn times the height of the contact.
  if (roll.intervals > 0) {
    const double aside = 2.0 * (2.0 * roll.most / roll.intervals) * highest;
    y_min_ += aside, y_max_ -= aside;
  }
  require(y_min_ < y_max_, "a contact table has too few lateral positions for its rolls and yaws");
}

const TableStretch* ContactTable::beyond(double y, const Sheet& sheet) const {
  if (!growth_.beyond || !std::isfinite(y)) return nullptr;
  const bool high = y > 0.0;
  Wing& wing = wing_at(y, sheet);
  const std::lock_guard lock(growing_);
  for (;;) {
    for (const TableStretch& stretch : wing.made)
      if (y >= stretch.y_min && y <= stretch.y_max) return &stretch;
    if (wing.ended) return nullptr;
    const TableStretch& last = wing.made.empty() ? sheet.central : wing.made.back();
    // -0.0 where the middle ends at 0: its sign says the side
    ColumnsBeyond more = growth_.beyond(sheet.turn, high ? last.y_max : std::copysign(last.y_min, -1.0));
    if (more.columns.size() < 2)
      wing.ended = true, wing.unsolved = std::move(more.unsolved);
    else
      wing.made.push_back(stretch_of(std::move(more.columns), loads_.first, loads_.reference, &last));
  }
}

std::string ContactTable::unsolved(double y, std::size_t sheet) const {
  const std::lock_guard lock(growing_);
  return wing_at(y, sheets_[sheet]).unsolved;
}

const TableStretch* ContactTable::heavier(const TableStretch& stretch, std::size_t index) const {
  if (loads_.heavier.empty()) return nullptr;
  const Sheet& sheet = sheets_[index];
  std::vector<double> loads = loads_.first;
  loads.insert(loads.end(), loads_.heavier.begin(), loads_.heavier.end());
  const auto make = [&](const TableStretch& from, const TableStretch* beside) {
    return stretch_of(growth_.heavier(sheet.turn, from.columns), loads, loads_.reference, beside);
  };
  const std::lock_guard lock(growing_);
  if (!sheet.central_heavier) sheet.central_heavier = make(sheet.central, nullptr);
  if (&stretch == &sheet.central) return &*sheet.central_heavier;
  // One after the other, as each goes on from the one before.
  for (Wing* wing : {&sheet.low, &sheet.high}) {
    if (ranges::none_of(wing->made, [&](const TableStretch& one) { return &one == &stretch; })) continue;
    for (std::size_t i = 0; i < wing->made.size(); ++i) {
      if (wing->heavier.size() == i)
        wing->heavier.push_back(make(wing->made[i], i == 0 ? &*sheet.central_heavier : &wing->heavier.back()));
      if (&wing->made[i] == &stretch) return &wing->heavier[i];
    }
  }
  return nullptr;
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
  if (p.track.curvature != 0.0)
    refuse("a contact table is made for straight track",
           "leave the curve of the track out of the case: what asks the table for forces says how the rail bends");
  if (p.roller) refuse("a contact table knows no rollers", "use full contacts for a roller rig");
  if (!(load > 0.0) || !std::isfinite(load))
    refuse("the reference load of a contact table must be positive and finite");
  for (const double length : {options.lateral_range, options.step, options.element_size})
    if (!(length > 0.0) || !std::isfinite(length))
      refuse("range, step and element size of a contact table must be positive and finite");
  if (!(options.growth >= 0.0) || !std::isfinite(options.growth))
    refuse("a contact table must grow by a finite length that is not negative");
  std::vector<double> loads = options.relative_loads;
  loads.insert(loads.end(), options.heavier.begin(), options.heavier.end());
  if (loads.empty() || !(loads.front() > 0.0) || !std::isfinite(loads.back()) ||
      !ranges::is_sorted(loads, std::less_equal<>{}))
    refuse("the relative loads of a contact table must be positive and increase");
  if (loads.size() > ContactTable::kMostLevels) refuse(kTooManyLoads);
  constexpr double kMostSteps = 5000.0;
  if (!(options.step <= options.lateral_range) || options.lateral_range / options.step > kMostSteps)
    refuse(fmt::format("a contact table over +-{:.6g} mm cannot have a step of {:.6g} mm", 1e3 * options.lateral_range,
                       1e3 * options.step));
  check(options.roll, options.yaw);
}

/// Rows of a patch's elements that belong together.
struct Rows {
  const wheelrail::PatchSolution* patch;
  int from, to;  ///< both included
  double force;  ///< normal, of all their elements [N]
};

std::vector<double> row_forces(const wheelrail::PatchSolution& patch) {
  std::vector<double> forces(static_cast<std::size_t>(patch.grid.ny));
  for (int iy = 0; iy < patch.grid.ny; ++iy)
    for (int ix = 0; ix < patch.grid.nx; ++ix)
      forces[static_cast<std::size_t>(iy)] += patch.contact.pressure[patch.grid.index(ix, iy)] * patch.grid.cell_area();
  return forces;
}

/// Leaves of the rows those before the deepest valley of their force and returns those behind; none where there is no
/// valley.
std::optional<Rows> split(Rows& rows, double all_force) {
  constexpr double kValley = 0.7;  // of the lower of both crests
  constexpr double kLeast = 0.05;  // of all force
  const std::vector<double> force = row_forces(*rows.patch);
  const auto first = force.begin() + rows.from, last = force.begin() + rows.to + 1;
  double deepest = 0.0, below = 0.0, force_below = 0.0;
  auto valley = last;
  for (auto row = first; row != last; below += *row, ++row) {
    if (row == first) continue;
    const double crest = std::min(*std::max_element(first, row), *std::max_element(row, last));
    if (*row < kValley * crest && crest - *row > deepest && below > kLeast * all_force &&
        rows.force - below > kLeast * all_force)
      deepest = crest - *row, valley = row, force_below = below;
  }
  if (valley == last) return std::nullopt;
  const int at = rows.from + static_cast<int>(valley - first);
  const Rows behind{rows.patch, at, rows.to, rows.force - force_below};
  rows = {rows.patch, rows.from, at - 1, force_below};
  return behind;
}

/// What the wheel touches the rail with, kMostParts at most; of more, those that carry most.
std::vector<Rows> parts_of(const wheelrail::PairSolution& s) {
  std::vector<Rows> parts;
  double all = 0.0;
  for (const wheelrail::PatchSolution& patch : s.patches) {
    if (!(patch.contact.force_n > 0.0)) continue;  // it was looked at, and is none
    parts.push_back({&patch, 0, patch.grid.ny - 1, patch.contact.force_n});
    all += patch.contact.force_n;
  }
  for (std::size_t i = 0; i < parts.size(); ++i)
    while (parts.size() < kMostParts) {
      const std::optional<Rows> behind = split(parts[i], all);
      if (!behind) break;
      parts.push_back(*behind);
    }
  ranges::stable_sort(parts, std::greater{}, &Rows::force);
  if (parts.size() > kMostParts) parts.resize(kMostParts, parts.front());
  return parts;
}

/// Where the rows have their force on the rail, with its inclination there, and as deep in the rail as the undeformed
/// wheel is. Sizes are from integrals over the pressures, which do not change in jumps as a count of elements does. For
/// an ellipsoid p_0 sqrt(1 - r^2) the squared mean of sqrt(p) is 24/25 of the mean of p, and the second moments are
/// a^2/5 and b^2/5.
ContactPart part_of(const Rows& rows, const Surface& rail, const Pose& X_TR, double depth) {
  const wheelrail::PatchSolution& patch = *rows.patch;
  double sum = 0.0, sum_of_roots = 0.0;
  Vec2 centre = Vec2::Zero(), second = Vec2::Zero();
  for (int iy = rows.from; iy <= rows.to; ++iy)
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

  const double y = centre.y();
  double height = 0.0, slope = 0.0;
  rail.heights({X_TR.inverse() * patch.frame.X_TC, Grid2{0.0, y, patch.grid.dx, patch.grid.dy, 1, 1}},
               {std::span(&height, 1), {}, std::span(&slope, 1)});
  if (!std::isfinite(height) || !std::isfinite(slope)) height = slope = 0.0;
  const double angle = patch.frame.angle + std::atan(slope);
  const Vec3 at = patch.frame.X_TC.apply({0.0, y, height}) + depth * rotation_x(angle).col(2);
  return {rows.force,
          angle,
          at.y(),
          at.z(),
          25.0 / 24.0 * sum_of_roots * sum_of_roots / sum * patch.grid.cell_area(),
          0.5 * std::log(second.x() / second.y())};
}

/// wheel_origin: of the wheel's profile at rest; moved: how far it is from there.
ContactUnderLoad under_load(const Surface& rail, double load, const wheelrail::PairSolution& s,
                            const Vec3& wheel_origin, const Vec3& moved) {
  ContactUnderLoad c;
  c.z = moved.z();
  const Vec3 origin = wheel_origin + moved;
  double height = 0.0, normal_force = 0.0;
  for (const wheelrail::PatchSolution& patch : s.patches) {
    c.elastic_energy += patch.contact.elastic_energy;
    height += patch.contact.force_n * patch.frame.X_TC.origin.z();
    normal_force += patch.contact.force_n;
  }
  const Vec3& force = s.load.track.force;
  const Vec3& marker = s.placement.X_TR.origin;
  c.slope = -force.y() / force.z();
  // On the line of action of the resultant, at the mean height of the patches on the rail; the wheel lies deeper by the
  // approach.
  const double z = height / normal_force;
  const double place_y = marker.y() + (s.load.track.moment.x() + (z - marker.z()) * force.y()) / force.z();
  const double per_vertical = std::sqrt(1.0 + c.slope * c.slope),
               to_wheel = 2.5 * c.elastic_energy / load / (per_vertical * per_vertical);
  c.wheel_y = place_y - c.slope * to_wheel - origin.y();
  c.wheel_z = z + to_wheel - origin.z();
  double carried = 0.0;
  for (const Rows& rows : parts_of(s)) {
    ContactPart& part = c.parts.emplace_back(part_of(rows, rail, s.placement.X_TR, to_wheel * per_vertical));
    carried += rows.force;
    part.wheel_y -= origin.y();
    part.wheel_z -= origin.z();
  }
  if (c.parts.size() == 1) {
    ContactPart& all = c.parts.front();
    all.angle = std::atan(c.slope), all.wheel_y = c.wheel_y, all.wheel_z = c.wheel_z;
  }
  for (ContactPart& part : c.parts) part.share *= normal_force / (carried * force.norm());
  return c;
}

struct Attempt {
  ContactTableColumn column;
  bool solved = true;
  bool parts = false;   ///< the wheel stands on the tip of its flange, or a profile ends below the wheel
  bool beside = false;  ///< wheel and rail nowhere face each other
  std::string message;  ///< why there are no more loads
};

bool part(const wheelrail::PairSolution& s) {
  return ranges::any_of(s.remarks, [](const Remark& r) {
    return r.kind == RemarkKind::on_flange_tip || r.kind == RemarkKind::on_flange_back ||
           r.kind == RemarkKind::surface_ends_in_contact;
  });
}

class Builder {
 public:
  Builder(const wheelrail::Geometry& geometry, const wheelrail::Problem& rest, std::vector<double> loads,
          double reference_load, const TableTurn& turn, bool parallel)
      : geometry_(geometry), rest_(rest), loads_(std::move(loads)), reference_(reference_load), parallel_(parallel) {
    const wheelrail::Placement nominal = wheelrail::place(geometry, rest);
    wheel_origin_ = nominal.X_TW.origin;
    rest_.state.position.roll = turn.roll, rest_.state.position.yaw = turn.yaw;
    if (turn.roll == 0.0 && turn.yaw == 0.0) return;
    const Vec3 arm = wheel_origin_ - nominal.X_TWs.origin;
    turned_aside_ = rotation_x(turn.roll) * rotation_z(turn.yaw) * arm - arm;
  }

  std::vector<Attempt> solve(const std::vector<double>& y) const {
    std::vector<Attempt> attempts(y.size());
    const auto solve_one = [&](std::size_t i) { attempts[i] = attempt(y[i]); };
    if (parallel_)
      parallel_for(y.size(), solve_one);
    else
      for (std::size_t i = 0; i < y.size(); ++i) solve_one(i);
    return attempts;
  }

  Attempt attempt(double y) const {
    Attempt a;
    a.column.y = y;
    a.solved = press(a);
    return a;
  }

  /// Adds the loads that columns lack.
  void press_harder(Columns& columns) const {
    for (ContactTableColumn& column : columns) {
      Attempt a;
      std::swap(a.column, column);
      press(a);
      std::swap(a.column, column);
    }
  }

 private:
  /// Adds the loads that a column lacks. False: not even the reference load has a solution.
  bool press(Attempt& a) const {
    std::vector<ContactUnderLoad>& under = a.column.under;
    const std::size_t loads = loads_.size();
    wheelrail::Problem p = rest_;
    p.state.position.y = a.column.y - turned_aside_.y();
    wheelrail::Pair pair(geometry_);
    while (under.size() < loads) {
      const double load = loads_[under.size()];
      p.vertical_force = load;
      p.discretisation.dx = p.discretisation.ds =
          rest_.discretisation.dx * std::cbrt(std::max(1.0, load / (kFine * reference_)));
      const wheelrail::PairSolution s = pair.solve(p);
      a.parts = a.parts || (load <= reference_ && part(s));
      a.beside = a.beside || (load <= reference_ && s.status == Status::no_contact);
      const auto stop = [&](const std::string& why) {
        a.message = fmt::format("{:.4g} mm aside of the central position under {:.4g} kN: {}", 1e3 * a.column.y,
                                1e-3 * load, why);
      };
      const Vec3 moved(0.0, a.column.y, s.z + turned_aside_.z());
      if (s.status != Status::ok || s.patches.empty()) {
        stop(s.message);
        break;
      }
      if (!under.empty() && !(moved.z() > under.back().z)) {
        stop("the wheel does not sink as the load grows");
        break;
      }
      const ContactUnderLoad c = under_load(*geometry_.rail, load, s, wheel_origin_, moved);
      if (!is_finite(c)) {
        stop("the contact has numbers that are not finite");
        break;
      }
      under.push_back(c);
    }
    if (under.size() < loads && (under.empty() || loads_[under.size() - 1] < reference_)) return false;
    while (under.size() < loads) under.push_back(like_hertz(under));
    return true;
  }

  /// The next load, from those before.
  ContactUnderLoad like_hertz(const std::vector<ContactUnderLoad>& under) const {
    const std::size_t k = under.size();
    const auto approach = [&](std::size_t i) { return std::cbrt(loads_[i] * loads_[i]); };
    ContactUnderLoad next = under.back();
    next.z += k == 1 ? (approach(1) / approach(0) - 1.0) * 2.5 * under[0].elastic_energy / loads_[0]
                     : (approach(k) - approach(k - 1)) / (approach(k - 1) - approach(k - 2)) *
                           (under[k - 1].z - under[k - 2].z);
    for (ContactPart& part : next.parts) part.area *= approach(k) / approach(k - 1);
    return next;
  }

  const wheelrail::Geometry& geometry_;
  wheelrail::Problem rest_;
  static constexpr double kFine = 2.0;  ///< up to so much of the reference load elements are as wanted
  std::vector<double> loads_;
  double reference_;
  bool parallel_;
  Vec3 wheel_origin_;                 ///< of its profile, at rest
  Vec3 turned_aside_ = Vec3::Zero();  ///< what turning the wheelset about its centre moves it by
};

constexpr std::size_t kMostBetween = 3;  ///< columns without a solution between two that have one

/// Those round the central one that have a solution.
Columns connected(const std::vector<Attempt>& attempts, std::size_t centre) {
  if (!attempts[centre].solved)
    throw Error(ErrorKind::numerical,
                "wheel and rail have no contact in their central position: " + attempts[centre].message, {},
                "check gauge, flange-back distance and profiles; smooth those that were measured");
  Columns columns{attempts[centre].column};
  for (const int way : {-1, 1}) {
    std::size_t without = 0;
    for (auto i = static_cast<std::ptrdiff_t>(centre) + way;
         i >= 0 && i < std::ssize(attempts) && without <= kMostBetween; i += way) {
      const Attempt& a = attempts[static_cast<std::size_t>(i)];
      without = a.solved ? 0 : without + 1;
      if (a.solved) columns.push_back(a.column);
    }
  }
  ranges::sort(columns, {}, &ContactTableColumn::y);
  return columns;
}

bool differ_much(const ContactTableColumn& a, const ContactTableColumn& b) {
  constexpr double kMostChange = 0.04, kMostWay = 3e-3;  // of the tangent; of the contact over the wheel [m]
  for (std::size_t k = 0; k < a.under.size(); ++k)
    if (std::abs(b.under[k].slope - a.under[k].slope) > kMostChange ||
        std::abs(b.under[k].wheel_y - a.under[k].wheel_y) > kMostWay)
      return true;
  return false;
}

/// Columns between those whose contacts differ much.
void refine(const Builder& builder, Columns& columns) {
  constexpr int kTimes = 3;
  for (int time = 0; time < kTimes; ++time) {
    std::vector<double> between;
    for (std::size_t i = 0; i + 1 < columns.size(); ++i)
      if (differ_much(columns[i], columns[i + 1])) between.push_back(0.5 * (columns[i].y + columns[i + 1].y));
    for (const Attempt& a : builder.solve(between))
      if (a.solved) columns.push_back(a.column);
    ranges::sort(columns, {}, &ContactTableColumn::y);
  }
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
  p.sensitivities = p.refinement = p.surface_loads = false;
  p.discretisation.dx = p.discretisation.ds = options.element_size;
  return p;
}

namespace {

std::vector<double> multiplied(std::vector<double> relative, double reference_load) {
  for (double& load : relative) load *= reference_load;
  return relative;
}

std::vector<double> loads_of(double reference_load, const ContactTableOptions& options) {
  return multiplied(options.relative_loads, reference_load);
}

}  // namespace

std::vector<Columns> solve_contact_sheets(const wheelrail::Geometry& geometry, const wheelrail::Problem& prototype,
                                          double reference_load, const ContactTableOptions& options,
                                          const Progress& progress) {
  check(geometry, prototype, reference_load, options);
  const wheelrail::Problem rest = table_problem(prototype, options);
  constexpr double kRounding = 1e-9;
  const auto each_way = to_whole<std::size_t>(options.lateral_range / options.step + kRounding);
  std::vector<double> y;
  y.reserve(2 * each_way + 1);
  for (std::size_t i = 0; i <= 2 * each_way; ++i)
    y.push_back(options.step * (static_cast<double>(i) - static_cast<double>(each_way)));

  const std::vector<TableTurn> turns = table_turns(options.roll, options.yaw);
  std::vector<Columns> sheets;
  for (const TableTurn& turn : turns) {
    const Builder builder(geometry, rest, loads_of(reference_load, options), reference_load, turn, true);
    refine(builder, sheets.emplace_back(connected(builder.solve(y), each_way)));
    if (progress.report) progress.report(sheets.size(), turns.size(), "contact under load");
  }
  return sheets;
}

ColumnsBeyond solve_columns_beyond(const wheelrail::Geometry& geometry, const wheelrail::Problem& prototype,
                                   double reference_load, const TableTurn& turn, double from,
                                   const ContactTableOptions& options) {
  // One after the other: whoever evaluates wheels on several threads may wait for this table.
  const Builder builder(geometry, table_problem(prototype, options), loads_of(reference_load, options), reference_load,
                        turn, false);
  const double step = std::copysign(options.step, from);
  const auto most = std::max<std::size_t>(1, to_whole<std::size_t>(std::round(options.growth / std::abs(step))));
  ColumnsBeyond out;
  bool parted = false;  // at the last column that has a solution, or behind it
  // A single column is no stretch: one more, or what ends the table.
  for (std::size_t i = 0, without = 0; (i <= most || out.columns.size() < 2) && without <= kMostBetween; ++i) {
    Attempt a = builder.attempt(from + static_cast<double>(i) * step);
    parted = a.parts || (!a.solved && (parted || a.beside));
    if (a.parts && i > 0) break;
    if (a.solved) {
      without = 0;
      out.columns.push_back(std::move(a.column));
    } else if (without++ == 0) {
      out.unsolved = std::move(a.message);
    }
  }
  if (parted) out.unsolved.clear();
  ranges::sort(out.columns, {}, &ContactTableColumn::y);
  refine(builder, out.columns);
  return out;
}

Columns solve_heavier(const wheelrail::Geometry& geometry, const wheelrail::Problem& prototype, double reference_load,
                      const TableTurn& turn, Columns columns, const ContactTableOptions& options) {
  std::vector<double> loads = loads_of(reference_load, options);
  const std::vector<double> heavier = multiplied(options.heavier, reference_load);
  loads.insert(loads.end(), heavier.begin(), heavier.end());
  Builder(geometry, table_problem(prototype, options), std::move(loads), reference_load, turn, false)
      .press_harder(columns);
  return columns;
}

std::shared_ptr<const ContactTable> contact_table_of(std::vector<Columns> sheets, const wheelrail::Geometry& geometry,
                                                     const wheelrail::Problem& prototype, double reference_load,
                                                     const ContactTableOptions& options, ContactTable::Growth growth) {
  const wheelrail::Problem rest = table_problem(prototype, options);
  const auto nearest =
      ranges::min_element(options.relative_loads, {}, [](double relative) { return std::abs(relative - 1.0); });
  const ContactTable::Loads loads{loads_of(reference_load, options), multiplied(options.heavier, reference_load),
                                  static_cast<std::size_t>(nearest - options.relative_loads.begin())};
  if (options.growth == 0.0) growth.beyond = nullptr;
  return std::make_shared<ContactTable>(std::move(sheets), loads, rest, wheelrail::place(geometry, rest), options.roll,
                                        options.yaw, std::move(growth));
}

std::shared_ptr<const ContactTable> build_contact_table(const wheelrail::Geometry& geometry,
                                                        const wheelrail::Problem& prototype, double reference_load,
                                                        const ContactTableOptions& options) {
  return contact_table_of(solve_contact_sheets(geometry, prototype, reference_load, options), geometry, prototype,
                          reference_load, options,
                          {[=](const TableTurn& turn, double from) {
                             return solve_columns_beyond(geometry, prototype, reference_load, turn, from, options);
                           },
                           [=](const TableTurn& turn, const Columns& columns) {
                             return solve_heavier(geometry, prototype, reference_load, turn, columns, options);
                           }});
}

void write_columns(const Columns& columns, ByteWriter& out) {
  out.put(columns.size());
  for (const auto& [y, under] : columns) {
    out.put(y);
    out.put(under.size());
    for (const ContactUnderLoad& c : under) {
      for (const auto number : kNumbers) out.put(c.*number);
      out.put(c.parts.size());
      for (const ContactPart& part : c.parts)
        for (const auto number : kPartNumbers) out.put(part.*number);
    }
  }
}

Columns read_columns(ByteReader& in) {
  Columns columns;
  for (auto count = in.get<std::size_t>(); count > 0; --count) {
    ContactTableColumn& column = columns.emplace_back();
    in.get(column.y);
    for (auto loads = in.get<std::size_t>(); loads > 0; --loads) {
      ContactUnderLoad& c = column.under.emplace_back();
      for (const auto number : kNumbers) in.get(c.*number);
      for (auto parts = in.get<std::size_t>(); parts > 0; --parts) {
        ContactPart& part = c.parts.emplace_back();
        for (const auto number : kPartNumbers) in.get(part.*number);
      }
      if (!is_finite(c) || !std::isfinite(column.y)) refuse_saved_state("a contact table holds what is no number");
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

ShapeCurve ShapeCurve::monotone(std::vector<double> x, std::vector<double> value, const ShapeCurve* beside) {
  require_points(x, value.size());
  const std::size_t last = x.size() - 1;
  const auto chord = [&](std::size_t i) { return (value[i + 1] - value[i]) / (x[i + 1] - x[i]); };
  std::vector<double> slope(x.size());
  slope.front() = beside && beside->x_.back() == x.front() ? beside->slope_.back() : chord(0);
  slope.back() = beside && beside->x_.front() == x.back() ? beside->slope_.front() : chord(last - 1);
  for (std::size_t i = 1; i < last; ++i)
    slope[i] = mean_slope(chord(i - 1), chord(i), x[i] - x[i - 1], x[i + 1] - x[i]);
  return {std::move(x), std::move(value), std::move(slope)};
}

ShapeCurve::Point ShapeCurve::at(double x, std::size_t i) const {
  if (x <= x_.front()) return {value_.front() + slope_.front() * (x - x_.front()), slope_.front()};
  if (x >= x_.back()) return {value_.back() + slope_.back() * (x - x_.back()), slope_.back()};
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
