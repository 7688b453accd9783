// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/damage/named_laws.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

template <class Law, class Value>
struct Set {
  Value Law::*member;
  Value value;
};
template <class Law, class Value>
Set(Value Law::*, Value) -> Set<Law, Value>;  // clang before 17 makes none for aggregates

template <class Law, class... Values>
Law law_of(Set<Law, Values>... parts) {
  Law law;
  ((law.*parts.member = std::move(parts.value)), ...);
  return law;
}

std::vector<NamedLaw> made_laws() {
  using T = WearTheory;
  using L = WearLaw;
  using F = FatigueSettings;
  using List = std::vector<double>;
  constexpr double kUg = 1e-3, kPerJ = 1e-9, kPerKm = 1e-12;  // by m and mm2; mm3
  const auto burstow = [](double begin) {
    return law_of(Set{&F::measures, std::vector{FatigueMeasure::whole_life}},
                  Set{&F::t_gamma, List{begin, 65.0, 175.0}}, Set{&F::passage_damage, List{0.0, 1e-5, 0.0}});
  };
  std::vector<NamedLaw> laws{
      // 5.3 T gamma/A, then level, then with a slope of 61.9
      {"sheffield-r8t",
       law_of(Set{&L::theory, T::t_gamma}, Set{&L::t_gamma_area, List{0.0, 10.4e6, 77.2e6, 177.2e6}},
              Set{&L::wear_rate, List{0.0, 55.12 * kUg, 55.12 * kUg, 6245.12 * kUg}}, Set{&L::density, 7850.0}),
       "Lewis and Dwyer-Joyce 2004, figures 16 and 17; numbers from secondary texts",
       "twin discs of wheel steel R8T on rail steel UIC60 900A, dry; wear of the wheel"},
      // the middles of 1 to 10, 30 to 40, 1 to 10 and 300 to 400 times 1e-4
      {"jendel",
       law_of(Set{&L::theory, T::archard}, Set{&L::hardness, 3e9}, Set{&L::k, List{5.5e-4, 35e-4, 5.5e-4}},
              Set{&L::slip_limits, List{0.2, 0.7}}, Set{&L::k_seizure, 350e-4}),
       "Jendel 2002, the wear chart of KTH; numbers from memory",
       "dry wheels and rails; middles of ranges that span up to a factor of ten, hardness 3 GPa assumed"},
      // of steel of 7850 kg/m3
      {"krause-poll",
       law_of(Set{&L::theory, T::energy}, Set{&L::power_limits, List{4e6}},
              Set{&L::volume_per_work, List{8.9172e-5 * kPerJ, 26.7516e-5 * kPerJ}}),
       "Krause and Poll 1986; 7e-10 and 21e-10 kg/J below and above 4 W/mm2 after Zobory 1997, from memory",
       "dry wheels and rails, mild and severe wear; the power is that of the whole patch"},
      // a section of a wheel of diameter D loses 0.25 T gamma / D mm2/km, from 100 N on 25 / D, from 200 N on
      // (1.19 T gamma - 154) / D, where it jumps; the volume is pi D times that
      {"british-rail",
       law_of(Set{&L::theory, T::t_gamma_patch}, Set{&L::patch_t_gamma, List{0.0, 100.0, 200.0, 200.001, 300.001}},
              Set{&L::volume_rate, List{0.0, 78.54 * kPerKm, 78.54 * kPerKm, 263.9 * kPerKm, 637.75 * kPerKm}}),
       "Pearce and Sherratt 1991, the three equations of the worn area; numbers from memory",
       "wheels of British Rail, tread and flange; not rails"},
      {"burstow-r220", burstow(15.0),
       "Burstow 2004, the damage function of the whole-life rail model; numbers from secondary texts",
       "rails of grade R220 in British traffic"},
      {"burstow-r260mn", burstow(20.0),
       "the form: Burstow 2004; the numbers: a program for head checks in Dutch rails, their grade from memory "
       "(Hiensch and Steenbergen 2018)",
       "rails of grade R260Mn in Dutch traffic"}};
  for (NamedLaw& law : laws) {
    const std::string source = std::string(law.name) + ": " + law.source + (law.verified ? "" : " (unverified)");
    std::visit([&](auto& of) { of.source = source, of.unverified = !law.verified; }, law.numbers);
  }
  return laws;
}

}  // namespace

std::string_view NamedLaw::kind() const {
  if (const auto* wear = std::get_if<WearLaw>(&numbers))
    return kWearTheories[static_cast<std::size_t>(wear->theory)].word;
  return row_of(std::get<FatigueSettings>(numbers).measures.front()).word;
}

std::span<const NamedLaw> named_laws() {
  static const std::vector<NamedLaw> laws = made_laws();
  return laws;
}

const NamedLaw* law_named(std::string_view name) {
  const auto found = ranges::find(named_laws(), name, &NamedLaw::name);
  return found == named_laws().end() ? nullptr : &*found;
}

}  // namespace treadmark
