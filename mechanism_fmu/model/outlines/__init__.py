"""Outlines of bodies: chains of straight segments and circular arcs, their areas, and SVG paths of them."""

from .outline import Outline as Outline
from .svg_paths import from_svg_path as from_svg_path, svg_path as svg_path
