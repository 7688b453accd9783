// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/damage/fatigue.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark {
namespace {

[[noreturn]] void refuse_fatigue(std::string message, std::string advice = {}) {
  throw Error(ErrorKind::configuration, std::move(message), {}, std::move(advice));
}

void require_known(double value, std::string_view key, const FatigueMeasureRow& row) {
  if (!(value > 0.0) || !std::isfinite(value))
    refuse_fatigue(fmt::format("{} needs a positive {}", row.word, key),
                   "fatigue has no numbers of its own: give those of the material");
}

void require_increasing(const std::vector<double>& values, const char* key, double above) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]) || !(i > 0 ? values[i] > values[i - 1] : values[i] >= above))
      refuse_fatigue(fmt::format("{} must increase and not be negative", key));
}

void check_depths(const std::vector<double>& depths, const FatigueMeasureRow& row) {
  if (depths.empty()) refuse_fatigue(fmt::format("{} needs depths_mm", row.word), "give depths below the surface");
  if (!(depths.front() > 0.0)) refuse_fatigue("depths_mm must be positive");
  require_increasing(depths, "depths_mm", 0.0);
}

void check_line(const std::vector<double>& t_gamma, const std::vector<double>& damage) {
  if (t_gamma.size() < 2 || t_gamma.size() != damage.size())
    refuse_fatigue(fmt::format("t_gamma_N has {} values and damage_per_passage has {}", t_gamma.size(), damage.size()),
                   "they are the points of a line: as many, and at least two");
  require_increasing(t_gamma, "t_gamma_N", 0.0);
}

/// Calls use(word) for each of some words with blanks between them.
template <class Use>
void for_each_word(std::string_view words, Use&& use) {
  while (!words.empty()) {
    const std::string_view word = words.substr(0, words.find(' '));
    words.remove_prefix(std::min(words.size(), word.size() + 1));
    if (!word.empty()) use(word);
  }
}

using M = FatigueMeasure;
using State = const FatigueState&;
using Settings = const FatigueSettings&;
using Record = const SurfaceRecord&;

template <FatigueMeasure measure>
constexpr Column<ContactFatigue> number_of(std::string_view key, FileUnit unit, std::string_view stored,
                                           std::string_view meaning) {
  return {key,
          unit,
          stored,
          {[](const ContactFatigue& c) { return c[measure]; }, [](ContactFatigue& c, double v) { c[measure] = v; }},
          meaning};
}

template <FatigueMeasure measure>
double largest(State s) {
  return s.largest(measure);
}
template <CellSheet StressRecord::*sheet>
const CellSheet& at_depth(Record r, std::size_t depth) {
  return r.stresses[depth].*sheet;
}
template <CellSheet SurfaceRecord::*sheet>
const CellSheet& on_surface(Record r, std::size_t) {
  return r.*sheet;
}
double as_it_is(Settings) { return 1.0; }
double in_MPa(Settings) { return 1e-6; }
double by_shear_yield(Settings s) { return 1.0 / s.shear_yield; }
double by_dang_van_limit(Settings s) { return 1.0 / s.dang_van_limit; }

}  // namespace

