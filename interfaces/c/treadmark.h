/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: Treadmark contributors
 *
 * Contact of wheels and rails, for C and everything that calls C. All numbers are in SI units (m, N, Pa, rad, s, degrees Celsius);
 * axes and signs are those of core/README.md: x along the track, y to the right, z down, forces act on the rail.
 *
 * Rules for all functions
 *  - A function that can fail returns a tm_status. Where it is above TM_FAILED the call has changed nothing: objects that it was to
 *    make and pointers that it was to lend are null, numbers stay as they were, and tm_message() says what is wrong, where, and what
 *    to do. What differs says so. No function prints, exits or throws.
 *  - What a function makes (tm_..._create, _read, _parse, ...) is freed with the function of its type; null is freed without effect.
 *    A pair keeps what it needs of the surfaces it was made of, a solution what it needs of its case.
 *  - Null for a needed argument is TM_BAD_ARGUMENT. Null for an output means that it is not wanted.
 *  - One object is used by one thread at a time, different objects by any threads at once; surfaces never change and may be used
 *    by several threads. Results do not depend on threads.
 *  - Pointers that are lent stay valid as long as the object that lent them is not changed or freed. Asking is no change.
 *  - Functions of the caller must not throw or jump out of the call. They may call everything here with other objects.
 *  - Comparisons with NaN are part of the work: a program that traps them (feenableexcept, -ffpe-trap=invalid) must not do so
 *    within a call.
 *
 * Binary interface: the number in libtreadmark.so.0 stays while programs linked with an older library run with a newer one. Until it
 * changes, functions and types stay as they are and only new ones come; enumerators keep their numbers, so that a program must
 * take a status above TM_FAILED that it does not know for an error; names of keys, numbers and fields stay. Which numbers there are,
 * texts and last digits of results may change. The objects behind the types are nobody's business.
 */
#ifndef TREADMARK_H
#define TREADMARK_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32)
#define TM_API
#else
#define TM_API __attribute__((visibility("default")))
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* How a call ended. The first four are ends of a computation, whose results can be asked for. */
typedef enum tm_status {
  TM_OK = 0,
  TM_NO_CONTACT = 1,
  TM_NOT_CONVERGED = 2,
  TM_FAILED = 3,
  TM_BAD_ARGUMENT = 10, /* null, an index or size out of range, an unknown name */
  TM_BAD_REQUEST = 11,  /* what is asked for is wrong or not supported */
  TM_BAD_INPUT = 12,    /* a file is missing, broken or implausible */
  TM_NUMERICAL = 13,    /* no meaningful result */
  TM_CANCELLED = 14,
  TM_OUT_OF_MEMORY = 15,
  TM_INTERNAL = 16 /* an error in Treadmark */
} tm_status;

typedef enum tm_body { TM_RAIL = 0, TM_WHEEL = 1 } tm_body;

typedef struct tm_case tm_case;         /* what is given: a wheel on a rail at one instant, or one patch */
typedef struct tm_surface tm_surface;   /* a wheel or a rail */
typedef struct tm_pair tm_pair;         /* both, and what the last solution left */
typedef struct tm_patch tm_patch;       /* a patch of given geometry, and what the last solution left */
typedef struct tm_solution tm_solution; /* results */
typedef struct tm_state tm_state;       /* on what following solutions depend */
typedef struct tm_contact_table tm_contact_table; /* forces of a wheel on a rail, tabulated */

/* ---- The library ---- */

/* Of the library that runs, which may be newer than this header. */
TM_API void tm_version(int *major, int *minor, int *patch);
/* With revision and parts, as `treadmark --version`. Lent for ever. */
TM_API const char *tm_version_text(void);
/* Of the last call of this thread that returned more than TM_FAILED: "file:line:column: what (what to do)". Lent until the next. */
TM_API const char *tm_message(void);
/* "ok", "no_contact", "bad_argument", ...; "unknown" for other numbers. Lent for ever. */
TM_API const char *tm_status_name(tm_status status);
/* Threads of calls that follow in this process, at most 4096: 0 = all of the machine. */
TM_API tm_status tm_set_threads(int count);
/* From any thread: while *flag is not 0, calls of this thread end with TM_CANCELLED; null: never. The flag stays the caller's. */
TM_API void tm_set_cancel_flag(const volatile int *flag);
/* Is told by tm_run, tm_pair_solve_many and tm_surface_from_scan called from this thread how far they are, on any thread but one call
 * at a time; not 0 = give up, the call returns TM_CANCELLED. what: the part just finished, lent for the call. Null: nobody is told. */
