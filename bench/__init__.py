"""Speed and accuracy, measured: `make bench`. Ratios and medians within one run; never part of the tests."""
