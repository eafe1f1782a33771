"""The web page and the command line over the library `solvers`."""
