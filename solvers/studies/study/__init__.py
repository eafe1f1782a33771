"""One scene at many points of its values: their design, their solving in processes, and what is kept of them."""
