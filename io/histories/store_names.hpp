// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::io {

/// Names in the stores of simulations and studies that writer and reader share.
inline constexpr const char* kSimulationFormat = "treadmark simulation 1";
inline constexpr const char* kStudyFormat = "treadmark study 1";
inline constexpr const char* kNames = "names";  // attribute of a group: its datasets in their order
inline constexpr const char* kCheckpoint = "checkpoint";
inline constexpr const char* kFields = "fields";
inline constexpr const char* kTime = "time";  // attributes of a snapshot
inline constexpr const char* kNominal = "nominal";
inline constexpr const char* kDrawn = "drawn";

}  // namespace treadmark::io
