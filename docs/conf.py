"""How Sphinx makes the site: `poe docs` writes it to build/docs, with no script or font from elsewhere."""

import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[1]
sys.path.insert(0, str(ROOT))

from jumpcad.face import __version__  # noqa: E402

project = "jumpcad"
release = version = __version__
copyright = "the jumpcad developers, MIT licence"

extensions = [
    "myst_parser",
    "sphinx.ext.autodoc",
    "sphinx.ext.napoleon",
    "sphinx_copybutton",
]
html_theme = "furo"
html_title = f"jumpcad {__version__}"
html_show_sphinx = False
myst_heading_anchors = 3
napoleon_google_docstring = False
napoleon_use_ivar = True
autodoc_member_order = "bysource"
autodoc_typehints = "description"
default_role = "code"
