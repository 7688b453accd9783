// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/app/measure/measure_files.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/surfaces.hpp"

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_measure(tm_body body, const char* file, const char* const* settings, size_t n, char** json) {
  if (json != nullptr) *json = nullptr;
  return guarded([&] {
    require(file != nullptr, "file must not be null");
    const app::MeasureRequest request =
        app::measure_request(body_of(body), io::given_settings(texts_of(settings, n, "settings must be n texts")));
    const app::MeasuredFile measured = app::measure_file(file, request);
    if (json != nullptr) *json = lasting(app::measure_json(measured, request));
  });
}

}  // extern "C"
