// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>

namespace treadmark::contact {

/// How much of it a caller wants to read in the log: as CNTC_if_idebug.
enum class Detail { warning = 0, calls = 1 };

/// Opens <file> for writing; also on the screen if wanted. A file that cannot be opened is said on the screen only.
void open_log(const std::string& file, bool screen);
void close_log();
void set_log_detail(int detail);

/// Writes a line. Lines before the log is open are lost. Thread-safe, never throws.
void log(Detail detail, const std::string& line) noexcept;
inline void warn(const std::string& line) noexcept { log(Detail::warning, line); }

}  // namespace treadmark::contact
