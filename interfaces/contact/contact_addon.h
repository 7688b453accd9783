/* SPDX-License-Identifier: Apache-2.0
 * SPDX-FileCopyrightText: Treadmark contributors */
#ifndef TREADMARK_CONTACT_ADDON_H
#define TREADMARK_CONTACT_ADDON_H

/* The functions of CONTACT's library version, answered by Treadmark. docs/contact-library.md says what they do and what
 * is refused. C99 and C++. Everything is passed by address; strings are bytes and their length; arrays of elements run
 * along x first. Arguments from the mark on are written, and left alone on failure; a null pointer there means "not
 * wanted". Units are those of cntc_setflags(CNTC_if_units). A function that cannot do what is asked writes a line into
 * the log; those with ierror also return a code. All functions may be called from any thread; of two threads that
 * calculate one problem the second one gets CNTC_err_busy. */

#ifdef __cplusplus
extern "C" {
#endif

enum {
  /* units */
  CNTC_if_units = 1933, CNTC_un_cntc = 1934, CNTC_un_spck = 1935, CNTC_un_si = 1936, CNTC_un_imper = 1937,
  /* kinds of input files */
  CNTC_inp_vamp = 1984, CNTC_inp_modul1 = 1988, CNTC_inp_spck = 1990, CNTC_inp_gensys = 1992,
  /* control digits */
  CNTC_ic_config = 1967, CNTC_ic_pvtime = 1970, CNTC_ic_bound = 1971, CNTC_ic_tang = 1972, CNTC_ic_norm = 1973,
  CNTC_ic_force = 1974, CNTC_ic_frclaw = 1976, CNTC_ic_discns = 1977, CNTC_ic_inflcf = 1978, CNTC_ic_mater = 1979,
  CNTC_ic_exrhs = 1980, CNTC_ic_xflow = 1981, CNTC_ic_heat = 1982, CNTC_ic_iestim = 1983, CNTC_ic_output = 1984,
  CNTC_ic_flow = 1985, CNTC_ic_return = 1986, CNTC_ic_matfil = 1987, CNTC_ic_sens = 1988, CNTC_ic_ifmeth = 1989,
  CNTC_ic_ifvari = 1990, CNTC_ic_sbsout = 1991, CNTC_ic_sbsfil = 1992, CNTC_ic_npomax = 1993,
  /* the library itself */
  CNTC_if_idebug = 2000, CNTC_if_licdbg = 2001, CNTC_if_wrtinp = 2002, CNTC_if_openmp = 2003, CNTC_if_timers = 2004,
  CNTC_if_ncase = 2005,
  /* fields */
  CNTC_fld_h = 1, CNTC_fld_mu = 2, CNTC_fld_px = 3, CNTC_fld_py = 4, CNTC_fld_pn = 5, CNTC_fld_ux = 7, CNTC_fld_uy = 8,
  CNTC_fld_un = 9, CNTC_fld_taucrt = 11, CNTC_fld_uplsx = 12, CNTC_fld_uplsy = 13, CNTC_fld_sx = 15, CNTC_fld_sy = 16,
  CNTC_fld_temp1 = 20, CNTC_fld_temp2 = 21, CNTC_fld_wx = 22, CNTC_fld_wy = 23,
  /* metadata */
  CNTC_mt_tim = 2011, CNTC_mt_xr = 2012, CNTC_mt_yr = 2013, CNTC_mt_xw = 2014, CNTC_mt_yw = 2015, CNTC_mt_sw = 2016,
  CNTC_mt_run = 2021, CNTC_mt_axle = 2022, CNTC_mt_side = 2023,
  /* errors */
  CNTC_err_allow = -12, CNTC_err_search = -25, CNTC_err_ftot = -26, CNTC_err_broydn = -26, CNTC_err_norm = -27,
  CNTC_err_tang = -28, CNTC_err_tol = -29, CNTC_err_icp = -31, CNTC_err_profil = -32, CNTC_err_frclaw = -33,
  CNTC_err_discr = -34, CNTC_err_input = -39, CNTC_err_other = -99, CNTC_err_busy = 305,
  /* sizes */
  CNTC_FLAGS_DIM = 25
};

/* start and end */
void cntc_setfileunits(int *nunits, int *iunits);
void cntc_initializefirst(int *ifcver, int *ierror, int *ioutput, const char *wrkdir, const char *outdir,
                          const char *expnam, int *len_wrkdir, int *len_outdir, int *len_expnam);
void cntc_initializefirst_new(int *ifcver, int *ierror, int *ioutput, const char *wrkdir, const char *outdir,
                              const char *expnam, int *len_wrkdir, int *len_outdir, int *len_expnam);
void cntc_initialize(int *ire, int *imodul, /*>*/ int *ifcver, int *ierror, const char *outdir, int *len_outdir);
void cntc_setglobalflags(int *lenflg, int *params, int *values);
void cntc_getmaxnumthreads(/*>*/ int *mxthrd);
void cntc_finalize(int *ire);
void cntc_finalizelast(void);

/* settings of a problem */
void cntc_setflags(int *ire, int *icp, int *lenflg, int *params, int *values);
void cntc_setmetadata(int *ire, int *icp, int *lenmta, int *params, double *values);
void cntc_setsolverflags(int *ire, int *icp, int *gdigit, int *nints, int *iparam, int *nreals, double *rparam);
void cntc_setmaterialparameters(int *ire, int *icp, int *mdigit, int *nparam, double *rparam);
void cntc_settemperaturedata(int *ire, int *icp, int *imeth, int *nparam, double *rparam);
void cntc_settimestep(int *ire, int *icp, double *dt);
void cntc_setrollingstepsize(int *ire, int *icp, double *chi, double *dq);
void cntc_setfrictionmethod(int *ire, int *icp, int *imeth, int *nparam, double *params);
void cntc_setpotcontact(int *ire, int *icp, int *ipotcn, int *nparam, double *rparam);
void cntc_settangentialforces(int *ire, int *icp, double *fx, double *fy);
void cntc_setmaterialproperties(int *ire, int *icp, double *g1, double *nu1, double *g2, double *nu2);
void cntc_setinterfaciallayer(int *ire, int *icp, int *imeth, int *nparam, double *params);

/* module 3 */
void cntc_setreferencevelocity(int *ire, int *icp, double *veloc);
void cntc_sethertzcontact(int *ire, int *icp, int *ipotcn, int *nparam, double *rparam);
void cntc_setpenetration(int *ire, int *icp, double *pen);
void cntc_setnormalforce(int *ire, int *icp, double *fn);
void cntc_setundeformeddistc(int *ire, int *icp, int *ibase, int *nparam, double *prmudf);
void cntc_setcreepages(int *ire, int *icp, double *vx, double *vy, double *phi);
void cntc_setextrarigidslip(int *ire, int *icp, int *lenarr, double *wx, double *wy);

/* module 1 */
void cntc_readinpfile(int *ire, int *inp_type, const char *fname, int *len_fname, /*>*/ int *ierror);
void cntc_setverticalforce(int *ire, double *fz);
void cntc_setprofileinputfname(int *ire, const char *fname, int *len_fname, int *nints, int *iparam, int *nreals,
                               double *rparam);
void cntc_setprofileinputvalues(int *ire, int *npoint, double *values, int *nints, int *iparam, int *nreals,
                                double *rparam);
void cntc_settrackdimensions(int *ire, int *ztrack, int *nparam, double *rparam);
void cntc_setwheelsetdimensions(int *ire, int *ewheel, int *nparam, double *rparam);
void cntc_setwheelsetposition(int *ire, int *ewheel, int *nparam, double *rparam);
void cntc_setwheelsetvelocity(int *ire, int *ewheel, int *nparam, double *rparam);
void cntc_setwheelsetflexibility(int *ire, int *ewheel, int *nparam, double *rparam);

/* solving */
void cntc_calculate(int *ire, int *icp, /*>*/ int *ierror);
void cntc_calculate1(int *ire, /*>*/ int *ierror);
void cntc_calculate3(int *ire, int *icp, /*>*/ int *ierror);
void subs_addblock(int *ire, int *icp, int *iblk, int *isubs, int *npx, int *npy, int *npz, double *x, double *y,
                   double *z);
void subs_calculate(int *ire, int *icp, /*>*/ int *ierror);

/* results */
void cntc_getflags(int *ire, int *icp, int *nparam, int *iparam, /*>*/ int *values);
void cntc_getparameters(int *ire, int *icp, int *itask, int *lenarr, /*>*/ double *values);
void cntc_getprofilevalues(int *ire, int *itask, int *nints, int *iparam, int *nreals, double *rparam, int *lenarr,
                           /*>*/ double *values);
void cntc_getprofilevalues_new(int *ire, int *itask, int *nints, int *iparam, int *nreals, double *rparam, int *lenarr,
                               /*>*/ double *values);
void cntc_getwheelsetposition(int *ire, int *lenarr, /*>*/ double *values);
void cntc_getwheelsetvelocity(int *ire, int *lenarr, /*>*/ double *values);
void cntc_getnumcontactpatches(int *ire, /*>*/ int *npatch);
void cntc_getcontactlocation(int *ire, int *icp, int *lenarr, /*>*/ double *values);
void cntc_getreferencevelocity(int *ire, int *icp, /*>*/ double *veloc);
void cntc_gethertzcontact(int *ire, int *icp, int *lenarr, /*>*/ double *values);
void cntc_getnumelements(int *ire, int *icp, /*>*/ int *mx, int *my);
void cntc_getgriddiscretization(int *ire, int *icp, /*>*/ double *dx, double *dy);
void cntc_getpotcontact(int *ire, int *icp, int *lenarr, /*>*/ double *values);
void cntc_getpenetration(int *ire, int *icp, /*>*/ double *pen);
void cntc_getcreepages(int *ire, int *icp, /*>*/ double *vx, double *vy, double *phi);
void cntc_getcontactforces(int *ire, int *icp, /*>*/ double *fn, double *tx, double *ty, double *mz);
void cntc_getglobalforces(int *ire, int *icp, int *lenarr, /*>*/ double *values);
void cntc_getcontactpatchareas(int *ire, int *icp, /*>*/ double *carea, double *harea, double *sarea);
void cntc_getelementdivision(int *ire, int *icp, int *lenarr, /*>*/ int *eldiv);
void cntc_getmaximumpressure(int *ire, int *icp, /*>*/ double *pnmax);
void cntc_getmaximumtraction(int *ire, int *icp, /*>*/ double *ptmax);
void cntc_getmaximumtemperature(int *ire, int *icp, /*>*/ double *t1max, double *t2max);
void cntc_getfielddata(int *ire, int *icp, int *ifld, int *lenarr, /*>*/ double *fld);
void cntc_gettractions(int *ire, int *icp, int *lenarr, /*>*/ double *pn, double *px, double *py);
void cntc_getmicroslip(int *ire, int *icp, int *lenarr, /*>*/ double *sx, double *sy);
void cntc_getdisplacements(int *ire, int *icp, int *lenarr, /*>*/ double *un, double *ux, double *uy);
void cntc_getsensitivities(int *ire, int *icp, int *lenout, int *lenin, /*>*/ double *sens);
void cntc_getcalculationtime(int *ire, int *icp, /*>*/ double *tcpu, double *twall);
void cntc_resetcalculationtime(int *ire, int *icp);
void subs_getblocksize(int *ire, int *icp, int *iblk, /*>*/ int *nx, int *ny, int *nz);
void subs_getresults(int *ire, int *icp, int *iblk, int *lenarr, int *ncol, int *icol, /*>*/ double *values);

#ifdef __cplusplus
}
#endif

#endif