std::span<const FatigueMeasureRow> fatigue_measures() {
  using unit::kOne;
  // A row of a table stays a row: clang-format would give each column a line.
  // clang-format off
  static const FatigueMeasureRow rows[] = {
      {M::fi_surf, "fi_surf", "utilised friction - 2 A k / (3 Fn), A the area of contact; > 0: fatigue",
       "Ekberg, Kabo and Andersson 2002 (unverified: from secondary literature)",
       "surface of full-slip Hertz contacts; of other patches the area stands for pi a b", "shear_yield_MPa", false,
       number_of<M::fi_surf>("fi_surf", kOne, "fi_surf", "surface fatigue index"),
       {{"fi_surf", kOne, "", {largest<M::fi_surf>}, "largest surface fatigue index, > 0: fatigue", kInChart}},
       {{"largest surface fatigue index above 0 up to here", "", "index", as_it_is, on_surface<&SurfaceRecord::fi_surf>,
         false, "index", "Surface fatigue index", "largest index above 0 up to here"}}},
      {M::shakedown, "shakedown",
       "(largest pressure / k) over the limit of the map at the utilised friction; > 1: flow at every passage",
       "Johnson 1985, section 9.2: Melan's theorem with the elastic stresses below a line contact in full slip",
       "4.0 without friction, 1 / friction above 0.367; a point contact bears up to 4.7", "shear_yield_MPa", false,
       number_of<M::shakedown>("shakedown", kOne, "shakedown", "pressure ratio over the limit of the shakedown map"),
       {{"shakedown", kOne, "", {largest<M::shakedown>},
         "largest pressure over the limit of the shakedown map, > 1: flow", kInChart}}},
      {M::whole_life, "whole_life", "damage of a passage by T gamma of the patch, a broken line, summed up",
       "Burstow 2004 (unverified: the shape has been looked up, the numbers have not)",
       "rails of the grade and the traffic that the line was fitted to", "t_gamma_N damage_per_passage", false,
       number_of<M::whole_life>("damage_per_passage", kOne, "damage", "of a passage by its T gamma"),
       {{"damage", kOne, "", {[](State s) { return s.record.damage.largest(); }},
         "largest sum of the damage of passages", kInChart}},
       {{"damage of passages", "", "damage", as_it_is, on_surface<&SurfaceRecord::damage>,
         false, "damage", "Damage", "damage of passages"}}},
      {M::subsurface, "subsurface",
       "von Mises, largest shear amplitude of all planes, least k that shakes down (Melan), at depths",
       "Johnson 1985; Ponter, Hearle and Johnson 1985", "half-spaces; depths of at least an element of the patch",
       "depths_mm shear_yield_MPa", false, {},
       {{"von_mises_ever_MPa", unit::kMPa, "", {[](State s) { return s.ever(&StressRecord::von_mises); }},
         "largest von Mises stress at the depths that has passed", kInChart},
        {"shear_ever_MPa", unit::kMPa, "", {[](State s) { return s.ever(&StressRecord::shear); }},
         "largest shear amplitude at the depths that has passed", kInChart},
        {"yield_share_ever", kOne, "", {[](State s) { return s.ever(&StressRecord::shakedown) / s.known.shear_yield; }},
         "largest shear yield that shakedown needs at the depths over that of the material, > 1: flow", kInChart}},
       {{"largest von Mises stress up to here", "MPa", "", in_MPa, at_depth<&StressRecord::von_mises>, true},
        {"largest shear amplitude up to here", "MPa", "", in_MPa, at_depth<&StressRecord::shear>, true},
        {"shear yield that shakedown needs over that of the material", "", "", by_shear_yield,
         at_depth<&StressRecord::shakedown>, true, "yield", "Shear yield that shakedown needs",
         "at the first depth, over that of the material"}}},
      {M::dang_van, "dang_van", "max over a passage of (shear amplitude + slope hydrostatic stress) / limit",
       "Dang Van et al. 1989, as Ekberg, Kabo and Andersson 2002 (unverified: from secondary literature)",
       "high-cycle fatigue without residual stresses", "depths_mm dang_van_slope dang_van_limit_MPa", false, {},
       {{"dang_van_ever", kOne, "", {[](State s) { return s.ever(&StressRecord::dang_van) / s.known.dang_van_limit; }},
         "largest equivalent stress of Dang Van over its limit, > 1: fatigue", kInChart}},
       {{"Dang Van's stress over its limit", "", "", by_dang_van_limit, at_depth<&StressRecord::dang_van>, true}}},
      {M::martensite, "martensite",
       "largest surface temperature less that of austenite; > 0: the surface may turn into martensite",
       "temperatures: Ertz and Knothe 2002; transformation: iron-carbon diagram (727 C of pure steel at rest)",
       "needed, not enough: cooling must be quick too, and short times and pressure shift the limit", "austenite_C",
       true, number_of<M::martensite>("temperature_C", unit::kCelsius, "temperature", "largest of the surface"),
       {{"temperature_C", unit::kCelsius, "", {largest<M::martensite>}, "largest of the surface", kInChart},
        {"over_austenite_ever_K", unit::kK, "",
         {[](State s) { return s.record.temperature.largest() - s.known.austenite; }},
         "largest temperature that has passed, less that of austenite, > 0: martensite may form", kInChart}},
       {{"largest temperature up to here", "°C", "temperature", as_it_is, on_surface<&SurfaceRecord::temperature>}}}};
  // clang-format on
  static_assert(std::size(rows) == kFatigueMeasureCount);
  return rows;
}

template <>
std::span<const Column<ContactFatigue>> columns() {
  static const std::vector<Column<ContactFatigue>> list = [] {
    std::vector<Column<ContactFatigue>> all{kUtilisedFriction, kPressureRatio};
    for (const FatigueMeasureRow& row : fatigue_measures())
      if (!row.of_contact.key.empty()) all.push_back(row.of_contact);
    return all;
  }();
  return list;
}

const FatigueMeasureRow& row_of(FatigueMeasure measure) {
  return fatigue_measures()[static_cast<std::size_t>(measure)];
}

std::string words_of(std::span<const FatigueMeasure> measures) {
  std::string words;
  for (const FatigueMeasure measure : measures)
    words += fmt::format("{}{}", words.empty() ? "" : " ", row_of(measure).word);
  return words;
}

std::vector<FatigueMeasure> measures_of(std::string_view words) {
  std::vector<FatigueMeasure> measures;
  for_each_word(words, [&](std::string_view word) {
    const auto row = ranges::find(fatigue_measures(), word, &FatigueMeasureRow::word);
    if (row == fatigue_measures().end())
      throw Error(ErrorKind::input_data, fmt::format("'{}' is no measure of fatigue", word));
    measures.push_back(row->measure);
  });
  return measures;
}

double FatigueState::largest(FatigueMeasure measure) const {
  double most = contacts.front()[measure];
  for (const ContactFatigue& c : contacts) most = std::max(most, c[measure]);
  return most;
}

double FatigueState::ever(CellSheet StressRecord::*sheet) const {
  double most = 0.0;
  for (const StressRecord& s : record.stresses) most = std::max(most, (s.*sheet).largest());
  return most;
}

bool FatigueSettings::has(FatigueMeasure measure) const { return ranges::count(measures, measure) > 0; }

void check(const FatigueSettings& settings) {
  for (const FatigueMeasure measure : settings.measures) {
    const FatigueMeasureRow& row = row_of(measure);
    for_each_word(row.keys, [&](std::string_view key) {
      if (key == "depths_mm") return check_depths(settings.depths, row);
      if (key == "t_gamma_N") return check_line(settings.t_gamma, settings.passage_damage);
      for (const FatigueNumber& number : kFatigueNumbers)
        if (key == number.key) require_known(settings.*number.value, number.key, row);
    });
  }
}

}  // namespace treadmark
