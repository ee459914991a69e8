"""Includes go one way, and foreign libraries stay in the room that wraps them."""

import re

import sources

# Each room and the rooms it may include, itself apart.
ENGINE = ["engine/base", "engine/mesh", "engine/packing", "engine/output", "engine/rigid"]
MAY_INCLUDE = {
    "engine/base": [],
    "engine/mesh": ["engine/base"],
    "engine/packing": ["engine/base", "engine/mesh"],
    "engine/output": ["engine/base", "engine/mesh", "engine/packing"],
    "engine/rigid": ["engine/base", "engine/mesh", "engine/packing"],
    "contact": ENGINE,
    "thermal": [*ENGINE, "contact"],
    "tools": [*ENGINE, "contact", "thermal"],
    "tests": [*ENGINE, "contact", "thermal", "tools"],
}

# A library's headers and the room that wraps it; the tests of that room may look behind the wrapping too, and a peer that is
# measured is what it is.
FOREIGN = {
    "Bullet": (re.compile(r"(bt[A-Z]\w*\.h|LinearMath/|Bullet\w+/)"), "engine/rigid"),
    "VTK": (re.compile(r"vtk\w*(\.h|/)"), "engine/output"),
    "Gmsh": (re.compile(r"gmshc?\.h"), "engine/mesh"),
}

INCLUDE = re.compile(r'^[ \t]*#[ \t]*include[ \t]*([<"])([^>"]+)[>"]', re.MULTILINE)


def room_of(path):
    return next((room for room in MAY_INCLUDE if path.startswith(room + "/")), None)


def at_home(path, home):
    return path.startswith((home + "/", "tests/" + home.split("/")[-1] + "/", "tools/bench/peers/"))


def check_own(path, header, texts):
    """A header of ours, included in quotes: it stands at that path from the root, in a room that may be included."""
    room, target = room_of(path), room_of(header)
    if header not in texts:
        return [f'{path}: "{header}" is no file from the root of the repository']
    if target != room and target not in MAY_INCLUDE[room]:
        return [f"{path}: {room} must not include {target} ({header})"]
    return []


def reaches(path, pattern, includes):
    """The chain of includes from a file to a header that matches, or nothing."""
    chains, seen = [[path]], {path}
    while chains:
        chain = chains.pop()
        for _, header in includes.get(chain[-1], []):
            if pattern.match(header):
                return [*chain, header]
            if header in includes and header not in seen:
                seen.add(header)
                chains.append([*chain, header])
    return []


def check(texts):
    """Breaches in sources given as {path from the root: text}."""
    includes = {path: INCLUDE.findall(text) for path, text in texts.items()}
    breaches = []
    for path in sorted(texts):
        if room_of(path) is None:
            breaches.append(f"{path}: belongs to no room that check_layers.py knows")
            continue
        for bracket, header in includes[path]:
            if bracket == '"':
                breaches += check_own(path, header, texts)
        for library, (pattern, home) in FOREIGN.items():
            chain = [] if at_home(path, home) else reaches(path, pattern, includes)
            if chain:
                breaches.append(f"{path}: {library} is for {home} alone ({' -> '.join(chain)})")
    return breaches


if __name__ == "__main__":
    files = sources.cpp_sources()
    sources.finish("layers", len(files), check(sources.read_all(files)))
