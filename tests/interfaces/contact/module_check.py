# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""usage: module_check.py WRAPPER

The package for Python has every function and constant of CONTACT's own wrapper, and no function of it fails on sound arguments."""
import importlib.util
import re
import sys
import pathlib

import numpy as np
import python_intfc as cntc

wrapper = pathlib.Path(sys.argv[1])
names = re.findall(r"^from \.\w+\s+import \w+\s+as (\w+)", (wrapper / "__init__.py").read_text(), re.M)
assert len(names) >= 60, names
missing = [name for name in names if not callable(getattr(cntc, name, None))]
assert not missing, missing
spec = importlib.util.spec_from_file_location("magic", wrapper / "cntc_getmagicnumbers.py")
magic = importlib.util.module_from_spec(spec)
spec.loader.exec_module(magic)
assert magic.cntc_getmagicnumbers() == cntc.getmagicnumbers()

CNTC = cntc.initlibrary()[0]
assert cntc.initialize(2, 1)[1] == 0
ire = 2
cntc.setflags(ire, [], [CNTC["if_units"], CNTC["ic_config"], CNTC["ic_tang"], CNTC["ic_sens"]], [CNTC["un_cntc"], 1, 3, 3])
assert cntc.getflags(ire, [], [CNTC["ic_config"], CNTC["ic_norm"]]).tolist() == [1, 0]
cntc.setmaterialproperties(ire, [], 82000, 0.28, 82000, 0.28)
cntc.setpotcontact(ire, [], -1, [0.5, 0.5, np.pi / 2, 8, 4])
cntc.setrollingstepsize(ire, [], [], 1)
cntc.settrackdimensions(ire, 3, [14, 0, 1435, 0, 0, 0, 0, 0, 0, 0, 0])
cntc.setwheelsetdimensions(ire, 3, [1360, -70, 460])
y = np.linspace(-35, 35, 141)
cntc.setprofileinputvalues(ire, np.column_stack([y, y**2 / 600]), [0, 0, 0, -1])
y = np.linspace(60, -35, 141)
cntc.setprofileinputvalues(ire, np.column_stack([y, -y / 40]), [1, 0, 0, -1])
assert cntc.getprofilevalues(ire, -1, [1]).tolist() == [0, 0]
assert cntc.getprofilevalues(ire, 0, [0, 0]) == 141
section = cntc.getprofilevalues(ire, 1, [0, 0])
assert section.shape == (141, 2) and abs(section[0, 0] + 35) < 1e-9
assert cntc.getprofilevalues(ire, 4, [0, 1], [10.0]).ndim == 1
cntc.setwheelsetposition(ire, 2, [0, 0, 0, 0, 0, 0])
cntc.setwheelsetvelocity(ire, 2, [2000, 0, 0, 0, 0, -2000 / 460])
cntc.setwheelsetflexibility(ire, 4, [0, 0.5] + 10 * [0])
cntc.setverticalforce(ire, 50e3)
assert cntc.calculate(ire) == 0
assert cntc.getnumcontactpatches(ire) == 1
assert abs(cntc.getglobalforces(ire)[2] - 50e3) < 5
assert cntc.getcontactlocation(ire, 1).shape == (38,)
mx, my = cntc.getnumelements(ire, 1)
for array in (*cntc.gettractions(ire, 1), *cntc.getmicroslip(ire, 1), *cntc.getdisplacements(ire, 1), cntc.getelementdivision(ire, 1),
              cntc.getfielddata(ire, 1, CNTC["fld_mu"])):
    assert array.shape == (my, mx)
assert abs(cntc.gettractions(ire, 1)[0].sum() * 0.25 - cntc.getcontactforces(ire, 1)[0]) < 1
assert cntc.getsensitivities(ire, 1, 4, 4).shape == (4, 4)
assert cntc.getsensitivities(ire, 1, 4, 4)[0, 0] > 0
areas = cntc.getcontactpatchareas(ire, 1)
assert len(areas) == 4 and areas[3] == 0
assert cntc.getpotcontact(ire, 1)[:2] == (mx, my)
assert cntc.getgriddiscretization(ire, -1) == (0.5, 0.5)
assert cntc.getparameters(ire, 1, 3)["fstat"] == [0.3]
assert cntc.getparameters(ire, 1, 2)["gg1"] == 82000
assert cntc.getcalculationtime(ire, 1)[1] > 0
assert cntc.subs_getresults(ire, 1, 1).shape == (21, 0)
cntc.finalize(ire)
cntc.closelibrary()
print("the package has all functions")
