// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/cases/case_derivatives.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include <fmt/format.h>

#include "treadmark/app/cases/run_parts.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/core/cancellation.hpp"
#include "treadmark/core/constants.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/surface.hpp"
#include "treadmark/io/cases/case_keys.hpp"
#include "treadmark/io/cases/read_toml.hpp"
#include "treadmark/io/results/quantities.hpp"

namespace treadmark::app {
namespace {

/// By what, where nobody says it.
constexpr const char* kUsualKeys[] = {
    "wheelset.y_mm",
    "wheelset.z_mm",
    "wheelset.roll_rad",
    "wheelset.yaw_rad",
    "wheelset.vertical_force_N",
    "wheelset.velocity_m_s",
    "wheelset.vy_m_s",
    "wheelset.vyaw_rad_s",
    "wheelset.vpitch_rad_s",
    "wheelset.flange_back_distance_mm",
    "track.gauge_mm",
    "track.rail_y_mm",
    "track.rail_z_mm",
    "track.cant_rad",
    "friction.coefficient",
};

/// In place of a key: all parameters of the surface of a body, each with the unit that its name then ends with.
struct ShapeKey {
  std::string_view key;
  Facing facing;
};
constexpr ShapeKey kShapes[] = {{"rail.shape", Facing::up}, {"wheel.shape", Facing::down}};
const ShapeKey* shape_key(std::string_view key) {
  for (const ShapeKey& row : kShapes)
    if (row.key == key) return &row;
  return nullptr;
}

/// A case as it is solved for derivatives.
struct Prepared {
  io::WheelRailCase input;
  wheelrail::Problem problem;
  wheelrail::Geometry geometry, given;  ///< with and without the heights that are added
};

constexpr const char* kNothingFollows = "contact does not follow from it";

/// Calls visit(name, row, of) for each number with derivatives; of: CaseResult -> the item that has the row.
template <class Visit>
void for_each_number(const io::CaseResult& result, Visit&& visit) {
  const auto each = [&](const auto& item, const std::string& prefix, const auto& of) {
    using Item = std::remove_cvref_t<decltype(item)>;
    for (const io::Quantity<Item>& row : io::quantities<Item>())
      if (!row.key.empty() && row.access.smooth && io::has_block(item, row.block) && row.has(item))
        visit(prefix + io::name_of(row), row, of);
  };
  each(result, "", [](const io::CaseResult& r) -> const io::CaseResult& { return r; });
  for (std::size_t k = 0; k < result.patches.size(); ++k)
    each(result.patches[k], fmt::format("patch_{}.", k + 1),
         [k](const io::CaseResult& r) -> const io::PatchResult& { return r.patches[k]; });
}

class CaseTangents {
 public:
  CaseTangents(const io::Case& c, SurfaceStore& store, const SampledRegions& regions,
               const SectionHeights* added = nullptr)
      : case_(c),
        store_(store),
        regions_(regions),
        added_(added),
        base_(std::make_shared<const Prepared>(prepared(c))) {}

  /// shown: a result of the case whose patches get the derivatives of their pressures by heights; null: none.
  io::CaseDerivatives by(const std::vector<std::string>& keys, std::span<const SectionHeights> heights = {},
                         io::CaseResult* shown = nullptr) {
    io::CaseDerivatives out;
    wheelrail::Pair pair(base_->geometry);
    const wheelrail::PairSolution solution = pair.solve(base_->problem);
    if (solution.status != Status::ok) {
      out.message = "the case has no solution that is ok";
      return out;
    }
    for (const std::string& key : keys) {
      if (const ShapeKey* shape = shape_key(key); shape != nullptr)
        add_shape(*shape, out);
      else
        add(key, out);
    }
    for (const SectionHeights& one : heights) add(one, out);
    std::vector<wheelrail::PairParameter> parameters;
    for (const Asked& one : asked_) parameters.push_back(one.parameter);
    const std::vector<wheelrail::PairNeighbours> found = pair.neighbours(base_->problem, solution, parameters);
    name_numbers(to_result(base_->input, solution), out);
    for (std::size_t i = 0; i < asked_.size(); ++i) fill(asked_[i], found[i], out);
    if (shown != nullptr && shown->patches.size() == solution.patches.size()) add_fields(pair, solution, *shown);
    return out;
  }

 private:
  struct Sides {
    std::shared_ptr<const Prepared> more, less;
    double step = 0.0;  ///< in the unit of the key
  };
  struct Asked {
    std::size_t place;  ///< in CaseDerivatives::parameters
    Sides sides;
    wheelrail::PairParameter parameter;
  };

