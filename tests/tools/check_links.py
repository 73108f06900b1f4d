"""Relative links of the Markdown files of the project: each points to a file or a folder that is there, and each #anchor to a
heading of its page. `check_links.py ROOT`; prints what is wrong, one line each, and ends with 1 if anything is."""
import re
import sys
import unicodedata
from pathlib import Path
from urllib.parse import unquote

LINK = re.compile(r"\]\(\s*<?([^)\s>]+)>?(?:\s+\"[^\"]*\")?\s*\)|\bsrc=\"([^\"]+)\"")
HEADING = re.compile(r"^ {0,3}(#{1,6})\s+(.*?)\s*#*\s*$")
FENCE = re.compile(r"^ {0,3}(```|~~~)")


def pages(root):
    """Markdown files that a reader is given."""
    return sorted([*root.glob("*.md"), *root.glob("docs/**/*.md"), *root.glob("tests/**/*.md")])


def prose(text):
    """Lines with their numbers, without blocks of code and without code within a line."""
    inside = False
    for number, line in enumerate(text.splitlines(), 1):
        if FENCE.match(line):
            inside = not inside
        elif not inside and not line.startswith("    "):
            yield number, line


def slug(heading):
    """The anchor that GitHub and MyST make of a heading."""
    text = re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", heading).replace("`", "").replace("*", "").lower()
    kept = (c for c in text if c in " -_" or unicodedata.category(c)[0] in "LN")
    return "".join(kept).replace(" ", "-")


def anchors(page, known):
    """All anchors of a page; a heading that is there twice gets -1 behind the second."""
    if page not in known:
        known[page] = set()
        for _, line in prose(page.read_text(encoding="utf-8")):
            match = HEADING.match(line)
            if match:
                base = name = slug(match.group(2))
                count = 0
                while name in known[page]:
                    count += 1
                    name = f"{base}-{count}"
                known[page].add(name)
    return known[page]


def wrong_links(root):
    """Yields "file:line: what is wrong" for each, and counts the links that were looked at."""
    known, count = {}, 0
    for page in pages(root):
        for number, line in prose(page.read_text(encoding="utf-8")):
            for match in LINK.finditer(re.sub(r"`[^`]*`", "``", line)):
                link = match.group(1) or match.group(2)
                if re.match(r"[a-z][a-z0-9+.-]*:", link):
                    continue
                count += 1
                path, _, anchor = unquote(link).partition("#")
                target = (page.parent / path).resolve() if path else page
                place = f"{page.relative_to(root)}:{number}: {link}"
                if not target.exists():
                    yield f"{place}: there is no such file"
                elif root not in [target, *target.parents]:
                    yield f"{place}: outside of the project"
                elif anchor and (target.suffix != ".md" or anchor not in anchors(target, known)):
                    yield f"{place}: there is no such heading"
    if count < 100:
        yield f"only {count} links were found: this test looks at the wrong place"


def main():
    """Prints what is wrong."""
    found = list(wrong_links(Path(sys.argv[1]).resolve()))
    print("\n".join(found) or "all links lead to something")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