typedef int (*tm_progress)(void *user, size_t finished, size_t total, const char *what);
TM_API void tm_set_progress(tm_progress function, void *user);

/* ---- Cases: what is given ---- */

/* All defaults: a wheel on a rail (patch = 0), or one patch (patch = 1). */
TM_API tm_status tm_case_create(int patch, tm_case **out);
/* Case `number` (from 1) of a file, .toml or .inp. Geometry is read when it is needed. */
TM_API tm_status tm_case_read(const char *file, int number, tm_case **out);
/* The same from the text of a .toml file; names of files in it count from `folder` (null: the current one). */
TM_API tm_status tm_case_parse(const char *text, size_t length, const char *folder, int number, tm_case **out);
TM_API tm_status tm_case_copy(const tm_case *from, tm_case **out);
TM_API void tm_case_free(tm_case *c);
/* The text of a .toml file that reads as the same case, names of files counted from its folder; freed with tm_text_free. */
TM_API tm_status tm_case_text(const tm_case *c, char **toml);
/* As --set of the program: "key=value" with the keys and units of case files ("wheelset.y_mm=5", "friction.kind=..."). */
TM_API tm_status tm_case_set(tm_case *c, const char *assignment);
/* A number by the name of its key without the unit, in SI: "wheelset.y", 5e-3. Takes well below a microsecond. */
TM_API tm_status tm_case_set_number(tm_case *c, const char *name, double value);
TM_API tm_status tm_case_get_number(const tm_case *c, const char *name, double *value);
/* The same by number; names do not change while the library is loaded. */
TM_API tm_status tm_case_find_number(const char *name, int *id);
TM_API tm_status tm_case_set_number_by_id(tm_case *c, int id, double value);

/* ---- Surfaces ---- */

/* Profile, slices, triangles or offsets; nominal_radius: of a wheel, 0 where the file has it. scale_to_mm: units of profiles and
 * triangles, 1 = mm. */
TM_API tm_status tm_surface_read(const char *file, tm_body body, double nominal_radius, double scale_to_mm, tm_surface **out);
/* The rail or wheel that a case names, in the representation that it asks for. */
TM_API tm_status tm_surface_of_case(const tm_case *c, tm_body body, tm_surface **out);
/* A cross-section through n points, in order: rails with growing, wheels with falling y. strength: of smoothing [m3], 0 = none. */
TM_API tm_status tm_surface_from_profile(tm_body body, const double *y, const double *z, size_t n, double nominal_radius,
                                         double strength, tm_surface **out);
/* n_u sections at growing u (along the track [m], or angles [rad]), each of n points: y[i * n + k], z[i * n + k]; z of wheels is
 * radial, over the nominal radius, downwards. */
TM_API tm_status tm_surface_from_slices(tm_body body, const double *u, size_t n_u, const double *y, const double *z, size_t n,
                                        double nominal_radius, tm_surface **out);
/* Triangles over vertices xyz[3 * i], counter-clockwise seen from outside the material. */
TM_API tm_status tm_surface_from_triangles(tm_body body, const double *xyz, size_t vertices, const int32_t *corners,
                                           size_t triangles, double nominal_radius, tm_surface **out);
/* As `treadmark import` makes it from the points of a scanner: units, placement, cleaning, fit. Several files are several passes.
 * settings: "key=value" as --set of that verb. audit, freed with tm_text_free: what was done to the points, as JSON; null: not
 * wanted. Needs room for the surface in the folder for passing files (TMPDIR). */
TM_API tm_status tm_surface_from_scan(const char *const *files, size_t n_files, tm_body body, const char *const *settings,
                                      size_t n_settings, char **audit, tm_surface **out);
/* A function of the caller, asked for height z of a rail or radial height of a wheel at u and n lateral positions y; all must be
 * finite; not 0 = give up, the call returns TM_CANCELLED. It is sampled here, at n_u and n points of the rectangle, on this
 * thread. */
typedef int (*tm_heights)(void *user, double u, const double *y, size_t n, double *z);
TM_API tm_status tm_surface_from_function(tm_body body, tm_heights heights, void *user, double u_min, double u_max, size_t n_u,
                                          double y_min, double y_max, size_t n, double nominal_radius, tm_surface **out);