  Prepared prepared(const io::Case& c) {
    constexpr double kExact = 1e-9;  // what is left open is a part of every derivative
    Prepared out{std::get<io::WheelRailCase>(c.content), {}, {}, {}};
    out.input.subsurface = {};
    out.input.history = HistoryUse::start;
    out.geometry = out.given = geometry_of(out.input, store_, regions_);
    if (added_ != nullptr) {
      auto& surface = added_->facing == Facing::up ? out.geometry.rail : out.geometry.wheel;
      std::shared_ptr<const Surface>& known = with_added_[surface];
      if (known == nullptr) known = with_heights(surface, *added_, 1.0);
      surface = known;
    }
    out.problem = to_problem(out.input, out.geometry.round_wheel);
    out.problem.solver.eps = std::min(out.problem.solver.eps, kExact);
    return out;
  }

  void add(const std::string& key, io::CaseDerivatives& out) {
    io::CaseDerivatives::Parameter& parameter = out.parameters.emplace_back();
    parameter.key = key;
    const std::optional<double> value = io::number_of(case_, key);
    parameter.value = value.value_or(kNaN);
    if (!value) {
      parameter.left_out = "the case does not give it";
      return;
    }
    Sides sides;
    const double unit = io::unit_of_key(key), step = difference_step(io::unit_at_end(key).si_name, *value * unit);
    try {
      sides.step = step / unit;
      const auto beside = [&](double amount) {
        io::Case c = case_;
        io::apply_override(c, fmt::format("{}={:.17g}", key, *value + amount));
        return std::make_shared<const Prepared>(prepared(c));
      };
      sides.more = beside(sides.step), sides.less = beside(-sides.step);
    } catch (const Error& e) {
      parameter.left_out = e.what();
      return;
    }
    const auto same = [&](const Prepared& p) {
      return p.geometry.rail == base_->geometry.rail && p.geometry.wheel == base_->geometry.wheel;
    };
    parameter.of_surfaces = !same(*sides.more) || !same(*sides.less);
    const bool contact =
        parameter.of_surfaces || sides.more->problem != base_->problem || sides.less->problem != base_->problem;
    if (!contact) {
      parameter.left_out = kNothingFollows;
      return;
    }
    asked_.push_back({out.parameters.size() - 1, sides, {changes(sides), step}});
  }

  void add_shape(const ShapeKey& shape, io::CaseDerivatives& out) {
    const std::string body(shape.key.substr(0, shape.key.find('.')));
    const Surface& surface = shape.facing == Facing::up ? *base_->geometry.rail : *base_->geometry.wheel;
    constexpr std::size_t kMost = 500;  // columns
    const std::size_t count = surface.parameter_count();
    if (count > kMost) {
      out.parameters.push_back({std::string(shape.key), kNaN, false,
                                fmt::format("its {} parameters are too many for a table: Pair.shape_gradient in Python "
                                            "and tm_pair_gradient_by_shape in C have them all",
                                            count)});
      return;
    }
    const std::vector<ShapeParameter> all = surface.parameters();
    for (std::size_t k = 0; k < all.size(); ++k) {
      const bool length = all[k].unit == "m";
      const std::size_t over = all[k].unit.find('/');  // as keys have it: _per_m, _m_per_rad
      const std::string above = all[k].unit.substr(0, over);
      const std::string ending = length ? "_mm"
                                        : (above == "1" ? "" : "_" + above) +
                                              (over == std::string::npos ? "" : "_per_" + all[k].unit.substr(over + 1));
      out.parameters.push_back({fmt::format("{}.{}{}", body, all[k].name, ending), 0.0, false, {}});
      wheelrail::PairParameter parameter;
      parameter.shape_of = shape.facing, parameter.shape = k;
      asked_.push_back(
          {out.parameters.size() - 1, {base_, base_, all[k].step * (length ? kMilli : 1.0)}, std::move(parameter)});
    }
    if (all.empty())
      out.parameters.push_back({std::string(shape.key), kNaN, false,
                                fmt::format("a surface of {} names no parameters of its shape", surface.backend())});
  }

  void add(const SectionHeights& heights, io::CaseDerivatives& out) {
    const double step = factor_step(heights);
    const auto beside = [&](double factor) {
      Prepared moved = *base_;
      const bool rail = heights.facing == Facing::up;
      auto& surface = rail ? moved.geometry.rail : moved.geometry.wheel;
      surface = added_ != nullptr && added_->facing == heights.facing
                    ? with_heights(rail ? base_->given.rail : base_->given.wheel, std::array{*added_, heights},
                                   std::array{1.0, factor})
                    : with_heights(surface, heights, factor);
      return std::make_shared<const Prepared>(std::move(moved));
    };
    out.parameters.push_back({"", 0.0, true, {}});
    const Sides sides{beside(step), beside(-step), step};
    asked_.push_back({out.parameters.size() - 1, sides, {changes(sides), step}});
  }

