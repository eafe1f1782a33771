"""The clock that long loops ask, which only browsers have: nobody there waits for an answer in another thread."""

from .kernels import inner_kernel


@inner_kernel
def check_time():
    """Nothing, of which no code is left. Where kernels are compiled for browsers, `app.wasm.build` puts a call in its
    place that does not come back once the time for an answer is over: the kernel is left, and what it wrote is void.
    """
