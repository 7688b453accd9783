// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/results/write_vtk.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <span>

#include "treadmark/core/error.hpp"
#include "treadmark/io/files/text.hpp"
#include "treadmark/tests/io/results/sample_block.hpp"
#include "treadmark/tests/io/results/sample_run.hpp"
#include "treadmark/tests/io/results/vtk_values.hpp"
#include "treadmark/tests/support/temporary_folder.hpp"

namespace treadmark {
namespace {

constexpr double kSinglePrecision = 1e-7;  // fields are stored as Float32
constexpr double kRounding = 1e-15;        // [m], of the sums behind a corner's place

TEST(Base64, AgreesWithTheExamplesOfTheStandard) {
  // RFC 4648, section 10.
  const std::pair<std::string, std::string> examples[] = {{"", ""},
                                                          {"f", "Zg=="},
                                                          {"fo", "Zm8="},
                                                          {"foo", "Zm9v"},
                                                          {"foob", "Zm9vYg=="},
                                                          {"fooba", "Zm9vYmE="},
                                                          {"foobar", "Zm9vYmFy"}};
  for (const auto& [plain, coded] : examples) EXPECT_EQ(io::to_base64(std::as_bytes(std::span(plain))), coded);
}

TEST(WriteVtk, CornersLieInTrackAxes) {
  const io::RunResult run = testing::sample_run();
  const io::PatchResult& patch = run.cases[0].patches[1];
  const testing::XmlElement root = testing::read_xml(io::patch_to_vts(patch, 1, 2));
  EXPECT_EQ(root.attributes.at("type"), "StructuredGrid");
  EXPECT_EQ(root.find("Piece").at(0)->attributes.at("Extent"), "0 24 0 20 0 0");
  const auto points = testing::vtk_values<double>(root, "points_m");
  ASSERT_EQ(points.size(), 3u * 25u * 21u);

  // The centre of an element's corners is its centre; rolled by hand about x by the contact angle.
  const io::PatchFields& fields = patch.fields;
  const int ix = 7, iy = 3;
  double centre[3] = {0, 0, 0};
  for (const int jy : {iy, iy + 1})
    for (const int jx : {ix, ix + 1})
      for (std::size_t k = 0; k < 3; ++k) centre[k] += 0.25 * points[3 * static_cast<std::size_t>(jx + 25 * jy) + k];
  const double s = fields.grid.y(iy);
  EXPECT_NEAR(centre[0], patch.x_tr + fields.grid.x(ix), kRounding);
  EXPECT_NEAR(centre[1], patch.y_tr + std::cos(patch.angle) * s, kRounding);
  EXPECT_NEAR(centre[2], patch.z_tr + std::sin(patch.angle) * s, kRounding);
}

TEST(WriteVtk, CellsCarryTheFieldsWithUnitsInTheirNames) {
  const io::RunResult run = testing::sample_run();
  const io::PatchResult& patch = run.cases[0].patches[1];
  const testing::XmlElement root = testing::read_xml(io::patch_to_vts(patch, 1, 2));
  const auto pressure = testing::vtk_values<float>(root, "pressure_Pa");
  ASSERT_EQ(pressure.size(), patch.fields.pressure.size());
  for (std::size_t i = 0; i < pressure.size(); ++i)
    EXPECT_NEAR(pressure[i], patch.fields.pressure[i], kSinglePrecision * patch.pmax);
  const auto state = testing::vtk_values<std::uint8_t>(root, "state");
  EXPECT_EQ(state, patch.fields.state);
  EXPECT_EQ(root.find("DataArray", "Name", "slip_x").size(), 1u);

  // The traction vector has the length of its components and pushes the rail down (z down).
  const auto vectors = testing::vtk_values<float>(root, "traction_on_rail_Pa");
  const std::size_t i = patch.fields.grid.index(12, 10);
  const double size = std::hypot(patch.fields.pressure[i], patch.fields.traction_x[i], patch.fields.traction_s[i]);
  EXPECT_NEAR(std::hypot(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]), size, 4 * kSinglePrecision * size);
  EXPECT_GT(vectors[3 * i + 2], 0.0f);

  const testing::XmlElement shift = testing::read_xml(io::patch_to_vts(run.cases[1].patches[0], 2, 1));
  EXPECT_EQ(shift.find("DataArray", "Name", "slip_x_m").size(), 1u);
}

TEST(WriteVtk, TheCollectionNamesEveryPatchFile) {
  const testing::TemporaryFolder folder;
  const auto written = io::write_vtk(folder.path() / "vtk", testing::sample_run(), "flat");
  ASSERT_EQ(written.size(), 4u);  // 2 + 1 patches with fields, and the collection
  const testing::XmlElement root = testing::read_xml(testing::read_text(written.back()));
  const auto sets = root.find("DataSet");
  ASSERT_EQ(sets.size(), 3u);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_EQ(folder.path() / "vtk" / sets[i]->attributes.at("file"), written[i]);
    EXPECT_NO_THROW(testing::read_xml(testing::read_text(written[i])));
  }
  EXPECT_EQ(sets[1]->attributes.at("file"), "flat_case0001_patch2.vts");
  EXPECT_EQ(sets[1]->attributes.at("part"), "1");
  EXPECT_EQ(sets[2]->attributes.at("timestep"), "2");
}