  void add_fields(wheelrail::Pair& pair, const wheelrail::PairSolution& solution, io::CaseResult& shown) const {
    try {
      const std::vector<wheelrail::HeightGradient> found =
          pair.height_gradients(base_->problem, solution, solution.patches.size(),
                                [](const wheelrail::PairSolution& s, std::span<double> values) {
                                  for (std::size_t k = 0; k < values.size(); ++k)
                                    values[k] = s.patches[k].contact.max_pressure;
                                });
      for (std::size_t k = 0; k < found.size(); ++k) {
        io::PatchFields& fields = shown.patches[k].fields;
        if (found[k].report.status != Status::ok || !(fields.grid == solution.patches[k].grid)) continue;
        fields.pmax_by_rail = found[k].rail_field[k], fields.pmax_by_wheel = found[k].wheel_field[k];
      }
    } catch (const Error&) {  // CONTACT's conventions, a hole in a surface: the table is there without them
    }
  }

  static std::function<void(double, wheelrail::Problem&, wheelrail::Geometry&)> changes(const Sides& sides) {
    return [sides](double amount, wheelrail::Problem& problem, wheelrail::Geometry& geometry) {
      const Prepared& there = amount > 0.0 ? *sides.more : *sides.less;
      problem = there.problem, geometry = there.geometry;
    };
  }

  static void name_numbers(const io::CaseResult& here, io::CaseDerivatives& out) {
    for_each_number(here, [&](std::string name, const auto& row, const auto& of) {
      out.numbers.push_back({std::move(name), row.unit.in_file(row.access.get(of(here))),
                             std::vector<double>(out.parameters.size(), kNaN)});
    });
    const io::PatchResult& patch = here.patches.front();
    const auto rows = io::quantities<io::PatchResult>();
    const auto twice = [&](const io::Quantity<io::PatchResult>& row) {  // a number that another row has, too
      return std::any_of(rows.begin(), rows.end(), [&](const io::Quantity<io::PatchResult>& other) {
        return other.access.smooth && other.key == row.key && other.object != row.object;
      });
    };
    for (const io::Quantity<io::PatchResult>& row : rows)
      if (!row.key.empty() && !row.access.smooth && io::has_block(patch, row.block) && row.has(patch) && !twice(row))
        out.without.push_back(io::name_of(row));
  }

  static void fill(const Asked& asked, const wheelrail::PairNeighbours& found, io::CaseDerivatives& out) {
    const Sides& sides = asked.sides;
    io::CaseDerivatives::Parameter& parameter = out.parameters[asked.place];
    if (found.report.status != Status::ok) {
      parameter.left_out = found.report.message;
      return;
    }
    parameter.of_surfaces |= found.heights == HeightsBy::differences;
    const io::CaseResult more = to_result(sides.more->input, found.more),
                         less = to_result(sides.less->input, found.less);
    std::size_t next = 0;
    for_each_number(more, [&](const std::string& name, const auto& row, const auto& of) {
      std::size_t here = next;
      while (here < out.numbers.size() && out.numbers[here].name != name) ++here;
      if (here == out.numbers.size()) return;  // a number that the case itself does not have
      next = here + 1;
      // units are factors, so that the difference has a unit of its own
      const double difference = row.access.get(of(more)) - row.access.get(of(less));
      out.numbers[here].by[asked.place] = row.unit.in_file(difference) / (2.0 * sides.step);
    });
  }

