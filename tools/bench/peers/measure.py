"""What the benchmarks beside other programs share: timing a process, and the tables they leave."""
import csv
import os
import pathlib
import platform
import resource
import statistics
import subprocess
import time

ROOT = pathlib.Path(__file__).resolve().parents[3]
SCREE = ROOT / "build/release/bin/scree"
DEBIAN_PYTHON = "/usr/bin/python3"


def run(words, folder, threads=1):
    """Wall and processor seconds and output of one process."""
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OPENBLAS_NUM_THREADS="1", OMPI_MCA_btl="self", FF_LOADPATH="/usr/lib/freefem++")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begin = time.perf_counter()
    done = subprocess.run(words, cwd=folder, env=environment, capture_output=True, text=True)
    wall = time.perf_counter() - begin
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode != 0:
        raise RuntimeError(f"{words[0]} failed: {done.stdout[-300:]} {done.stderr[-600:]}")
    return wall, processor, done.stdout


def machine():
    return f"machine: {platform.machine()}, {os.cpu_count()} processors, {platform.platform()}, load {os.getloadavg()[0]:.1f}"


def probe_rows(folder):
    """probes.csv of a run as a dictionary per row."""
    lines = [line for line in (folder / "probes.csv").read_text().splitlines() if not line.startswith("#")]
    return [dict(zip(lines[0].split(","), map(float, line.split(",")))) for line in lines[1:]]


def medians(found, keys):
    return {key: statistics.median(run[key] for run in found) for key in keys}


def write_table(rows, path):
    with open(path, "w", newline="") as table:
        writer = csv.DictWriter(table, fieldnames=list(rows[0]))
        writer.writeheader()
        writer.writerows(rows)


def append_to_record(rows, path):
    """A line per program and size, with the version of Scree that was timed."""
    version = subprocess.run([str(SCREE), "--version"], capture_output=True, text=True).stdout.split()[1]
    fresh = not path.exists()
    with open(path, "a", newline="") as table:
        writer = csv.DictWriter(table, fieldnames=["version", *rows[0]])
        if fresh:
            writer.writeheader()
        writer.writerows({"version": version, **{key: f"{value:.4g}" if isinstance(value, float) else value for key, value in row.items()}}
                         for row in rows)