/// A cylinder of 8 stations and 3 points in each, one of which is missing.
io::SampledSurface cylinder_with_hole() {
  io::SampledSurface surface;
  surface.body = "wheel", surface.name = "wheel_1";
  surface.nu = 8, surface.nv = 3, surface.closed = true;
  for (int iu = 0; iu < surface.nu; ++iu)
    for (int iv = 0; iv < surface.nv; ++iv) {
      const double angle = 2.0 * std::acos(-1.0) * iu / surface.nu;
      const bool hole = iu == 2 && iv == 0;
      surface.x.push_back(hole ? NAN : 0.46 * std::sin(angle));
      surface.y.push_back(hole ? NAN : 0.01 * iv);
      surface.z.push_back(hole ? NAN : 0.46 * std::cos(angle));
      surface.deviation.push_back(hole ? NAN : 1e-3 * iv);
    }
  return surface;
}

TEST(WriteVtk, BodiesArePolygonsWhereTheyAreWithoutWhatIsMissing) {
  const io::SampledSurface surface = cylinder_with_hole();
  const Pose X_TA{{0.1, 0.75, -0.46}, rotation_x(0.3)};
  const testing::XmlElement root = testing::read_xml(io::surface_to_vtp(surface, X_TA));
  EXPECT_EQ(root.attributes.at("type"), "PolyData");
  const auto points = testing::vtk_values<float>(root, "points_m");
  const auto deviation = testing::vtk_values<float>(root, "deviation_m");
  const auto corners = testing::vtk_values<std::int32_t>(root, "connectivity");
  const auto ends = testing::vtk_values<std::int32_t>(root, "offsets");
  ASSERT_EQ(points.size(), 3u * 23u);
  ASSERT_EQ(deviation.size(), 23u);
  // 8 x 2 cells round the cylinder; two have the missing corner.
  ASSERT_EQ(ends.size(), 14u);
  ASSERT_EQ(corners.size(), 56u);
  EXPECT_EQ(root.find("Piece").at(0)->attributes.at("NumberOfPoints"), "23");
  EXPECT_EQ(root.find("Piece").at(0)->attributes.at("NumberOfPolys"), "14");
  for (std::size_t i = 0; i < ends.size(); ++i) EXPECT_EQ(ends[i], 4 * static_cast<std::int32_t>(i + 1));
  const auto own = [&](std::int32_t k) -> Vec3 {  // in the body's axes
    const std::size_t at = 3 * static_cast<std::size_t>(k);
    return X_TA.rotation.transpose() * (Vec3(points[at], points[at + 1], points[at + 2]) - X_TA.origin);
  };
  // Every cell has the sides of its own: a chord of the circle and a step along the axle; its points lie on the circle.
  const double chord = 2.0 * 0.46 * std::sin(std::acos(-1.0) / 8.0);
  for (std::size_t i = 0; i < corners.size(); i += 4) {
    for (std::size_t k = 0; k < 4; ++k) {
      ASSERT_GE(corners[i + k], 0);
      ASSERT_LT(corners[i + k], 23);
      const Vec3 p = own(corners[i + k]);
      EXPECT_NEAR(std::hypot(p.x(), p.z()), 0.46, 4 * kSinglePrecision);
      EXPECT_NEAR(deviation[static_cast<std::size_t>(corners[i + k])], 0.1 * p.y(), 4 * kSinglePrecision);
      EXPECT_NEAR((own(corners[i + (k + 1) % 4]) - p).norm(), k % 2 == 0 ? chord : 0.01, 8 * kSinglePrecision);
    }
  }
}

