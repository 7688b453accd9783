// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/io/simulations/study_model.hpp"

namespace treadmark::io {

inline constexpr double kMostValues = 100000;  ///< of a variation, and runs of a study

/// [[study.vary]].
struct VaryInput {
  Variation variation;
  double from = 0.0, to = 0.0;  ///< instead of its values, so many
  int count = 0;
  bool logarithmic = false;
};

/// [study] and its tables; [evolve] shares its first ones.
const KeyTable<StudyFile>& study_keys();
const KeyTable<VaryInput>& vary_keys();
const KeyTable<VariedValue>& vary_value_keys();
const KeyTable<StudyFigure>& figure_keys();
const KeyTable<FigureMark>& mark_keys();

}  // namespace treadmark::io
