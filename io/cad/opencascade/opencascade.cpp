// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <GeomAPI_Interpolate.hxx>
#include <GeomAPI_PointsToBSplineSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IntCurvesFace_Intersector.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TColgp_HArray1OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopAbs_State.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <gp_Ax1.hxx>
#include <gp_Lin.hxx>

#include <sys/resource.h>

#include <algorithm>
#include <memory>
#include <string>
#include <string_view>

#include "treadmark/io/cad/cad_messages.hpp"

namespace treadmark::io::cad {
namespace {

constexpr double kMillimetres = 1e3;  // in a metre: what OpenCASCADE counts in
constexpr double kTolerance = 1e-7;   // [mm]
constexpr int kMostFaces = 100'000;

void be_quiet() {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
}

gp_Pnt to_mm(const Point& p) { return {kMillimetres * p[0], kMillimetres * p[1], kMillimetres * p[2]}; }
Point to_m(const gp_Pnt& p) { return {p.X() / kMillimetres, p.Y() / kMillimetres, p.Z() / kMillimetres}; }

class Shape {
 public:
  Shape(TopoDS_Shape whole, std::string unit) : whole_(std::move(whole)), unit_(std::move(unit)) {
    TopExp::MapShapes(whole_, TopAbs_FACE, faces_);
    Bnd_Box all;
    boxes_.reserve(static_cast<std::size_t>(faces_.Extent()));
    for (int i = 1; i <= faces_.Extent(); ++i) {
      Bnd_Box box;
      BRepBndLib::Add(faces_(i), box);
      all.Add(box);
      boxes_.push_back(box);
      meets_.push_back(nullptr);
    }
    if (all.IsVoid()) return;
    gp_Pnt low = all.CornerMin(), high = all.CornerMax();
    low_ = to_m(low), high_ = to_m(high);
  }
  void name_entities(std::vector<std::string> entities) { entities_ = std::move(entities); }
  const TopTools_IndexedMapOfShape& all() const { return faces_; }

  std::string unit() const { return unit_; }
  int faces() const { return faces_.Extent(); }
  Point low() const { return low_; }
  Point high() const { return high_; }
  std::vector<CadHit> hits(const Point& origin, const Point& direction) const {
    const gp_Lin line(to_mm(origin), gp_Dir(direction[0], direction[1], direction[2]));
    std::vector<CadHit> out;
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i].IsOut(line)) continue;
      if (!meets_[i])
        meets_[i] =
            std::make_unique<IntCurvesFace_Intersector>(TopoDS::Face(faces_(static_cast<int>(i) + 1)), kTolerance);
      meets_[i]->Perform(line, -1e9, 1e9);
      if (!meets_[i]->IsDone()) continue;
      for (int k = 1; k <= meets_[i]->NbPnt(); ++k)
        out.push_back({meets_[i]->WParameter(k) / kMillimetres, static_cast<int>(i)});
    }
    std::sort(out.begin(), out.end(), [](const CadHit& a, const CadHit& b) { return a.t < b.t; });
    return out;
  }
  std::vector<Point> points_on(int face) const {
    constexpr int kEach = 5;
    const TopoDS_Face& f = TopoDS::Face(faces_(face + 1));
    const BRepAdaptor_Surface surface(f);
    const BRepTopAdaptor_FClass2d inside(f, 1e-9);
    double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
    BRepTools::UVBounds(f, u0, u1, v0, v1);
    std::vector<Point> out;
    for (int i = 0; i < kEach; ++i)
      for (int j = 0; j < kEach; ++j) {
        const double u = u0 + (u1 - u0) * (i + 0.5) / kEach, v = v0 + (v1 - v0) * (j + 0.5) / kEach;
        if (inside.Perform(gp_Pnt2d(u, v)) == TopAbs_IN) out.push_back(to_m(surface.Value(u, v)));
      }
    return out;
  }
  std::vector<Point> edges_of(int face) const {
    constexpr int kEach = 5;
    std::vector<Point> out;
    for (TopExp_Explorer edges(faces_(face + 1), TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
      // where a surface meets itself, as after a whole turn, nothing ends
      if (BRep_Tool::Degenerated(edge) || BRep_Tool::IsClosed(edge, TopoDS::Face(faces_(face + 1)))) continue;
      const BRepAdaptor_Curve curve(edge);
      for (int i = 0; i < kEach; ++i)
        out.push_back(to_m(curve.Value(curve.FirstParameter() +
                                       (curve.LastParameter() - curve.FirstParameter()) * (i + 0.5) / kEach)));
    }
    return out;
  }
  bool unchanging(int face, bool turned) const {
    const BRepAdaptor_Surface s(TopoDS::Face(faces_(face + 1)), Standard_False);
    const gp_Dir axis = turned ? gp_Dir(0.0, 1.0, 0.0) : gp_Dir(1.0, 0.0, 0.0);
    const gp_Ax1 line(gp_Pnt(0.0, 0.0, 0.0), axis);
    constexpr double kAngle = 1e-9, kLength = 1e-6;  // [rad], [mm]
    const auto about = [&](const gp_Ax1& other) { return other.IsCoaxial(line, kAngle, kLength); };
    const auto along = [&](const gp_Dir& d) { return d.IsParallel(axis, kAngle); };
    switch (s.GetType()) {
      case GeomAbs_Plane:
        return turned ? along(s.Plane().Axis().Direction()) : s.Plane().Axis().Direction().IsNormal(axis, kAngle);
      case GeomAbs_Cylinder:
        return turned ? about(s.Cylinder().Axis()) : along(s.Cylinder().Axis().Direction());
      case GeomAbs_Cone:
        return turned && about(s.Cone().Axis());
      case GeomAbs_Sphere:
        return turned && line.Direction().IsParallel(axis, kAngle) &&
               gp_Lin(line).Distance(s.Sphere().Location()) < kLength;
      case GeomAbs_Torus:
        return turned && about(s.Torus().Axis());
      case GeomAbs_SurfaceOfRevolution:
        return turned && about(s.AxeOfRevolution());
      case GeomAbs_SurfaceOfExtrusion:
        return !turned && along(s.Direction());
      default:
        return false;
    }
  }
  std::string entity(int face) const {
    const auto i = static_cast<std::size_t>(face);
    return i < entities_.size() ? entities_[i] : std::string();
  }

 private:
  TopoDS_Shape whole_;
  std::string unit_;
  TopTools_IndexedMapOfShape faces_;
  std::vector<Bnd_Box> boxes_;
  mutable std::vector<std::unique_ptr<IntCurvesFace_Intersector>> meets_;
  std::vector<std::string> entities_;
  Point low_{}, high_{};
};

