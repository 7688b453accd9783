// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <optional>
#include <string>
#include <string_view>

#include "treadmark/app/geometry/geometry_run.hpp"
#include "treadmark/app/surfaces/profile_check.hpp"
#include "treadmark/interfaces/c/calls.hpp"
#include "treadmark/interfaces/c/surfaces.hpp"

using namespace treadmark;
using namespace treadmark::c;

extern "C" {

tm_status tm_geometry(const char* const* settings, size_t n, char** json) {
  if (json != nullptr) *json = nullptr;
  return guarded([&] {
    app::SectionStore store;
    const app::GeometryResult result = app::run_geometry(
        app::geometry_request(io::given_settings(texts_of(settings, n, "settings must be n texts"))), store);
    if (json != nullptr) *json = lasting(app::geometry_json(result));
  });
}

tm_status tm_check_profile(const char* file, const char* body, char** json) {
  if (json != nullptr) *json = nullptr;
  return guarded([&] {
    require(file != nullptr, "file must not be null");
    const std::string_view kind = body == nullptr ? "" : body;
    require(kind.empty() || kind == "wheel" || kind == "rail", "body must be wheel or rail");
    std::optional<Body> known;
    if (!kind.empty()) known = kind == "wheel" ? Body::wheel : Body::rail;
    const std::string text = app::profile_check_json(app::check_profile(file, known));
    if (json != nullptr) *json = lasting(text);
  });
}

}  // extern "C"
