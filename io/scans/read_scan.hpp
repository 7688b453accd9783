// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <functional>
#include <limits>
#include <optional>
#include <string>

#include "treadmark/core/error.hpp"
#include "treadmark/core/progress.hpp"
#include "treadmark/model/shape/length_unit.hpp"
#include "treadmark/model/shape/offset_map.hpp"
#include "treadmark/model/shape/point_cloud.hpp"
#include "treadmark/model/shape/profile.hpp"

namespace treadmark::io {

/// A point cloud as it stands in its file.
struct Scan {
  PointCloud cloud;    ///< numbers of the file, nothing scaled
  std::string format;  ///< in words: "PLY, binary little endian", "columns x y z pass, separated by ','"
  std::optional<LengthUnit>
      unit;  ///< only where the file itself says it (a comment or a header of a column), and no other
  std::optional<LengthUnit> usual_unit;  ///< of files of this kind that do not say it (LAS: metres)
  std::string reference;                 ///< coordinate system of the Earth that the file names; empty: none
  std::size_t points_in_file = 0;        ///< = points of the cloud + not_finite + withheld + outside
  std::size_t not_finite = 0;   ///< left out: lost points, for which scanners write NaN or infinite coordinates,
                                ///< 0 0 0 (PTX) or a mark (E57)
  std::size_t withheld = 0;     ///< left out: points that a LAS file marks as withheld, that is deleted
  std::size_t outside = 0;      ///< left out: points outside the box or the ranges that were asked for
  bool several_passes = false;  ///< of passes that went with batches: not all are the same
};

/// Points that are read by how far they are from the scanner, in the unit of the file, and how strong their echo is.
struct ScanRanges {
  double nearest = 0.0, farthest = std::numeric_limits<double>::infinity();
  double least_intensity = -std::numeric_limits<double>::infinity();

