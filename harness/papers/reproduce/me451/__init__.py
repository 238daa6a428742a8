"""The ME451 slides: joints, gears and cams."""
