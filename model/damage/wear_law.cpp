// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/model/damage/wear_law.hpp"

#include <cmath>

#include <fmt/format.h>

#include "treadmark/core/error.hpp"

namespace treadmark {
namespace {

[[noreturn]] void refuse(std::string message, std::string advice) {
  throw Error(ErrorKind::configuration, std::move(message), {}, std::move(advice));
}

void require_positive(double value, const char* key) {
  if (!(value > 0.0) || !std::isfinite(value))
    refuse(fmt::format("the law needs a positive {}", key),
           "a law of wear has no numbers of its own: give those of a test");
}

void check_regimes(const std::vector<double>& values, const std::vector<double>& limits, const char* key,
                   const char* limit_key) {
  if (values.empty()) refuse(fmt::format("the law needs {}", key), "give one number, or one for each regime");
  for (const double value : values)
    if (!(value >= 0.0) || !std::isfinite(value)) refuse(fmt::format("{} must not be negative", key), "");
  if (limits.size() + 1 != values.size())
    refuse(fmt::format("{} has {} values and {} has {}", key, values.size(), limit_key, limits.size()),
           fmt::format("there is one limit less than there are regimes"));
  for (std::size_t i = 0; i < limits.size(); ++i)
    if (!(limits[i] > (i > 0 ? limits[i - 1] : 0.0)))
      refuse(fmt::format("{} must be positive and increase", limit_key), "");
}

void check_line(const std::vector<double>& x, const std::vector<double>& y) {
  if (x.size() < 2 || x.size() != y.size())
    refuse(fmt::format("t_gamma_area_MPa has {} values and wear_rate_ug_m_mm2 has {}", x.size(), y.size()),
           "they are the points of a line: as many, and at least two");
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (!(y[i] >= 0.0) || !std::isfinite(y[i])) refuse("wear_rate_ug_m_mm2 must not be negative", "");
    if (!(x[i] >= 0.0) || !std::isfinite(x[i]) || (i > 0 && !(x[i] > x[i - 1])))
      refuse("t_gamma_area_MPa must increase from 0 on", "");
  }
  if (y.back() < y[y.size() - 2])
    refuse("wear_rate_ug_m_mm2 falls at the end of the line, which goes on behind it", "let its last piece not fall");
}

}  // namespace

void check(const WearLaw& law) {
  switch (law.theory) {
    case WearTheory::archard:
      require_positive(law.hardness, "hardness_GPa");
      check_regimes(law.k, law.slip_limits, "k", "slip_m_s");
      if (!(law.k_seizure >= 0.0) || !(law.seizure_ratio > 0.0))
        refuse("k_seizure and seizure_pressure_over_hardness must not be negative", "");
      break;
    case WearTheory::t_gamma:
      require_positive(law.density, "density_kg_m3");
      check_line(law.t_gamma_area, law.wear_rate);
      break;
    case WearTheory::energy:
      check_regimes(law.volume_per_work, law.power_limits, "volume_per_work_mm3_J", "power_density_W_mm2");
      break;
  }
}

}  // namespace treadmark
