// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/measure/read_measured.hpp"
#include "treadmark/core/error.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::app {

bool is_only_scan(const std::string&) { return false; }

ReadMeasured read_scanned(const std::string& name, const MeasureRequest&) {
  throw Error(ErrorKind::configuration, left_out_message("scans", "measuring scans"), {name}, left_out_advice("scans"));
}

}  // namespace treadmark::app
