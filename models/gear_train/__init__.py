"""A pair of gears: a motor's pinion turns a wheel, slower and stronger, the other way round."""
