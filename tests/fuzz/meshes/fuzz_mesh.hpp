// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "treadmark/core/error.hpp"
#include "treadmark/io/meshes/parse_mesh.hpp"

namespace treadmark::fuzz {

/// Feeds the bytes to one parser; an Error is a fair answer, anything else that is thrown is not.
template <class Parser>
void parse_mesh(const std::uint8_t* data, std::size_t size, Parser parser) {
  try {
    parser(std::string_view(reinterpret_cast<const char*>(data), size), "fuzz", 1e-3);
  } catch (const Error&) {
  }
}

}  // namespace treadmark::fuzz
