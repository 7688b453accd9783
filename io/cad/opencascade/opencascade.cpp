// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include <APIHeaderSection_MakeHeader.hxx>
#include <BRepAdaptor_Curve.hxx>
#include <BRepAdaptor_Surface.hxx>
#include <BRepBndLib.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepMesh_IncrementalMesh.hxx>
#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Builder.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Geom2d_Curve.hxx>
#include <GeomConvert.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_Curve.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_SurfaceOfLinearExtrusion.hxx>
#include <Geom_SurfaceOfRevolution.hxx>
#include <IGESControl_Reader.hxx>
#include <IGESData_GlobalSection.hxx>
#include <IGESData_IGESModel.hxx>
#include <IntCurvesFace_Intersector.hxx>
#include <Interface_Check.hxx>
#include <Interface_InterfaceModel.hxx>
#include <Interface_Static.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_PrinterOStream.hxx>
#include <Poly_PolygonOnTriangulation.hxx>
#include <Poly_Triangulation.hxx>
#include <STEPControl_Reader.hxx>
#include <STEPControl_Writer.hxx>
#include <Standard_Failure.hxx>
#include <StepBasic_Product.hxx>
#include <StepGeom_CartesianPoint.hxx>
#include <StepGeom_GeometricRepresentationItem.hxx>
#include <StepShape_Face.hxx>
#include <TColStd_Array1OfInteger.hxx>
#include <TColStd_Array1OfReal.hxx>
#include <TColStd_Array2OfReal.hxx>
#include <TColStd_SequenceOfAsciiString.hxx>
#include <TColgp_Array1OfPnt.hxx>
#include <TColgp_Array2OfPnt.hxx>
#include <TCollection_HAsciiString.hxx>
#include <TopAbs_State.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS.hxx>
#include <TopoDS_Compound.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Wire.hxx>
#include <XSControl_TransferReader.hxx>
#include <XSControl_WorkSession.hxx>
#include <gp_Ax1.hxx>
#include <gp_Lin.hxx>

#include <algorithm>
#include <array>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <sstream>
#include <string>
#include <unordered_map>
#include <utility>

#include "treadmark/core/helper_program.hpp"
#include "treadmark/core/platform/ranges.hpp"
#include "treadmark/core/to_whole.hpp"
#include "treadmark/io/cad/cad_messages.hpp"

namespace treadmark::io::cad {
namespace {

constexpr double kMillimetres = 1e3;  // in a metre: what OpenCASCADE counts in
constexpr double kTolerance = 1e-7;   // [mm]

void be_quiet() {
  Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
  Interface_Static::SetCVal("xstep.cascade.unit", "MM");
}

gp_Pnt to_mm(const Point& p) { return {kMillimetres * p[0], kMillimetres * p[1], kMillimetres * p[2]}; }
Point to_m(const gp_Pnt& p) { return {p.X() / kMillimetres, p.Y() / kMillimetres, p.Z() / kMillimetres}; }

class Shape {
 public:
  Shape(TopoDS_Shape whole, std::string unit, const Handle(XSControl_WorkSession) & read)
      : whole_(std::move(whole)), unit_(std::move(unit)), read_(read) {
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
    // lines are square to y
    strips_.resize(kStrips);
    for (std::size_t i = 0; i < boxes_.size(); ++i) {
      if (boxes_[i].IsVoid()) continue;
      const std::size_t last = strip(boxes_[i].CornerMax().Y() + kTolerance);
      for (std::size_t k = strip(boxes_[i].CornerMin().Y() - kTolerance); k <= last; ++k) strips_[k].push_back(i);
    }
  }

