// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "treadmark/model/damage/surface_record.hpp"
#include "treadmark/model/rows.hpp"

namespace treadmark {

/// What says how much a contact fatigues a body, without changing it.
enum class FatigueMeasure {
  fi_surf,     ///< utilised friction over what the surface stands
  shakedown,   ///< largest pressure over the limit of the shakedown map
  whole_life,  ///< damage of a passage by its T gamma
  subsurface,  ///< stresses at depths, and whether residual stresses can keep them elastic
  dang_van,    ///< shear amplitude and hydrostatic stress at depths
  martensite,  ///< largest temperature of the surface over that at which steel becomes austenite
};
inline constexpr std::size_t kFatigueMeasureCount = 6;

/// What is known of a body's material, SI. Every measure uses the keys that its row names.
struct FatigueSettings {
  std::vector<FatigueMeasure> measures;  ///< none: nothing is known and nothing computed
  std::string source;                    ///< where the numbers come from
  bool unverified = false;               ///< of a named law whose numbers have not been compared with their source

  double shear_yield = 0.0;            ///< k, in cyclic shear [Pa]
  std::vector<double> depths;          ///< below the surface, increasing [m]
  double dang_van_slope = 0.0;         ///< factor of the hydrostatic stress [-]
  double dang_van_limit = 0.0;         ///< equivalent shear stress that is endured [Pa]
  double austenite = 0.0;              ///< temperature from which on the steel becomes austenite [deg C]
  std::vector<double> t_gamma;         ///< points of a broken line, increasing [N]; goes on straight behind the last
  std::vector<double> passage_damage;  ///< at these points; 1: failure, negative: wear takes more than fatigue adds

  bool has(FatigueMeasure measure) const;
};

/// A number of a material: its key of evolution files, with its unit, and its name in results, where they have it.
struct FatigueNumber {
  double FatigueSettings::*value;
  std::string_view key, stored, meaning;
};
inline constexpr FatigueNumber kFatigueNumbers[] = {
    {&FatigueSettings::shear_yield, "shear_yield_MPa", "shear_yield",
     "fi_surf, shakedown, subsurface: k of the material in cyclic shear"},
    {&FatigueSettings::dang_van_slope, "dang_van_slope", "", "dang_van: factor of the hydrostatic stress"},
    {&FatigueSettings::dang_van_limit, "dang_van_limit_MPa", "dang_van_limit",
     "dang_van: equivalent shear stress that is endured"},
    {&FatigueSettings::austenite, "austenite_C", "austenite",
     "martensite: temperature from which on the steel becomes austenite"}};

/// What a contact as a whole does to a body.
struct ContactFatigue {
  double friction = 0.0;        ///< utilised: traction over normal force [-]
  double pressure_ratio = 0.0;  ///< largest pressure over the shear yield [-]
  /// The number of a measure, SI; 0 of those that are not asked for or have none.
  double& operator[](FatigueMeasure measure) { return of[static_cast<std::size_t>(measure)]; }
  double operator[](FatigueMeasure measure) const { return of[static_cast<std::size_t>(measure)]; }

 private:
  std::array<double, kFatigueMeasureCount> of{};
};
template <>
std::span<const Column<ContactFatigue>> columns();
inline constexpr Column<ContactFatigue> kUtilisedFriction{"utilised_friction", unit::kOne, "friction",
                                                          access::of<&ContactFatigue::friction>(),
                                                          "utilised: traction over normal force"};
inline constexpr Column<ContactFatigue> kPressureRatio{"pressure_over_shear_yield", unit::kOne, "pressure_ratio",
                                                       access::of<&ContactFatigue::pressure_ratio>(),
                                                       "largest pressure over shear yield"};

/// What the measures of a body follow from: its material, the present contacts and what points have endured.
struct FatigueState {
  const FatigueSettings& known;
  std::span<const ContactFatigue> contacts;
  const SurfaceRecord& record;

  /// Largest of the contacts, of which there is one at least.
  double largest(FatigueMeasure measure) const;
  /// Largest of a sheet at all depths.
  double ever(CellSheet StressRecord::*sheet) const;
};

/// What points have endured, as reports draw it: over the section, and over the surface where it has a title.
struct EnduredSheet {
  std::string_view label, unit, name;  ///< name: of the line; those at depths have their depth instead
  double (*scale)(const FatigueSettings&);
  const CellSheet& (*sheet)(const SurfaceRecord& record, std::size_t depth);
  bool at_depths = false;
  std::string_view id = {}, title = {}, on_surface = {};  ///< of the map, of the first depth
};

/// One row a measure: its word in evolution files, what it is, where it holds, the keys that it needs, and its numbers.
struct FatigueMeasureRow {
  FatigueMeasure measure;
  std::string_view word, name, source, validity;
  std::string_view keys;                   ///< needed ones, with blanks between them
  bool heat = false;                       ///< needs the temperatures of contacts
  Column<ContactFatigue> of_contact = {};  ///< without a key: contacts have none
  std::vector<Column<FatigueState>> of_body = {};
  std::vector<EnduredSheet> endured = {};
};

/// In the order of the enumerators.
std::span<const FatigueMeasureRow> fatigue_measures();
const FatigueMeasureRow& row_of(FatigueMeasure measure);

/// Words of measures with blanks between them.
std::string words_of(std::span<const FatigueMeasure> measures);
/// Errors: Error(input_data) for a word that is none.
std::vector<FatigueMeasure> measures_of(std::string_view words);

/// Errors: Error(configuration) that names the key for numbers that are missing, negative or out of order.
void check(const FatigueSettings& settings);

}  // namespace treadmark
