// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/evolve_keys.hpp"

#include "treadmark/io/simulations/study_keys.hpp"

namespace treadmark::io {

const KeyTable<EvolveInput>& evolve_keys() {
  using I = EvolveInput;
  static const auto keys = key_table<I>([](auto& list) {
    list.text(
        "title", "without it the name of the file", [](auto& i) -> auto& { return i.file.positions.title; });
    list.value(
        key_info("base", KeyType::path, "case or simulation file; its tables may stand beside [evolve] instead"),
        [](auto& i) -> auto& { return i.file.positions.base; });
    list.number("distance_km", kPositive, "that the wheelset runs; required where [evolve.wheel] is", &I::distance,
                kNoDefault, "a wheel evolves over it");
    list.number("passages", kPositive, "of wheels over a rail; required where [evolve.rail] is", &I::passages,
                kNoDefault, "a rail evolves over it");
    list.table(
        "vary", KeyType::table_list, "positions: their product, the last one fastest, as in [[study.vary]]",
        vary_keys().infos, [](auto& i) -> auto& { return i.file.positions.variations; });
    list.number_list(
        "weights", kNotNegative,
        "share of each position in the order of the product, made to sum up to 1; default: equal",
        [](auto& i) -> auto& { return i.file.weights; });
    list.number(
        "max_depth_mm", kPositive, "most that an update may remove", [](auto& i) -> auto& { return i.file.max_depth; });
    list.number(
        "max_pressure_change", kPositive, "most that an update may change the largest pressure of a case, as a share",
        [](auto& i) -> auto& { return i.file.max_pressure_change; });
    list.number(
        "smallest_step", {0.0, {}, 1.0}, "share of the whole that an update makes at least, whatever the limits say",
        [](auto& i) -> auto& { return i.file.smallest_step; });
    list.integer(
        "updates", 1, kMostValues, "so many equal updates instead of those that keep the limits",
        [](auto& i) -> auto& { return i.file.updates; }, kNoDefault);
    list.integer(
        "fields_every", 0, kMostValues, "contact fields of every so many generations are kept; 0: none",
        [](auto& i) -> auto& { return i.file.fields_every; });
    list.table("wheel", KeyType::table, "the wheel evolves", evolving_body_keys().infos, &I::wheel);
    list.table("rail", KeyType::table, "the rail evolves", evolving_body_keys().infos, &I::rail);
  });
  return keys;
}

const KeyTable<EvolvingBody>& evolving_body_keys() {
  using B = EvolvingBody;
  static const auto keys = key_table<B>([](auto& list) {
    list.choice("along", {{"uniform", false}, {"local", true}},
                "the same all round or along the track, or each place by itself: cases of the base follow each other "
                "round the wheel or along the rail",
                &B::local);
    list.number("du_mm", kPositive, "step of the cells along, where it is local", &B::du);
    list.number("dy_mm", kPositive, "step of the cells across", &B::dy);
    list.number("smoothing_mm", kNotNegative,
                "standard deviation of the Gaussian kernel over what an update removes; 0: none", &B::smoothing);
    list.table("law", KeyType::table, "how contact removes depth: numbers of your own, or the name of a law",
               wear_law_keys().infos, &B::law, kNeeded, "name one of `treadmark list laws`, or give your numbers")
        .key.info.choices = law_names<WearLaw>();
    list.table("fatigue", KeyType::table,
               "what contact does to the material below, without changing it: the same, or the name of a law",
               fatigue_keys().infos, &B::fatigue)
        .key.info.choices = law_names<FatigueSettings>();
    list.table("flow", KeyType::table, "how contact makes the material below flow", flow_law_keys().infos, &B::flow);
  });
  return keys;
}

}  // namespace treadmark::io
