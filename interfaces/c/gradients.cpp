// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "treadmark/app/cases/case_derivatives.hpp"
#include "treadmark/app/cases/wheelrail_case.hpp"
#include "treadmark/app/cases/wheelrail_result.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/handles.hpp"
#include "treadmark/interfaces/c/many.hpp"
#include "treadmark/interfaces/c/surfaces.hpp"

namespace treadmark::c {
namespace {

/// What a solution of this pair was solved for.
const io::WheelRailCase& given_to(const tm_pair* p, const tm_solution* s) {
  require(p != nullptr && s != nullptr, "pair and solution must not be null");
  require(s->pair && s->geometry.rail == p->geometry.rail && s->geometry.wheel == p->geometry.wheel,
          "the solution is not one of this pair");
  if (s->pair->status != Status::ok)
    throw Error(ErrorKind::numerical, "a solution that is not ok has no derivatives: " + s->pair->message);
  return std::get<io::WheelRailCase>(s->input->content);
}

/// The number of this name, of a patch that stays the same one when numbers change.
io::ListedNumber number_named(std::string_view name, const io::CaseResult& result) {
  io::ListedNumber number = io::listed_number(name, io::Names::si);
  if (number.of_patch != nullptr && number.patch == 0)
    number.patch =
        1 + static_cast<int>(ranges::max_element(result.patches, {}, &io::PatchResult::fn) - result.patches.begin());
  require(number.of_patch == nullptr || static_cast<std::size_t>(number.patch) <= result.patches.size(),
          "there is no patch of this number");
  return number;
}

/// A number by which derivatives are wanted, with the cases that have it a step more and a step less.
struct Beside {
  io::WheelRailCase more, less;
  wheelrail::PairParameter parameter;
  double step = 0.0;
};

Beside beside(const tm_pair& p, const tm_solution& s, const std::string& name) {
  const auto& given = std::get<io::WheelRailCase>(s.input->content);
  for (const Surface* surface : {p.geometry.rail.get(), p.geometry.wheel.get()}) {
    const std::string_view body = surface->facing() == Facing::up ? "rail." : "wheel.";
    if (!name.starts_with(body)) continue;
    const std::vector<ShapeParameter> all = surface->parameters();
    const auto found = ranges::find(all, name.substr(body.size()), &ShapeParameter::name);
    if (found == all.end()) continue;
    Beside out{given, given, {}, found->step};
    out.parameter.shape_of = surface->facing();
    out.parameter.shape = static_cast<std::size_t>(found - all.begin());
    return out;
  }
  const int id = case_number_named(name);
  require(id >= 0, "no number of cases has this name (tm_list names them), and no parameter of the pair's surfaces");
  const CaseNumber& number = case_numbers()[static_cast<std::size_t>(id)];
  // a placement by something else is another case on both sides
  const std::optional<double> in_file = io::number_of(*s.input, number.key->info.path);
  if (!in_file) throw Error(ErrorKind::configuration, "the case does not give it", {}, "set it, and solve again");
  const double value = *in_file * number.si, step = app::difference_step(number.unit, value);
  const auto changed = [&](double amount) {
    tm_case c{std::make_shared<io::Case>(*s.input), {}, false};
    set_number(c, number, value + amount);
    return checked_for(p, &c);
  };
  Beside out{changed(step), changed(-step), {}, step};
  const bool round = p.geometry.round_wheel;
  const wheelrail::Problem more = app::to_problem(out.more, round), less = app::to_problem(out.less, round);
  if (more == less)
    throw Error(ErrorKind::configuration, "contact does not follow from it: the surfaces of a pair stay as they are");
  out.parameter.step = step;
  out.parameter.change = [more, less](double amount, wheelrail::Problem& problem, wheelrail::Geometry&) {
    problem = amount > 0.0 ? more : less;
  };
  return out;
}

/// The same; errors say of which number.
Beside beside_named(const tm_pair& p, const tm_solution& s, const std::string& name) {
  try {
    return beside(p, s, name);
  } catch (const Error& e) {
    throw Error(e.kind(), fmt::format("there are no derivatives by {}: {}", name, e.message()), {}, e.advice());
  }
}

io::ListedNumber smooth_number(const char* name, tm_solution* s) {
  require(name != nullptr, "the name of a number must not be null");
  io::ListedNumber n = number_named(name, result_of(s));
  if (!(n.of_case != nullptr ? n.of_case->access.smooth : n.of_patch != nullptr && n.of_patch->access.smooth))
    throw Error(ErrorKind::configuration, fmt::format("{} has no derivatives", name), {},
                "treadmark run --sensitivities names the numbers that have them");
  return n;
}

wheelrail::HeightGradient by_heights(tm_pair* p, tm_solution* s, const char* name) {
  io::WheelRailCase given = given_to(p, s);
  const io::ListedNumber number = smooth_number(name, s);
  if (!std::isfinite(number.si(result_of(s))))
    throw Error(ErrorKind::numerical, fmt::format("{} is not known of this solution", name));
  const wheelrail::Problem problem = app::to_problem(given, p->geometry.round_wheel);
  given.subsurface = {};
  std::vector<wheelrail::HeightGradient> found = p->pair.height_gradients(
      problem, *s->pair, 1, [&](const wheelrail::PairSolution& beside, std::span<double> value) {
        value[0] = number.si(app::to_result(given, beside));
      });
  if (found[0].report.status != Status::ok) throw Error(ErrorKind::numerical, found[0].report.message);
  return std::move(found[0]);
}

std::size_t elements_of(const wheelrail::PairSolution& solution) {
  std::size_t elements = 0;
  for (const wheelrail::PatchSolution& patch : solution.patches) elements += patch.grid.size();
  return elements;
}

}  // namespace
}  // namespace treadmark::c

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_pair_gradient(tm_pair* p, tm_solution* s, const char* const* numbers, size_t n_numbers,
                           const char* const* by, size_t n_by, double* derivatives) {
  return guarded([&] {
    const io::WheelRailCase& given = given_to(p, s);
    require(derivatives != nullptr || n_numbers * n_by == 0, "derivatives must not be null");
    std::vector<io::ListedNumber> wanted;
    for (const std::string& name : texts_of(numbers, n_numbers, "numbers must be n_numbers texts"))
      wanted.push_back(smooth_number(name.c_str(), s));
    std::vector<Beside> sides;
    for (const std::string& name : texts_of(by, n_by, "by must be n_by texts"))
      sides.push_back(beside_named(*p, *s, name));
    std::vector<wheelrail::PairParameter> parameters;
    for (const Beside& side : sides) parameters.push_back(side.parameter);
    const std::vector<wheelrail::PairNeighbours> found =
        p->pair.neighbours(app::to_problem(given, p->geometry.round_wheel), *s->pair, parameters);
    std::vector<double> all(n_numbers * n_by);
    for (std::size_t i = 0; i < n_by; ++i) {
      if (found[i].report.status != Status::ok)
        throw Error(ErrorKind::numerical,
                    fmt::format("there is no derivative by {}: {}", by[i], found[i].report.message));
      for (io::WheelRailCase* input : {&sides[i].more, &sides[i].less}) input->subsurface = {};
      const io::CaseResult more = app::to_result(sides[i].more, found[i].more),
                           less = app::to_result(sides[i].less, found[i].less);
      for (std::size_t k = 0; k < n_numbers; ++k) {
        double& slope = all[k * n_by + i];
        slope = (wanted[k].si(more) - wanted[k].si(less)) / (2.0 * sides[i].step);
        if (!std::isfinite(slope))
          throw Error(ErrorKind::numerical, fmt::format("{} is not known of this solution", numbers[k]));
      }
    }
    std::copy(all.begin(), all.end(), derivatives);
  });
}

