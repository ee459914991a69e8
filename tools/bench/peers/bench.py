"""What the benchmarks beside other programs share: the machine, timing a process, tables, ratios at equal error and plots."""
import argparse
import collections
import csv
import math
import os
import pathlib
import platform
import re
import resource
import shutil
import statistics
import subprocess
import sys
import time

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[2]
SCREE = ROOT / "build/release/bin/scree"
DEBIAN_PYTHON = "/usr/bin/python3"  # the one that Debian's Python packages are installed for
PACKAGES = ("python3-dolfinx", "freefem++", "calculix-ccx", "yade", "liggghts", "libbullet3.24", "libopenblas0-pthread")
COLOURS = ("#c23b22", "#e08a1e", "#8c564b", "#3d4a8f", "#5b8c5a", "#7a6fb0", "#777777", "#c77ba8", "#4aa3a3")  # of programs in the plots
TIMES = ("processor", "wall", "loop")  # what rows state in seconds

# One way of doing the work: `run(size, folder)` gives a row's entries. Sizes above `largest` are left out without --long, those below
# `smallest` always.
Program = collections.namedtuple("Program", "name setting run installed largest smallest", defaults=(True, math.inf, 0))


def run(words, folder, threads=1):
    """Wall and processor seconds and output of one process."""
    environment = dict(os.environ, OMP_NUM_THREADS=str(threads), OPENBLAS_NUM_THREADS="1", OMPI_MCA_btl="self", FF_LOADPATH="/usr/lib/freefem++")
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    begin = time.perf_counter()
    done = subprocess.run([str(word) for word in words], cwd=folder, env=environment, capture_output=True, text=True)
    wall = time.perf_counter() - begin
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    processor = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    if done.returncode != 0:
        raise RuntimeError(f"{words[0]} failed: {done.stdout[-300:]} {done.stderr[-600:]}")
    return wall, processor, done.stdout


def version():
    return subprocess.run([str(SCREE), "--version"], capture_output=True, text=True).stdout.split()[1]


def machine():
    """A few lines: processor, memory, load, and the versions of what is compared."""
    model = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    memory = os.sysconf("SC_PAGE_SIZE") * os.sysconf("SC_PHYS_PAGES") / 2**30
    asked = subprocess.run(["dpkg-query", "-W", "-f=${Package} ${Version}\n", *PACKAGES], capture_output=True, text=True)
    release = re.search(r'PRETTY_NAME="(.*)"', pathlib.Path("/etc/os-release").read_text()).group(1)
    return (f"machine: {model.group(1) if model else platform.machine()}, {os.cpu_count()} cores, {memory:.0f} GB, {release}, "
            f"load {os.getloadavg()[0]:.1f} at the start\nversions: Scree {version()}, {', '.join(asked.stdout.split(chr(10))[:-1])}")


def parser(text, name, repeats):
    """The options that all benchmarks have."""
    result = argparse.ArgumentParser(description=text, formatter_class=argparse.RawDescriptionHelpFormatter)
    result.add_argument("--quick", action="store_true", help="small sizes and one repetition")
    result.add_argument("--long", action="store_true", help="the slow peers at the large sizes, too")
    result.add_argument("--repeats", type=int, default=repeats, help="of every row, of which the median counts")
    result.add_argument("--only", nargs="+", default=[], help="programs whose name begins so")
    result.add_argument("--record", action="store_true", help=f"append the table to tools/bench/record_{name}.csv, the record of changes")
    result.add_argument("--out", type=lambda word: pathlib.Path(word).resolve(), default=f"out/bench-{name}")
    return result


def python_has(module):
    return subprocess.run([DEBIAN_PYTHON, "-c", f"import {module}"], capture_output=True).returncode == 0


def probe_rows(folder):
    """probes.csv of a run as a dictionary per row."""
    lines = [line for line in (folder / "probes.csv").read_text().splitlines() if not line.startswith("#")]
    return [dict(zip(lines[0].split(","), map(float, line.split(",")))) for line in lines[1:]]


