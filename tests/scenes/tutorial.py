"""Does what scenes/TUTORIAL.md says, step by step, and looks at what comes of it.

    tutorial.py TUTORIAL.md FOLDER_OF_SCREE
"""

import csv
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

BLOCK = re.compile(r"(?:<!-- exit (?P<exit>\d+) -->\n)?```(?P<kind>yaml|sh)\n(?P<text>.*?)```", re.DOTALL)


def follow(tutorial, folder, environment):
    """Every block in order; returns how many there were of each kind."""
    count = {"yaml": 0, "sh": 0}
    for block in BLOCK.finditer(tutorial):
        count[block["kind"]] += 1
        if block["kind"] == "yaml":
            with open(folder / "my_pile.yaml", "a", encoding="utf-8") as scene:
                scene.write(block["text"])
            continue
        done = subprocess.run(["sh", "-e", "-c", block["text"]], cwd=folder, env=environment, capture_output=True, text=True)
        expected = int(block["exit"] or 0)
        if done.returncode != expected:
            sys.exit(f"exit {done.returncode}, not {expected}:\n{block['text']}\n{done.stdout}{done.stderr}")
        if expected and done.stderr.strip() not in re.sub(r"(?m)^    ", "", tutorial):
            sys.exit(f"the tutorial does not show what the program says:\n{done.stderr}")
    return count


def last_probe(table):
    rows = [row for row in csv.reader(table.read_text().splitlines()) if not row[0].startswith("#")]
    return float(rows[-1][1])


def look(folder):
    first = folder / "out" / "my_pile"
    summary = json.loads((first / "summary.json").read_text())
    assert summary["status"] == "complete", summary["status"]
    assert summary["blocks"] == 31
    assert summary["settle"]["reused"], "the pile fell again"
    assert summary["settle"]["at_rest"]
    assert summary["settle"]["certificate"]["coordination"]["mean_of_all"] > 1
    for name in ("settle.png", "heat.png", "report.html"):
        assert (first / name).stat().st_size > 10_000, name
    soft, stiff = last_probe(first / "probes.csv"), last_probe(folder / "out" / "stiffer" / "probes.csv")
    assert 293.15 < soft < stiff < 363.15, (soft, stiff)


def main():
    tutorial = pathlib.Path(sys.argv[1]).read_text(encoding="utf-8")
    environment = dict(os.environ, PATH=sys.argv[2] + os.pathsep + os.environ["PATH"])
    with tempfile.TemporaryDirectory() as folder:
        count = follow(tutorial, pathlib.Path(folder), environment)
        assert count["yaml"] >= 3 and count["sh"] >= 6, count
        look(pathlib.Path(folder))


main()
