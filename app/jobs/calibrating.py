"""Calibrate the machine of the server once, for all visitors: by a worker, beside whatever else there is to do."""

import asyncio
import logging

from solvers.accuracy.calibration import calibrate, known
from solvers.jit.compiling import NotCompiled

from ..views.tradeoff import stored_data
from .answers import KEPT
from .loops import of_loop
from .workers import LONG, Workers

COMPILING_SECONDS = 60.0  # after which the process that compiles has what the three solves need, as a rule
log = logging.getLogger("strikewave")


def calibrate_once() -> None:
    """Unless it is known how fast this machine is, measure it and keep that."""
    if known() is None:
        calibrate()


async def calibrate_machine() -> None:
    """Have a worker do it; what fails is left, as times that are stored can be shown as they were measured."""
    workers = of_loop(Workers)
    try:
        try:
            await workers.start(calibrate_once, level=LONG).answer
        except NotCompiled:
            await asyncio.sleep(COMPILING_SECONDS)
            await workers.start(calibrate_once, compiled=False).answer
        KEPT.forget(stored_data)  # whose times are scaled from now on
    except Exception as error:
        log.warning("this machine could not be calibrated (%s)", error)
