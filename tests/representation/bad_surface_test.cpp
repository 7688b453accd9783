// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>

#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/representation/kinds.hpp"

// Broken triangles, files of offsets and defects get one clear message with the right exit status, or are repaired so
// that the contact is that of the sound surface.

namespace treadmark::testing {
namespace {

using ::testing::HasSubstr;

constexpr const char* kBadCase = R"(
[case]
side = "right"
regime = "steady"
[wheel]
WHEEL
[rail]
RAIL
[track]
gauge_mm = 1435.0
gauge_height_mm = 14.0
cant = "1:40"
[wheelset]
flange_back_distance_mm = 1360.0
flange_back_position_mm = -70.0
nominal_radius_mm = 460.0
vertical_force_N = 80e3
velocity_m_s = 2.0
vpitch_rad_s = -4.3478
[material]
shear_modulus_GPa = 82.0
poisson_ratio = 0.28
[friction]
coefficient = 0.3
[discretisation]
dx_mm = 1.0
ds_mm = 1.0
[[cases]]
wheelset.s_mm = 0.0
)";

class BadSurface : public ::testing::Test {
 protected:
  /// Writes case.toml and runs it.
  ProgramResult run(const std::string& wheel, const std::string& rail, const std::vector<std::string>& options = {}) {
    std::string text = kBadCase;
    text.replace(text.find("WHEEL"), 5, wheel);
    text.replace(text.find("RAIL"), 4, rail);
    folder.write("case.toml", text);
    std::filesystem::remove(json());
    std::vector<std::string> arguments{"run", (folder.folder() / "case.toml").string(), "--json", json().string(),
                                       "--quiet"};
    arguments.insert(arguments.end(), options.begin(), options.end());
    return run_program(arguments);
  }
  ProgramResult run_rail(const std::string& rail, const std::vector<std::string>& options = {}) {
    return run("shape.standard = \"S1002\"", rail, options);
  }
  ProgramResult run_mesh(const TriangleMesh& mesh, const std::vector<std::string>& options = {}) {
    io::write_mesh(folder.folder() / "rail.ply", mesh);
    return run_rail("shape.file = \"rail.ply\"", options);
  }
  void expect_refused(const ProgramResult& r, int status, const std::vector<std::string>& words) {
    EXPECT_EQ(r.status, status) << r.err;
    for (const auto& word : words) EXPECT_THAT(r.err, HasSubstr(word));
    EXPECT_EQ(std::count(r.err.begin(), r.err.end(), '\n'), 1) << "one message: " << r.err;
    EXPECT_FALSE(std::filesystem::exists(json()));
  }
  std::filesystem::path json() const { return folder.folder() / "result.json"; }
  nlohmann::json only_patch() const {
    const auto patches = nlohmann::json::parse(folder.read("result.json"))["cases"][0]["patches"];
    EXPECT_EQ(patches.size(), 1u);
    return patches.at(0);
  }

  /// A rail with a squat off the contact, 16 cm of it in triangles of 2 mm.
  static const TriangleMesh& sound() {
    static const TriangleMesh mesh = [] {
      Region region;
      region.u_min = -0.08;
      region.u_max = 0.08;
      Defects beside = one_squat();
      beside.squats[0].x_center = 0.05;
      return to_triangles(create_natural(rail_60e1(beside)), {"", 2e-3, region});
    }();
    return mesh;
  }
  static Vec3 middle(const TriangleMesh& mesh, const std::array<std::uint32_t, 3>& t) {
    return (mesh.vertices[t[0]] + mesh.vertices[t[1]] + mesh.vertices[t[2]]) / 3.0;
  }

  void expect_same_contact(const TriangleMesh& repaired, double tolerance,
                           const std::vector<std::string>& options = {}) {
    ASSERT_EQ(run_mesh(sound(), options).status, 0);
    const nlohmann::json truth = only_patch();
    const ProgramResult r = run_mesh(repaired, options);
    ASSERT_EQ(r.status, 0) << r.err;
    const nlohmann::json found = only_patch();
    const auto expect_near = [&](const char* key, const char* scale) {
      EXPECT_NEAR(found[key].get<double>(), truth[key].get<double>(), tolerance * truth[scale].get<double>()) << key;
    };
    for (const char* key : {"pmax_MPa", "fn_N", "approach_mm"}) expect_near(key, key);
    for (const char* key : {"fx_N", "fs_N"}) expect_near(key, "fn_N");
    EXPECT_EQ(found["elements"], truth["elements"]);
  }

