// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>
#include <vector>

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

/// What is known of a body's material, SI. Every measure uses what its row in kFatigueMeasures names.
struct FatigueSettings {
  std::vector<FatigueMeasure> measures;  ///< none: nothing is known and nothing computed
  std::string source;                    ///< where the numbers come from

  double shear_yield = 0.0;            ///< k, in cyclic shear [Pa]
  std::vector<double> depths;          ///< below the surface, increasing [m]
  double dang_van_slope = 0.0;         ///< factor of the hydrostatic stress [-]
  double dang_van_limit = 0.0;         ///< equivalent shear stress that is endured [Pa]
  double austenite = 0.0;              ///< temperature from which on the steel becomes austenite [deg C]
  std::vector<double> t_gamma;         ///< points of a broken line, increasing [N]; goes on straight behind the last
  std::vector<double> passage_damage;  ///< at these points; 1: failure, negative: wear takes more than fatigue adds

  bool has(FatigueMeasure measure) const;
};

/// One row a measure: its word in study files, what it is, where it holds, and the keys that it needs.
struct FatigueMeasureRow {
  FatigueMeasure measure;
  std::string_view word, name, source, validity;
  std::string_view keys;  ///< needed ones, with blanks between them
};

/// Rows lie in the order of the enumerators.
inline constexpr FatigueMeasureRow kFatigueMeasures[] = {
    {FatigueMeasure::fi_surf, "fi_surf", "utilised friction - 2 A k / (3 Fn), A the area of contact; > 0: fatigue",
     "Ekberg, Kabo and Andersson 2002 (unverified: from secondary literature)",
     "surface of full-slip Hertz contacts; of other patches the area stands for pi a b", "shear_yield_MPa"},
    {FatigueMeasure::shakedown, "shakedown",
     "(largest pressure / k) over the limit of the map at the utilised friction; > 1: flow at every passage",
     "Johnson 1985, section 9.2: Melan's theorem with the elastic stresses below a line contact in full slip",
     "4.0 without friction, 1 / friction above 0.367; a point contact bears up to 4.7", "shear_yield_MPa"},
    {FatigueMeasure::whole_life, "whole_life", "damage of a passage by T gamma of the patch, a broken line, summed up",
     "Burstow 2004 (unverified: the shape has been looked up, the numbers have not)",
     "rails of the grade and the traffic that the line was fitted to", "t_gamma_N damage_per_passage"},
    {FatigueMeasure::subsurface, "subsurface",
     "von Mises, largest shear amplitude of all planes, least k that shakes down (Melan), at depths",
     "Johnson 1985; Ponter, Hearle and Johnson 1985", "half-spaces; depths of at least an element of the patch",
     "depths_mm shear_yield_MPa"},
    {FatigueMeasure::dang_van, "dang_van", "max over a passage of (shear amplitude + slope hydrostatic stress) / limit",
     "Dang Van et al. 1989, as Ekberg, Kabo and Andersson 2002 (unverified: from secondary literature)",
     "high-cycle fatigue without residual stresses", "depths_mm dang_van_slope dang_van_limit_MPa"},
    {FatigueMeasure::martensite, "martensite",
     "largest surface temperature less that of austenite; > 0: the surface may turn into martensite",
     "temperatures: Ertz and Knothe 2002; transformation: iron-carbon diagram (727 C of pure steel at rest)",
     "needed, not enough: cooling must be quick too, and short times and pressure shift the limit", "austenite_C"}};

/// What a contact as a whole does to a body, for those measures that are asked for; 0 otherwise.
struct ContactFatigue {
  double friction = 0.0;        ///< utilised: traction over normal force [-]
  double pressure_ratio = 0.0;  ///< largest pressure over the shear yield [-]
  double fi_surf = 0.0;         ///< surface fatigue index [-]
  double shakedown = 0.0;       ///< pressure_ratio over the limit of the shakedown map [-]
  double damage = 0.0;          ///< of a passage by its T gamma [-]
  double temperature = 0.0;     ///< largest of the surface [deg C]
};

/// Errors: Error(configuration) that names the key for numbers that are missing, negative or out of order.
void check(const FatigueSettings& settings);

}  // namespace treadmark
