// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors

#include <cmath>

#include "treadmark/io/cases/shared_keys.hpp"
#include "treadmark/model/magnitudes.hpp"

namespace treadmark::io {

namespace {

using W = WheelRailCase;

void add_case(KeyList& list) {
  CaseKey& regime = shared_choice<Regime>(
      list, "case.regime", words_of<Case>(kRegimes),
      "tangential problem: none, one shift, one step of transient rolling or steady rolling; a [patch] starts from "
      "\"none\"",
      [](auto& c) -> Regime& { return c.regime; });
  regime.info.default_text = "\"steady\"";

  shared_choice<HistoryUse>(
      list, "case.history",
      {{"start", HistoryUse::start},
       {"continue", HistoryUse::keep_going},
       {"normal_only", HistoryUse::normal_only},
       {"same_instant", HistoryUse::same_instant}},
      "what a case takes over from the one before it in its sequence: nothing, its tractions as previous "
      "instant, only the normal part of them, or the same previous instant as that case had",
      [](auto& c) -> HistoryUse& { return c.history; });

  constexpr double kMostSequences = 1e6;
  KeyInfo sequence =
      key_info("case.sequence", KeyType::integer, "cases with the same number follow each other in time");
  sequence.at_least = 0.0;
  sequence.at_most = kMostSequences;
  sequence.default_text = std::string("0");  // a plain literal sets off a false alarm of GCC 12
  CaseKey& number = list.add(sequence);
  number.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    c.sequence = static_cast<int>(v.integer());
  };
  number.text = [](const Case& c) { return std::to_string(c.sequence); };

  KeyInfo table = key_info("case.element_table", KeyType::choice,
                           "text table of the elements of each patch (.mat): none, those in contact or all");
  table.choices = {"none", "contact", "all"};
  table.default_text = "\"none\"";
  CaseKey& elements = list.add(table);
  elements.set = [choices = table.choices](Case& c, const CaseValue& v, const std::filesystem::path&) {
    for (std::size_t i = 0; i < choices.size(); ++i)
      if (choices[i] == v.text()) c.element_table = static_cast<int>(i);
  };
  elements.text = [choices = table.choices](const Case& c) {
    return toml_text(choices.at(static_cast<std::size_t>(c.element_table)));
  };

  shared_flag(list, "case.sensitivities",
              "derivatives of the forces by creepages and approach in the results; full theory",
              [](auto& c) -> bool& { return c.sensitivities; });

  list.choice<W, ErrorBars>(
      "case.error_bars", {{"auto", ErrorBars::automatic}, {"always", ErrorBars::always}, {"never", ErrorBars::never}},
      "how well results are known: auto: where the case says how well it is (case.uncertainty); always: also where "
      "only the import of its surfaces does, or the noise of its profiles; never",
      [](W& c) -> ErrorBars& { return c.error_bars; });
  KeyInfo uncertainty = key_info("case.uncertainty", KeyType::table_list,
                                 "how well what is given is known, for error bars of the results");
  uncertainty.scope = KeyScope::wheel_rail;
  using Known = UncertainInput;
  add_list<Known>(
      list, std::move(uncertainty),
      {required(ElementKey<Known>{
           key_info("key", KeyType::text, "a number of the case by its key, or rail.shape, wheel.shape: heights"),
           [](Known& u, const CaseValue& v) { u.key = v.text(); },
           {},
           [](const Known& u) { return toml_text(u.key); }}),
       required(element_number<Known>("sigma", kPositive,
                                      "standard deviation, in the unit of the key; of heights in mm", &Known::sigma)),
       element_number<Known>(
           "length_mm", kPositive,
           "of heights: places so far apart have errors of their own; noise of points: their distance",
           &Known::length)},
      [](W& c, bool) { return &c.uncertainty; });
}

void add_steps(KeyList& list) {
  constexpr double kMostSteps = 100000;
  list.integer<Case>("case.steps", 0, kMostSteps,
                     "number of cases that a table makes, one after the other in time: a wheelset moves by its "
                     "velocities from each to "
                     "the next where the table does not give the position; 0: one case at the position given",
                     [](Case& c) -> int& { return c.steps; });
  KeyInfo& step = list.number<Case>(
      "case.time_step_s", {0.0, {}, kMostStep},
      "time between two of these cases, from which the rolling step follows; without it the forward velocity "
      "rolls one rolling step (dq_relative * dx_mm). A shift has no time: its velocities are displacements",
      [](Case& c) -> double& { return c.time_step; });
  step.default_text.clear();
}

void add_solver(KeyList& list) {
  shared_number(list, "solver.tolerance", {0.0, {}, 0.1}, "relative accuracy of tractions and forces",
                [](auto& c) -> double& { return c.solver.eps; });
  shared_integer(list, "solver.max_solver_iterations", "iterations of one linear or tangential solve",
                 [](auto& c) -> int& { return c.solver.max_iterations; });
  shared_integer(list, "solver.max_set_iterations", "changes of the contact, adhesion and slip areas",
                 [](auto& c) -> int& { return c.solver.max_outer; });
  shared_integer(list, "solver.max_force_iterations", "iterations on prescribed total forces",
                 [](auto& c) -> int& { return c.solver.max_force; });
  shared_integer(list, "solver.max_outer_iterations",
                 "alternations of the normal and the tangential problem of dissimilar bodies; 1: tangential tractions "
                 "do not act on the "
                 "normal problem",
                 [](auto& c) -> int& { return c.solver.max_coupling; });
  using Method = SolverSettings::Method;
  shared_choice<Method>(list, "solver.method", {{"automatic", Method::automatic}, {"sweeps", Method::sweeps}},
                        "tangential solver: the one that suits the problem, or sweeps over single elements",
                        [](auto& c) -> Method& { return c.solver.method; });
  using First = SolverSettings::FirstSlip;
  shared_choice<First>(
      list, "solver.first_slip", {{"below", First::below}, {"above", First::above}, {"last", First::last}},
      "falling friction with several solutions: slip velocity to start from: none, the rolling velocity, or that of "
      "the case before",
      [](auto& c) -> First& { return c.solver.first_slip; });
}

/// A [patch] has such keys of its own.
void add_wheel_rail_models(KeyList& list) {
  list.choice<W>("solver.normal_model", words_of<W>(kNormalTheories),
                 "pressure of a wheel on a rail: solved, or one of two approximations; kpec is the faster one",
                 [](W& c) -> NormalModel& { return c.normal_model; });
  add_simplified_theory<W>(list, "solver.");
}

}  // namespace

