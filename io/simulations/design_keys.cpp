// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/design_keys.hpp"

#include "treadmark/io/simulations/study_keys.hpp"

namespace treadmark::io {
namespace {

/// What goals and limits are of.
template <class List>
void add_quantity_keys(List& list) {
  list.text(
      "quantity",
      "a number of [results](results.md) with derivatives, `conicity`, or of the depth `removed_mm2`, `bend_1_per_m`, "
      "`convexity_1_per_m`",
      [](auto& i) -> auto& { return i.of.name; }, kNeeded);
  list.number_list(
      "amplitudes_mm", kPositive, "of the conicity, required there", [](auto& i) -> auto& { return i.of.amplitudes; });
}

}  // namespace

const KeyTable<DesignInput>& design_keys() {
  using I = DesignInput;
  using Method = DesignFile::Method;
  static const auto keys = key_table<I>([](auto& list) {
    list.text(
        "title", "without it the name of the file", [](auto& i) -> auto& { return i.file.positions.title; });
    list.value(
        key_info("base", KeyType::path, "case file; its tables may stand beside [design] instead"),
        [](auto& i) -> auto& { return i.file.positions.base; });
    list.table(
        "vary", KeyType::table_list, "positions: their product, the last one fastest, as in [[study.vary]]",
        vary_keys().infos, [](auto& i) -> auto& { return i.file.positions.variations; });
    list.number_list(
        "weights", kNotNegative,
        "share of each position in the order of the product, made to sum up to 1; default: equal",
        [](auto& i) -> auto& { return i.file.weights; });
    list.choice(
        "method", {{"slsqp", Method::slsqp}, {"mma", Method::mma}},
        "sequential quadratic programming (Kraft 1988), or moving asymptotes (Svanberg 2002)",
        [](auto& i) -> auto& { return i.file.method; });
    list.integer(
        "solutions", 1, kMostValues,
        "of cases at most, without those that check the result; of designs where no goal and no limit asks for contact",
        [](auto& i) -> auto& { return i.file.solutions; });
    list.number(
        "tolerance", {0.0, {}, 0.1},
        "ends the search: change of the sum as a share of it, or of all that is sought as a share of its range",
        [](auto& i) -> auto& { return i.file.tolerance; });
    list.table("depth", KeyType::table, "depths across a body are sought", design_depth_keys().infos, &I::depth);
    list.table(
        "parameters", KeyType::table_list, "numbers of the base that are sought", design_parameter_keys().infos,
        [](auto& i) -> auto& { return i.file.parameters; });
    list.table(
        "goals", KeyType::table_list, "whose sum becomes least", design_goal_keys().infos,
        [](auto& i) -> auto& { return i.file.goals; }, kNoDefault, "say what is to become least");
    list.table(
        "limits", KeyType::table_list, "that are kept", design_limit_keys().infos,
        [](auto& i) -> auto& { return i.file.limits; });
  });
  return keys;
}

const KeyTable<DesignDepth>& design_depth_keys() {
  using D = DesignDepth;
  static const auto keys = key_table<D>([](auto& list) {
    list.choice("body", {{"rail", Body::rail}, {"wheel", Body::wheel}}, "whose profile changes", &D::body);
    list.number("from_mm", kAnyNumber, "y of the first place", &D::from, kNeeded);
    list.number("to_mm", kAnyNumber, "y of the last place", &D::to, kNeeded);
    list.number("step_mm", kPositive, "between two places, a whole part of the way", &D::step, kNeeded);
    list.number_list("least_mm", kAnyNumber,
                     "depth at each place, or one for all places; negative: material comes on top; without it 0",
                     &D::least);
    list.number_list("most_mm", kAnyNumber,
                     "the same; where both are equal that is the depth. The search begins at the depth nearest to 0",
                     &D::most, kNeeded);
    list.choice("ends", {{"zero", false}, {"level", true}},
                "beyond the places: no depth, or that of the last place goes on", &D::level_ends);
  });
  return keys;
}

const KeyTable<DesignParameter>& design_parameter_keys() {
  using P = DesignParameter;
  static const auto keys = key_table<P>([](auto& list) {
    list.text("key", "of the base, as in `--set`: a number, which the base gives", &P::key, kNeeded);
    list.number("from", kAnyNumber, "least value, in the unit of the key", &P::from, kNeeded);
    list.number("to", kAnyNumber, "greatest value", &P::to, kNeeded);
  });
  return keys;
}

const KeyTable<DesignGoal>& design_goal_keys() {
  using G = DesignGoal;
  static const auto keys = key_table<G>([](auto& list) {
    add_quantity_keys(list);
    list.choice("over", {{"mean", false}, {"largest", true}},
                "the mean of the positions by weight, of patches the one that has most, or the largest of all",
                &G::largest);
    list.number("weight", kPositive, "in the sum", &G::weight);
    list.number("target", kAnyNumber, "the mean of the squares of what is missed becomes least, over `scale`",
                &G::target, kNoDefault);
    list.number("scale", kPositive, "what counts as 1; without it the target, else the value at the start", &G::scale,
                kNoDefault);
  });
  return keys;
}

const KeyTable<DesignLimit>& design_limit_keys() {
  using L = DesignLimit;
  static const auto keys = key_table<L>([](auto& list) {
    add_quantity_keys(list);
    list.number("at_most", kAnyNumber, "in every position, patch or place", &L::at_most, kNoDefault);
    list.number("at_least", kAnyNumber, "the same", &L::at_least, kNoDefault);
  });
  return keys;
}

}  // namespace treadmark::io