/* The same surface by another backend (`treadmark list backends`), sampled at a resolution [m], 0 = its default. */
TM_API tm_status tm_surface_represent(const tm_surface *from, const char *backend, double resolution, tm_surface **out);
/* Heights over points (x, y) of a plane: origin of its axes in the surface's, rotation by rows (null: the surface's axes). z, dzdx
 * and dzdy: n numbers each, NaN where nothing is; after TM_CANCELLED they may be half written. */
TM_API tm_status tm_surface_heights(const tm_surface *s, const double origin[3], const double rotation[9], const double *x,
                                    const double *y, size_t n, double *z, double *dzdx, double *dzdy);
/* How many numbers its shape follows from, by which there are derivatives: points, coefficients, vertices (docs/representations.md). */
TM_API size_t tm_surface_parameters(const tm_surface *s);
/* Where they act in the surface's axes: xyz[3 * i], n of them; NaN: at no one place. */
TM_API tm_status tm_surface_parameter_places(const tm_surface *s, double *xyz, size_t n);
/* "spline", "mesh", ... Lent by the surface; null for null. */
TM_API const char *tm_surface_backend(const tm_surface *s);
TM_API void tm_surface_free(tm_surface *s);

/* ---- A wheel on a rail ---- */

/* The rail may be a roller: tm_surface_of_case of a case that has one. */
TM_API tm_status tm_pair_create(const tm_surface *rail, const tm_surface *wheel, tm_pair **out);
/* Of a case: both surfaces as it names them. */
TM_API tm_status tm_pair_of_case(const tm_case *c, tm_pair **out);
/* Solves one instant and goes on from the last one as the case says (case.history). TM_NO_CONTACT, TM_NOT_CONVERGED and TM_FAILED
 * have a solution too, whose message says why. A NaN is TM_BAD_REQUEST, and so are nominal radii that are not those of the
 * surfaces. */
TM_API tm_status tm_pair_solve(tm_pair *p, const tm_case *c, tm_solution **out);
/* Many instants that do not depend on each other, on all threads (tm_set_threads), each to the bits of tm_pair_solve. Row i is the
 * case with in[k][i] in place of its number in_names[k] ("wheelset.y", as tm_case_set_number). out[k][i] becomes the number
 * out_names[k]: of the solution ("force_on_rail.fz_tr"), "npatch", of the patch with the greatest normal force ("pmax"), or of one
 * patch, counted from 1 ("patch_2.pmax"); NaN where there is none. No array of out may be another one, too. status: of every row,
 * null: not wanted; rows that make no sense are TM_FAILED, without numbers. told hears why rows are not TM_OK, and grave warnings
 * about those that are, on any thread but one call at a time; null: nobody does. The pair keeps what its last solution left, which
 * no row goes on from. Returns TM_OK however rows end. After TM_CANCELLED the other rows have NaN and the status TM_CANCELLED.
 * Memory does not grow with rows. */
typedef void (*tm_row_message)(void *user, size_t row, tm_status status, const char *message);
TM_API tm_status tm_pair_solve_many(const tm_pair *p, const tm_case *c, size_t rows, const char *const *in_names,
                                    const double *const *in, size_t n_in, const char *const *out_names, double *const *out,
                                    size_t n_out, tm_status *status, tm_row_message told, void *user);
/* Total derivatives of numbers of a solution of this pair that is TM_OK (docs/results.md#derivatives): derivatives[k * n_by + i] of
 * numbers[k], named as in tm_pair_solve_many, by by[i]: a number of cases ("wheelset.y"), or one that a surface of the pair tells of its
 * shape ("rail.point_12"). As exact as the solution is (solver.tolerance). The pair keeps what its last solution left. TM_BAD_REQUEST: a
 * number or a theory without derivatives; TM_NUMERICAL: there is none by one of by here, as where contact comes or goes with it. */
TM_API tm_status tm_pair_gradient(tm_pair *p, tm_solution *s, const char *const *numbers, size_t n_numbers, const char *const *by,
                                  size_t n_by, double *derivatives);
/* Derivatives of a number by the gap of each element, contact planes staying where they are: nx * ny numbers of the first patch
 * (tm_patch_grid), then those of the next; n: of all. Of "wheelset.z", "force_on_rail.fz_tr", and of a patch "fn", "fx", "fs", "approach",
 * "pmax", "elastic_energy", "dissipated". A rail that is moved by d along n, into itself, adds d to the gap, a wheel takes it away. */