void add_general_keys(KeyList& list) {
  add_case(list);
  add_steps(list);
  add_material_keys(list);
  add_friction_keys(list);
  add_solver(list);
  add_wheel_rail_models(list);
}

namespace {

using Block = SubsurfaceInput::Block;

/// Columns or rows of elements, counted from 0.
ElementKey<Block> element_indices(const std::string& name, std::string doc, std::vector<int> Block::*member) {
  constexpr double kMost = 4e6;
  KeyInfo info = key_info(name, KeyType::number_list, std::move(doc));
  info.at_least = 0.0;
  info.at_most = kMost;
  info.group = "subsurface points";
  info.alternative = "elements";
  return {info,
          [name, member](Block& b, const CaseValue& v) {
            std::vector<int> list;
            for (const CaseValue& one : v.list()) {
              if (one.number() != std::floor(one.number()))
                throw Error(ErrorKind::configuration, name + " must be a list of integers", one.where);
              list.push_back(static_cast<int>(one.number()));
            }
            b.*member = std::move(list);
          },
          {},
          [member](const Block& b) {
            return !b.at_elements || (b.*member).empty() ? std::string()
                                                         : fmt::format("[{}]", fmt::join(b.*member, ", "));
          }};
}

ElementKey<Block> element_lengths(const std::string& name, std::string doc, std::vector<double> Block::*member,
                                  bool free) {
  KeyInfo info = key_info(name, KeyType::number_list, std::move(doc));
  if (free) {
    info.group = "subsurface points";
    info.alternative = "free";
  }
  return {info,
          [member, free, unit = unit_of_key(name)](Block& b, const CaseValue& v) {
            b.*member = numbers_of(v, unit);
            if (free) b.at_elements = false;
          },
          {},
          [member, free, unit = unit_of_key(name)](const Block& b) {
            return free && b.at_elements ? std::string() : exact_list(b.*member, unit);
          }};
}

SubsurfaceInput& subsurface(Case& c) {
  return std::visit([](auto& content) -> SubsurfaceInput& { return content.subsurface; }, c.content);
}

}  // namespace

void add_subsurface_keys(KeyList& list) {
  std::vector<ElementKey<Block>> keys{
      element_indices("columns", "under the elements of these columns, counted from 0; without it of all",
                      &Block::columns),
      element_indices("rows", "under the elements of these rows, counted from 0; without it of all", &Block::rows),
      element_lengths("x_mm", "free points instead: their x; with y_mm a grid", &Block::x, true),
      element_lengths("y_mm", "free points instead: their y", &Block::y, true),
      required(element_lengths("z_mm", "depths, positive in body 1, negative in body 2", &Block::z, false))};
  KeyInfo blocks = key_info("subsurface.blocks", KeyType::table_list,
                            "grids of points at which stresses below the surface are computed");
  add_list<Block, Case>(list, std::move(blocks), std::move(keys), [](Case& c, bool) { return &subsurface(c).blocks; });

  KeyInfo table = key_info("subsurface.text_table", KeyType::choice,
                           "text table of them (.subs): none, stress invariants, or all stresses too");
  table.choices = {"none", "invariants", "tensor"};
  table.default_text = "\"none\"";
  CaseKey& wanted = list.add(table);
  wanted.set = [](Case& c, const CaseValue& v, const std::filesystem::path&) {
    SubsurfaceInput& s = subsurface(c);
    s.text_table = v.text() != "none";
    s.full_tensor = v.text() == "tensor";
  };
  wanted.text = [](const Case& c) {
    const SubsurfaceInput& s = subsurface(const_cast<Case&>(c));
    return toml_text(!s.text_table ? "none" : s.full_tensor ? "tensor" : "invariants");
  };
}

}  // namespace treadmark::io
