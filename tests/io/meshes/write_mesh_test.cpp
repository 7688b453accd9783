// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "mesh_files.hpp"
#include "treadmark/io/files/shape_extension.hpp"

namespace treadmark::io {
namespace {

using namespace testing;

TriangleMesh sample() {
  TriangleMesh mesh = parse(meshes::parse_obj, obj());
  for (Vec3& v : mesh.vertices) v += Vec3(1.0 / 3.0, -1.0 / 7.0, 100.0 + 1e-7 / 3.0);
  return mesh;
}

TEST(WriteMesh, ReadsBackWhatItWrote) {
  const TemporaryFolder folder;
  const TriangleMesh mesh = sample();
  for (const char* name : {"a.ply", "a.OBJ", "a.off"}) {
    write_mesh(folder.path() / name, mesh);
    const TriangleMesh back = read_mesh(folder.path() / name);
    ASSERT_EQ(back.vertices.size(), mesh.vertices.size());
    // metres to millimetres and back: one rounding each
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i)
      EXPECT_LE((back.vertices[i] - mesh.vertices[i]).norm(), 4e-14) << name;
    EXPECT_EQ(back.triangles, mesh.triangles);
    EXPECT_EQ(back.name, (folder.path() / name).string());
  }
  write_mesh(folder.path() / "a.stl", mesh);
  const TriangleMesh soup = read_mesh(folder.path() / "a.stl");
  ASSERT_EQ(soup.triangles.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (std::size_t k = 0; k < 3; ++k)  // floats: 4e-3 mm at 1e5 mm
      EXPECT_LE((soup.vertices[soup.triangles[t][k]] - mesh.vertices[mesh.triangles[t][k]]).norm(), 1e-5);
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_NE(entry.path().extension(), ".part");
}

TEST(WriteMesh, SaysWhatItCannotDo) {
  const TemporaryFolder folder;
  const auto refused = [&](const std::filesystem::path& file, const std::string& part) {
    try {
      write_mesh(file, sample());
      ADD_FAILURE() << "written: " << file;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::configuration);
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
    EXPECT_FALSE(std::filesystem::is_regular_file(file));
  };
  refused(folder.path() / "a.vtk", "unknown extension");
  std::ofstream(folder.path() / "file") << "no folder";
  refused(folder.path() / "file" / "a.ply", "cannot write");
  std::filesystem::create_directory(folder.path() / "folder.ply");
  std::filesystem::create_directory(folder.path() / "folder.ply" / "full");
  refused(folder.path() / "folder.ply", "it is a folder");
  TriangleMesh broken = sample();
  broken.triangles[0][0] = 77;
  EXPECT_THROW(write_mesh(folder.path() / "b.ply", broken), Error);
}

TEST(ReadMeshFile, KnowsItsFiles) {
  for (const char* name : {"a.ply", "b.STL", "c.Obj", "path/d.off"}) EXPECT_TRUE(is_mesh_file(name));
  for (const char* name : {"a.prr", "ply", "a.ply.gz", ""}) EXPECT_FALSE(is_mesh_file(name));
  for (const ShapeExtension& row : kShapeExtensions)
    EXPECT_EQ(is_mesh_file("a" + std::string(row.extension)), (row.kinds & kTriangleFile) != 0) << row.extension;
}

TEST(ReadMeshFile, ScalesAndPlacesItsErrors) {
  const TemporaryFolder folder;
  const auto metres = folder.write("m.obj", obj());
  const TriangleMesh mesh = read_mesh(metres, 1000.0);
  EXPECT_EQ(mesh.vertices[2], Vec3(10.0, 20.0, 0.0));
  const SourcePosition asked{"case.toml", 3, 7};
  const auto place = [&](const std::filesystem::path& file, double scale) {
    try {
      read_mesh(file, scale, asked);
    } catch (const Error& error) {
      return error.where().to_string();
    }
    return std::string("no error");
  };
  EXPECT_EQ(place(folder.path() / "missing.ply", 1.0), "case.toml:3:7");
  EXPECT_EQ(place(folder.path() / "m.prr", 1.0), "case.toml:3:7");
  for (const double scale : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(place(metres, scale), "case.toml:3:7");
  EXPECT_EQ(place(folder.write("bad.obj", "v 1 2 x\n"), 1.0), (folder.path() / "bad.obj").string() + ":1:7");
}

}  // namespace
}  // namespace treadmark::io
