"""The files of the repository, for the checks beside this one."""

import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
CPP = {".h", ".cpp"}


def tracked(root=ROOT):
    """Files git tracks or would track, relative to the root; all but build, output and hidden ones outside a checkout."""
    git = ["git", "-C", str(root), "ls-files", "-z", "--cached", "--others", "--exclude-standard", "--deduplicate"]
    try:
        names = subprocess.run(git, capture_output=True, check=True, text=True).stdout.split("\0")
        files = [pathlib.PurePosixPath(name) for name in names if name]
    except (OSError, subprocess.CalledProcessError):
        found = (path.relative_to(root) for path in root.rglob("*"))
        files = [p for p in found if p.parts[0] not in ("build", "out") and not any(part.startswith(".") for part in p.parts)]
    return sorted(path for path in files if (root / path).is_file())


def cpp_sources(root=ROOT):
    return [path for path in tracked(root) if path.suffix in CPP]


def read_all(paths, root=ROOT):
    return {str(path): (root / path).read_text(encoding="utf-8") for path in paths}


def finish(check, count, breaches):
    """Prints what was found and leaves with the status CTest reads. No files at all is a broken check, not a clean one."""
    for breach in breaches:
        print(breach)
    print(f"{check}: {count} files, {len(breaches)} breaches")
    sys.exit(1 if breaches or count == 0 else 0)
