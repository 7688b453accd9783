// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <complex>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "treadmark/io/simulations/read_vehicle.hpp"
#include "treadmark/solvers/vehicle/track/fit_lumped.hpp"

namespace treadmark::app {

/// What `treadmark track` is asked for.
struct TrackRequest {
  std::filesystem::path file;
  std::vector<std::string> overrides;  ///< of the track file
  double from = 10.0, to = 1500.0;     ///< frequencies [Hz]
  int count = 200;                     ///< of them, evenly spaced in the logarithm
  int layers = 0;                      ///< of a lumped track to be fitted; 0: none
  /// Where contact lies on the rail's head, beside its middle [m]: what couples vertical and lateral motion there.
  double aside = 0.0;
};

/// Motion of a rail's top under a force of 1 N at it, in the same direction unless the name says otherwise.
struct TrackCurve {
  std::string name;  ///< "between sleepers"
  std::string key;   ///< "between"
  std::vector<std::complex<double>> receptance;
  double at_rest = 0.0;  ///< [m/N]
};

/// How a track gives way.
struct TrackResult {
  TrackRequest request;
  std::string name, source;
  bool flexible = false;
  std::vector<double> frequency;   ///< [Hz]
  std::vector<TrackCurve> curves;  ///< vertical: between, over, mean of a flexible track; rail of a lumped one
  /// Of the rail, where it moves sideways; of a flexible track whose rails bend there between and over sleepers and the
  /// mean of a bay (key lateral), and vertically under a lateral force beside the middle of the head.
  std::vector<TrackCurve> lateral;

  /// Of the bay in the middle of a flexible track.
  struct Bay {
    std::size_t seats = 0;                        ///< of the whole track
    double length = 0.0;                          ///< [m]
    double pinned_pinned = 0.0;                   ///< by Timoshenko's formula [Hz]
    std::optional<double> lateral_pinned_pinned;  ///< of bending sideways [Hz]
    double peak = 0.0;  ///< where the receptance between sleepers exceeds that over one the most [Hz]
    double peak_ratio = 0.0;
    std::vector<double> x;           ///< from its middle [m]
    std::vector<double> deflection;  ///< of the rail at rest under a force of 1 N at x = 0 [m/N]
  };
  std::optional<Bay> bay;

  /// Made from the mean, or from a lumped track's own receptance.
  struct Fitted {
    vehicle::LumpedFit fit;
    TrackModel track;
    TrackCurve curve;
  };
  std::optional<Fitted> fitted;

  /// That which is fitted: the last of curves.
  const TrackCurve& typical() const { return curves.back(); }
};

/// Errors: Error(configuration) for files and frequencies that make no sense. May be cancelled.
TrackResult run_track(const TrackRequest& request);
/// Of a track that has been read; the request says where from.
TrackResult run_track(const TrackRequest& request, const io::AnyTrack& track);

/// A lumped track of these layers below each wheel: both halves of a track are equal and not connected. distance: of
/// the middles of both rails [m].
TrackModel lumped_track(const std::string& name, const std::vector<vehicle::LumpedLayer>& layers, double distance,
                        const std::optional<LateralSupport>& lateral);

std::string track_table(const TrackResult& result);
std::string track_json(const TrackResult& result);
std::string track_csv(const TrackResult& result);
std::string track_svg(const TrackResult& result);
/// The fitted track as a file.
std::string fitted_text(const TrackResult& result);

/// track.json, receptance.csv, track.svg and, where there is one, fitted.toml.
void write_track_folder(const std::filesystem::path& folder, const TrackResult& result);

}  // namespace treadmark::app
