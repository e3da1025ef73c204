"""The documentation site: `sphinx-build -W docs out/site`, with what docs/requirements.txt names and the Python package itself."""

import squirmers

project = "squirmers"
author = "The squirmers developers"
copyright = author
version = release = squirmers.__version__

extensions = [
    "myst_nb",
    "numpydoc",
    "sphinx.ext.autodoc",
    "matplotlib.sphinxext.plot_directive",
]
exclude_patterns = ["requirements.txt"]

# Everything that refers to something has to find it.
nitpicky = True
nitpick_ignore_regex = [
    # Packages that are not part of this site, and words of numpydoc.
    (r"py:.*", r"(numpy|np|npt|pandas|xarray|matplotlib|collections|os)\..*"),
    (r"py:.*", r"(array_like|optional|default.*|shape|path|sequence.*|callable|mapping|None|True|False|\d.*|\{.*)"),
]

myst_heading_anchors = 3
# Words in the margin of a code block that no lexer knows.
suppress_warnings = ["misc.highlighting_failure"]

# Notebooks are run while the site is built: one that raises fails it.
nb_execution_mode = "force"
nb_execution_raise_on_error = True
nb_execution_timeout = 300
# What a notebook writes to its error stream, warnings too, fails the site.
nb_output_stderr = "error"

numpydoc_show_class_members = False
numpydoc_xref_param_type = False
autodoc_typehints = "none"
autodoc_member_order = "bysource"

plot_html_show_source_link = False
plot_html_show_formats = False
plot_formats = [("svg", 100)]

html_theme = "furo"
html_title = f"squirmers {release}"
