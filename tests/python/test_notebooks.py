"""Runs the code cells of docs/notebooks/*.ipynb, each notebook in a process of its own: test_notebooks.py SOURCE SCRATCH."""
import json
import shutil
import subprocess
import sys
from pathlib import Path

try:
    import numpy  # noqa: F401
except ImportError:
    print("skipped: NumPy is not installed (python3-numpy)")
    sys.exit(77)

source, scratch = Path(sys.argv[1]), Path(sys.argv[2])
shutil.rmtree(scratch, ignore_errors=True)
failures = 0
notebooks = sorted((source / "docs" / "notebooks").glob("*.ipynb"))
assert len(notebooks) >= 3, notebooks
for notebook in notebooks:
    content = json.loads(notebook.read_text(encoding="utf-8"))
    assert content["nbformat"] == 4 and content["metadata"]["kernelspec"]["language"] == "python"
    cells = ["".join(cell["source"]) for cell in content["cells"] if cell["cell_type"] == "code"]
    assert len(cells) >= 3, notebook
    folder = scratch / notebook.stem
    folder.mkdir(parents=True)
    (folder / "cells.py").write_text("\n\n".join(cells) + "\n", encoding="utf-8")
    done = subprocess.run([sys.executable, "cells.py"], cwd=folder)
    print(f"{notebook.name}: {len(cells)} cells, status {done.returncode}", flush=True)
    failures += done.returncode != 0
sys.exit(failures > 0)
