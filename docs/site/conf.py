"""What Sphinx is told. `docs.site` calls it; nothing in what it writes asks a network."""

import os

import mechanism_fmu

project = "mechanism_fmu"
author = "the authors of mechanism_fmu"
copyright = "MIT licence"
version = release = mechanism_fmu.__version__

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "docs.site.mathml",
    "docs.site.live",
    "docs.site.api",
]
exclude_patterns = ["drawings", "README.md"]
myst_enable_extensions = ["dollarmath", "html_image", "attrs_inline", "deflist", "colon_fence"]
myst_heading_anchors = 4
myst_dmath_double_inline = True
# Names that two modules pass on, as `MechanismError`; languages without colours, as csv.
suppress_warnings = ["ref.python", "misc.highlighting_failure"]
default_role = "code"
nitpicky = False

autodoc_member_order = "bysource"
autodoc_typehints = "none"
napoleon_attr_annotations = False
smartquotes = False
autodoc_class_signature = "mixed"
napoleon_google_docstring = True
napoleon_numpy_docstring = False
napoleon_use_ivar = True
napoleon_custom_sections = [("Source", "params_style")]
add_module_names = False

html_theme = "pydata_sphinx_theme"
html_title = "mechanism_fmu"
html_static_path = ["static"]
html_css_files = ["site.css"]
html_js_files = ["site.js"]
html_math_renderer = "mathml"
html_extra_path = [os.environ["SITE_EXTRA"]]
html_show_sourcelink = False
html_copy_source = False
# Summaries would be fetched, which a browser refuses for files.
html_show_search_summary = False
html_context = {"default_mode": "auto"}
html_sidebars = {"index": [], "gallery": []}
html_theme_options = {
    "navbar_align": "left",
    "header_links_before_dropdown": 6,
    "show_toc_level": 2,
    "navigation_with_keys": False,
    "secondary_sidebar_items": ["page-toc"],
    "footer_start": ["copyright"],
    "footer_end": [],
    "pygments_light_style": "a11y-high-contrast-light",
    "pygments_dark_style": "a11y-high-contrast-dark",
}