TEST(WriteVtk, BodiesThatStayHaveOneFileForAllTimes) {
  const testing::TemporaryFolder folder;
  io::RunResult run = testing::sample_run();
  io::SampledSurface rail = cylinder_with_hole();
  rail.body = "rail", rail.name = "rail_1";
  run.sampled = {cylinder_with_hole(), rail};
  run.cases.resize(2);
  const std::vector<double> times{0.25, 0.5};
  for (std::size_t k = 0; k < 2; ++k) {
    run.cases[k].wheel_surface = "wheel_1", run.cases[k].rail_surface = "rail_1";
    run.cases[k].bodies = io::CaseResult::Bodies{};
    run.cases[k].bodies->X_TA.origin.x() = 0.1 * static_cast<double>(k);
  }
  const auto written = io::write_vtk_bodies(folder.path(), run, "bodies", times);
  ASSERT_EQ(written.size(), 4u);
  const testing::XmlElement root = testing::read_xml(testing::read_text(written.back()));
  std::vector<std::string> said;
  for (const testing::XmlElement* set : root.find("DataSet"))
    said.push_back(set->attributes.at("timestep") + ' ' + set->attributes.at("part") + ' ' +
                   set->attributes.at("file"));
  EXPECT_EQ(said, (std::vector<std::string>{"0.25 0 bodies_rail_1_0001.vtp", "0.25 1 bodies_wheel_1_0001.vtp",
                                            "0.5 0 bodies_rail_1_0001.vtp", "0.5 1 bodies_wheel_1_0002.vtp"}));
  // Patches have the same times.
  const auto patches = io::write_vtk(folder.path(), run, "result", times);
  EXPECT_EQ(testing::read_xml(testing::read_text(patches.back())).find("DataSet").back()->attributes.at("timestep"),
            "0.5");
  run.sampled.clear();
  EXPECT_TRUE(io::write_vtk_bodies(folder.path(), run).empty());
}

TEST(WriteVtk, PointsBelowTheSurfaceLieInTrackAxes) {
  const testing::TemporaryFolder folder;
  io::RunResult run = testing::sample_run();
  io::PatchResult& patch = run.cases[0].patches[1];
  patch.subsurface = {testing::sample_block(3, 2, 4)};
  const auto written = io::write_vtk(folder.path(), run, "flat");
  ASSERT_EQ(written.size(), 5u);
  const testing::XmlElement collection = testing::read_xml(testing::read_text(written.back()));
  EXPECT_EQ(collection.find("DataSet", "file", "flat_case0001_patch2_block1.vts").at(0)->attributes.at("part"), "2");

  const testing::XmlElement root =
      testing::read_xml(testing::read_text(folder.path() / "flat_case0001_patch2_block1.vts"));
  EXPECT_EQ(root.find("Piece").at(0)->attributes.at("Extent"), "0 2 0 1 0 3");
  const auto points = testing::vtk_values<double>(root, "points_m");
  const auto stress = testing::vtk_values<float>(root, "stress_Pa");
  const auto mises = testing::vtk_values<float>(root, "von_mises_Pa");
  ASSERT_EQ(points.size(), 3u * 24u);
  ASSERT_EQ(stress.size(), 9u * 24u);
  const std::size_t i = 17;
  const io::SubsurfaceValue& v = patch.subsurface[0].values[i];
  EXPECT_NEAR(points[3 * i + 1], patch.y_tr + std::cos(patch.angle) * v.point.y() - std::sin(patch.angle) * v.point.z(),
              kRounding);
  EXPECT_NEAR(points[3 * i + 2], patch.z_tr + std::sin(patch.angle) * v.point.y() + std::cos(patch.angle) * v.point.z(),
              kRounding);
  // Turned about x: the component along x and the sum of the normal stresses stay, yz follows by hand.
  const double scale = v.stress.norm(), c = std::cos(patch.angle), s = std::sin(patch.angle);
  const double yz = c * s * (v.stress(1, 1) - v.stress(2, 2)) + (c * c - s * s) * v.stress(1, 2);
  EXPECT_NEAR(stress[9 * i], v.stress(0, 0), kSinglePrecision * scale);
  EXPECT_NEAR(stress[9 * i] + stress[9 * i + 4] + stress[9 * i + 8], v.stress.trace(), 4 * kSinglePrecision * scale);
  EXPECT_NEAR(stress[9 * i + 5], yz, 2 * kSinglePrecision * scale);
  EXPECT_NEAR(mises[i], v.von_mises, kSinglePrecision * v.von_mises);
  patch.subsurface[0].values.pop_back();
  EXPECT_THROW(io::write_vtk(folder.path(), run, "flat"), Error);
}

TEST(WriteVtk, RefusesFieldsThatDoNotMatchTheirGrid) {
  io::PatchResult patch = testing::ball_patch(5, 4, 1e9);
  patch.fields.state.pop_back();
  EXPECT_THROW(io::patch_to_vts(patch, 1, 1), Error);
}

TEST(XmlReader, RejectsWhatIsNotWellFormed) {
  for (const char* broken : {"<a><b></a></b>", "<a>", "<a x=1/>", "<a>&</a>", "<a/><b/>", "<a x=\"1\" x=\"2\"/>"})
    EXPECT_THROW(testing::read_xml(broken), std::runtime_error) << broken;
}

}  // namespace
}  // namespace treadmark
