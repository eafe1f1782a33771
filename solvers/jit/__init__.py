"""How kernels are compiled and cached; nothing else in the library knows."""
