"""Every C++ source is as clang-format would write it: check_format.py CLANG_FORMAT."""

import subprocess
import sys

import sources

if __name__ == "__main__":
    files = [str(path) for path in sources.cpp_sources()]
    run = subprocess.run([sys.argv[1], "--dry-run", "-Werror", *files], cwd=sources.ROOT, check=False, capture_output=True, text=True)
    unformatted = {line.split(":")[0] for line in run.stderr.splitlines() if ": error: " in line}
    breaches = [f"{path}: run clang-format-14 -i on it" for path in sorted(unformatted)]
    if run.returncode and not breaches:
        breaches = [run.stderr]
    sources.finish("format", len(files), breaches)