  std::string unit() const { return unit_; }
  int faces() const { return faces_.Extent(); }
  Point low() const { return low_; }
  Point high() const { return high_; }
  CadHit last_hit(double least, const CadLine& given) const {
    const gp_Lin line(to_mm(given.origin), gp_Dir(given.direction[0], given.direction[1], given.direction[2]));
    if (strips_.empty()) return {};
    least *= kMillimetres;
    // the line leaves a box after it leaves the face within
    struct Left {
      double t;
      std::size_t face;
    };
    std::vector<Left> faces;
    for (const std::size_t i : strips_[strip(kMillimetres * given.origin[1])])
      if (const double t = leaves(boxes_[i], line); t >= least) faces.push_back({t, i});
    std::sort(faces.begin(), faces.end(), [](const Left& a, const Left& b) { return a.t > b.t; });
    CadHit out;
    double last = least;
    constexpr double kBeyond = 1.0;  // [mm]
    for (const auto& [t, i] : faces) {
      if (t < last) break;
      if (!meets_[i])
        meets_[i] =
            std::make_unique<IntCurvesFace_Intersector>(TopoDS::Face(faces_(static_cast<int>(i) + 1)), kTolerance);
      IntCurvesFace_Intersector& meets = *meets_[i];
      meets.Perform(line, last, t + kBeyond);
      if (!meets.IsDone()) continue;
      for (int k = 1; k <= meets.NbPnt(); ++k)
        if (out.face < 0 || meets.WParameter(k) > last) {
          last = meets.WParameter(k);
          out = {last / kMillimetres, static_cast<int>(i), meets.UParameter(k), meets.VParameter(k)};
        }
    }
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
  std::vector<CadEdgePoint> edges_of(int face) const {
    constexpr int kEach = 5;
    std::vector<CadEdgePoint> out;
    const TopoDS_Face& f = TopoDS::Face(faces_(face + 1));
    const TopoDS_Wire outer = BRepTools::OuterWire(f);
    for (TopExp_Explorer wires(f, TopAbs_WIRE); wires.More(); wires.Next())
      for (TopExp_Explorer edges(wires.Current(), TopAbs_EDGE); edges.More(); edges.Next()) {
        const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
        // where a surface meets itself, as after a whole turn, nothing ends
        if (BRep_Tool::Degenerated(edge) || BRep_Tool::IsClosed(edge, f)) continue;
        const BRepAdaptor_Curve curve(edge);
        const double from = curve.FirstParameter(), to = curve.LastParameter();
        for (int i = 0; i < kEach; ++i)
          out.push_back(
              {to_m(curve.Value(from + (to - from) * (i + 0.5) / kEach)), wires.Current().IsSame(outer) ? 0 : 1});
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
  /// All of the face where nothing but its ends bounds it, or else the part that counts. Empty, and why: no B-spline.
  CadSpline spline_of(int face, CadPart part, std::string& why) const;
  CadTriangles triangles_of(const std::vector<std::int64_t>& faces, double deviation, double side) const;

  std::string entity(int face) const;

 private:
  TopoDS_Shape whole_;
  std::string unit_;
  TopTools_IndexedMapOfShape faces_;
  std::vector<Bnd_Box> boxes_;
  mutable std::vector<std::unique_ptr<IntCurvesFace_Intersector>> meets_;
  Handle(XSControl_WorkSession) read_;
  Point low_{}, high_{};

  /// Where a line leaves a box; -infinity: it passes by.
  static double leaves(const Bnd_Box& box, const gp_Lin& line) {
    constexpr double kFar = std::numeric_limits<double>::infinity();
    double from = -kFar, to = kFar;
    const gp_Pnt low = box.CornerMin(), high = box.CornerMax();
    for (int k = 1; k <= 3; ++k) {
      const double x = line.Location().Coord(k), d = line.Direction().Coord(k);
      const double a = low.Coord(k) - kTolerance - x, b = high.Coord(k) + kTolerance - x;
      if (d == 0.0) {
        if (a > 0.0 || b < 0.0) return -kFar;
        continue;
      }
      from = std::max(from, std::min(a / d, b / d));
      to = std::min(to, std::max(a / d, b / d));
    }
    return from <= to ? to : -kFar;
  }

  static constexpr std::size_t kStrips = 256;
  std::size_t strip(double y) const {
    const double low = kMillimetres * low_[1], high = kMillimetres * high_[1];
    const double share = high > low ? (y - low) / (high - low) : 0.0;
    return to_whole<std::size_t>(share * (kStrips - 1), 0.0, kStrips - 1.0);
  }
  std::vector<std::vector<std::size_t>> strips_;  ///< boxes that reach into each
};

constexpr int kOnEdge = 64;      // points of an edge
constexpr double kOnEnd = 1e-7;  // of the length of a range of parameters

/// Whether no edge of a face leads through the inside of a part of its parameters, whose middle lies on the face.
bool is_clear(const TopoDS_Face& face, const CadPart& part) {
  const double du = kOnEnd * (part.u1 - part.u0), dv = kOnEnd * (part.v1 - part.v0);
  if (!(du > 0.0 && dv > 0.0)) return false;
  for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
    double from = 0.0, to = 0.0;
    const Handle(Geom2d_Curve) curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edges.Current()), face, from, to);
    if (curve.IsNull()) return false;
    for (int i = 0; i <= kOnEdge; ++i) {
      const gp_Pnt2d p = curve->Value(from + (to - from) * i / kOnEdge);
      if (p.X() > part.u0 + du && p.X() < part.u1 - du && p.Y() > part.v0 + dv && p.Y() < part.v1 - dv) return false;
    }
  }
  const BRepTopAdaptor_FClass2d inside(face, 1e-9);
  return inside.Perform(gp_Pnt2d(0.5 * (part.u0 + part.u1), 0.5 * (part.v0 + part.v1))) == TopAbs_IN;
}

/// Offset surfaces, and what is made of offset curves, become splines only about.
bool is_exact_spline(const TopoDS_Face& face) {
  const BRepAdaptor_Surface s(face, Standard_False);
  const auto known = [](GeomAbs_CurveType type) { return type != GeomAbs_OffsetCurve && type != GeomAbs_OtherCurve; };
  switch (s.GetType()) {
    case GeomAbs_OffsetSurface:
    case GeomAbs_OtherSurface:
      return false;
    case GeomAbs_SurfaceOfRevolution:
    case GeomAbs_SurfaceOfExtrusion:
      return known(s.BasisCurve()->GetType());
    default:
      return true;
  }
}

CadSpline Shape::spline_of(int face, CadPart part, std::string& why) const {
  const TopoDS_Face& f = TopoDS::Face(faces_(face + 1));
  CadPart whole;
  BRepTools::UVBounds(f, whole.u0, whole.u1, whole.v0, whole.v1);
  if (is_clear(f, whole))
    part = whole;
  else if (!is_clear(f, part))
    return why = "is trimmed where it can be touched", CadSpline{};
  if (!is_exact_spline(f)) return why = "is no surface that a B-spline can be exactly", CadSpline{};
  const Handle(Geom_Surface) surface = BRep_Tool::Surface(f);
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  surface->Bounds(u0, u1, v0, v1);
  if (!surface->IsUPeriodic()) part.u0 = std::max(part.u0, u0), part.u1 = std::min(part.u1, u1);
  if (!surface->IsVPeriodic()) part.v0 = std::max(part.v0, v0), part.v1 = std::min(part.v1, v1);
  const auto near = [](double a, double b, double range) { return std::fabs(a - b) <= kOnEnd * range; };
  Handle(Geom_BSplineSurface) spline = Handle(Geom_BSplineSurface)::DownCast(surface);
  if (!spline.IsNull() && near(part.u0, u0, u1 - u0) && near(part.u1, u1, u1 - u0) && near(part.v0, v0, v1 - v0) &&
      near(part.v1, v1, v1 - v0))
    spline = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
  else
    spline = GeomConvert::SurfaceToBSplineSurface(
        new Geom_RectangularTrimmedSurface(surface, part.u0, part.u1, part.v0, part.v1));
  if (spline->IsUPeriodic()) spline->SetUNotPeriodic();
  if (spline->IsVPeriodic()) spline->SetVNotPeriodic();
  CadSpline out;
  out.degree_u = spline->UDegree(), out.degree_v = spline->VDegree();
  const auto knots = [](const TColStd_Array1OfReal& sequence) {
    std::vector<double> list;
    list.reserve(static_cast<std::size_t>(sequence.Length()));
    for (int i = sequence.Lower(); i <= sequence.Upper(); ++i) list.push_back(sequence(i));
    return list;
  };
  out.knots_u = knots(spline->UKnotSequence()), out.knots_v = knots(spline->VKnotSequence());
  const bool rational = spline->IsURational() || spline->IsVRational();
  const auto size = static_cast<std::size_t>(spline->NbUPoles()) * static_cast<std::size_t>(spline->NbVPoles());
  out.poles.reserve(size);
  out.weights.reserve(rational ? size : 0);
  for (int j = 1; j <= spline->NbVPoles(); ++j)
    for (int i = 1; i <= spline->NbUPoles(); ++i) {
      out.poles.push_back(to_m(spline->Pole(i, j)));
      if (rational) out.weights.push_back(spline->Weight(i, j));
    }
  return out;
}

/// One face as triangles whose corners lie on it, divided until no side is longer than asked for. Neighbours divide the
/// edge that they share at the same points of it.
class FaceTriangles {
 public:
  FaceTriangles(const TopoDS_Face& face, const Handle(Poly_Triangulation) & given)
      : surface_(face), turned_(face.Orientation() == TopAbs_REVERSED) {
    const auto count = static_cast<std::size_t>(given->NbNodes());
    points_.reserve(count), uv_.reserve(count);
    for (int i = 1; i <= given->NbNodes(); ++i) {
      uv_.push_back(given->UVNode(i));
      points_.push_back(surface_.Value(uv_.back().X(), uv_.back().Y()));
    }
    triangles_.reserve(static_cast<std::size_t>(given->NbTriangles()));
    for (int i = 1; i <= given->NbTriangles(); ++i) {
      int a = 0, b = 0, c = 0;
      given->Triangle(i).Get(a, b, c);
      triangles_.push_back({a - 1, b - 1, c - 1});
    }
    TopLoc_Location place;
    BRep_Tool::Triangulation(face, place);
    for (TopExp_Explorer edges(face, TopAbs_EDGE); edges.More(); edges.Next()) {
      const TopoDS_Edge& edge = TopoDS::Edge(edges.Current());
      const Handle(Poly_PolygonOnTriangulation) polygon = BRep_Tool::PolygonOnTriangulation(edge, given, place);
      if (polygon.IsNull() || polygon->Parameters().IsNull() || BRep_Tool::Degenerated(edge)) continue;
      double from = 0.0, to = 0.0;
      const Handle(Geom2d_Curve) on_face = BRep_Tool::CurveOnSurface(edge, face, from, to);
      if (on_face.IsNull()) continue;
      borders_.push_back({BRepAdaptor_Curve(edge), on_face});
      const int index = static_cast<int>(borders_.size()) - 1;
      const TColStd_Array1OfInteger& nodes = polygon->Nodes();
      for (int i = nodes.Lower(); i <= nodes.Upper(); ++i) {
        const double t = polygon->Parameters()->Value(i - nodes.Lower() + polygon->Parameters()->Lower());
        const auto node = static_cast<std::size_t>(nodes(i) - 1);
        points_[node] = borders_.back().curve.Value(t);
        if (i == nodes.Lower()) continue;
        const double before = polygon->Parameters()->Value(i - 1 - nodes.Lower() + polygon->Parameters()->Lower());
        note_border(nodes(i - 1) - 1, nodes(i) - 1, {index, before, t});
      }
    }
  }