std::vector<std::string> entities_of(const Handle(XSControl_WorkSession) & work,
                                     const TopTools_IndexedMapOfShape& faces) {
  std::vector<std::string> out;
  const Handle(XSControl_TransferReader)& reader = work->TransferReader();
  const Handle(Interface_InterfaceModel)& model = work->Model();
  for (int i = 1; i <= faces.Extent(); ++i) {
    std::string name;
    for (const int mode : {1, 3, 0}) {
      const Handle(Standard_Transient) entity = reader->EntityFromShapeResult(faces(i), mode);
      if (entity.IsNull()) continue;
      name = std::string(model->StringLabel(entity)->ToCString()) + " (" + entity->DynamicType()->Name() + ")";
      break;
    }
    out.push_back(name);
  }
  return out;
}

std::unique_ptr<Shape> finished(XSControl_Reader& reader, std::string unit, CadFault& fault) {
  reader.TransferRoots();
  const TopoDS_Shape whole = reader.OneShape();
  TopTools_IndexedMapOfShape faces;
  if (!whole.IsNull()) TopExp::MapShapes(whole, TopAbs_FACE, faces);
  if (faces.Extent() == 0) {
    fault = {"holds no face", "export surfaces or solids, not curves or meshes alone"};
    return nullptr;
  }
  if (faces.Extent() > kMostFaces) {
    fault = {"holds " + std::to_string(faces.Extent()) + " faces, more than " + std::to_string(kMostFaces),
             "export the running surface alone, or triangles (.stl)"};
    return nullptr;
  }
  auto shape = std::make_unique<Shape>(whole, std::move(unit));
  shape->name_entities(entities_of(reader.WS(), shape->all()));
  return shape;
}

