"""Every row of docs/reproduction.md that differs says why, or that it is not known: check_notes.py PROJECT."""

import pathlib
import re
import sys


def main():
    page = (pathlib.Path(sys.argv[1]) / "docs/reproduction.md").read_text(encoding="utf-8")
    noted = set(re.findall(r"^- ([A-Za-z0-9-]+): ", page, re.M))
    rows = [line.split("|") for line in page.splitlines() if line.startswith("| ") and "**differs**" in line]
    missing = [row[1].strip() for row in rows if row[1].strip() not in noted]
    for name in missing:
        print(f"FAIL: docs/reproduction.md: {name} differs and has no explanation")
    if not rows:
        print("FAIL: docs/reproduction.md has no rows that differ: is the table another one?")
    print(f"{len(rows)} rows differ, {len(missing)} without a note")
    return 1 if missing or not rows else 0


if __name__ == "__main__":
    sys.exit(main())
