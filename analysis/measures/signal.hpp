// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace treadmark::measures {

/// Signals in time or along a track: even steps, filters, sliding means, percentiles. Everything is a pure function and
/// thread-safe.

/// Samples at begin, begin + step, ...
struct EvenSignal {
  double begin = 0.0, step = 0.0;  ///< [s] or [m]
  std::vector<double> values;

  double end() const { return begin + step * static_cast<double>(values.empty() ? 0 : values.size() - 1); }
};

/// A signal through points at unequal steps, straight between them, as means over a step about each sample: of what is
/// too fast for the step little is left, and none is mistaken for the mean. at does not decrease; of points at one
/// place the last counts from there on. Errors: Error(input_data) for fewer than two points, places that decrease, a
/// step that is not positive or gives more than 1e8 samples.
EvenSignal even_samples(std::span<const double> at, std::span<const double> values, double step);

/// Means over windows of this width about middles begin + width/2, then every step further, all windows within begin to
/// end, of the signal straight between its points. Empty where the window does not fit. Errors: as even_samples.
EvenSignal sliding_means(std::span<const double> at, std::span<const double> values, double begin, double end,
                         double width, double step);

/// A second-order section: y = b0 x + b1 x' + b2 x'' - a1 y' - a2 y''.
struct FilterSection {
  double b0 = 1.0, b1 = 0.0, b2 = 0.0, a1 = 0.0, a2 = 0.0;
};

/// A second-order filter (b2 s^2 + b1 s + b0)/(s^2 / w^2 + s / (q w) + 1) of analog frequency s by the bilinear
/// transformation, exact at w = 2 pi corner. Numerators: low pass {0, 0, 1}, high pass {1, 0, 0} with s over w.
FilterSection low_pass_section(double corner, double quality, double step);
FilterSection high_pass_section(double corner, double quality, double step);
/// (1 + s / w_a) / (1 + s / (q w_b) + s^2 / w_b^2).
FilterSection transition_section(double zero, double corner, double quality, double step);
/// (1 + s / (q_a w_a) + s^2 / w_a^2) / (1 + s / (q_b w_b) + s^2 / w_b^2) (w_a / w_b)^2.
FilterSection step_section(double zero, double zero_quality, double corner, double quality, double step);

/// Magnitude of sections at a frequency [Hz].
double magnitude(std::span<const FilterSection> sections, double frequency, double step);

/// Forwards, from rest in the steady state of the first sample.
std::vector<double> filtered(std::span<const double> values, std::span<const FilterSection> sections);

/// Low pass of 24 dB an octave without delay: a Butterworth filter of second order forwards and backwards, -3 dB at
/// the corner [Hz]. Its magnitude is 1/(1 + (sqrt(2) - 1) (f/corner)^4). Both ends are continued by their mirror image
/// through the end point; within a period of the corner they are less sure.
std::vector<double> low_passed(std::span<const double> values, double step, double corner);
/// The same high pass.
std::vector<double> high_passed(std::span<const double> values, double step, double corner);
/// The magnitude of both [-].
double low_pass_magnitude(double frequency, double corner);
double high_pass_magnitude(double frequency, double corner);

/// Frequency weightings of whole-body vibration with the parameters of ISO 8041 (its band-limiting, transition and
/// upward step): d for horizontal, b for vertical motion of passengers. Causal. The corner frequencies need a step well
/// below 1 ms.
enum class Weighting { b, d };
std::vector<FilterSection> weighting_sections(Weighting weighting, double step);
/// Analog magnitude of a weighting at a frequency [Hz]; what the sections come near to far below 1/(2 step).
double weighting_magnitude(Weighting weighting, double frequency);

/// The value below which this share [0 ... 1] of samples lies, straight between the sorted samples; NaN for none.
double percentile(std::vector<double> values, double share);

/// Root of the mean square about zero; NaN for none.
double rms_of(std::span<const double> values);

}  // namespace treadmark::measures