  /// Halves the longest sides, which makes thin triangles stouter (Rivara 1984), until none is too long. Every side
  /// that is, and no other, is halved at last, so that neighbours agree. False: more triangles than asked for.
  bool divide(double longest, std::size_t most) {
    const auto length = [&](int a, int b) {
      return points_[static_cast<std::size_t>(a)].SquareDistance(points_[static_cast<std::size_t>(b)]);
    };
    double area = 0.0;
    for (const auto& t : triangles_) {
      const auto side = [&](std::size_t to) {
        return points_[static_cast<std::size_t>(t[to])].XYZ() - points_[static_cast<std::size_t>(t[0])].XYZ();
      };
      area += 0.5 * side(1).Crossed(side(2)).Modulus();
    }
    // of equal sides at best
    if (area > 0.25 * std::sqrt(3.0) * longest * longest * static_cast<double>(most)) return false;
    for (;;) {
      std::unordered_map<std::uint64_t, int> middles;
      for (const auto& t : triangles_) {
        const std::array<double, 3> sides{length(t[0], t[1]), length(t[1], t[2]), length(t[2], t[0])};
        const auto k = static_cast<std::size_t>(ranges::max_element(sides) - sides.begin());
        if (sides[k] <= longest * longest) continue;
        const int a = t[k], b = t[(k + 1) % 3];
        if (const auto [at, fresh] = middles.try_emplace(side_of(a, b), -1); fresh) at->second = halve(a, b);
      }
      if (middles.empty()) return true;
      std::vector<std::array<int, 3>> next;
      next.reserve(triangles_.size() + 2 * middles.size());
      const auto middle = [&](int a, int b) {
        const auto at = middles.find(side_of(a, b));
        return at == middles.end() ? -1 : at->second;
      };
      for (const auto& t : triangles_) part(t, {middle(t[0], t[1]), middle(t[1], t[2]), middle(t[2], t[0])}, next);
      triangles_ = std::move(next);
      if (triangles_.size() > most) return false;
    }
  }

