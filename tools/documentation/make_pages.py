"""Makes the pages of the documentation that come from the program and the scenes: all keys, and a page per scene.

    make_pages.py SCREE SCENES PAGES
"""

import pathlib
import subprocess
import sys


def header(scene):
    """The comment a scene begins with, as Markdown: lines that are set in stay as they are."""
    lines = []
    for line in scene.splitlines():
        if not line.startswith("#"):
            break
        text = line[1:].removeprefix(" ")
        if text.startswith("  "):
            if lines and lines[-1] and not lines[-1].startswith("    "):
                lines.append("")
            lines.append("    " + text.strip())
        else:
            if lines and lines[-1].startswith("    "):
                lines.append("")
            lines.append(text)
    return "\n".join(lines).strip()


def keys_page(table):
    """The aligned table of `scree keys` as one of Markdown."""
    lines = [line for line in table.splitlines() if line.strip()]
    starts = [lines[0].index(name) for name in ("key", "value", "default", "meaning")] + [None]
    rows = []
    for line in lines:
        cells = [line[a:b].strip() for a, b in zip(starts, starts[1:])]
        rows.append("| " + " | ".join(
            cell.replace("\\", "\\\\").replace("|", "\\|").replace("*", "\\*").replace("<", "&lt;") for cell in cells) + " |")
    rows.insert(1, "| --- | --- | --- | --- |")
    return "# Every key of a scene {#keys}\n\n" + "\n".join(rows) + "\n"


def scene_page(path):
    scene = path.read_text(encoding="utf-8")
    return (f"# {path.name} {{#scene_{path.stem}}}\n\n{header(scene)}\n\n"
            f"    scree run scenes/{path.name}\n\n```yaml\n{scene}```\n")


def main():
    scree, scenes, pages = sys.argv[1], pathlib.Path(sys.argv[2]), pathlib.Path(sys.argv[3])
    pages.mkdir(parents=True, exist_ok=True)
    keys = subprocess.run([scree, "keys"], capture_output=True, text=True, check=True).stdout
    (pages / "keys.md").write_text(keys_page(keys), encoding="utf-8")
    names = sorted(scenes.glob("*.yaml"))
    for path in names:
        (pages / f"scene_{path.stem}.md").write_text(scene_page(path), encoding="utf-8")
    links = "\n".join(f"- [{path.name}](@ref scene_{path.stem}): "
                      f"{header(path.read_text(encoding='utf-8')).split(chr(10))[0]}" for path in names)
    (pages / "scenes.md").write_text(f"# A page per scene {{#scene_pages}}\n\n{links}\n", encoding="utf-8")


main()
