// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/backends/levelset/make.hpp"
#include "treadmark/backends/levelset/read_level_set.hpp"
#include "treadmark/core/parts.hpp"

namespace treadmark::levelset {
namespace {

[[noreturn]] void without_openvdb() { left_out("openvdb", "level sets"); }

}  // namespace

DistanceGrid read_level_set(const std::filesystem::path&, double, const std::string&) { without_openvdb(); }

std::shared_ptr<const Surface> make_level_set_surface(const TriangleMesh&, Body, double, std::string) {
  without_openvdb();
}

std::shared_ptr<const Surface> make_level_set_surface(const SolidShape&, Body, double, std::string) {
  without_openvdb();
}

}  // namespace treadmark::levelset
