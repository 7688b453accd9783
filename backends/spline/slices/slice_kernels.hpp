// SPDX-License-Identifier: Apache-2.0
// SPDX-FileCopyrightText: Treadmark contributors
#pragma once

namespace treadmark::spline {

// Evaluation of slice surfaces four breaks, cells or samples at a time, on plain arrays; see slice_section.hpp for what
// is computed. Whatever a kernel cannot settle it reports, and scalar code does it again.

/// A SliceNet: value = cubics[span * span_size + (2 power + field) * stride + line], field 0 = y, 1 = w.
struct NetArrays {
  const double* cubics;
  const double* starts;  ///< of the spans, then the end of the last one
  long span_size, stride;
  int spans;
  bool straight;  ///< in v between its breaks
};

/// A section along one grid line, and the arrays of its breaks (v = index + 1), padded to a multiple of four and one
/// more. Derivatives by v are those of the cell that begins at a break; at the end of cell k they are ds_end[k] and so
/// on, which are ds[k + 1] themselves unless cells are straight; then ds_end[-1] exists too.
struct SectionArrays {
  NetArrays net;
  bool wheel;
  double across[4], along[4], normal[4];  ///< in the turned frame: x, y, z, origin
  double c;                               ///< across coordinate of the line
  double reference;                       ///< angle of the turned frame
  double turn;                            ///< whole turns to be added to u for the net
  double shift;                           ///< of c since the cut before, 0: none
  double before, slope;  ///< u of a neighbouring line and its change from line to line, where there was no cut before
  double u_tolerance, largest_step, largest_prediction;
  int span;  ///< near u; updated
  double *s, *n, *ds, *dn, *u, *du;
  double *ds_end, *dn_end, *du_end;
  double *u_by_c, *change, *predicted;
  int* spans;
};

/// Derivative bounds of SliceHulls: bound = twist[(group * 7 + which) * stride + cell].
struct TwistArrays {
  const float* twist;
  long stride;
  int spans_per_group;
  double greatest_error, greatest_turn, turns_normal;
};

/// The cubics of a cell in f = 0 .. 1: s, n, u, and f by a power series in s - s(0).
struct alignas(32) CellCubics {
  double s[4], n[4], u[4], f[4];
};

/// Room for cells, as many as breaks.
struct CellArrays {
  CellCubics* cells;
  int *first_sample, *sample_count;
  char *fast, *redo;
};

struct SampleArrays {
  double first, step;
  int count;
  double slack;  ///< in steps
};

/// The outermost hits of a line's samples; cell, v and u may be null.
struct HitArrays {
  double sign;  ///< of the outermost direction along the normal
  double* n;
  int* cell;
  double *v, *u;
};

struct SlopeArrays {
  double *along, *across;
};

struct SliceKernel {
  /// Cuts breaks 4 first .. 4 last + 3; trouble[group] = 1 where one of four did not settle, else 0.
  void (*cut)(SectionArrays& section, int first, int last, char* trouble);
  /// Hits of the samples over cells first .. last - 1 of which the cubics serve: fast[cell] = 1, else 0. redo[cell] = 1
  /// for cells with a hit that did not converge.
  void (*hit)(const SectionArrays& section, const TwistArrays& twist, const SampleArrays& samples, int first, int last,
              const CellArrays& work, const HitArrays& hits);
  /// Slopes of the surface at the hits; arrays padded to a multiple of four.
  void (*slopes)(SectionArrays& section, const HitArrays& hits, int count, const SlopeArrays& slopes);

  static const SliceKernel generic;
  static const SliceKernel* const avx2;  ///< nullptr if this build has none
};

}  // namespace treadmark::spline
