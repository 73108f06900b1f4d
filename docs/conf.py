# The documentation as a site: `make site` (Sphinx with MyST, both of Debian). The pages are the Markdown files of the
# project as they are; this file alone has what a site needs beside them: which pages, in which order.
import re
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
FRONT = "README"

# Headings of the navigation and the pages below them (paths without .md).
NAVIGATION = {
    "First steps": ["docs/getting-started", "docs/tutorials/README", "docs/gallery", "docs/glossary"],
    "Reference": ["docs/case-reference", "docs/output", "docs/sweeps", "docs/clusters", "docs/python", "docs/library"],
    "Theory": ["docs/theory", "docs/friction-update", "docs/rotation-length"],
    "What it reaches": ["docs/reproduction", "docs/preparation", "docs/full-runs", "docs/performance"],
    "The project": ["docs/architecture", "CONTRIBUTING", "CHANGELOG"],
}
# Pages with pages below them: those of a folder, in the order in which the page links to them.
PARENTS = {"docs/theory": "docs/theory", "docs/tutorials/README": "docs/tutorials"}

project = "Scree"
author = "the authors of Scree"
extensions = ["myst_parser"]
root_doc = FRONT
include_patterns = ["README.md", "CONTRIBUTING.md", "CHANGELOG.md", "docs/**.md"]
exclude_patterns = ["build*", "out*", "src", "tests", ".git"]
myst_heading_anchors = 4
highlight_language = "none"
html_theme = "sphinx_rtd_theme"
html_title = "Scree"
html_copy_source = False
html_static_path = ["site.css"]
html_css_files = ["site.css"]
html_show_sphinx = False
html_show_copyright = False
html_theme_options = {"navigation_depth": 3, "collapse_navigation": True}


def tree(caption, pages):
    """A table of contents that is seen in the navigation alone."""
    entries = "\n".join(f"/{page}" for page in pages)
    heading = f":caption: {caption}\n" if caption else ""
    return f"\n\n```{{toctree}}\n:hidden:\n{heading}\n{entries}\n```\n"


def linked_pages(text, page, folder):
    """Pages of a folder in the order in which the text of a page links to them."""
    found = []
    for link in re.findall(r"\]\(([^)#:]+)\.md", text):
        target = ((ROOT / page).parent / link).resolve()
        name = target.relative_to(ROOT).as_posix()
        if name.startswith(folder + "/") and name != page and name not in found:
            found.append(name)
    return found


def add_navigation(app, page, source):
    """Adds to a page, as it is read, the table of contents that the Markdown file does not have."""
    if page == FRONT:
        source[0] += "".join(tree(caption, pages) for caption, pages in NAVIGATION.items())
    elif page in PARENTS:
        source[0] += tree("", linked_pages(source[0], page, PARENTS[page]))


def add_start(app, error):
    """index.html leads to the front page, for servers that look for it."""
    if not error:
        (Path(app.outdir) / "index.html").write_text(
            f'<!DOCTYPE html><title>Scree</title><meta http-equiv="refresh" content="0; url={FRONT}.html">'
            f'<a href="{FRONT}.html">Scree</a>\n', encoding="utf-8")


def setup(app):
    """What Sphinx calls before it begins."""
    app.connect("source-read", add_navigation)
    app.connect("build-finished", add_start)
    return {"parallel_read_safe": True, "parallel_write_safe": True}
