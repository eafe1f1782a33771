"""Memory that is let go of stays with the process for a while.

A solve makes arrays of megabytes and lets them go. The C library of Linux would give each back at once and fetch it
anew, page by page, which takes as long as the solve. It learns from the largest block that it was ever given back, up
to 32 MiB, to keep blocks as large as that, and twice as much in all: so it is given one back that was never used.
"""

import numpy as np

MOST_LEARNT = 2**25  # bytes
HEADER = 2**14  # bytes, at least what the library adds to it

np.empty(MOST_LEARNT - HEADER, np.uint8)