def medians(found, keys):
    return {key: statistics.median(run[key] for run in found) for key in keys}


def need(program, target):
    """Ends here if a program of ours has not been built."""
    if not program.exists():
        sys.exit(f"{program.relative_to(ROOT)}: not there; build it with: cmake --build build/release --target {target}")


def prepare(out):
    need(SCREE, "scree")
    out.mkdir(parents=True, exist_ok=True)
    (out / "machine.txt").write_text(machine() + "\n")
    print(machine())


def measure(programs, sizes, arguments):
    """A row per program and size, the programs of one size in turn; each is printed as it comes."""
    rows = []
    for size in sizes:
        for program in programs:
            name = f"{program.name}, {program.setting}"
            if arguments.only and not any(name.lower().startswith(word.lower()) for word in arguments.only):
                continue
            if size < program.smallest:
                continue
            if not program.installed or (size > program.largest and not arguments.long):
                print(f"{name}, {size}: " + ("left out (--long)" if program.installed else "not installed, left out"))
                continue
            folder = arguments.out / re.sub(r"\W+", "_", f"{name}_{size}")
            folder.mkdir(parents=True, exist_ok=True)
            found = [program.run(size, folder) for _ in range(1 if arguments.quick else arguments.repeats)]
            rows.append({"program": program.name, "setting": program.setting, **found[0], **medians(found, TIMES)})
            print_row(rows[-1])
    return rows


def shown(value):
    return f"{value:.4g}" if isinstance(value, float) else str(value)


def print_row(row):
    print("  ".join(f"{key} {shown(value)}" for key, value in row.items()), flush=True)


def write_table(rows, path):
    with open(path, "w", newline="") as table:
        writer = csv.DictWriter(table, fieldnames=list(rows[0]), lineterminator="\n")
        writer.writeheader()
        writer.writerows({key: shown(value) for key, value in row.items()} for row in rows)


def append_to_record(rows, path):
    """A line per program and size, with the version of Scree that was timed."""
    fresh = not path.exists()
    with open(path, "a", newline="") as table:
        writer = csv.DictWriter(table, fieldnames=["version", *rows[0]], lineterminator="\n")
        if fresh:
            writer.writeheader()
        writer.writerows({"version": version(), **{key: shown(value) for key, value in row.items()}} for row in rows)


def keep(name, rows, arguments):
    """The table in the output directory and, if asked for, in the record of changes."""
    write_table(rows, arguments.out / f"{name}.csv")
    if arguments.record:
        append_to_record(rows, HERE.parent / f"record_{name}.csv")


def cheapest(rows, error, measure):
    """Of the rows whose error is no larger."""
    return min((row for row in rows if row["error"] <= error and row[measure] == row[measure]), key=lambda row: row[measure], default=None)


def between(rows, error):
    """The processor seconds of exactly this error, on the straight line in logarithms between the two rows next to it."""
    front = sorted((row for row in rows if cheapest(rows, row["error"], "processor") is row), key=lambda row: row["error"])
    finer, coarser = ([row for row in front if (row["error"] <= error) == within] for within in (True, False))
    if not finer or not coarser:
        return finer[-1] if finer else None
    low, high = finer[-1], coarser[0]
    part = math.log(error / low["error"]) / math.log(high["error"] / low["error"])
    return {"processor": low["processor"] ** (1 - part) * high["processor"] ** part}


