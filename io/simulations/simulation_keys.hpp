// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string_view>

namespace treadmark::io {

/// The keys of vehicle, track, simulation and study files, table by table (docs/simulation-files.md).

inline constexpr std::string_view kVehicleTables[] = {"vehicle", "bodies", "springs", "bump_stops", "wheelsets"};
inline constexpr std::string_view kTrackTables[] = {"track", "bodies", "springs"};
inline constexpr std::string_view kVehicleKeys[] = {"name", "source", "scale_mass", "scale_stiffness", "scale_damping"};
inline constexpr std::string_view kTrackKeys[] = {"name",       "source",          "rails",
                                                  "scale_mass", "scale_stiffness", "scale_damping"};
inline constexpr std::string_view kBodyKeys[] = {"name",       "mass_kg",     "inertia_kg_m2",
                                                 "position_m", "positions_m", "free"};
inline constexpr std::string_view kPlaceKeys[] = {"between", "at_m"};
inline constexpr std::string_view kSpringKeys[] = {"name",
                                                   "between",
                                                   "at_m",
                                                   "places",
                                                   "stiffness_N_per_m",
                                                   "damping_N_s_per_m",
                                                   "damper_stiffness_N_per_m",
                                                   "rotational_stiffness_N_m_per_rad",
                                                   "rotational_damping_N_m_s_per_rad",
                                                   "rotational_damper_stiffness_N_m_per_rad"};
inline constexpr std::string_view kBumpStopKeys[] = {"name",      "between",         "at_m",   "places",
                                                     "direction", "displacement_mm", "force_N"};
inline constexpr std::string_view kWheelsetKeys[] = {"body", "nominal_radius_mm"};

inline constexpr std::string_view kSimulationKeys[] = {
    "vehicle",         "track",       "speed_m_s",   "distance_m",        "duration_s",      "gravity_m_s2",
    "tolerance_um",    "max_step_us", "min_step_us", "max_step_elements", "spectral_radius", "checkpoint_s",
    "output_every_mm", "fields",      "wheels",      "other_wheel"};
inline constexpr std::string_view kFieldKeys[] = {"pitch_deg", "position_m"};
inline constexpr std::string_view kWheelKeys[] = {"wheelset", "side", "contact", "defects", "pitch_deg"};

inline constexpr std::string_view kStudyKeys[] = {"title", "base", "vary", "figures"};
inline constexpr std::string_view kVaryKeys[] = {"key", "label", "values", "from", "to", "count", "spacing"};
inline constexpr std::string_view kVaryValueKeys[] = {"label", "set"};
inline constexpr std::string_view kFigureKeys[] = {"file",    "kind",    "title",  "x",      "y",    "x_label",
                                                   "y_label", "x_range", "series", "labels", "only", "mark"};
inline constexpr std::string_view kMarkKeys[] = {"x", "y", "label"};

}  // namespace treadmark::io
