// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/core/progress.hpp"
#include "treadmark/io/files/content_cache.hpp"
#include "treadmark/io/simulations/simulation_model.hpp"
#include "treadmark/solvers/vehicle/stability/eigenmodes.hpp"

namespace treadmark::app {

/// What `treadmark response` is asked for.
struct ResponseRequest {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< of the simulation file
  double from = 0.5, to = 50.0;        ///< frequencies [Hz]
  int count = 201;                     ///< of them, by equal ratios
  std::vector<std::string> inputs;     ///< names, * for any letters; empty: irregularities, forces at the first wheel
  std::vector<std::string> channels;   ///< the same of what responds; empty: of those of the file, else all
  bool iso_3095 = false;               ///< both rails are as rough as ISO 3095:2013 allows
  std::optional<io::ContentCache> cache;  ///< where tables are kept for other processes
};

/// What responds to one input.
struct ResponseCurve {
  std::string input, channel, unit;          ///< "longitudinal_level", "ws1_left.Q_N", "N/m"
  std::vector<std::complex<double>> values;  ///< by frequency [SI], e^(i w t)
};

/// What a channel does on the irregularities of the file, and on rails of that roughness.
struct ResponseSpectrum {
  std::string channel, unit;    ///< of the channel: "ws1_left.Q_N", "N"
  std::vector<double> density;  ///< by frequency, one-sided [unit^2/Hz]
  double rms = 0.0;             ///< between the first and the last frequency [unit]
};

/// Said of a vehicle that is not stable.
inline constexpr const char* kUnstable =
    "the linearised vehicle is unstable at this speed: what is computed is no response that lasts (treadmark "
    "stability)";

/// Transfer functions of a vehicle that runs steadily.
struct ResponseRun {
  ResponseRequest request;
  std::string title;
  std::vector<std::string> notes;  ///< of the file, and warnings about the equilibrium
  double speed = 0.0;              ///< [m/s]
  bool stable = true;              ///< false: some motion grows by itself at this speed, so that no response lasts
  std::vector<double> frequency;   ///< [Hz]
  std::vector<ResponseCurve> curves;
  std::vector<ResponseSpectrum> spectra;  ///< none without irregularities from spectra, and without roughness
  std::vector<vehicle::Eigenmode> modes;  ///< vibrations up to the highest frequency
  vehicle::Multibody system;              ///< whose coordinates their shapes have
};

/// The vehicle of a simulation file on straight track at its speed, linearised
/// (solvers/vehicle/stability/response.hpp). Errors: Error(configuration) for frequencies that are no range, names that
/// fit nothing, wheels with full contact and rails that bend; those of the file; Error(numerical) without an
/// equilibrium. May be cancelled. Spectra are those of independent inputs: S of the channel = sum of |H|^2 S of each.
ResponseRun run_response(const ResponseRequest& request, const Progress& progress = {});

std::string response_table(const ResponseRun& run);
std::string response_json(const ResponseRun& run);
std::string response_csv(const ResponseRun& run);
/// "channel,frequency_Hz,density,unit".
std::string spectra_csv(const ResponseRun& run);
std::string response_svg(const ResponseRun& run);
/// The modes as pictures, the vehicle from the side and from above; empty without any.
std::string modes_svg(const ResponseRun& run);

/// response.json, response.csv, response.svg, modes.svg, and spectra.csv where there are any.
void write_response_folder(const std::filesystem::path& folder, const ResponseRun& run);

}  // namespace treadmark::app
