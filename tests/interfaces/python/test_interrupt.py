# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
"""Ctrl-C ends calls that take long, and leaves everything usable."""
import os
import signal
import threading
import time

import pytest

import treadmark as tm
from conftest import CASE

LONG = {**CASE, "discretisation.dx_mm": 0.1, "discretisation.ds_mm": 0.1, "discretisation.max_elements": 200000}
SOON = 2.0  # [s] from the signal to the end


@pytest.fixture
def interrupt_soon():
    """Sends the signal of Ctrl-C in a moment, and says how long ago that was."""
    sent = []

    def send():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)

    timer = threading.Timer(0.2, send)
    timer.start()
    yield lambda: time.monotonic() - sent[0]
    timer.cancel()


def test_a_run_ends(interrupt_soon):
    with pytest.raises(KeyboardInterrupt):
        tm.run({**LONG, "cases": [{"wheelset.y_mm": [0.01 * k for k in range(40)]}]})
    assert interrupt_soon() < SOON
    assert tm.run(CASE).cases[0].ok


def test_a_pair_ends_and_remembers(interrupt_soon, pair):
    pair.solve()
    before = pair.save().to_bytes()
    with pytest.raises(KeyboardInterrupt):
        for _ in range(100):
            pair.solve(dx=1e-4, ds=1e-4, max_elements=200000)
    assert interrupt_soon() < SOON and pair.solve().ok
    assert len(before) > 0


def test_many_problems_end(interrupt_soon, pair):
    with pytest.raises(KeyboardInterrupt):
        pair.solve(y=[1e-5 * k for k in range(400)], dx=2e-4, ds=2e-4)
    assert interrupt_soon() < 2 * SOON


def test_many_rows_end_and_leave_other_threads_to_work(interrupt_soon, pair):
    counted = []
    thread = threading.Thread(target=lambda: [counted.append(time.sleep(0.01)) for _ in range(10)])
    thread.start()
    with pytest.raises(KeyboardInterrupt):
        pair.solve_many(y_mm=[1e-5 * k for k in range(100000)], quantities=["pmax"])
    assert interrupt_soon() < SOON and counted
    thread.join()
    assert pair.solve().ok


def test_a_handler_of_ones_own_is_called():
    called = []
    before = signal.signal(signal.SIGINT, lambda *what: called.append(what))
    try:
        timer = threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT))
        timer.start()
        result = tm.run({**LONG, "cases": [{"wheelset.y_mm": [0.01 * k for k in range(40)]}]})
        assert called and not result.complete and len(result.cases) < 40  # what was finished
    finally:
        signal.signal(signal.SIGINT, before)
    assert signal.getsignal(signal.SIGINT) is before


def test_a_callback_hears_it_too():
    with pytest.raises(KeyboardInterrupt):
        tm.run({**CASE, "cases": [{"wheelset.y_mm": [0.01 * k for k in range(40)]}]},
               progress=lambda *what: os.kill(os.getpid(), signal.SIGINT), threads=1)
    assert tm.run(CASE).cases[0].ok
