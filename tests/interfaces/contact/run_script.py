# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""usage: run_script.py SCRIPT NAME...

Runs a script of CONTACT's users in this folder and prints, as JSON, variables that it leaves; all_fx are the F_x of its calculations.
Functions that scripts call and the package does not have any more are added, as scripts with the wrapper of later versions need it."""
import importlib.util
import json
import runpy
import sys

import numpy as np
import python_intfc as cntc

all_fx = []
ask_forces = cntc.getcontactforces


def getcontactforces(*arguments):
    forces = ask_forces(*arguments)
    all_fx.append(forces[1])
    return forces


def setmaterialproperties(ire, icp, g1, nu1, g2, nu2):
    cntc.setmaterialparameters(ire, icp, 0, [nu1, nu2, g1, g2])


def setinterfaciallayer(ire, icp, imeth, params):
    elastic = cntc.getparameters(ire, icp if isinstance(icp, int) else 1, 2)
    cntc.setmaterialparameters(ire, icp, imeth, [elastic["poiss1"], elastic["poiss2"], elastic["gg1"], elastic["gg2"], *params])


cntc.getcontactforces = getcontactforces
for function in (setmaterialproperties, setinterfaciallayer):
    if not hasattr(cntc, function.__name__):
        setattr(cntc, function.__name__, function)

left = runpy.run_module(sys.argv[1], run_name="__main__")
left["all_fx"] = all_fx
print(json.dumps({name: left[name] for name in sys.argv[2:]}, default=lambda x: x.tolist() if isinstance(x, (np.ndarray, np.generic)) else str(x)))