tm_status tm_pair_gradient_by_gap(tm_pair* p, tm_solution* s, const char* number, double* by_gap, size_t n) {
  return guarded([&] {
    const io::WheelRailCase& given = given_to(p, s);
    require(number != nullptr && by_gap != nullptr, "number and by_gap must not be null");
    require(n == elements_of(*s->pair), "n must be the number of elements of all patches (tm_patch_grid)");
    if (given.damping)
      throw Error(ErrorKind::configuration, "forces with damping have no derivatives by gaps", {}, "leave it out");
    const app::GapNumber of = app::gap_number(number_named(number, result_of(s)));
    const wheelrail::PairGradient found =
        p->pair.gradient(app::to_problem(given, p->geometry.round_wheel), *s->pair, of.quantity);
    if (found.report.status != Status::ok) throw Error(ErrorKind::numerical, found.report.message);
    for (const std::vector<double>& patch : found.by_gap)
      by_gap = std::transform(patch.begin(), patch.end(), by_gap, [&](double by) { return of.factor * by; });
  });
}

tm_status tm_pair_gradient_by_shape(tm_pair* p, tm_solution* s, const char* number, tm_body body, double* by_shape,
                                    size_t n, int* exact) {
  return guarded([&] {
    given_to(p, s);
    const bool rail = body_of(body) == Body::rail;
    const Surface& surface = rail ? *p->geometry.rail : *p->geometry.wheel;
    require(by_shape != nullptr || n == 0, "by_shape must not be null");
    require(n == surface.parameter_count(), "n must be the number of the surface's parameters (tm_surface_parameters)");
    const wheelrail::HeightGradient found = by_heights(p, s, number);
    const wheelrail::ShapeGradient pulled = wheelrail::pulled_back(surface, rail ? found.rail : found.wheel);
    std::copy(pulled.by.begin(), pulled.by.end(), by_shape);
    if (exact != nullptr) *exact = pulled.heights == HeightsBy::exact ? 1 : 0;
  });
}

tm_status tm_pair_gradient_by_height(tm_pair* p, tm_solution* s, const char* number, tm_body body, double* by_height,
                                     size_t n) {
  return guarded([&] {
    given_to(p, s);
    const bool rail = body_of(body) == Body::rail;
    require(by_height != nullptr, "by_height must not be null");
    require(n == elements_of(*s->pair), "n must be the number of elements of all patches (tm_patch_grid)");
    const wheelrail::HeightGradient found = by_heights(p, s, number);
    for (const std::vector<double>& patch : rail ? found.rail_field : found.wheel_field)
      by_height = std::copy(patch.begin(), patch.end(), by_height);
  });
}

}  // extern "C"
