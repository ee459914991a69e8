"""Sources are short enough to read, and no text of the repository names a place on somebody's machine."""

import re

import sources

MAX_LINES = 400
SHORT = {".h", ".cpp", ".py", ".cmake", ".in", ""}
PLAIN = SHORT | {".md", ".txt", ".yaml", ".json", ".gnuplot"}
# What an absolute path on a developer's machine looks like; relative ones and web addresses have something before the slash.
MACHINE_PATH = re.compile(r"(?<![\w.~})/-])/(?:work|home|root|Users|tmp/\w+-)\b[\w./-]*")


def check(texts):
    """Breaches in files given as {path: text}."""
    breaches = []
    for path, text in sorted(texts.items()):
        lines = text.splitlines()
        if len(lines) > MAX_LINES and suffix(path) in SHORT and path != "LICENSE":
            breaches.append(f"{path}: {len(lines)} lines, {MAX_LINES} at most: divide it by ideas")
        for number, line in enumerate(lines, 1):
            found = MACHINE_PATH.search(line)
            if found:
                breaches.append(f"{path}:{number}: {found.group()} is a place on one machine")
    return breaches


def suffix(path):
    name = path.rsplit("/", 1)[-1].lstrip(".")
    return "." + name.rsplit(".", 1)[1] if "." in name else ""


if __name__ == "__main__":
    files = [path for path in sources.tracked() if suffix(str(path)) in PLAIN]
    sources.finish("text", len(files), check(sources.read_all(files)))