  /// Adds them; deviation: see CadTriangles.
  void append(int face, std::vector<gp_Pnt>& points, CadTriangles& out) const {
    const auto first = static_cast<std::int32_t>(points.size());
    points.insert(points.end(), points_.begin(), points_.end());
    for (const auto& t : triangles_) {
      const auto at = [&](int k) { return static_cast<std::size_t>(t[static_cast<std::size_t>(k)]); };
      const gp_XYZ a = points_[at(0)].XYZ(), b = points_[at(1)].XYZ(), c = points_[at(2)].XYZ();
      const gp_XYZ normal = (b - a).Crossed(c - a);
      const double area = normal.Modulus();
      if (area > 0.0) {
        const gp_XY uv = (uv_[at(0)].XY() + uv_[at(1)].XY() + uv_[at(2)].XY()) / 3.0;
        const gp_XYZ off = surface_.Value(uv.X(), uv.Y()).XYZ() - (a + b + c) / 3.0;
        out.deviation = std::max(out.deviation, std::fabs(off.Dot(normal)) / area / kMillimetres);
      }
      out.triangles.push_back({first + t[0], first + t[turned_ ? 2 : 1], first + t[turned_ ? 1 : 2]});
      out.faces.push_back(face);
    }
  }

 private:
  struct Border {
    BRepAdaptor_Curve curve;
    Handle(Geom2d_Curve) on_face;
  };
  struct OnBorder {
    int border;
    double from, to;  // of the lesser and the greater node
  };