std::unique_ptr<Shape> read_step(const std::string& file, CadFault& fault) {
  STEPControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
    fault = {"is no STEP file that can be read", "is it damaged, or another format?"};
    return nullptr;
  }
  TColStd_SequenceOfAsciiString lengths, angles, solid;
  reader.FileUnits(lengths, angles, solid);
  bool named = !lengths.IsEmpty();
  for (int i = 1; i <= lengths.Length(); ++i) named = named && !lengths(i).IsEmpty();
  if (!named) {
    fault = {"does not say its unit of length", "export it with units; without them 1 may be a millimetre or an inch"};
    return nullptr;
  }
  for (int i = 2; i <= lengths.Length(); ++i)
    if (!lengths(i).IsEqual(lengths(1))) {
      fault = {std::string("has several units of length, ") + lengths(1).ToCString() + " and " + lengths(i).ToCString(),
               "export it in one of them"};
      return nullptr;
    }
  return finished(reader, lengths(1).ToCString(), fault);
}

std::unique_ptr<Shape> read_iges(const std::string& file, CadFault& fault) {
  IGESControl_Reader reader;
  if (reader.ReadFile(file.c_str()) != IFSelect_RetDone) {
    fault = {"is no IGES file that can be read", "is it damaged, or another format?"};
    return nullptr;
  }
  const Handle(IGESData_IGESModel) model = Handle(IGESData_IGESModel)::DownCast(reader.Model());
  const int flag = model.IsNull() ? 0 : model->GlobalSection().UnitFlag();
  constexpr int kNamed = 3, kLast = 11;
  if (flag < 1 || flag > kLast || (flag == kNamed && model->GlobalSection().UnitName().IsNull())) {
    fault = {"does not say its unit of length", "export it with units; without them 1 may be a millimetre or an inch"};
    return nullptr;
  }
  const Handle(TCollection_HAsciiString) name = model->GlobalSection().UnitName();
  return finished(reader, name.IsNull() ? std::to_string(flag) : std::string(name->ToCString()), fault);
}

std::unique_ptr<Shape> read(const std::string& file, bool iges, CadFault& fault) {
  try {
    be_quiet();
    return iges ? read_iges(file, fault) : read_step(file, fault);
  } catch (const Standard_Failure& failure) {
    fault = {std::string("is more than OpenCASCADE takes: ") + failure.GetMessageString(),
             "is it damaged? export it again"};
  } catch (const std::exception& failure) {
    fault = {std::string("cannot be read: ") + failure.what(), "is it damaged? export it again"};
  }
  return nullptr;
}

Handle(Geom_BSplineCurve) curve_through(const std::vector<Point>& points) {
  Handle(TColgp_HArray1OfPnt) array = new TColgp_HArray1OfPnt(1, static_cast<int>(points.size()));
  for (std::size_t i = 0; i < points.size(); ++i) array->SetValue(static_cast<int>(i) + 1, to_mm(points[i]));
  GeomAPI_Interpolate interpolate(array, Standard_False, kTolerance);
  interpolate.Perform();
  if (!interpolate.IsDone()) throw Standard_Failure("a curve cannot be laid through the points");
  return interpolate.Curve();
}

TopoDS_Shape shape_of(const CadSheet& sheet) {
  if (sheet.kind == CadSheet::Kind::grid) {
    const int rows = static_cast<int>(sheet.rows), columns = static_cast<int>(sheet.points.size()) / rows;
    TColgp_Array2OfPnt array(1, rows, 1, columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j)
        array.SetValue(i + 1, j + 1, to_mm(sheet.points[static_cast<std::size_t>(i * columns + j)]));
    GeomAPI_PointsToBSplineSurface interpolate;
    interpolate.Interpolate(array);
    if (!interpolate.IsDone()) throw Standard_Failure("a surface cannot be laid through the points");
    return BRepBuilderAPI_MakeFace(interpolate.Surface(), kTolerance).Face();
  }
  const Handle(Geom_BSplineCurve) curve = curve_through(sheet.points);
  const double first = curve->FirstParameter(), last = curve->LastParameter();
  if (sheet.kind == CadSheet::Kind::extruded) {
    Handle(Geom_SurfaceOfLinearExtrusion) surface = new Geom_SurfaceOfLinearExtrusion(curve, gp_Dir(1.0, 0.0, 0.0));
    return BRepBuilderAPI_MakeFace(surface, first, last, kMillimetres * sheet.from, kMillimetres * sheet.to, kTolerance)
        .Face();
  }
  // from +z towards +x is the positive sense about y
  Handle(Geom_SurfaceOfRevolution) surface =
      new Geom_SurfaceOfRevolution(curve, gp_Ax1(gp_Pnt(0.0, 0.0, 0.0), gp_Dir(0.0, 1.0, 0.0)));
  return BRepBuilderAPI_MakeFace(surface, sheet.from, sheet.to, first, last, kTolerance).Face();
}

