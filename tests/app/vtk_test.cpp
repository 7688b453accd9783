// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <map>
#include <nlohmann/json.hpp>

#include "treadmark/io/meshes/read_mesh.hpp"
#include "treadmark/tests/app/program.hpp"
#include "treadmark/tests/app/sample_input.hpp"
#include "treadmark/tests/io/results/vtk_values.hpp"

namespace treadmark::testing {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string kWheelCase =
    "rail.shape.standard = \"60E1\"\nwheel.shape.standard = \"S1002\"\ntrack.cant = \"1:40\"\n"
    "discretisation.dx_mm = 1\ndiscretisation.ds_mm = 1\n"
    "[wheelset]\nnominal_radius_mm = 460\nvertical_force_N = 1e5\nvelocity_km_h = 100\nrolling = \"nominal\"\n"
    "[[cases]]\n";

/// time -> files of a collection.
std::map<double, std::vector<std::string>> collection(const std::string& text) {
  std::map<double, std::vector<std::string>> out;
  const XmlElement root = read_xml(text);
  for (const XmlElement* set : root.find("DataSet"))
    out[std::stod(set->attributes.at("timestep"))].push_back(set->attributes.at("file"));
  return out;
}

std::vector<double> times_of(const SampleInput& input, const std::string& cases) {
  input.write("case.toml", kWheelCase + cases);
  const std::string folder = (input.folder() / "out").string();
  const ProgramResult r = run_program({"run", (input.folder() / "case.toml").string(), "-o", folder, "--vtk"});
  EXPECT_EQ(r.status, 0) << r.err;
  std::vector<double> times;
  const auto patches = collection(input.read("out/vtk/result.pvd")),
             bodies = collection(input.read("out/vtk/bodies.pvd"));
  for (const auto& [time, files] : patches) {
    times.push_back(time);
    EXPECT_EQ(bodies.at(time).size(), 2u) << time;
  }
  EXPECT_EQ(bodies.size(), patches.size());
  return times;
}

TEST(VtkFiles, TimeIsWhatGrowsFromCaseToCase) {
  const SampleInput input;
  EXPECT_THAT(times_of(input, "wheelset.pitch_deg = [-3, 0.5, 4]\n"), ElementsAre(-3.0, 0.5, 4.0));
  // A wheel that rolls forward turns backward: its place grows.
  EXPECT_THAT(times_of(input, "wheelset.pitch_deg = [0, -1, -2]\nwheelset.s_mm = [10, 18, 26]\n"),
              ElementsAre(10.0, 18.0, 26.0));
  EXPECT_THAT(times_of(input, "wheelset.y_mm = [3, -1, 2]\n"), ElementsAre(1.0, 2.0, 3.0));
}

TEST(VtkFiles, BodiesTouchWhereTheResultSays) {
  const SampleInput input;
  const std::vector<double> times = times_of(input, "wheelset.y_mm = [-2, 3]\n");
  const auto bodies = collection(input.read("out/vtk/bodies.pvd"));
  const auto result = nlohmann::json::parse(input.read("out/result.json"));
  for (std::size_t k = 0; k < times.size(); ++k) {
    const auto& place = result["cases"][k]["patches"][0]["reference"];
    const Vec3 contact(1e-3 * place["x_tr_mm"].get<double>(), 1e-3 * place["y_tr_mm"].get<double>(),
                       1e-3 * place["z_tr_mm"].get<double>());
    for (const std::string& file : bodies.at(times[k])) {
      const auto points = vtk_values<float>(read_xml(input.read("out/vtk/" + file)), "points_m");
      double height = NAN, nearest = 1.0;
      for (std::size_t i = 0; i + 2 < points.size(); i += 3)
        if (const double d = std::hypot(points[i] - contact.x(), points[i + 1] - contact.y());
            d < nearest && points[i + 2] > -0.3)  // not the upper side of the wheel
          nearest = d, height = points[i + 2];
      EXPECT_LT(nearest, 15e-3) << file;  // as finely as bodies are sampled
      EXPECT_NEAR(height, contact.z(), 0.5e-3) << file;
    }
  }
}

TEST(ConvertCommand, WritesTrianglesForParaView) {
  const SampleInput input;
  const auto in = [&](const char* name) { return (input.folder() / name).string(); };
  for (const char* name : {"wheel.vtp", "wheel.ply"}) {
    const ProgramResult r = run_program({"convert", in("case.inp"), in(name), "--body", "wheel", "--resolution", "20"});
    ASSERT_EQ(r.status, 0) << r.err;
    EXPECT_THAT(r.out, HasSubstr("triangles"));
  }
  const TriangleMesh same = io::read_mesh(in("wheel.ply"));
  const XmlElement root = read_xml(input.read("wheel.vtp"));
  const auto points = vtk_values<double>(root, "points_m");
  const auto corners = vtk_values<std::int32_t>(root, "connectivity");
  ASSERT_EQ(points.size(), 3 * same.vertices.size());
  ASSERT_EQ(corners.size(), 3 * same.triangles.size());
  for (std::size_t i = 0; i < points.size(); ++i)
    EXPECT_NEAR(points[i], same.vertices[i / 3][static_cast<int>(i % 3)], 1e-12);
  for (std::size_t i = 0; i < corners.size(); ++i)
    EXPECT_EQ(static_cast<std::uint32_t>(corners[i]), same.triangles[i / 3][i % 3]);
}

}  // namespace
}  // namespace treadmark::testing