  /// The same for both directions.
  static std::uint64_t side_of(int a, int b) {
    return (static_cast<std::uint64_t>(std::min(a, b)) << 32) | static_cast<std::uint64_t>(std::max(a, b));
  }
  void note_border(int a, int b, OnBorder on) {
    if (a > b) std::swap(a, b), std::swap(on.from, on.to);
    on_border_.insert_or_assign(side_of(a, b), on);
  }
  int halve(int a, int b) {
    const int fresh = static_cast<int>(points_.size());
    const auto found = on_border_.find(side_of(a, b));
    if (found != on_border_.end()) {
      const OnBorder on = found->second;
      const double t = 0.5 * (on.from + on.to);
      const Border& border = borders_[static_cast<std::size_t>(on.border)];
      points_.push_back(border.curve.Value(t));
      uv_.push_back(border.on_face->Value(t));
      note_border(std::min(a, b), fresh, {on.border, on.from, t});
      note_border(std::max(a, b), fresh, {on.border, on.to, t});
      return fresh;
    }
    const gp_XY uv = 0.5 * (uv_[static_cast<std::size_t>(a)].XY() + uv_[static_cast<std::size_t>(b)].XY());
    uv_.emplace_back(uv);
    points_.push_back(surface_.Value(uv.X(), uv.Y()));
    return fresh;
  }
  /// A triangle by those of its sides that have a middle.
  static void part(const std::array<int, 3>& t, const std::array<int, 3>& m, std::vector<std::array<int, 3>>& out) {
    const int divided = (m[0] >= 0) + (m[1] >= 0) + (m[2] >= 0);
    if (divided == 0) return out.push_back(t);
    if (divided == 3) {
      out.insert(out.end(), {{t[0], m[0], m[2]}, {m[0], t[1], m[1]}, {m[2], m[1], t[2]}, {m[0], m[1], m[2]}});
      return;
    }
    // turned so that the first side is divided, and the last one is not
    std::size_t k = 0;
    while (!(m[k] >= 0 && m[(k + 2) % 3] < 0)) ++k;
    const int a = t[k], b = t[(k + 1) % 3], c = t[(k + 2) % 3], ab = m[k], bc = m[(k + 1) % 3];
    if (divided == 1)
      out.insert(out.end(), {{a, ab, c}, {ab, b, c}});
    else
      out.insert(out.end(), {{a, ab, c}, {ab, b, bc}, {ab, bc, c}});
  }