  SampleInput folder;
};

constexpr double kSame = 1e-6;

TEST_F(BadSurface, FlippedTrianglesAreTurned) {
  TriangleMesh mesh = sound();
  for (std::size_t i = 0; i < mesh.triangles.size(); i += 7) std::swap(mesh.triangles[i][1], mesh.triangles[i][2]);
  expect_same_contact(mesh, kSame);
}

TEST_F(BadSurface, AMeshInsideOutIsTurned) {
  TriangleMesh mesh = sound();
  for (auto& t : mesh.triangles) std::swap(t[1], t[2]);
  expect_same_contact(mesh, kSame);
}

TEST_F(BadSurface, DuplicateTrianglesAreRemoved) {
  TriangleMesh mesh = sound();
  for (std::size_t i = 0, n = mesh.triangles.size(); i < n; i += 5) mesh.triangles.push_back(mesh.triangles[i]);
  expect_same_contact(mesh, kSame);
}

TEST_F(BadSurface, TrianglesWithoutAreaAreRemoved) {
  TriangleMesh mesh = sound();
  for (std::size_t i = 0, n = mesh.triangles.size(); i < n; i += 9) {
    const auto t = mesh.triangles[i];
    mesh.triangles.push_back({t[0], t[0], t[1]});
    mesh.triangles.push_back({t[2], t[1], t[1]});
  }
  expect_same_contact(mesh, kSame);
}

/// Sound triangles with a corner more on some edges, next to an end: needles on both sides of the edge.
TriangleMesh with_slivers(const TriangleMesh& sound, double share) {
  TriangleMesh mesh = sound;
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::vector<std::size_t>> edges;
  for (std::size_t i = 0; i < sound.triangles.size(); ++i)
    for (int k = 0; k < 3; ++k) {
      const std::uint32_t a = sound.triangles[i][static_cast<std::size_t>(k)],
                          b = sound.triangles[i][static_cast<std::size_t>((k + 1) % 3)];
      edges[{std::min(a, b), std::max(a, b)}].push_back(i);
    }
  std::vector<bool> used(sound.triangles.size(), false);
  int count = 0;
  for (const auto& [edge, sides] : edges) {
    if (sides.size() != 2 || used[sides[0]] || used[sides[1]] || ++count % 37 != 0) continue;
    const auto [a, b] = edge;
    const auto added = static_cast<std::uint32_t>(mesh.vertices.size());
    mesh.vertices.push_back(mesh.vertices[a] + share * (mesh.vertices[b] - mesh.vertices[a]));
    for (const std::size_t side : sides) {
      used[side] = true;
      auto& t = mesh.triangles[side];
      auto sliver = t;
      for (auto& corner : t) corner = corner == a ? added : corner;
      for (auto& corner : sliver) corner = corner == b ? added : corner;
      mesh.triangles.push_back(sliver);
    }
  }
  return mesh;
}

TEST_F(BadSurface, SliversChangeNothing) {
  // On the triangles themselves. The smooth refinement fits its polynomials to the corners as they are; one corner more
  // on some edges moves it by its own error.
  expect_same_contact(with_slivers(sound(), 1e-6), kSame, {"--rail-backend", "mesh-flat"});
  expect_same_contact(with_slivers(sound(), 1e-6), 1e-3);
}

TEST_F(BadSurface, AHoleUnderTheContact) {
  TriangleMesh mesh = sound();
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const Vec3 p = middle(mesh, t);
    return std::fabs(p.x()) < 6e-3 && std::fabs(p.y()) < 12e-3;
  });
  const ProgramResult r = run_mesh(mesh);
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.out, HasSubstr("failed (the rail has no surface at the contact reference point: there is a hole"));
}

TEST_F(BadSurface, ASmallHoleWithinTheContact) {
  TriangleMesh mesh = sound();
  std::erase_if(mesh.triangles, [&](const auto& t) {
    const Vec3 p = middle(mesh, t);
    return std::hypot(p.x() - 3e-3, p.y()) < 1.6e-3;
  });
  const ProgramResult r = run_mesh(mesh);
  EXPECT_EQ(r.status, 1);
  EXPECT_THAT(r.out, HasSubstr("has a hole of"));
  EXPECT_THAT(r.out, HasSubstr("within contact"));
}

TEST_F(BadSurface, NumbersThatAreNone) {
  io::write_mesh(folder.folder() / "rail.obj", sound());
  std::string text = folder.read("rail.obj");
  const auto line = text.find("\nv ", text.size() / 4) + 1;
  text.replace(line, text.find('\n', line) - line, "v nan 0 1");
  folder.write("rail.obj", text);
  expect_refused(run_rail("shape.file = \"rail.obj\""), 3, {"rail.obj:", "'nan'", "not finite"});
}

TEST_F(BadSurface, WrongUnits) {
  for (const double factor : {1e-3, 1e3}) {  // written in metres and in micrometres
    TriangleMesh mesh = sound();
    for (Vec3& v : mesh.vertices) v *= factor;
    expect_refused(run_mesh(mesh), 3, {"rail.ply", factor < 1.0 ? "only 0.000" : "no rail is"});
    const ProgramResult scaled =
        run_rail("shape.file = \"rail.ply\"\nshape.scale_to_mm = " + std::to_string(1.0 / factor));
    EXPECT_EQ(scaled.status, 0) << scaled.err;
  }
}

