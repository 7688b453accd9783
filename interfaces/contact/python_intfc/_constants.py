# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Constants of contact_addon.h, without CNTC_."""

CNTC = {
    "if_units": 1933, "un_cntc": 1934, "un_spck": 1935, "un_si": 1936, "un_imper": 1937, "inp_vamp": 1984,
    "inp_modul1": 1988, "inp_spck": 1990, "inp_gensys": 1992, "ic_config": 1967, "ic_pvtime": 1970, "ic_bound": 1971,
    "ic_tang": 1972, "ic_norm": 1973, "ic_force": 1974, "ic_frclaw": 1976, "ic_discns": 1977, "ic_inflcf": 1978,
    "ic_mater": 1979, "ic_exrhs": 1980, "ic_xflow": 1981, "ic_heat": 1982, "ic_iestim": 1983, "ic_output": 1984,
    "ic_flow": 1985, "ic_return": 1986, "ic_matfil": 1987, "ic_sens": 1988, "ic_ifmeth": 1989, "ic_ifvari": 1990,
    "ic_sbsout": 1991, "ic_sbsfil": 1992, "ic_npomax": 1993, "if_idebug": 2000, "if_licdbg": 2001, "if_wrtinp": 2002,
    "if_openmp": 2003, "if_timers": 2004, "if_ncase": 2005, "fld_h": 1, "fld_mu": 2, "fld_px": 3, "fld_py": 4,
    "fld_pn": 5, "fld_ux": 7, "fld_uy": 8, "fld_un": 9, "fld_taucrt": 11, "fld_uplsx": 12, "fld_uplsy": 13,
    "fld_sx": 15, "fld_sy": 16, "fld_temp1": 20, "fld_temp2": 21, "fld_wx": 22, "fld_wy": 23, "mt_tim": 2011,
    "mt_xr": 2012, "mt_yr": 2013, "mt_xw": 2014, "mt_yw": 2015, "mt_sw": 2016, "mt_run": 2021, "mt_axle": 2022,
    "mt_side": 2023, "err_allow": -12, "err_search": -25, "err_ftot": -26, "err_broydn": -26, "err_norm": -27,
    "err_tang": -28, "err_tol": -29, "err_icp": -31, "err_profil": -32, "err_frclaw": -33, "err_discr": -34,
    "err_input": -39, "err_other": -99,
}
