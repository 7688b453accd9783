# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Stresses below one element, by the package for Python; numbers of CONTACT."""
import numpy as np
import python_intfc as cntc

CNTC, version, error = cntc.initlibrary()
assert error == 0
ire, icp = 1, 1
cntc.initialize(ire, 3)
cntc.setflags(ire, icp, [CNTC["if_units"], CNTC["ic_norm"], CNTC["ic_tang"], CNTC["ic_pvtime"]], [CNTC["un_cntc"], 1, 0, 2])
cntc.setmaterialproperties(ire, icp, 1.0, 0.28, 1.0, 0.28)
cntc.sethertzcontact(ire, icp, -3, [1, 1, 0.5, 0.5, 1.0])
cntc.setreferencevelocity(ire, icp, 10000)
cntc.setnormalforce(ire, icp, 1)
cntc.setfrictionmethod(ire, icp, 0, [1.0, 1.0])
depths = [0.0, 0.1, 0.3, 0.5, 1.0, 2.5, 5.0]
across = [-5, -3, -2, -1, -0.8, -0.6, -0.4, -0.3, -0.2, -0.1, 0, 0.1, 0.2, 0.3, 0.4, 0.6, 0.8, 1, 2, 3, 5]
cntc.subs_addblock(ire, icp, 1, 9, [0.0], [0.0], depths)
cntc.subs_addblock(ire, icp, 2, 9, across, across, depths)
assert cntc.calculate(ire, icp) == 1  # the only element is at the border
assert cntc.subs_calculate(ire, icp) == 0
z, hydrostatic, mises = cntc.subs_getresults(ire, icp, 1, [3, 7, 8])
np.testing.assert_allclose(z, depths)
np.testing.assert_allclose(hydrostatic, [-0.853333, -0.702176, -0.448778, -0.284444, -0.109387, -0.020899, -0.005379], atol=1e-5)
np.testing.assert_allclose(mises, [0.22, 0.438178, 0.664177, 0.624662, 0.34008, 0.076071, 0.02011], atol=1e-5)
everything = cntc.subs_getresults(ire, icp, 2, "all")
assert everything.shape == (21, 21 * 21 * 7)
middle = (everything[0] == 0) & (everything[1] == 0)
np.testing.assert_allclose(everything[7][middle], mises, atol=1e-9)

cntc.setflags(ire, icp, [CNTC["ic_tang"], CNTC["ic_force"]], [3, 1])
cntc.settangentialforces(ire, icp, 0.999, 0)
assert cntc.calculate(ire, icp) == 1
assert cntc.subs_calculate(ire, icp) == 0
mises, tresca, ux = cntc.subs_getresults(ire, icp, 1, [8, 9, 4])
np.testing.assert_allclose(mises[[0, 1, 3, 4, 6]], [1.744247, 1.348665, 0.676144, 0.342655, 0.02011], rtol=1e-4)
np.testing.assert_allclose(tresca[[0, 1, 3, 4, 6]], [2.010074, 1.536618, 0.692455, 0.343508, 0.02011], rtol=1e-4)
np.testing.assert_allclose(ux[[0, 1, 3, 4, 6]], [0.482063, 0.38327, 0.175337, 0.094958, 0.019386], rtol=1e-4)
np.testing.assert_allclose(cntc.getcreepages(ire, icp)[0], -0.643026, rtol=1e-4)
cntc.finalize(ire)
cntc.closelibrary()
print("stresses agree")