class BadOffsets : public BadSurface {
 protected:
  void SetUp() override {
    Region region;
    region.u_min = -0.2;
    region.u_max = 0.2;
    write_offsets(folder.folder() / "rail.vdb", create_natural(rail_60e1(one_squat())), {"offset", 1e-3, region});
    write_offsets(folder.folder() / "wheel.vdb", create_natural(s1002(one_flat())), {"offset", 1e-3, region});
    SurfaceSpec other = s1002(one_flat());
    other.nominal_radius = 0.49;
    write_offsets(folder.folder() / "wheel490.vdb", create_natural(other), {"offset", 1e-3, region});
  }
  ProgramResult run_files(const std::string& wheel, const std::string& rail) {
    return run("shape.file = \"" + wheel + "\"", "shape.file = \"" + rail + "\"");
  }
};

TEST_F(BadOffsets, TheSoundOnesAreFine) { EXPECT_EQ(run_files("wheel.vdb", "rail.vdb").status, 0); }

TEST_F(BadOffsets, EmptyForeignAndCutFiles) {
  const std::string whole = folder.read("rail.vdb");
  folder.write("empty.vdb", "");
  folder.write("foreign.vdb", "solid this is a file of triangles\nendsolid\n" + std::string(2000, 'x'));
  expect_refused(run_files("wheel.vdb", "empty.vdb"), 3, {"empty.vdb", "empty"});
  expect_refused(run_files("wheel.vdb", "foreign.vdb"), 3, {"foreign.vdb", "not a VDB file"});
  expect_refused(run_files("wheel.vdb", "absent.vdb"), 3, {"absent.vdb", "does not exist"});
  for (const double share : {0.02, 0.3, 0.6, 0.99}) {
    folder.write("cut.vdb", whole.substr(0, static_cast<std::size_t>(share * static_cast<double>(whole.size()))));
    expect_refused(run_files("wheel.vdb", "cut.vdb"), 3, {"cut.vdb"});
  }
}

TEST_F(BadOffsets, OfTheOtherBodyOrAnotherRadius) {
  expect_refused(run_files("wheel.vdb", "wheel.vdb"), 2, {"wheel.vdb", "the offsets belong to a wheel"});
  expect_refused(run_files("rail.vdb", "rail.vdb"), 2, {"rail.vdb", "the offsets belong to a rail"});
  expect_refused(run_files("wheel490.vdb", "rail.vdb"), 2, {"wheel490.vdb", "490 mm", "460 mm", "nominal_radius_mm"});
}

class BadDefect : public BadSurface {
 protected:
  void expect_flat_refused(const std::string& numbers, const std::vector<std::string>& words) {
    expect_refused(run("shape.standard = \"S1002\"\n[[wheel.flats]]\nshape = \"rounded\"\n" + numbers,
                       "shape.standard = \"60E1\""),
                   2, words);
  }
  void expect_rail_refused(const std::string& defect, const std::vector<std::string>& words) {
    expect_refused(run_rail("shape.standard = \"60E1\"\n" + defect), 2, words);
  }
};

TEST_F(BadDefect, FlatsBeyondTheAxle) {
  for (const char* depth : {"240.0", "460.0", "600.0"})
    expect_flat_refused("length_mm = 160.0\ndepth_mm = " + std::string(depth),
                        {"case.toml:", "wheel.flats[0]", "depth"});
}

TEST_F(BadDefect, FlatsAndSquatsSteeperThanTheyCanBe) {
  expect_flat_refused("length_mm = 160.0\ndepth_mm = 100.0",
                      {"wheel.flats[0]", "too deep for its length", "45 degrees"});
  expect_rail_refused("[[rail.squats]]\nlength_mm = 40.0\nwidth_mm = 30.0\ndepth_mm = 20.0",
                      {"rail.squats[0]", "too deep for its length", "45 degrees"});
}

constexpr const char* kStations =
    "stations = [{ x_mm = -500.0, y_mm = 0.0, z_mm = 1.0 }, { x_mm = 500.0, y_mm = 0.0, z_mm = 1.0 }]\n";

TEST_F(BadDefect, CutterThatIsNoGraph) {
  // more than a half circle
  expect_rail_refused(
      std::string("[[rail.milling_paths]]\nstart_y_mm = -10.0\nstart_z_mm = 5.0\nstart_angle_deg = -60.0\n"
                  "section = [{ length_mm = 40.0, radius_mm = 10.0 }]\n") +
          kStations,
      {"rail.milling_paths[0]"});
  // a cutter that is a graph, rolled until it is none
  expect_rail_refused(
      "[[rail.milling_paths]]\nstart_y_mm = -10.0\nsection = [{ length_mm = 20.0 }]\n"
      "stations = [{ x_mm = -500.0, y_mm = 0.0, z_mm = 1.0 }, { x_mm = 500.0, y_mm = 0.0, z_mm = 1.0, roll_deg = 85.0 "
      "}]\n",
      {"rail.milling_paths[0]"});
}

TEST_F(BadDefect, PathsThatGoBack) {
  expect_rail_refused(
      "[[rail.milling_paths]]\nstart_y_mm = -10.0\nsection = [{ length_mm = 20.0 }]\n"
      "stations = [{ x_mm = 0.0, y_mm = 0.0, z_mm = 1.0 }, { x_mm = -5.0, y_mm = 0.0, z_mm = 1.0 }]\n",
      {"rail.milling_paths[0]"});
}

}  // namespace
}  // namespace treadmark::testing
