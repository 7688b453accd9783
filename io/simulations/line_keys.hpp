// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <array>
#include <optional>
#include <string_view>

#include "treadmark/io/settings/key_rows.hpp"
#include "treadmark/io/simulations/read_irregularities.hpp"
#include "treadmark/model/vehicle/irregularities.hpp"
#include "treadmark/model/vehicle/track_layout.hpp"

namespace treadmark::io {

/// [layout].
struct LayoutInput {
  double start = 0.0;           ///< [m]
  std::optional<double> gauge;  ///< [m]
  TrackLayout line;             ///< without elements
};

/// [[layout.elements]].
struct ElementInput {
  enum class Kind { straight, curve, transition };
  Kind kind = Kind::straight;
  double length = 0.0;          ///< [m]
  double radius = 0.0;          ///< of a curve [m]
  double cant = 0.0;            ///< of the outer rail, or of a straight's left one [m]
  std::optional<double> gauge;  ///< [m]
  TransitionShape shape = TransitionShape::linear;
};
inline constexpr std::array<std::string_view, 3> kElementKinds{"straight", "curve", "transition"};

/// [irregularities].
struct IrregularityInput {
  IrregularitySpec spec;
  RecordingSettings recording;
  std::optional<double> begin;  ///< [m]
};

/// [[irregularities.spectra]].
struct SpectrumInput {
  Irregularity function = Irregularity::longitudinal_level;
  IrregularitySpectrum spectrum;
};

/// Where a member of the spectrum is.
template <class Value>
auto of_spectrum(Value IrregularitySpectrum::*member) {
  return [member](auto& input) -> auto& { return input.spectrum.*member; };
}

/// [layout], [[layout.elements]], [irregularities] and [[irregularities.spectra]] beside [simulation].
const KeyTable<LayoutInput>& layout_keys();
const KeyTable<ElementInput>& element_keys();
const KeyTable<IrregularityInput>& irregularity_keys();
const KeyTable<SpectrumInput>& spectrum_keys();

}  // namespace treadmark::io