TM_API tm_status tm_pair_gradient_by_gap(tm_pair *p, tm_solution *s, const char *number, double *by_gap, size_t n);
/* Total derivatives of one number, as tm_pair_gradient has them, by all that the shape of one of the pair's surfaces follows from: n
 * numbers, as many as tm_surface_parameters of that surface, in SI. exact: 0 where surfaces on both sides of a parameter were differenced
 * for it; null: not wanted. Costs a few linear systems, however many there are, for surfaces that know how they move. */
TM_API tm_status tm_pair_gradient_by_shape(tm_pair *p, tm_solution *s, const char *number, tm_body body, double *by_shape, size_t n,
                                           int *exact);
/* The same by the height of one surface over each element, along n of the patch (into the rail): as tm_pair_gradient_by_gap, but with all
 * that contact planes and creepages do. What the gauge or the tape circle does is not at elements. */
TM_API tm_status tm_pair_gradient_by_height(tm_pair *p, tm_solution *s, const char *number, tm_body body, double *by_height, size_t n);
/* Forgets the last solution. */
TM_API tm_status tm_pair_reset(tm_pair *p);
TM_API tm_status tm_pair_save(const tm_pair *p, tm_state **out);
/* Into any pair of the same surfaces: goes on to the same bits. TM_BAD_REQUEST for a state of other surfaces. */
TM_API tm_status tm_pair_restore(tm_pair *p, const tm_state *s);
TM_API void tm_pair_free(tm_pair *p);

/* *size: room on entry, bytes on return, also where the room is too small (TM_BAD_ARGUMENT); buffer null: only the size. Bytes are
 * of this kind of machine. */
TM_API tm_status tm_state_to_bytes(const tm_state *s, void *buffer, size_t *size);
TM_API tm_status tm_state_from_bytes(const void *bytes, size_t size, tm_state **out);
TM_API void tm_state_free(tm_state *s);

/* ---- Tables of forces ---- */

/* Of a round wheel on a prismatic rail, with an error measured against the exact theory (docs/tables.md): what `treadmark table` makes.
 * The case says track, wheelset, material and friction, and the load; settings: "key=value" with the names of that verb's options
 * ("lateral_range_mm=8", "yaw_mrad=20"). Takes minutes; tells tm_set_progress's function. */
TM_API tm_status tm_table_create(const tm_pair *p, const tm_case *c, const char *const *settings, size_t n, tm_contact_table **out);
/* Files .h5 and .json hold all of a table, .csv its nodes, which cannot be read again. */
TM_API tm_status tm_table_read(const char *file, tm_contact_table **out);
TM_API tm_status tm_table_write(const tm_contact_table *t, const char *file);
/* Shares the numbers: one copy for each thread costs nothing. */
TM_API tm_status tm_table_copy(const tm_contact_table *from, tm_contact_table **out);
/* motion: the first n_motion of the numbers of TM_MOTION_NUMBERS, the others 0; forces: room for the first n_forces of those of
 * TM_FORCE_NUMBERS. TM_OK; TM_NO_CONTACT: the wheel is in the air, forces are 0; TM_FAILED: outside of what the table covers, and
 * for a wheel that slides and does not roll; TM_NOT_CONVERGED: no height gives the load. The last two give NaN, and tm_table_message()
 * says why. Takes a few microseconds. */
TM_API tm_status tm_table_evaluate(tm_contact_table *t, const double *motion, size_t n_motion, double *forces, size_t n_forces);
/* Of the last tm_table_evaluate; "". Lent until the next one. */
TM_API const char *tm_table_message(const tm_contact_table *t);
/* How far a number is from the exact theory at the points of the comparison, at most and root of the mean square: "z" [m], the others
 * without unit (docs/tables.md): "normal_force", "fx", "fy", "spin_moment", "t_gamma". */
TM_API tm_status tm_table_error(const tm_contact_table *t, const char *number, double *worst, double *rms);
TM_API void tm_table_free(tm_contact_table *t);

/* ---- One patch of given geometry ---- */

TM_API tm_status tm_patch_create(tm_patch **out);
/* As tm_pair_solve, of a case of one patch. After TM_CANCELLED, TM_OUT_OF_MEMORY and TM_INTERNAL it starts from rest. */
TM_API tm_status tm_patch_solve(tm_patch *p, const tm_case *c, tm_solution **out);
TM_API void tm_patch_free(tm_patch *p);

/* ---- Results ---- */

