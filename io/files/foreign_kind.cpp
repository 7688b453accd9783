// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/files/foreign_kind.hpp"

#include <string>
#include <string_view>

#include <fmt/format.h>

#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/io/files/extension.hpp"

namespace treadmark::io {
namespace {

constexpr const char *kAsColumns = "save the section as columns y z in mm (.csv, .txt)",
                     *kAsTriangles = "export triangles: .ply, .stl, .obj or .off",
                     *kAsSolid = "export it as STEP (.step)",
                     *kDrawing = "save the section as columns y z in mm (.csv), or the solid as STEP (.step)",
                     *kElements =
                         "write the running surface as triangles (.ply, .stl, .obj), or the section as columns "
                         "y z in mm (.csv)";

struct ForeignKind {
  std::string_view extension, name;
  const char* advice;
};
constexpr ForeignKind kForeign[] = {
    {".dxf", "a drawing (DXF)", kDrawing},
    {".dwg", "a drawing (DWG)", kDrawing},
    {".svg", "a drawing (SVG)", kDrawing},
    {".json", "JSON", kElements},
    {".gltf", "a scene (glTF)", kAsTriangles},
    {".glb", "a scene (glTF)", kAsTriangles},
    {".3mf", "a model for printers (3MF)", kAsTriangles},
    {".amf", "a model for printers (AMF)", kAsTriangles},
    {".fbx", "a scene (FBX)", kAsTriangles},
    {".dae", "a scene (COLLADA)", kAsTriangles},
    {".3ds", "a scene (3DS)", kAsTriangles},
    {".wrl", "a scene (VRML)", kAsTriangles},
    {".x3d", "a scene (X3D)", kAsTriangles},
    {".usd", "a scene (USD)", kAsTriangles},
    {".usdz", "a scene (USD)", kAsTriangles},
    {".blend", "a scene of Blender", kAsTriangles},
    {".vtk", "a file of VTK", kAsTriangles},
    {".vtp", "a file of VTK", kAsTriangles},
    {".vtu", "a file of VTK", kAsTriangles},
    {".msh", "a mesh of elements (Gmsh or Fluent)", kElements},
    {".bdf", "a mesh of elements (Nastran)", kElements},
    {".nas", "a mesh of elements (Nastran)", kElements},
    {".cdb", "a mesh of elements (Ansys)", kElements},
    {".k", "a mesh of elements (LS-DYNA)", kElements},
    {".unv", "a mesh of elements (UNV)", kElements},
    {".med", "a mesh of elements (MED)", kElements},
    {".brep", "a shape of OpenCASCADE", kAsSolid},
    {".sat", "a solid (ACIS)", kAsSolid},
    {".x_t", "a solid (Parasolid)", kAsSolid},
    {".x_b", "a solid (Parasolid)", kAsSolid},
    {".jt", "a solid (JT)", kAsSolid},
    {".sldprt", "a part of SolidWorks", kAsSolid},
    {".ipt", "a part of Inventor", kAsSolid},
    {".prt", "a part of a CAD program", kAsSolid},
    {".catpart", "a part of CATIA", kAsSolid},
    {".fcstd", "a document of FreeCAD", kAsSolid},
    {".3dm", "a model of Rhino", kAsSolid},
    {".ifc", "a building model (IFC)", kAsSolid},
    {".xlsx", "a workbook", kAsColumns},
    {".xls", "a workbook", kAsColumns},
    {".ods", "a workbook", kAsColumns},
    {".mat", "a file of MATLAB", kAsColumns},
    {".m", "a script", kAsColumns},
    {".py", "a script", kAsColumns},
    {".npy", "an array of NumPy", kAsColumns},
    {".npz", "an array of NumPy", kAsColumns},
    {".h5", "an HDF5 file", kAsColumns},
    {".pdf", "a document (PDF)", kAsColumns},
    {".zip", "an archive", "unpack it"},
    {".gz", "an archive", "unpack it"},
    {".7z", "an archive", "unpack it"},
    {".png", "a picture", kAsColumns},
    {".jpg", "a picture", kAsColumns},
};

}  // namespace

void refuse_foreign_file(const std::filesystem::path& file, const SourcePosition& asked_by) {
  const std::string extension = extension_of(file);
  const auto* kind = ranges::find(kForeign, extension, &ForeignKind::extension);
  if (kind == std::end(kForeign)) return;
  throw Error(ErrorKind::configuration,
              fmt::format("'{}' is {}, which is not read as a wheel or rail", file.filename().string(), kind->name),
              asked_by.file.empty() ? SourcePosition{file.string()} : asked_by, kind->advice);
}

}  // namespace treadmark::io