def ratios(rows, size, finer):
    """The fastest peer's seconds over Scree's, at the error of every peer that no other peer beats in both; for each size and, where larger is
    `finer` and not more work, over all: Scree may then take any size for any.

    Both sides count with their cheapest row whose error is no larger, so that only what was run counts; `interpolated` asks what Scree would
    take for the peer's error. Scree is the program "Scree"; its variants are neither side. Where it does not get to an error the ratio is
    empty.
    """
    result = []
    for only in [*sorted({row[size] for row in rows}), *(["any"] if finer else [])]:
        here = [row for row in rows if only in (row[size], "any")]
        ours = [row for row in (rows if finer else here) if row["program"] == "Scree"]
        peers = [row for row in here if not row["program"].startswith("Scree")]
        front = [row for row in peers if ours and cheapest(peers, row["error"], "processor") is row]
        for peer in sorted(front, key=lambda row: -row["error"]):
            mine = cheapest(ours, peer["error"], "processor")
            against = {f"{key}_ratio": ratio(cheapest(peers, peer["error"], key), cheapest(ours, peer["error"], key), key) for key in TIMES}
            result.append({size: only, "error": peer["error"], "peer": f"{peer['program']}, {peer['setting']}", f"peer_{size}": peer[size],
                           "scree": mine["setting"] if mine else "not reached", f"scree_{size}": mine[size] if mine else "",
                           "scree_error": mine["error"] if mine else "", **against,
                           "interpolated_ratio": ratio(peer, between(ours, peer["error"]), "processor")})
    return result


def ratio(peer, mine, key):
    return peer[key] / mine[key] if peer and mine else ""


def print_ratios(found, size):
    print("the fastest peer over Scree, at an error no larger (processor, wall, loop seconds; processor seconds at the same error):")
    for row in found:
        numbers = ", ".join(shown(row[f"{key}_ratio"]) or "-" for key in (*TIMES, "interpolated"))
        print(f"  {size} {row[size]}: error {row['error']:.3g} by {row['peer']} ({row[f'peer_{size}']} {size}); Scree {row['scree']}: {numbers}")


def finish(name, rows, size, arguments, title, error, finer=False):
    """The tables, the record and the plot of a benchmark whose rows state an error; `finer`: larger sizes do the same work more exactly."""
    keep(name, rows, arguments)
    found = ratios(rows, size, finer)
    if found:
        write_table(found, arguments.out / f"{name}_ratios.csv")
        print_ratios(found, size)
    plot(rows, arguments.out / f"{name}.png", title, (size, "error", error))


def plot(rows, path, title, axes):
    """Error against processor seconds, log-log: a curve per program and size, of which the colour says the program and the points the
    size. `axes`: what a row calls its size and its error, and the error's name. Rows without an error are left out."""
    size, error, label = axes
    rows = [row for row in rows if not math.isnan(row[error])]
    if not shutil.which("gnuplot"):
        print("gnuplot: not installed, no plot")
        return
    programs, sizes = list(dict.fromkeys(row["program"] for row in rows)), sorted({row[size] for row in rows})
    curves = collections.defaultdict(list)
    for row in rows:
        curves[row["program"], row[size]].append((row["processor"], row[error]))
    script = [f"set terminal pngcairo size 1100,640 font 'DejaVu Sans,13' background 'white'\nset output '{path}'\nset logscale xy",
              f"set title '{title}'\nset xlabel 'processor seconds'\nset ylabel '{label}'",
              "set key outside right top noenhanced\nset grid linetype 1 linecolor '#dddddd'\nset tics nomirror\nset border 3"]
    parts = []
    for n, ((program, number), points) in enumerate(curves.items()):
        script.append(f"$curve{n} << END\n" + "\n".join(f"{x:.6g} {y:.6g}" for x, y in sorted(points)) + "\nEND")
        colour = COLOURS[programs.index(program) % len(COLOURS)]
        parts.append(f"$curve{n} with linespoints linecolor '{colour}' pointtype {4 + sizes.index(number)} linewidth 1.5 notitle")
    parts += [f"NaN with lines linecolor '{COLOURS[n % len(COLOURS)]}' linewidth 3 title '{program}'" for n, program in enumerate(programs)]
    parts += [f"NaN with points linecolor 'black' pointtype {4 + n} title '{number:,} {size}'" for n, number in enumerate(sizes)]
    script.append("plot " + ", ".join(parts))
    subprocess.run(["gnuplot"], input="\n".join(script) + "\n", text=True, check=True)