  BRepAdaptor_Surface surface_;
  bool turned_;
  std::vector<gp_Pnt> points_;
  std::vector<gp_Pnt2d> uv_;
  std::vector<std::array<int, 3>> triangles_;
  std::vector<Border> borders_;
  std::unordered_map<std::uint64_t, OnBorder> on_border_;
};

/// Corners that neighbours share become one.
void join_corners(const std::vector<gp_Pnt>& points, CadTriangles& out) {
  constexpr double kSame = 1e-4;  // [mm]
  struct Hash {
    std::size_t operator()(const std::array<std::int64_t, 3>& k) const {
      return static_cast<std::size_t>(k[0] * 73'856'093 ^ k[1] * 19'349'663 ^ k[2] * 83'492'791);
    }
  };
  std::unordered_map<std::array<std::int64_t, 3>, std::int32_t, Hash> known;
  std::vector<std::int32_t> become(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const gp_Pnt& p = points[i];
    std::array<std::int64_t, 3> cell{};
    for (int k = 0; k < 3; ++k)
      cell[static_cast<std::size_t>(k)] = to_whole<long long>(std::round(p.Coord(k + 1) / kSame));
    std::int32_t found = -1;
    for (std::int64_t n = 0; n < 27 && found < 0; ++n) {
      const auto at = known.find({cell[0] + n % 3 - 1, cell[1] + n / 3 % 3 - 1, cell[2] + n / 9 - 1});
      if (at == known.end()) continue;
      const Point& other = out.vertices[static_cast<std::size_t>(at->second)];
      const gp_Pnt there(kMillimetres * other[0], kMillimetres * other[1], kMillimetres * other[2]);
      if (there.Distance(p) <= kSame) found = at->second;
    }
    if (found < 0) {
      found = static_cast<std::int32_t>(out.vertices.size());
      out.vertices.push_back(to_m(p));
      known.emplace(cell, found);
    }
    become[i] = found;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < out.triangles.size(); ++i) {
    auto t = out.triangles[i];
    for (auto& corner : t) corner = become[static_cast<std::size_t>(corner)];
    if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
    out.triangles[kept] = t, out.faces[kept] = out.faces[i];
    ++kept;
  }
  out.triangles.resize(kept), out.faces.resize(kept);
}

CadTriangles Shape::triangles_of(const std::vector<std::int64_t>& faces, double deviation, double side) const {
  constexpr std::size_t kMostTriangles = 4'000'000;
  constexpr double kTurn = 0.2;  // [rad] between neighbours
  TopoDS_Compound together;
  BRep_Builder builder;
  builder.MakeCompound(together);
  for (const std::int64_t face : faces) builder.Add(together, faces_(static_cast<int>(face) + 1));
  const BRepMesh_IncrementalMesh mesh(together, kMillimetres * deviation, Standard_False, kTurn);
  CadTriangles out;
  std::vector<gp_Pnt> points;
  for (const std::int64_t face : faces) {
    const TopoDS_Face& f = TopoDS::Face(faces_(static_cast<int>(face) + 1));
    TopLoc_Location place;
    const Handle(Poly_Triangulation) given = BRep_Tool::Triangulation(f, place);
    if (given.IsNull() || !given->HasUVNodes()) {
      out.message = "cannot be made into triangles (" + entity(static_cast<int>(face)) + ")";
      return out;
    }
    FaceTriangles divided(f, given);
    if (!divided.divide(kMillimetres * side, kMostTriangles - std::min(kMostTriangles, out.triangles.size()))) {
      out = {};
      out.message = "needs more than " + std::to_string(kMostTriangles) + " triangles";
      return out;
    }
    divided.append(static_cast<int>(face), points, out);
  }
  join_corners(points, out);
  return out;
}

std::string Shape::entity(int face) const {
  // looks through all that was read: only where somebody asks
  if (face < 0 || face >= faces()) return {};
  const Handle(XSControl_TransferReader)& reader = read_->TransferReader();
  for (const int mode : {1, 3, 0}) {
    const Handle(Standard_Transient) entity = reader->EntityFromShapeResult(faces_(face + 1), mode);
    if (entity.IsNull()) continue;
    return std::string(read_->Model()->StringLabel(entity)->ToCString()) + " (" + entity->DynamicType()->Name() + ")";
  }
  return {};
}

CadFault too_many_faces(int faces) {
  return {"holds " + std::to_string(faces) + " faces, more than " + std::to_string(kMostFaces),
          "export the running surface alone, or triangles (.stl)"};
}

/// How far the edges are from the faces that they bound, at most [mm]: damaged edges are at no end of triangles.
double gap_at_edges(const TopoDS_Shape& whole) {
  double widest = 0.0;
  for (TopExp_Explorer edges(whole, TopAbs_EDGE); edges.More(); edges.Next())
    widest = std::max(widest, BRep_Tool::Tolerance(TopoDS::Edge(edges.Current())));
  return widest;
}

std::unique_ptr<Shape> finished(XSControl_Reader& reader, std::string unit, CadFault& fault) {
  // before anything is made of them
  const Handle(Interface_InterfaceModel) model = reader.Model();
  int said = 0;
  for (int i = 1; i <= model->NbEntities(); ++i)
    if (model->Value(i)->IsKind(STANDARD_TYPE(StepShape_Face))) ++said;
  if (said > kMostFaces) return fault = too_many_faces(said), nullptr;
  reader.TransferRoots();
  const TopoDS_Shape whole = reader.OneShape();
  TopTools_IndexedMapOfShape faces;
  if (!whole.IsNull()) TopExp::MapShapes(whole, TopAbs_FACE, faces);
  if (faces.Extent() == 0) {
    fault = {"holds no face", "export surfaces or solids, not curves or meshes alone"};
    return nullptr;
  }
  if (faces.Extent() > kMostFaces) return fault = too_many_faces(faces.Extent()), nullptr;
  constexpr double kWidestGap = 1.0;  // [mm]
  if (const double gap = gap_at_edges(whole); !(gap < kWidestGap)) {
    std::ostringstream text;
    text << "has an edge that lies " << 1e-3 * gap << " m beside the face that it bounds";
    fault = {text.str(), "is the file damaged? export it again"};
    return nullptr;
  }
  return std::make_unique<Shape>(whole, std::move(unit), reader.WS());
}

/// Translating does not end where they are not. What is no number was read as 0.
bool points_are_finite(const Interface_InterfaceModel& model) {
  constexpr double kFarthest = 1e12;  // in any unit
  for (int i = 1; i <= model.NbEntities(); ++i) {
    if (model.Value(i)->IsKind(STANDARD_TYPE(StepGeom_GeometricRepresentationItem)) &&
        model.Check(i, true)->HasFailed())
      return false;
    const Handle(StepGeom_CartesianPoint) point = Handle(StepGeom_CartesianPoint)::DownCast(model.Value(i));
    if (point.IsNull()) continue;
    for (int k = 1; k <= point->NbCoordinates(); ++k)
      if (!(std::abs(point->CoordinatesValue(k)) < kFarthest)) return false;
  }
  return true;
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
  if (!points_are_finite(*reader.Model())) {
    fault = {"has points that lie nowhere: a coordinate is no finite number", "is it damaged? export it again"};
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

/// Knots as OpenCASCADE counts them.
struct Knots {
  TColStd_Array1OfReal values;
  TColStd_Array1OfInteger times;

  explicit Knots(const std::vector<double>& knots) : values(1, different(knots)), times(1, different(knots)) {
    int n = 0;
    for (std::size_t i = 0; i < knots.size(); ++i) {
      if (i == 0 || knots[i] > knots[i - 1]) values(++n) = knots[i], times(n) = 0;
      ++times(n);
    }
  }
  static int different(const std::vector<double>& knots) {
    int n = 0;
    for (std::size_t i = 0; i < knots.size(); ++i) n += i == 0 || knots[i] > knots[i - 1] ? 1 : 0;
    return n;
  }
};

TopoDS_Shape shape_of(const CadSheet& sheet) {
  const CadSpline& spline = sheet.spline;
  const Knots across(spline.knots_v);
  const int columns = static_cast<int>(spline.knots_v.size()) - static_cast<int>(spline.degree_v) - 1;
  if (sheet.kind == CadSheet::Kind::surface) {
    const Knots along(spline.knots_u);
    const int rows = static_cast<int>(spline.knots_u.size()) - static_cast<int>(spline.degree_u) - 1;
    TColgp_Array2OfPnt poles(1, rows, 1, columns);
    TColStd_Array2OfReal weights(1, rows, 1, columns);
    for (int i = 0; i < rows; ++i)
      for (int j = 0; j < columns; ++j) {
        const auto k = static_cast<std::size_t>(j) * static_cast<std::size_t>(rows) + static_cast<std::size_t>(i);
        poles(i + 1, j + 1) = to_mm(spline.poles.at(k));
        weights(i + 1, j + 1) = spline.weights.empty() ? 1.0 : spline.weights.at(k);
      }
    const Handle(Geom_BSplineSurface) surface =
        new Geom_BSplineSurface(poles, weights, along.values, across.values, along.times, across.times,
                                static_cast<int>(spline.degree_u), static_cast<int>(spline.degree_v));
    return BRepBuilderAPI_MakeFace(surface, kTolerance).Face();
  }
  TColgp_Array1OfPnt poles(1, columns);
  for (int j = 0; j < columns; ++j) poles(j + 1) = to_mm(spline.poles.at(static_cast<std::size_t>(j)));
  const Handle(Geom_BSplineCurve) curve =
      new Geom_BSplineCurve(poles, across.values, across.times, static_cast<int>(spline.degree_v));
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
  constexpr std::time_t kFirstDate = 315'619'200;  // 2 January 1980: OpenCASCADE knows none before it
  if (std::time(nullptr) < kFirstDate)
    return {"cannot be written: the clock of this machine stands before 1980", "set the clock"};
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
    header.SetDescriptionValue(1, new TCollection_HAsciiString(sheet.description.c_str()));
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
      case Question::last_hits: {
        const auto least = channel.take<double>();
        std::vector<CadHit> hits;
        for (const CadLine& line : channel.take_list<std::vector<CadLine>>())
          hits.push_back(shape.last_hit(least, line));
        channel.put_list(hits);
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
      case Question::spline_of: {
        const auto face = channel.take<std::int64_t>();
        const auto part = channel.take<CadPart>();
        std::string why;
        CadSpline spline;
        try {
          spline = shape.spline_of(static_cast<int>(face), part, why);
        } catch (const Standard_Failure& failure) {
          why = std::string("cannot become a B-spline: ") + failure.GetMessageString();
        }
        channel.put_list(why);
        if (why.empty()) put(channel, spline);
        break;
      }
      case Question::triangles_of: {
        const auto faces = channel.take_list<std::vector<std::int64_t>>();
        const double deviation = channel.take<double>(), side = channel.take<double>();
        CadTriangles out;
        try {
          out = shape.triangles_of(faces, deviation, side);
        } catch (const Standard_Failure& failure) {
          out.message = std::string("cannot be made into triangles: ") + failure.GetMessageString();
        }
        channel.put_list(out.message);
        channel.put(out.deviation);
        channel.put_list(out.vertices);
        channel.put_list(out.triangles);
        channel.put_list(out.faces);
        break;
      }
      case Question::entity:
        channel.put_list(shape.entity(static_cast<int>(channel.take<std::int64_t>())));
        break;
    }
  }
}

void serve(Channel& channel) {
  bound_what_a_file_takes(std::uint64_t{16} << 30);
  enum class Task : std::int64_t { step, iges, write };
  const auto task = channel.take<Task>();
  const auto file = channel.take_list<std::string>();
  if (task == Task::write) {
    CadSheet sheet;
    sheet.kind = channel.take<CadSheet::Kind>();
    sheet.from = channel.take<double>();
    sheet.to = channel.take<double>();
    sheet.name = channel.take_list<std::string>();
    sheet.description = channel.take_list<std::string>();
    sheet.spline = take_spline(channel);
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
  return treadmark::serve_as_helper(count, arguments, TREADMARK_MODULE_VERSION, treadmark::io::cad::serve);
}
