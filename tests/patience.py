"""How long tests wait for another process: so long that only what hangs takes it, however busy the machine."""

SECONDS = 1_200.0