TM_API tm_status tm_solution_status(const tm_solution *s);
/* Why the status is not TM_OK; "". Lent by the solution. */
TM_API const char *tm_solution_message(const tm_solution *s);
/* Warnings (`treadmark list remarks`): remark i of tm_solution_remarks(); grave: the numbers may be wrong; else a minor one. */
TM_API size_t tm_solution_remarks(const tm_solution *s);
TM_API tm_status tm_solution_remark(const tm_solution *s, size_t i, const char **name, const char **text, int *patch, int *grave);
/* Numbers by their names in results (docs/results.md) without unit, in SI: "force_on_rail.fz_tr"; of a patch "fn", "pmax". A quantity
 * that was not computed is NaN. */
TM_API tm_status tm_solution_number(tm_solution *s, const char *name, double *value);
/* Where the surface of the wheel or rail lay: p_track = origin + rotation p_surface, rotation by rows, the wheel's with its pitch; the
 * surface of a left-hand side is the mirror image of its file. TM_BAD_REQUEST: a solution without bodies. */
TM_API tm_status tm_solution_pose(tm_solution *s, tm_body body, double origin[3], double rotation[9]);
TM_API size_t tm_solution_patches(const tm_solution *s);
TM_API tm_status tm_patch_number(tm_solution *s, size_t patch, const char *name, double *value);
/* Size and place of a patch's elements: centre of the first and steps [m]. */
TM_API tm_status tm_patch_grid(tm_solution *s, size_t patch, int *nx, int *ny, double *x0, double *y0, double *dx, double *dy);
/* Of the axes (x, s, n) of a patch's grid in those of the track, as tm_solution_pose; of a case of one patch its own axes. */
TM_API tm_status tm_patch_pose(tm_solution *s, size_t patch, double origin[3], double rotation[9]);
/* A field of nx * ny numbers, x running fastest: "pressure", "traction_x", ... Lent by the solution. Null and TM_OK: was not computed. */
TM_API tm_status tm_patch_field(tm_solution *s, size_t patch, const char *name, const double **values);
/* Likewise what each element is: 0 outside of contact, 1 adhesion, 2 slip, 3 plastic. */
TM_API tm_status tm_patch_states(tm_solution *s, size_t patch, const uint8_t **states);
TM_API void tm_solution_free(tm_solution *s);

/* Name, unit and meaning of the i-th number of cases, results, fields or tables of forces; TM_BAD_ARGUMENT behind the last one. Lent for ever. */
typedef enum tm_table { TM_CASE_NUMBERS = 0, TM_SOLUTION_NUMBERS = 1, TM_PATCH_NUMBERS = 2, TM_PATCH_FIELDS = 3,
               TM_MOTION_NUMBERS = 4, TM_FORCE_NUMBERS = 5 } tm_table;
TM_API tm_status tm_list(tm_table table, size_t i, const char **name, const char **unit, const char **meaning);

/* ---- Whole files, geometry, measures ---- */

/* All cases of a file, .toml or .inp, with assignments as for tm_case_set: result.json as text, freed with tm_text_free. Returns
 * the gravest status of the cases. */
TM_API tm_status tm_run(const char *file, const char *const *assignments, size_t n, char **json);
/* As `treadmark geometry`: how a wheelset sits on its track at every shift, without forces, and its conicity. settings: "key=value" with
 * the names of that verb's options ("wheel=S1002", "rail=60E1", "gauge_mm=1435", "cant=1:40", "amplitudes_mm=[1, 3]"; docs/c-interface.md),
 * the later of two holds; "case=FILE" names a case, whose keys may change as in tm_run ("wheelset.y_mm=5"). json: as
 * `treadmark schema geometry` says, freed with tm_text_free. */
TM_API tm_status tm_geometry(const char *const *settings, size_t n, char **json);
/* As `treadmark measure` of one file, or of a profile by its name (`treadmark list profiles`): "nominal=S1002", "limits=FILE". What was not
 * measured says why; limits that do not hold are results, too. json: as `treadmark schema measure` says, freed with
 * tm_text_free. */
TM_API tm_status tm_measure(tm_body body, const char *file, const char *const *settings, size_t n, char **json);
/* As `treadmark check` of a profile's file: how it is read, and what speaks for that. body: "wheel", "rail", null: by its name and shape. json,
 * freed with tm_text_free: {"body", "facts": [[name, value], ...], "notes": [text, ...], "warnings": [[name, text], ...]}. */
TM_API tm_status tm_check_profile(const char *file, const char *body, char **json);
TM_API void tm_text_free(char *text);

#ifdef __cplusplus
}
#endif
#endif
