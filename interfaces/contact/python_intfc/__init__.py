# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""The functions of CONTACT's library version for Python, answered by Treadmark.

Functions are named as in the library, without cntc_; docs/contact-library.md says what each of them does. ire is a result element, icp a
contact problem or patch, -1 for the whole of a wheel on a rail; what is not an int, such as [], means the default. Arrays of elements have
the shape (my, mx)."""
import ctypes

import numpy as np

from ._constants import CNTC
from ._library import Out, call, cntc_dll, integer, ints, number, reals, value

_WHOLE, _FIRST = -1, 1


def _ire(ire):
    return ire if isinstance(ire, (int, np.integer)) else 1


def _icp(icp, default):
    return icp if isinstance(icp, (int, np.integer)) else default


def _text(text):
    data = str(text).encode("utf-8")
    return data, len(data)


def _counted(array):
    return len(array), array


# start and end


def getmagicnumbers():
    return dict(CNTC)


def initlibrary(wrkdir=" ", outdir=" ", expnam=" ", idebug=1):
    """[constants, version of the interface, error]"""
    (work, n_work), (out, n_out), (name, n_name) = _text(wrkdir), _text(outdir), _text(expnam)
    version, error = integer(), integer()
    call("cntc_initializefirst", version, error, 0, work, out, name, n_work, n_out, n_name)
    return [getmagicnumbers(), version.array.item(), error.array.item()]


def initialize(ire, imodul, outdir=" ", idebug=1):
    """[version of the interface, error]"""
    out, n_out = _text(outdir)
    version, error = integer(), integer()
    call("cntc_initialize", _ire(ire), imodul, version, error, out, n_out)
    return [version.array.item(), error.array.item()]


def setglobalflags(params, values):
    codes, given = ints(params), ints(values)
    call("cntc_setglobalflags", min(len(codes), len(given)), codes, given)


def getmaxnumthreads():
    return call("cntc_getmaxnumthreads", integer())


def finalize(ire=1):
    call("cntc_finalize", _ire(ire))


def finalizelast():
    call("cntc_finalizelast")


closelibrary = finalizelast


# settings


def setflags(ire, icp, params, values):
    codes, given = ints(params), ints(values)
    call("cntc_setflags", _ire(ire), _icp(icp, _WHOLE), min(len(codes), len(given)), codes, given)


def setmetadata(ire, icp, params, values):
    codes, given = ints(params), reals(values)
    call("cntc_setmetadata", _ire(ire), _icp(icp, _WHOLE), min(len(codes), len(given)), codes, given)


def setsolverflags(ire, icp, imeth, iparam, rparam):
    call("cntc_setsolverflags", _ire(ire), _icp(icp, _WHOLE), imeth, *_counted(ints(iparam)), *_counted(reals(rparam)))


def setmaterialparameters(ire, icp, m_digit, rparam):
    call("cntc_setmaterialparameters", _ire(ire), _icp(icp, _WHOLE), m_digit, *_counted(reals(rparam)))


def setmaterialproperties(ire, icp, g1, nu1, g2, nu2):
    call("cntc_setmaterialproperties", _ire(ire), _icp(icp, _WHOLE), float(g1), float(nu1), float(g2), float(nu2))


def setinterfaciallayer(ire, icp, imeth, params):
    call("cntc_setinterfaciallayer", _ire(ire), _icp(icp, _WHOLE), imeth, *_counted(reals(params)))


def settemperaturedata(ire, icp, imeth, params):
    call("cntc_settemperaturedata", _ire(ire), _icp(icp, _WHOLE), imeth, *_counted(reals(params)))


def settimestep(ire, icp, dt):
    call("cntc_settimestep", _ire(ire), _icp(icp, _FIRST), float(dt))


def setrollingstepsize(ire, icp, chi, dq):
    call("cntc_setrollingstepsize", _ire(ire), _icp(icp, _WHOLE), number(chi), number(dq))


def setfrictionmethod(ire, icp, imeth, params):
    call("cntc_setfrictionmethod", _ire(ire), _icp(icp, _WHOLE), imeth, *_counted(reals(params)))


def setpotcontact(ire, icp, ipotcn, params):
    call("cntc_setpotcontact", _ire(ire), _icp(icp, _WHOLE), ipotcn, *_counted(reals(params)))


def settangentialforces(ire, icp, fx, fy=0.0):
    call("cntc_settangentialforces", _ire(ire), _icp(icp, _FIRST), float(fx), number(fy))


# basic contact (module 3)


def setreferencevelocity(ire, icp, veloc):
    call("cntc_setreferencevelocity", _ire(ire), _icp(icp, _FIRST), float(veloc))


def sethertzcontact(ire, icp, ipotcn, params):
    call("cntc_sethertzcontact", _ire(ire), _icp(icp, _FIRST), ipotcn, *_counted(reals(params)))


def setpenetration(ire, icp, pen):
    call("cntc_setpenetration", _ire(ire), _icp(icp, _FIRST), float(pen))


def setnormalforce(ire, icp, fn):
    call("cntc_setnormalforce", _ire(ire), _icp(icp, _FIRST), float(fn))


def setundeformeddistc(ire, icp, ibase, prmudf):
    call("cntc_setundeformeddistc", _ire(ire), _icp(icp, _FIRST), ibase, *_counted(reals(prmudf)))


def setcreepages(ire, icp, vx, vy, phi):
    call("cntc_setcreepages", _ire(ire), _icp(icp, _FIRST), float(vx), float(vy), float(phi))


def setextrarigidslip(ire, icp, wx, wy):
    x, y = reals(wx), reals(wy)
    call("cntc_setextrarigidslip", _ire(ire), _icp(icp, _FIRST), min(len(x), len(y)), x, y)


# a wheel on a rail (module 1)


def readinpfile(ire, inp_type, fname):
    name, length = _text(fname)
    return call("cntc_readinpfile", _ire(ire), inp_type, name, length, integer())


def setverticalforce(ire, fz):
    call("cntc_setverticalforce", _ire(ire), float(fz))


def _profile_options(iparam, rparam, type_otherwise):
    whole = ints([type_otherwise] if iparam is None or np.size(iparam) == 0 else iparam)
    real = reals([-1.0, 0.0] if rparam is None or np.size(rparam) == 0 else rparam)
    return (*_counted(whole), *_counted(real))


def setprofileinputfname(ire, fname, iparam=None, rparam=None):
    name, length = _text(fname)
    call("cntc_setprofileinputfname", _ire(ire), name, length, *_profile_options(iparam, rparam, -1))


def setprofileinputvalues(ire, values, iparam=None, rparam=None):
    """values: y1, z1, y2, z2, ..., or rows of y and z."""
    points = reals(values)
    call("cntc_setprofileinputvalues", _ire(ire), len(points) // 2, points, *_profile_options(iparam, rparam, 0))


def settrackdimensions(ire, ztrack, params):
    call("cntc_settrackdimensions", _ire(ire), ztrack, *_counted(reals(params)))


def setwheelsetdimensions(ire, ewheel, params):
    call("cntc_setwheelsetdimensions", _ire(ire), ewheel, *_counted(reals(params)))


def setwheelsetposition(ire, ewheel, params):
    call("cntc_setwheelsetposition", _ire(ire), ewheel, *_counted(reals(params)))


def setwheelsetvelocity(ire, ewheel, params):
    call("cntc_setwheelsetvelocity", _ire(ire), ewheel, *_counted(reals(params)))


def setwheelsetflexibility(ire, ewheel, params):
    with_deviations = isinstance(ewheel, int) and ewheel >= 4
    call("cntc_setwheelsetflexibility", _ire(ire), ewheel if isinstance(ewheel, int) else 0, *_counted(reals(params if with_deviations else [])))


# solving

_MESSAGES = {-32: "a profile of rail or wheel is missing or bad", -26: "the total force was not found"}


def calculate(ire=1, icp=-1, idebug=1):
    error = call("cntc_calculate", _ire(ire), _icp(icp, _WHOLE), integer())
    if error < 0 and idebug >= 1:
        print("calculate: %s (%d)" % (_MESSAGES.get(error, "the calculation failed, the log says why"), error))
    return error


def subs_addblock(ire, icp, iblk, isubs, xparam, yparam, zparam):
    parts = [reals(p) for p in (xparam, yparam, zparam)]
    call("subs_addblock", _ire(ire), _icp(icp, _WHOLE), iblk, isubs, *map(len, parts), *parts)


def subs_calculate(ire=1, icp=-1, idebug=1):
    return call("subs_calculate", _ire(ire), _icp(icp, _WHOLE), integer())


# results


def _of_patch(function, ire, icp, *out):
    return call(function, _ire(ire), _icp(icp, _FIRST), *out)


def getflags(ire, icp, params):
    codes = ints(params)
    return call("cntc_getflags", _ire(ire), _icp(icp, _WHOLE), len(codes), codes, Out(len(codes), ctypes.c_int))


_PARAMETERS = {
    1: "veloc chi dq spinxo spinyo tau_c0",
    2: "gg1 gg2 gg poiss1 poiss2 poiss ak flx1 flx2 flx3 k0_mf alfamf betamf k_eff gg3 laythk tau_c0 k_tau cdampn cdampt dfnmax dftmax",
}


def getparameters(ire, icp, itask):
    """A dict of numbers: of rolling (1), material (2), friction (3)."""
    itask = itask if isinstance(itask, int) else 1
    count = 4
    found = call("cntc_getparameters", _ire(ire), _icp(icp, _FIRST), itask, 30, Out(30))
    if itask != 3:
        return dict(zip(_PARAMETERS[itask].split(), found.tolist()))
    sets = int(round(found[1]))
    size = count + 3 * sets
    found = call("cntc_getparameters", _ire(ire), _icp(icp, _FIRST), itask, size, Out(size))
    laws = found[count:].reshape(sets, 3).T.tolist()
    return {"lmeth": int(round(found[0])), "nvf": sets, "memdst": found[2], "mem_s0": found[3],
            "alpha": laws[0], "fstat": laws[1], "fkin": laws[2]}


def getprofilevalues(ire, itask, iparam=None, rparam=None):
    """Points of a profile and what belongs to them: arrays (n, 2) or (n, 3) of coordinates, (n,) of others."""
    options = (*_counted(ints([0, 0] if iparam is None or np.size(iparam) == 0 else iparam)),
               *_counted(reals([1.0] if rparam is None or np.size(rparam) == 0 else rparam)))

    def ask(task, size):
        return call("cntc_getprofilevalues", _ire(ire), task, *options, size, Out(size))

    if itask == -1:
        return ask(itask, 2).astype(int)
    points = int(ask(itask if itask > 5 else 0, 1)[0])
    if itask == 0:
        return points
    if itask == 3:
        return ask(itask, 6)
    columns = {1: 2, 2: 2, 4: 1, 5: 1}.get(itask, 3)
    found = ask(itask, columns * points)
    return found if columns == 1 else found.reshape((points, columns), order="F")


def getwheelsetposition(ire=1):
    return call("cntc_getwheelsetposition", _ire(ire), 6, Out(6))


def getwheelsetvelocity(ire=1):
    return call("cntc_getwheelsetvelocity", _ire(ire), 6, Out(6))


def getnumcontactpatches(ire=1):
    return call("cntc_getnumcontactpatches", _ire(ire), integer())


def getcontactlocation(ire=1, icp=1):
    return _of_patch("cntc_getcontactlocation", ire, icp, 38, Out(38))


def getreferencevelocity(ire=1, icp=1):
    return _of_patch("cntc_getreferencevelocity", ire, icp, value())


def gethertzcontact(ire=1, icp=1):
    return _of_patch("cntc_gethertzcontact", ire, icp, 10, Out(10))


def getnumelements(ire=1, icp=1):
    return _of_patch("cntc_getnumelements", ire, icp, integer(), integer())


def getgriddiscretization(ire=1, icp=1):
    return _of_patch("cntc_getgriddiscretization", ire, icp, value(), value())


def getpotcontact(ire=1, icp=1):
    found = _of_patch("cntc_getpotcontact", ire, icp, 6, Out(6))
    return (int(found[0]), int(found[1]), *found[2:].tolist())


def getpenetration(ire=1, icp=1):
    return _of_patch("cntc_getpenetration", ire, icp, value())


def getcreepages(ire=1, icp=1):
    return _of_patch("cntc_getcreepages", ire, icp, value(), value(), value())


def getcontactforces(ire=1, icp=1):
    return _of_patch("cntc_getcontactforces", ire, icp, value(), value(), value(), value())


def getglobalforces(ire=1, icp=-1):
    return call("cntc_getglobalforces", _ire(ire), _icp(icp, _WHOLE), 24, Out(24))


def getcontactpatchareas(ire=1, icp=1):
    """Areas of contact, adhesion, slip and plastic shear."""
    contact, adhesion, slip = _of_patch("cntc_getcontactpatchareas", ire, icp, value(), value(), value())
    return contact, adhesion, slip, contact - adhesion - slip


def _elements(ire, icp):
    mx, my = getnumelements(ire, icp)
    return my, mx


def getelementdivision(ire=1, icp=1):
    shape = _elements(ire, icp)
    return _of_patch("cntc_getelementdivision", ire, icp, shape[0] * shape[1], Out(shape, ctypes.c_int))


def getmaximumpressure(ire=1, icp=1):
    return _of_patch("cntc_getmaximumpressure", ire, icp, value())


def getmaximumtraction(ire=1, icp=1):
    return _of_patch("cntc_getmaximumtraction", ire, icp, value())


def getmaximumtemperature(ire=1, icp=1):
    return _of_patch("cntc_getmaximumtemperature", ire, icp, value(), value())


def getfielddata(ire, icp, ifld):
    shape = _elements(ire, icp)
    return _of_patch("cntc_getfielddata", ire, icp, ifld, shape[0] * shape[1], Out(shape))


def _fields(function, ire, icp, count):
    shape = _elements(ire, icp)
    return _of_patch(function, ire, icp, shape[0] * shape[1], *(Out(shape) for _ in range(count)))


def gettractions(ire=1, icp=1):
    return _fields("cntc_gettractions", ire, icp, 3)


def getmicroslip(ire=1, icp=1):
    return _fields("cntc_getmicroslip", ire, icp, 2)


def getdisplacements(ire=1, icp=1):
    return _fields("cntc_getdisplacements", ire, icp, 3)


def getsensitivities(ire, icp, lenout, lenin):
    return _of_patch("cntc_getsensitivities", ire, icp, lenout, lenin, Out((lenin, lenout))).T


def getcalculationtime(ire=1, icp=1):
    return _of_patch("cntc_getcalculationtime", ire, icp, value(), value())


def resetcalculationtime(ire=1, icp=1):
    _of_patch("cntc_resetcalculationtime", ire, icp)


def subs_getblocksize(ire=1, icp=1, iblk=1):
    return call("subs_getblocksize", _ire(ire), _icp(icp, _FIRST), iblk, integer(), integer(), integer())


def subs_getresults(ire, icp, iblk, icol="all"):
    """Columns of the results of a block of points: an array (columns, points). Of a block that is not there: no points."""
    columns = ints(range(1, 22) if isinstance(icol, str) or icol is None else icol)
    size = subs_getblocksize(ire, icp, iblk)
    points = max(0, size[0] * size[1] * size[2]) if min(size) > 0 else 0
    out = Out((len(columns), points))
    return call("subs_getresults", _ire(ire), _icp(icp, _FIRST), iblk, points, *_counted(columns), out)
