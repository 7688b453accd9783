// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <filesystem>

#include "treadmark/io/histories/history_model.hpp"

namespace treadmark::io {

/// Tables with commas, a line of names first, in SI units; numbers are the shortest that read back exactly. The files
/// appear only when complete. Errors: Error(configuration) as check_simulation and for files that cannot be written.
/// Thread-safe.

/// The columns of the history, a line an instant.
void write_history_csv(const std::filesystem::path& path, const SimulationResult& result);

/// t_s,x_m,wheel,kind
void write_events_csv(const std::filesystem::path& path, const SimulationResult& result);

/// frequency_Hz,damping_ratio,shape
void write_modes_csv(const std::filesystem::path& path, const SimulationResult& result);

}  // namespace treadmark::io
