"""The slider-crank: crank, connecting rod and slider, with an offset if wanted."""
