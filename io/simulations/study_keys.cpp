// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/study_keys.hpp"

namespace treadmark::io {

const KeyTable<StudyFile>& study_keys() {
  using S = StudyFile;
  static const auto keys = key_table<S>([](auto& list) {
    list.text("title", "without it the name of the file", &S::title);
    list.value(key_info("base", KeyType::path, "simulation or case file"), &S::base);
    list.table("vary", KeyType::table_list, "what is varied, the last one fastest", vary_keys().infos, &S::variations);
    list.table("figures", KeyType::table_list, "pictures of the results", figure_keys().infos, &S::figures);
  });
  return keys;
}

const KeyTable<VaryInput>& vary_keys() {
  using V = VaryInput;
  static const auto keys = key_table<V>([](auto& list) {
    list.text(
        "key", "key of the base, as in `--set`", [](auto& v) -> auto& { return v.variation.key; });
    list.text(
        "label", "for charts, default the key", [](auto& v) -> auto& { return v.variation.label; });
    list.value(
        key_info("values", KeyType::value_list,
                 "numbers, texts, true or false, lists, or sets of keys: tables of `label` (required) and "
                 "`set`, a list of `\"key=value\"` (required)"),
        [](auto& v) -> auto& { return v.variation.values; }, kNoDefault, "a list of values, or from, to and count");
    list.number("from", kAnyNumber, "instead of `values`: evenly spaced numbers from here", &V::from, kNoDefault);
    list.number("to", kAnyNumber, "the last of them", &V::to, kNoDefault, "from, to and count belong together");
    list.integer("count", 2, kMostValues, "how many of them", &V::count, kNoDefault,
                 "from, to and count belong together");
    list.choice("spacing", {{"linear", false}, {"logarithmic", true}}, "even steps or even ratios", &V::logarithmic);
  });
  return keys;
}

const KeyTable<VariedValue>& vary_value_keys() {
  using V = VariedValue;
  static const auto keys = key_table<V>([](auto& list) {
    list.text("label", "for charts", &V::label, kNeeded);
    list.words("set", "\"key=value\"", &V::overrides, kNeeded, "a list of \"key=value\"");
  });
  return keys;
}

const KeyTable<StudyFigure>& figure_keys() {
  using F = StudyFigure;
  static const auto keys = key_table<F>([](auto& list) {
    list.text("file", "a name without folders that ends with `.svg`", &F::file, kNeeded);
    list.choice("kind", {{"history", F::Kind::history}, {"summary", F::Kind::summary}, {"patches", F::Kind::patches}},
                "a line for each run, a point for each run, or contact patches", &F::kind, kNeeded);
    list.text("title", "above the figure", &F::title);
    list.text("x", "column along the axis, or the key of a variation (required but for patches)", &F::x, kNoDefault,
              "the column along the axis");
    list.words("y", "columns (required but for patches)", &F::y, kNoDefault, "a list of columns");
    list.text("x_label", "instead of that of the column", &F::x_label);
    list.text("y_label", "instead of that of the columns", &F::y_label);
    list.value(key_info("x_range", KeyType::number_list, "two numbers"), &F::x_range)
        .read_by([](F& figure, const CaseValue& value) {
          const std::vector<double> range = numbers_of(value, 1.0);
          if (range.size() == 2 && range[0] < range[1]) figure.x_range = {range[0], range[1]};
        });
    list.text("series", "variation whose values get a line each, by its key or label", &F::series);
    list.words("labels", "names of these lines instead of the values", &F::labels);
    list.value(key_info("only", KeyType::text_list,
                        "`\"key=value\"`: of the variations named, by key or label, only these values are drawn"),
               &F::only);
    list.table("mark", KeyType::table_list, "numbers of others", mark_keys().infos, &F::marks);
  });
  return keys;
}

const KeyTable<FigureMark>& mark_keys() {
  using M = FigureMark;
  static const auto keys = key_table<M>([](auto& list) {
    list.number("x", kAnyNumber, "in the unit of the column", &M::x, kNeeded);
    list.number("y", kAnyNumber, "in the unit of the column", &M::y, kNeeded);
    list.text("label", "beside it", &M::label);
  });
  return keys;
}

}  // namespace treadmark::io
