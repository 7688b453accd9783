// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/read_design.hpp"

#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "treadmark/core/constants.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/simulations/design_keys.hpp"
#include "treadmark/io/simulations/read_study.hpp"

namespace treadmark::io {
namespace {

/// One number for all places, or one each.
template <class Member>
void spread(const TableOf<DesignDepth>& table, DesignDepth& depth, Member member, std::size_t places) {
  std::vector<double>& values = depth.*member;
  if (values.empty()) values = {0.0};
  if (values.size() == 1) values.assign(places, values.front());
  if (values.size() != places)
    table.refuse(member, fmt::format("{} has {} numbers for {} places", table.path_of(member), values.size(), places),
                 "give one for all, or one each");
}

DesignDepth read_depth(const TableOf<DesignInput>& design) {
  using D = DesignDepth;
  design.table(design.key(&DesignInput::depth));
  const TableOf table(design.need(&DesignInput::depth), design.path_of(&DesignInput::depth), design_depth_keys());
  D out = table.read();
  out.where = table.where();
  constexpr double kWhole = 1e-6, kMostPlaces = 200.0;
  const double steps = (out.to - out.from) / out.step, whole = std::round(steps);
  if (!(whole >= 1.0) || std::fabs(steps - whole) > kWhole)
    table.refuse(&D::step, fmt::format("from {:g} to {:g} mm there is no whole number of steps of {:g} mm",
                                       kMilli * out.from, kMilli * out.to, kMilli * out.step));
  if (whole >= kMostPlaces)
    table.refuse(&D::step, fmt::format("{:.0f} places are more than {:.0f}", whole + 1.0, kMostPlaces));
  const auto places = to_whole<std::size_t>(whole) + 1;
  spread(table, out, &D::least, places);
  spread(table, out, &D::most, places);
  bool sought = false;
  for (std::size_t k = 0; k < places; ++k) {
    if (!(out.least[k] <= out.most[k]))
      table.refuse(&D::most, fmt::format("at y = {:g} mm {:g} mm is less than {}",
                                         kMilli * (out.from + static_cast<double>(k) * out.step), kMilli * out.most[k],
                                         table.path_of(&D::least)));
    sought |= out.least[k] < out.most[k];
  }
  if (!sought) table.refuse(&D::most, "no depth is sought: every place has one that is given");
  return out;
}

/// What goals and limits are of, with its place.
template <class Root>
void settle_quantity(const TableOf<Root>& table, Root& root) {
  const auto amplitudes = [](auto& i) -> auto& { return i.of.amplitudes; };
  root.of.where = table.need([](auto& i) -> auto& { return i.of.name; }).where;
  const std::vector<double>& values = root.of.amplitudes;
  for (std::size_t i = 1; i < values.size(); ++i)
    if (!(values[i] > values[i - 1]))
      table.refuse(amplitudes, fmt::format("{} must increase", table.path_of(amplitudes)));
}

template <class Root, class Member>
std::vector<TableOf<Root>> tables_of(const TableOf<DesignInput>& design, Member member, const KeyTable<Root>& keys) {
  std::vector<TableOf<Root>> out;
  for (const CaseValue* one : design.tables(member)) out.emplace_back(*one, design.path_of(member), keys);
  return out;
}

std::vector<DesignParameter> read_parameters(const TableOf<DesignInput>& design) {
  using P = DesignParameter;
  std::vector<P> out;
  const auto member = [](auto& i) -> auto& { return i.file.parameters; };
  for (const TableOf<P>& table : tables_of(design, member, design_parameter_keys())) {
    P one = table.read();
    one.where = table.need(&P::key).where;
    if (!(one.from < one.to))
      table.refuse(&P::to, fmt::format("{} must be more than {}", table.path_of(&P::to), table.path_of(&P::from)));
    if (ranges::any_of(out, [&](const P& other) { return other.key == one.key; }))
      table.refuse(&P::key, fmt::format("{} is sought twice", one.key));
    out.push_back(std::move(one));
  }
  return out;
}

std::vector<DesignGoal> read_goals(const TableOf<DesignInput>& design) {
  using G = DesignGoal;
  std::vector<G> out;
  const auto member = [](auto& i) -> auto& { return i.file.goals; };
  design.need(member);
  for (const TableOf<G>& table : tables_of(design, member, design_goal_keys())) {
    G one = table.read();
    settle_quantity(table, one);
    if (one.largest && one.target)
      table.refuse(&G::target, fmt::format("{} is for means", table.path_of(&G::target)),
                   "leave it out, or put the largest into [[design.limits]]");
    if (one.target == 0.0 && !one.scale)
      table.refuse(&G::target, fmt::format("a target of 0 needs {}", table.path_of(&G::scale)));
    out.push_back(std::move(one));
  }
  if (out.empty()) design.refuse(member, fmt::format("{} is empty", design.path_of(member)));
  return out;
}

std::vector<DesignLimit> read_design_limits(const TableOf<DesignInput>& design) {
  using L = DesignLimit;
  std::vector<L> out;
  const auto member = [](auto& i) -> auto& { return i.file.limits; };
  for (const TableOf<L>& table : tables_of(design, member, design_limit_keys())) {
    L one = table.read();
    settle_quantity(table, one);
    if (!one.at_most) table.need(&L::at_least);
    if (one.at_most && one.at_least && *one.at_least > *one.at_most)
      table.refuse(&L::at_least,
                   fmt::format("{} is more than {}", table.path_of(&L::at_least), table.path_of(&L::at_most)));
    out.push_back(std::move(one));
  }
  return out;
}

}  // namespace

DesignFile read_design_file(const std::filesystem::path& file, std::span<const std::string> overrides) {
  StudyTables tables(file, "design", overrides);
  const TableOf design(tables.table->value, "design", design_keys());
  DesignInput given = design.read();
  DesignFile& out = given.file;
  if (design.find(&DesignInput::depth) != nullptr) out.depth = read_depth(design);
  out.parameters = read_parameters(design);
  if (!out.depth && out.parameters.empty())
    design.fail("nothing is sought: neither [design.depth] nor [[design.parameters]] is there", "give one of them");
  out.goals = read_goals(design);
  out.limits = read_design_limits(design);
  tables.read_runs(design);
  if (tables.study.base_is_simulation)
    design.fail("the base of a design is a case file, this is a simulation",
                "take contacts of it as cases: treadmark convert --at");
  out.weights = shares_of_runs(std::move(out.weights), tables.study.runs.size(), design,
                               design.key([](auto& i) -> auto& { return i.file.weights; }));
  out.positions = std::move(tables.study);
  return std::move(out);
}

}  // namespace treadmark::io
