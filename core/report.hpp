// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <string>
#include <string_view>

namespace treadmark {

/// How a computation ended.
enum class Status { ok, no_contact, not_converged, failed };

/// "ok", "no_contact", "not_converged", "failed": the words of the result file.
std::string_view to_string(Status status);

/// How a numerical method ended. Methods that may rightly fail return one of these instead of throwing.
struct Report {
  Status status = Status::ok;
  int iterations = 0;     ///< done
  double residual = 0.0;  ///< relative, in the measure the method documents
  std::string message;    ///< empty when there is nothing to say
};

}  // namespace treadmark
