// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/simulations/line_keys.hpp"

namespace treadmark::io {

const KeyTable<LayoutInput>& layout_keys() {
  using L = LayoutInput;
  static const auto keys = key_table<L>([](auto& list) {
    list.number("start_m", kNotNegative, "place of the vehicle's x = 0 at the start, from the beginning of the line",
                &L::start);
    list.number("gauge_mm", kGaugeMm, "where no element says another; without it that of `[track]`", &L::gauge);
    list.number("cant_base_mm", kPositive, "width over which cant is measured",
                [](L& l) -> double& { return l.line.cant_base; });
    list.choice(
        "cant_about", {{"centre", CantAxis::centre}, {"low_rail", CantAxis::low_rail}},
        "what keeps its height where the track is canted", [](L & l) -> auto& { return l.line.cant_axis; });
    list.table(
        "elements", KeyType::table_list, "one behind the other", element_keys().infos,
        [](auto& l) -> auto& { return l.line.elements; }, kNeeded);
  });
  return keys;
}

const KeyTable<ElementInput>& element_keys() {
  using E = ElementInput;
  static const auto keys = key_table<E>([](auto& list) {
    list.choice("kind", kElementKinds,
                "a transition goes from the element before it to the one behind it; at the ends of the line from or "
                "to a straight without cant",
                &E::kind, kNeeded);
    list.number("length_m", {0.0, {}, kLongestLine}, "along the centre line in plan", &E::length, kNeeded);
    list.number("radius_m", kAnyNumber, "of a curve (required there): positive to the right, negative to the left",
                &E::radius, kNoDefault, "positive to the right, negative to the left");
    list.number("cant_mm", kAnyNumber, "of a curve: how much the outer rail lies higher; of a straight: the left one",
                &E::cant);
    list.number("gauge_mm", kGaugeMm, "of a straight or a curve", &E::gauge);
    list.choice("shape", {{"clothoid", TransitionShape::linear}, {"bloss", TransitionShape::bloss}},
                "of a transition: how curvature, cant and gauge go over", &E::shape);
  });
  return keys;
}

const KeyTable<IrregularityInput>& irregularity_keys() {
  using I = IrregularityInput;
  static const auto keys = key_table<I>([](auto& list) {
    list.value(
        key_info("file", KeyType::path, "measured ones, as text with named columns; this or `spectra` is required"),
        [](auto& i) -> auto& { return i.spec.table; });
    list.number(
        "offset_m", kAnyNumber, "added to the distances of the file", [](auto& i) -> auto& { return i.spec.offset; });
    list.number(
        "nominal_gauge_mm", kPositive,
        "from which a gauge such as 1436.2 mm in the file is counted; without it what the file states, the "
        "gauge of the track, or the nearest one in use",
        [](auto& i) -> auto& { return i.recording.nominal_gauge; }, kNoDefault);
    list.number(
        "sampling_m", kPositive, "way between two rows of the file, where its distances do not tell (broken chains)",
        [](auto& i) -> auto& { return i.recording.sampling; }, kNoDefault);
    list.flag(
        "as_stated", "distances of the file are used as they stand, also where they jump",
        [](auto& i) -> auto& { return i.recording.as_stated; });
    list.flag(
        "seen_backwards", "left, right and signs of the file are as seen along falling distances",
        [](auto& i) -> auto& { return i.recording.seen_backwards; });
    list.number("begin_m", kAnyNumber, "from here on they grow; without it from in front of the vehicle", &I::begin);
    list.number(
        "wind_up_m", kNotNegative, "length over which they grow from zero",
        [](auto& i) -> auto& { return i.spec.wind_up; });
    list.integer(
        "seed", 0, 1e15, "another number, another track with the same spectra",
        [](auto& i) -> auto& { return i.spec.spectral.seed; });
    list.number(
        "shortest_wavelength_m", kPositive, "that occurs in spectra",
        [](auto& i) -> auto& { return i.spec.spectral.shortest; });
    list.number(
        "longest_wavelength_m", kPositive, "that occurs in spectra",
        [](auto& i) -> auto& { return i.spec.spectral.longest; });
    list.integer(
        "sinusoids_per_third_octave", 1, 1000, "of which spectra are made",
        [](auto& i) -> auto& { return i.spec.spectral.sinusoids_per_third_octave; });
    for (std::size_t f = 0; f < kIrregularityNames.size(); ++f)
      list.number(
          fmt::format("{}_factor", kIrregularityNames[f]), kAnyNumber,
          "on this function; -1 changes its sign", [f](auto& i) -> auto& { return i.spec.factor[f]; });
    list.table(
        "spectra", KeyType::table_list, "power spectral densities, at most one of each function", spectrum_keys().infos,
        [](auto& i) -> auto& { return i.spec.spectral.spectra; });
  });
  return keys;
}

const KeyTable<SpectrumInput>& spectrum_keys() {
  using S = SpectrumInput;
  using F = IrregularitySpectrum;
  using Form = F::Form;
  static const auto keys = key_table<S>([](auto& list) {
    list.choice("function", kIrregularityNames, "of the track", &S::function, kNeeded);
    list.choice("form", {{"two_poles", Form::two_poles}, {"three_poles", Form::three_poles}, {"table", Form::table}},
                "A c²/((k² + r²)(k² + c²)), the same times k²/(k² + s²), or numbers", of_spectrum(&F::form), kNeeded);
    list.number("amplitude_m_rad", kNotNegative, "A (required but for a table)", of_spectrum(&F::amplitude),
                kNoDefault);
    list.number("omega_c_rad_m", kPositive, "c (required but for a table)", of_spectrum(&F::omega_c), kNoDefault);
    list.number("omega_r_rad_m", kNotNegative, "r", of_spectrum(&F::omega_r));
    list.number("omega_s_rad_m", kNotNegative, "s", of_spectrum(&F::omega_s));
    list.number_list("wavenumber_rad_m", kPositive, "of a table, increasing", of_spectrum(&F::wavenumber));
    list.number_list("density_m3_rad", kPositive, "of a table at them; straight lines between logarithms",
                     of_spectrum(&F::density));
    list.value(key_info("sides", KeyType::integer,
                        "1: the variance is the integral over positive wavenumbers; 2: twice that", {{}, 1.0, 2.0}),
               of_spectrum(&F::two_sided))
        .shown("1")
        .read_by([](S& s, const CaseValue& value) { s.spectrum.two_sided = value.integer() == 2; });
  });
  return keys;
}

}  // namespace treadmark::io