  const io::Case& case_;
  SurfaceStore& store_;
  const SampledRegions& regions_;
  const SectionHeights* added_;
  /// Surfaces with them, by those without: of one surface always the same one.
  std::map<std::shared_ptr<const Surface>, std::shared_ptr<const Surface>> with_added_;
  std::shared_ptr<const Prepared> base_;
  std::vector<Asked> asked_;
};

/// What derive() gives; keys have been looked at: where it fails it is the case that has none.
template <class Derive>
io::CaseDerivatives with_reason(Derive&& derive) {
  try {
    return derive();
  } catch (const Error& e) {
    io::CaseDerivatives none;
    none.message = e.what();
    return none;
  }
}

/// The usual keys as far as a case gives them, else those asked for.
std::vector<std::string> keys_for(const io::Case& c, const std::vector<std::string>& asked) {
  if (!asked.empty()) return asked;
  std::vector<std::string> out;
  for (const char* key : kUsualKeys)
    if (io::number_of(c, key)) out.emplace_back(key);
  return out;
}

io::CaseDerivatives derivatives_of(const io::Case& c, SurfaceStore& store, const SampledRegions& regions,
                                   const std::vector<std::string>& asked, io::CaseResult& shown) {
  io::CaseDerivatives none;
  if (!std::holds_alternative<io::WheelRailCase>(c.content)) {
    none.message = "a patch by itself has no placement: derivatives are those of a wheel on a rail";
    return none;
  }
  return with_reason([&] { return CaseTangents(c, store, regions).by(keys_for(c, asked), {}, &shown); });
}

}  // namespace

io::CaseDerivatives derivatives_by(const io::Case& c, SurfaceStore& store, const SampledRegions& regions,
                                   const std::vector<std::string>& keys, std::span<const SectionHeights> heights,
                                   const SectionHeights* added) {
  io::CaseDerivatives out = with_reason([&] { return CaseTangents(c, store, regions, added).by(keys, heights); });
  for (std::size_t k = 0; k < out.parameters.size(); ++k) {
    if (out.parameters[k].left_out != kNothingFollows) continue;
    out.parameters[k].left_out.clear();
    for (io::CaseDerivatives::Number& number : out.numbers) number.by[k] = 0.0;
  }
  return out;
}

std::vector<std::pair<std::string, double>> smooth_numbers(const io::CaseResult& result) {
  std::vector<std::pair<std::string, double>> out;
  for_each_number(result, [&](std::string name, const auto& row, const auto& of) {
    const double value = row.unit.in_file(row.access.get(of(result)));
    if (std::isfinite(value)) out.emplace_back(std::move(name), value);
  });
  return out;
}

void check_derivative_keys(const io::CaseFile& file, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) {
    if (shape_key(key) != nullptr) continue;
    const bool given = std::any_of(file.cases.begin(), file.cases.end(),
                                   [&](const io::Case& c) { return io::number_of(c, key).has_value(); });
    if (!given)
      throw Error(ErrorKind::configuration, fmt::format("there are no derivatives by {}: no case gives it", key), {},
                  "write it into the case file, or name another key");
  }
}

double difference_step(std::string_view si_unit, double value) {
  struct Step {
    std::string_view unit;
    double step;
  };
  constexpr Step kSteps[] = {{"m", 5e-8}, {"rad", 5e-8}, {"N", 1.0}};
  constexpr double kOther = 1e-5;
  for (const Step& row : kSteps)
    if (row.unit == si_unit) return row.step;
  return kOther * std::max(1.0, std::abs(value));
}

GapNumber gap_number(const io::ListedNumber& number) {
  using kalker::Quantity;
  using Of = wheelrail::PairQuantity::Of;
  struct Row {
    std::string_view name;
    GapNumber number;
  };
  constexpr Row kNumbers[] = {
      {"wheelset.z_mm", {{Of::height, 0, {}}, 1.0}},
      {"force_on_rail.fz_tr_N", {{Of::vertical_force, 0, {}}, 1.0}},
      {"fn_N", {{Of::patch, 0, Quantity::force_n}, 1.0}},
      {"fx_N", {{Of::patch, 0, Quantity::force_x}, 1.0}},
      {"fs_N", {{Of::patch, 0, Quantity::force_y}, 1.0}},
      {"approach_mm", {{Of::patch, 0, Quantity::approach}, 1.0}},
      {"pmax_MPa", {{Of::patch, 0, Quantity::max_pressure}, 1.0}},
      {"elastic_energy_J", {{Of::patch, 0, Quantity::elastic_energy}, 1.0}},
      {"dissipated_W", {{Of::patch, 0, Quantity::frictional_power}, -1.0}},
  };
  const std::string name = number.of_case != nullptr    ? io::name_of(*number.of_case)
                           : number.of_patch != nullptr ? io::name_of(*number.of_patch)
                                                        : number.name;
  for (const Row& row : kNumbers) {
    if (row.name != name) continue;
    GapNumber out = row.number;
    out.quantity.patch = static_cast<std::size_t>(std::max(1, number.patch)) - 1;
    return out;
  }
  std::vector<std::string_view> known;
  for (const Row& row : kNumbers) known.push_back(row.name);
  throw Error(ErrorKind::configuration, fmt::format("{} has no derivatives by gaps", number.name), {},
              fmt::format("these have: {}", fmt::join(known, ", ")));
}

void add_derivatives(io::RunResult& result, const io::CaseFile& file, SurfaceStore& store,
                     const std::vector<std::string>& keys, const Progress& progress) {
  check_derivative_keys(file, keys);
  const SampledRegions regions = sampled_regions(file);
  const std::vector<const io::Case*> c = solved_cases(file, result);
  std::size_t finished = 0;
  try {
    const CancellationScope scope(progress.stop);
    for (std::size_t i = 0; i < result.cases.size(); ++i) {
      io::CaseResult& solved = result.cases[i];
      check_cancelled();
      solved.derivatives = derivatives_of(*c[i], store, regions, keys, solved);
      if (progress.report)
        progress.report(++finished, result.cases.size(), fmt::format("derivatives of case {}", solved.number));
    }
  } catch (const Cancelled&) {  // the cases themselves are whole
    result.complete = false;
  }
}

}  // namespace treadmark::app
