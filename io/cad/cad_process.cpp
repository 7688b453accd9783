// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#include "treadmark/io/cad/cad_process.hpp"

#include <cmath>
#include <utility>

#include "treadmark/core/error.hpp"
#include "treadmark/core/helper_process.hpp"
#include "treadmark/core/platform/ranges.hpp"

namespace treadmark::io::cad {
namespace {

namespace fs = std::filesystem;

constexpr Helper kOpenCascade{"treadmark-opencascade", "OpenCASCADE", "files of CAD", "cad"};

Error broke_down(const std::string& file) {
  return {ErrorKind::input_data,
          "OpenCASCADE broke down over the CAD file",
          {file},
          "is it damaged? export it again, or export triangles (.stl)"};
}

bool is_finite(const Point& p) {
  return ranges::all_of(p, [](double x) { return std::isfinite(x); });
}

void require(bool sense) {
  if (!sense) throw Broken{};
}

std::vector<Point> take_points(Channel& c) {
  auto points = c.take_list<std::vector<Point>>();
  require(ranges::all_of(points, is_finite));
  return points;
}

}  // namespace

std::unique_ptr<Channel> start_opencascade(const std::string& file) { return start_helper(kOpenCascade, file); }

template <class Talk>
auto CadShape::ask(Talk talk) const {
  return talk_to(channel_, talk, [this] { return broke_down(file_); });
}

CadShape::CadShape(std::unique_ptr<Channel> channel, const fs::path& file, bool iges)
    : channel_(std::move(channel)), file_(file.string()) {
  const CadFault fault = ask([&](Channel& c) {
    c.put<std::int64_t>(iges ? 1 : 0);
    c.put_list(file_);
    return take_fault(c);
  });
  if (!fault.message.empty())
    throw Error(ErrorKind::input_data, "the CAD file " + fault.message, {file_}, fault.advice);
  ask([&](Channel& c) {
    unit_ = c.take_list<std::string>();
    const auto faces = c.take<std::int64_t>();
    low_ = c.take<Point>();
    high_ = c.take<Point>();
    require(faces > 0 && faces <= kMostFaces && is_finite(low_) && is_finite(high_));
    for (std::size_t k = 0; k < 3; ++k) require(low_[k] <= high_[k]);
    faces_ = static_cast<int>(faces);
  });
}

std::vector<CadHit> CadShape::last_hits(double least, const std::vector<CadLine>& lines) const {
  return ask([&](Channel& c) {
    c.put(Question::last_hits);
    c.put(least);
    c.put_list(lines);
    auto hits = c.take_list<std::vector<CadHit>>();
    require(hits.size() == lines.size());
    for (const CadHit& hit : hits) require(hit.face >= -1 && hit.face < faces_ && std::isfinite(hit.t));
    return hits;
  });
}

std::vector<Point> CadShape::points_on(std::int64_t face) const {
  return ask([&](Channel& c) {
    c.put(Question::points_on);
    c.put(face);
    return take_points(c);
  });
}

std::vector<CadEdgePoint> CadShape::edges_of(std::int64_t face) const {
  return ask([&](Channel& c) {
    c.put(Question::edges_of);
    c.put(face);
    auto points = c.take_list<std::vector<CadEdgePoint>>();
    for (const CadEdgePoint& point : points) require(is_finite(point.p));
    return points;
  });
}

bool CadShape::unchanging(std::int64_t face, bool turned) const {
  return ask([&](Channel& c) {
    c.put(Question::unchanging);
    c.put(face);
    c.put<std::int64_t>(turned ? 1 : 0);
    return c.take<std::int64_t>() != 0;
  });
}

std::string CadShape::entity(std::int64_t face) const {
  return ask([&](Channel& c) {
    c.put(Question::entity);
    c.put(face);
    return c.take_list<std::string>();
  });
}

CadSpline CadShape::spline_of(std::int64_t face, const CadPart& part, std::string& why) const {
  return ask([&](Channel& c) {
    c.put(Question::spline_of);
    c.put(face);
    c.put(part);
    why = c.take_list<std::string>();
    CadSpline spline;
    if (why.empty()) spline = take_spline(c);
    return spline;
  });
}

CadTriangles CadShape::triangles_of(const std::vector<std::int64_t>& faces, double deviation, double side) const {
  return ask([&](Channel& c) {
    c.put(Question::triangles_of);
    c.put_list(faces);
    c.put(deviation);
    c.put(side);
    CadTriangles out;
    out.message = c.take_list<std::string>();
    out.deviation = c.take<double>();
    out.vertices = take_points(c);
    out.triangles = c.take_list<std::vector<std::array<std::int32_t, 3>>>();
    out.faces = c.take_list<std::vector<std::int32_t>>();
    require(out.faces.size() == out.triangles.size() && !(out.deviation < 0.0));
    for (const auto& triangle : out.triangles)
      for (const std::int32_t corner : triangle)
        require(corner >= 0 && static_cast<std::size_t>(corner) < out.vertices.size());
    for (const std::int32_t face : out.faces) require(face >= 0 && face < faces_);
    return out;
  });
}

void write_sheet(const fs::path& file, const CadSheet& sheet) {
  std::unique_ptr<Channel> channel = start_opencascade(file.string());
  const CadFault fault = talk_to(
      channel,
      [&](Channel& c) {
        constexpr std::int64_t kWrite = 2;
        c.put(kWrite);
        c.put_list(file.string());
        c.put(sheet.kind);
        c.put(sheet.from);
        c.put(sheet.to);
        c.put_list(sheet.name);
        c.put_list(sheet.description);
        put(c, sheet.spline);
        return take_fault(c);
      },
      [&] { return broke_down(file.string()); });
  if (!fault.message.empty())
    throw Error(ErrorKind::configuration, "the CAD file " + fault.message, {file.string()}, fault.advice);
}

}  // namespace treadmark::io::cad