  bool by_distance() const { return nearest > 0.0 || !std::isinf(farthest); }
  bool by_intensity() const { return !std::isinf(least_intensity); }
};

struct ScanReadOptions {
  SourcePosition asked_by;                      ///< where the file was named
  std::size_t most_points = 200'000'000;        ///< a file that says it has more is refused
  std::optional<Eigen::AlignedBox3d> box = {};  ///< points outside are left out, in the unit of the file
  std::optional<ScanRanges> ranges = {};        ///< the same
  std::optional<Vec3> station = {};             ///< where the scanner stood, whatever a file says of it, in its unit
  /// Gets the points in their order, kBatch at most at a time, and may take them; the cloud of the scan stays empty
  /// then. Without normals and intensities; with passes wherever the file has them, see Scan::several_passes. What is
  /// read as a whole (.stl, compressed .pcd) comes in batches, too.
  std::function<void(PointCloud& batch)> batch = {};
  static constexpr std::size_t kBatch = 65'536;
};

/// The ends of the names of scans that are read: ".ply .stl .obj ...".
std::string scan_extensions();

/// Whether the name ends so (any case).
bool is_scan_file(const std::filesystem::path& file);

/// Reads the points (vertices; each once where triangles of an STL file repeat them bit by bit) of a scan, with normals
/// and passes where the file has them. Read in pieces; what is allocated never exceeds what the file can hold.
///   .ply  ASCII and binary of both endians, any order of elements and properties; pass: a whole-number property named
///   pass,
///         pass_id, scan_id, scan or point_source_id.
///   .stl  ASCII and binary. .obj: normals only where each vertex has its own. .off: text (normals with NOFF) and
///   binary. .las  1.0 to 1.4 without compression, formats 0 to 10; pass: the point source ID, unless it is the same
///   everywhere.
///         Points marked as withheld are left out; longitudes and latitudes are refused.
///   .pcd  0.5 to 0.7: ASCII, binary, binary_compressed; pass as for .ply. The viewpoint is ignored.
///   .ptx  stations one after the other, each with its matrix applied; pass: the station where there are several.
///   .e57  1.0: scans with Cartesian or spherical coordinates, each with its pose applied; the check sum of every page
///         that is read is tested; unit: metre; pass: the scan where there are several. Needs Expat.
///         Of both, the places of matrices and poses are where the scanner stood, if all scans of an .e57 have poses
///         or spherical coordinates.
///   .xyz .xyzrgb .xyzn .pts .asc .txt .csv  columns of text. Separators: blanks, tabs, ',' or ';'; decimal commas
///   where something else separates
///         and there is no decimal point. Comments: # ! % // at the start of a line or behind the numbers, ';' before
///         words. A leading number of points may stand there. Columns by a line of names (also in a comment: x, y, z,
///         nx, ny, nz, pass, scan id, line id ..., "X [mm]"), else by their number: 3 = x y z, 6 = x y z nx ny nz where
///         these are unit vectors in the first lines; what stands behind x y z is ignored otherwise.
/// Normals become unit vectors; where the file has a zero or NaN they are zero vectors. What was found or assumed is in
/// format. progress counts bytes. Errors: Error(input_data) with file:line:column or the byte offset, and advice; also
/// when stopped.
Scan read_scan(const std::filesystem::path& file, const ScanReadOptions& options = {}, const Progress& progress = {});

/// Distances that rows of heights do not say, in the unit of the file; 0: not known.
struct HeightRowOptions {
  double across = 0.0;  ///< between the heights of a row
  double along = 0.0;   ///< between rows; 0: the first column says where they are
};

/// Reads what a line scanner writes: a row of heights a profile (16 or more, no names), behind the place of the row if
/// the first column grows or falls. x is along the rows' places, y across, z the height. Nothing if the file is no such
/// text (.csv, .txt, .asc). Errors: as read_scan; Error(configuration) for a distance that is not known.
std::optional<Scan> read_height_rows(const std::filesystem::path& file, const HeightRowOptions& how,
                                     const ScanReadOptions& options = {}, const Progress& progress = {});

/// Whether that would read the file.
bool is_height_rows(const std::filesystem::path& file);

/// The ends of the names of scans that are written: ".ply .las ...".
std::string written_scan_extensions();

/// Errors: Error(configuration) for a name that ends otherwise.
void require_written_scan(const std::filesystem::path& file);

/// Writes points times 1/metres_per(unit) by the extension: .ply (binary little endian, double, with a comment that
/// names the unit), .xyz .asc .txt .csv (header line with names of columns and unit), .las 1.2 (steps of 0.1 um or
/// finer, the unit as system identifier). Normals and passes are written where the cloud has them and the format can
/// hold them (LAS has no normals). points: [m]. The same cloud gives the same bytes; the file appears only when
/// complete. Errors: Error(configuration) for another extension, a cloud that is empty or not finite, one beyond 400 m
/// for LAS, or a file that cannot be written.
void write_scan(const std::filesystem::path& file, const PointCloud& cloud, LengthUnit unit);

/// Whether the content of a .csv, .txt or .asc file is a gridded map of deviations and no list of points. A matrix is
/// told by words or nothing in its first cell beside a first row of numbers; with a number there, by a first row (of at
/// least four positions) and a first column that increase evenly. False for a file that cannot be read.
bool is_deviation_map(const std::filesystem::path& file);

/// How the numbers of a gridded map are meant.
struct MapReadOptions {
  Body body = Body::rail;
  double nominal_radius = 0.0;  ///< wheel: turns lengths along the circumference into angles [m]
  std::optional<LengthUnit>
      unit;  ///< of positions along y, along the track or circumference; default: the file's word, else mm
  std::optional<LengthUnit> height_unit;  ///< of the deviations; default: the file's word, else as unit
  bool angles_deg = false;                ///< wheel: the rows' positions are degrees, not lengths
  bool complete = false;                  ///< every cell must hold a number
  /// What is wrong with a cell, found after the map had been read; the reader then says it at the cell's place.
  struct Objection {
    int iu = 0, iy = 0;  ///< in the grid of the map
    std::string message, advice;
  };
  std::optional<Objection> objection;
  SourcePosition asked_by;

  /// Throws where the cell is to be refused.
  void judge(const std::function<void(const std::string&, const std::string&)>& fail, int iu, int iy,
             bool missing) const {
    if (complete && missing)
      fail("a cell without a deviation", "every cell needs a number here; write 0 where the surface is as it was");
    if (objection && objection->iu == iu && objection->iy == iy) fail(objection->message, objection->advice);
  }
};

/// A map of deviations: a CSV matrix (first row: lateral positions y, first column: positions x along the track or
/// round the wheel; empty cells and "nan" = no data) or an ESRI ASCII grid (.asc: ncols, nrows, xllcorner or xllcenter,
/// yllcorner or yllcenter, cellsize, NODATA_value; columns along x, rows along y with the last row at the least y).
/// Deviations are positive along +z of a rail (material gone) and along +r of a wheel (material added), as OffsetMap
/// has them. Units: a comment or the first cell that states one ("unit mm", "[mm]", "deviations in um"). Errors:
/// Error(input_data) with file:line:column: positions that do not increase evenly (within 5 % of a step), ragged rows,
/// no data at all, a cell without data where the options want all of them, deviations that cannot be metres after
/// scaling (beyond 50 mm, with a hint on units), a wheel's rows that go round more than once. Error(configuration):
/// degrees on a rail, lengths round a wheel without its radius.
OffsetMap read_deviation_map(const std::filesystem::path& file, const MapReadOptions& options);

}  // namespace treadmark::io