CadFault write(const std::string& file, const CadSheet& sheet) {
  try {
    be_quiet();
    STEPControl_Writer writer;
    Interface_Static::SetCVal("write.step.unit", "MM");
    Interface_Static::SetCVal("write.step.product.name", sheet.name.c_str());
    if (writer.Transfer(shape_of(sheet), STEPControl_AsIs) != IFSelect_RetDone)
      return {"cannot be made of the surface", "write triangles or slices"};
    APIHeaderSection_MakeHeader header(writer.Model());
    header.SetName(new TCollection_HAsciiString(sheet.name.c_str()));
    header.SetTimeStamp(new TCollection_HAsciiString("1970-01-01T00:00:00"));  // the same surface gives the same bytes
    header.SetAuthorValue(1, new TCollection_HAsciiString(""));
    header.SetOriginatingSystem(new TCollection_HAsciiString("Treadmark"));
    if (writer.Write(file.c_str()) != IFSelect_RetDone) return {"cannot be written", "is there room in its folder?"};
  } catch (const Standard_Failure& failure) {
    return {std::string("cannot be made of the surface: ") + failure.GetMessageString(), "write triangles or slices"};
  }
  return {};
}

/// Answers until the other end hangs up.
void answer(Channel& channel, const Shape& shape) {
  channel.put_list(shape.unit());
  channel.put<std::int64_t>(shape.faces());
  channel.put(shape.low());
  channel.put(shape.high());
  for (;;) {
    switch (channel.take<Question>()) {
      case Question::hits: {
        const auto origin = channel.take<Point>(), direction = channel.take<Point>();
        channel.put_list(shape.hits(origin, direction));
        break;
      }
      case Question::points_on:
        channel.put_list(shape.points_on(static_cast<int>(channel.take<std::int64_t>())));
        break;
      case Question::edges_of:
        channel.put_list(shape.edges_of(static_cast<int>(channel.take<std::int64_t>())));
        break;
      case Question::unchanging: {
        const auto face = channel.take<std::int64_t>(), turned = channel.take<std::int64_t>();
        channel.put<std::int64_t>(shape.unchanging(static_cast<int>(face), turned != 0) ? 1 : 0);
        break;
      }
      case Question::entity:
        channel.put_list(shape.entity(static_cast<int>(channel.take<std::int64_t>())));
        break;
    }
  }
}

void put(Channel& channel, const CadFault& fault) {
  channel.put_list(fault.message);
  channel.put_list(fault.advice);
}

/// A file may ask for anything.
void bound_what_it_takes() {
  constexpr rlim_t kMemory = 16ULL << 30, kSeconds = 3600;
  const rlimit none{0, 0}, memory{kMemory, kMemory}, time{kSeconds, kSeconds};
  ::setrlimit(RLIMIT_CORE, &none);
  ::setrlimit(RLIMIT_AS, &memory);
  ::setrlimit(RLIMIT_CPU, &time);
}

void serve(Channel& channel) {
  enum class Task : std::int64_t { step, iges, write };
  const auto task = channel.take<Task>();
  const auto file = channel.take_list<std::string>();
  if (task == Task::write) {
    CadSheet sheet;
    sheet.kind = channel.take<CadSheet::Kind>();
    sheet.rows = channel.take<std::int64_t>();
    sheet.from = channel.take<double>();
    sheet.to = channel.take<double>();
    sheet.name = channel.take_list<std::string>();
    sheet.points = channel.take_list<std::vector<Point>>();
    return put(channel, write(file, sheet));
  }
  CadFault fault;
  const std::unique_ptr<Shape> shape = read(file, task == Task::iges, fault);
  put(channel, fault);
  if (shape != nullptr) answer(channel, *shape);
}

}  // namespace
}  // namespace treadmark::io::cad

int main(int count, char** arguments) {
  constexpr int kSocket = 3;
  if (count != 2 || std::string_view(arguments[1]) != TREADMARK_MODULE_VERSION) return 2;
  treadmark::io::cad::bound_what_it_takes();
  try {
    treadmark::io::cad::Channel channel(kSocket);
    treadmark::io::cad::serve(channel);
  } catch (...) {  // the other end sees that this one is gone
    return 1;
  }
  return 0;
}
