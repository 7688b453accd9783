// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <string>

#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/request_settings.hpp"
#include "treadmark/interfaces/c/surfaces.hpp"

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_geometry(const char* const* settings, size_t n, char** json) {
  if (json != nullptr) *json = nullptr;
  return guarded([&] {
    const GeometryAnswer answer = answer_geometry(geometry_asked(texts_of(settings, n, "settings must be n texts")));
    if (json != nullptr) *json = lasting(answer.json());
  });
}

tm_status tm_measure(tm_body body, const char* file, const char* const* settings, size_t n, char** json) {
  if (json != nullptr) *json = nullptr;
  return guarded([&] {
    require(file != nullptr, "file must not be null");
    const app::MeasureRequest request = measure_asked(body_of(body), texts_of(settings, n, "settings must be n texts"));
    const app::MeasuredFile measured = app::measure_file(file, request);
    if (json != nullptr) *json = lasting(app::measure_json(measured, request));
  });
}

}  // extern "C"
