// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <map>
#include <string>

#include "treadmark/io/cases/case_keys.hpp"

namespace treadmark::io::testing {

inline std::string key_text(const CaseKey& key, const Case& c) {
  return key.written ? key.written(c, "") : key.text ? key.text(c) : std::string();
}

/// The same words, and numbers but for the last bit: not every number of one unit has one of the other that gives it.
inline bool same_values(const std::string& a, const std::string& b) {
  constexpr double kLastBit = 4e-16;
  const char *p = a.c_str(), *q = b.c_str();
  while (*p != '\0' && *q != '\0') {
    char *p_end = nullptr, *q_end = nullptr;
    const double x = std::strtod(p, &p_end), y = std::strtod(q, &q_end);
    if (p_end == p || q_end == q) {
      if (*p++ != *q++) return false;
      continue;
    }
    if (x != y && !(std::abs(x - y) <= kLastBit * std::abs(x))) return false;
    p = p_end;
    q = q_end;
  }
  return *p == *q;
}

/// Whether a key says something that the case uses.
inline bool matters(const std::string& path, const Case& c) {
  if (path == "case.sequence" || path == "case.steps" || path == "case.time_step_s") return false;
  const auto starts = [&](const char* prefix) { return path.starts_with(prefix); };
  const auto shared = [&](const auto& content) {
    const bool coulomb = content.friction.kind == FrictionLaw::Kind::coulomb;
    if (starts("friction.memory") && coulomb) return false;
    if (starts("influence.") && path != "influence.kind" && path != "influence.file")
      return content.influence.kind == InfluenceSettings::Kind::angle_corrected;
    if (path.find("fastsim_") != std::string::npos) return content.tangential_model != TangentialModel::full;
    if (starts("subsurface.text_table")) return !content.subsurface.blocks.empty();
    return true;
  };
  if (const auto* patch = std::get_if<BasicCase>(&c.content)) {
    const bool rolling = patch->regime == Regime::transient || patch->regime == Regime::steady;
    if (!rolling && (starts("patch.rolling") || starts("patch.velocity") || starts("patch.spin_offset"))) return false;
    if (!patch->friction_of_row.empty() && starts("friction.") && path != "friction.rows") return false;
    return shared(*patch);
  }
  const auto& rail = std::get<WheelRailCase>(c.content);
  if (path == "wheel.shape.open_seam") {
    const auto* file = std::get_if<GeometryFile>(&rail.wheel.geometry);
    return file != nullptr && file->file.extension() == ".slcw";
  }
  return shared(rail);
}

/// By every key of case files that matters; sequences may have other numbers.
inline void expect_same_cases(const CaseFile& a, const CaseFile& b) {
  ASSERT_EQ(a.cases.size(), b.cases.size());
  std::map<int, int> sequences;
  for (std::size_t i = 0; i < a.cases.size(); ++i) {
    const Case &x = a.cases[i], &y = b.cases[i];
    ASSERT_EQ(x.content.index(), y.content.index()) << "case " << i;
    EXPECT_EQ(sequences.try_emplace(x.sequence, y.sequence).first->second, y.sequence) << "case " << i;
    const KeyScope scope = std::holds_alternative<BasicCase>(x.content) ? KeyScope::patch : KeyScope::wheel_rail;
    for (const CaseKey& key : case_keys()) {
      if ((key.info.scope != KeyScope::any && key.info.scope != scope) || !matters(key.info.path, x)) continue;
      EXPECT_TRUE(same_values(key_text(key, x), key_text(key, y)))
          << "case " << i << ": " << key.info.path << " = " << key_text(key, x) << ", then " << key_text(key, y);
    }
  }
}

}  // namespace treadmark::io::testing
