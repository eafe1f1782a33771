"""The library's kernels for browsers: compiled ahead of time to WebAssembly, from the same source."""
