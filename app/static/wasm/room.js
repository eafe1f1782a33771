// Sizes of the arrays that kernels work in, and places of figures: written by app/wasm/build.py.
export const ROOM = {
  line: 546,
  rows: 2624,
  coefficients: 2560,
  degrees: 64,
  jumps: 400,
  waveTime: 3200,
  wave: 3200,
  forceTime: 1801,
  force: 1801,
  mass: 301,
  end: 301,
  whole: 301,
  contacts: 448,
  out: 10,
};
export const OUT = {
  impulse: 0,
  target: 1,
  compressing: 2,
  energy: 3,
  contacts: 5,
  duration: 7,
  wavePoints: 8,
  forcePoints: 9,
};
