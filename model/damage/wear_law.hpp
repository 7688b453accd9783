// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace treadmark {

/// What a depth removed by wear follows from.
enum class WearTheory {
  archard,        ///< pressure times sliding distance, over hardness
  t_gamma,        ///< power of friction over rolling speed, by area
  energy,         ///< work of friction
  t_gamma_patch,  ///< power of friction of a patch over rolling speed
};

/// A law with its numbers, SI. Every theory uses those that its row in kWearTheories names.
struct WearLaw {
  WearTheory theory = WearTheory::archard;
  std::string source;       ///< where the numbers come from
  bool unverified = false;  ///< of a named law whose numbers have not been compared with their source

  double hardness = 0.0;            ///< [Pa]
  std::vector<double> k;            ///< Archard's coefficient in each regime of slip speed [-]
  std::vector<double> slip_limits;  ///< speeds between the regimes, increasing [m/s]
  double k_seizure = 0.0;           ///< at pressures above seizure_ratio times the hardness; 0: no such regime
  double seizure_ratio = 0.8;       ///< [-]

  std::vector<double> t_gamma_area;  ///< points of a broken line, increasing [N/m2]; goes on straight behind the last
  std::vector<double> wear_rate;     ///< at these points: mass by distance rolled and area of contact [kg/m3]
  double density = 0.0;              ///< [kg/m3]

  std::vector<double> volume_per_work;  ///< in each regime of power by area [m3/J]
  std::vector<double> power_limits;     ///< of a whole patch between the regimes, increasing [W/m2]

  std::vector<double> patch_t_gamma;  ///< points of a broken line, increasing [N]; goes on straight behind the last
  std::vector<double> volume_rate;    ///< at these points: volume by distance rolled [m3/m]
};

/// A number of a law, or a list of them: its key of evolution files, with its unit.
struct WearNumber {
  std::variant<double WearLaw::*, std::vector<double> WearLaw::*> value;
  std::string_view key, meaning;
  bool may_be_zero = false;
  std::string_view limits = {};  ///< of a list with a value for each regime: key of the limits between them
  std::string_view over = {};    ///< of a broken line: key of where its values are
};
inline constexpr WearNumber kWearNumbers[] = {
    {&WearLaw::hardness, "hardness_GPa", "archard: of the body that wears"},
    {&WearLaw::k, "k", "archard: coefficient, one for each regime of slip speed", true, "slip_m_s"},
    {&WearLaw::slip_limits, "slip_m_s", "archard: slip speeds between the regimes"},
    {&WearLaw::k_seizure, "k_seizure", "archard: coefficient at high pressures; 0: there is no such regime", true},
    {&WearLaw::seizure_ratio, "seizure_pressure_over_hardness", "archard: where high pressures begin"},
    {&WearLaw::t_gamma_area, "t_gamma_area_MPa",
     "t_gamma: points of a broken line (1 MPa = 1 N/mm²), which goes on straight behind the last", true},
    {&WearLaw::wear_rate,
     "wear_rate_ug_m_mm2",
     "t_gamma: mass by distance and area at these points",
     true,
     {},
     "t_gamma_area_MPa"},
    {&WearLaw::density, "density_kg_m3", "t_gamma: of the body that wears"},
    {&WearLaw::volume_per_work, "volume_per_work_mm3_J", "energy: coefficient, one for each regime of power by area",
     true, "power_density_W_mm2"},
    {&WearLaw::power_limits, "power_density_W_mm2", "energy: powers by area between the regimes"},
    {&WearLaw::patch_t_gamma, "t_gamma_N",
     "t_gamma_patch: points of a broken line, which goes on straight behind the last", true},
    {&WearLaw::volume_rate,
     "volume_mm3_km",
     "t_gamma_patch: volume by distance rolled at these points",
     true,
     {},
     "t_gamma_N"}};

/// Whether a law is complete without a number, which is 0 or has a usual value then.
inline bool may_lack(const WearNumber& number, double WearLaw::*value) {
  return number.may_be_zero || WearLaw{}.*value > 0.0;
}

/// One row a theory: its word in study files, what it is, where it holds, and the keys that it needs.
struct WearTheoryRow {
  WearTheory theory;
  std::string_view word, name, source, validity;
  std::string_view keys;  ///< needed ones, with blanks between them
};

/// Rows lie in the order of the enumerators.
inline constexpr WearTheoryRow kWearTheories[] = {
    {WearTheory::archard, "archard", "depth = k pressure sliding / hardness, k by regimes of slip speed and pressure",
     "Archard 1953; regimes as Jendel 2002 (unverified: from secondary literature)",
     "dry sliding of metals; k scatters by a factor of two and more", "hardness_GPa k"},
    {WearTheory::t_gamma, "t_gamma", "mass by distance and area from T gamma over the area of contact, a broken line",
     "Lewis et al. 2003, Braghin et al. 2006", "twin-disc tests of the pair of steels that the line is from",
     "t_gamma_area_MPa wear_rate_ug_m_mm2 density_kg_m3"},
    {WearTheory::energy, "energy", "volume = coefficient times work of friction, by regimes of its power by area",
     "Krause and Poll 1986 (unverified: from secondary literature)",
     "mild and severe wear of dry wheels and rails; the power is that of the whole patch", "volume_per_work_mm3_J"},
    {WearTheory::t_gamma_patch, "t_gamma_patch",
     "volume by distance from T gamma of the patch, a broken line, spread over it as its work of friction",
     "Pearce and Sherratt 1991 (unverified: from memory)", "wheels of the traffic that the line was fitted to",
     "t_gamma_N volume_mm3_km"}};

/// Errors: Error(configuration) that names the key for numbers that are missing, negative or out of order.
void check(const WearLaw& law);

}  // namespace treadmark
