"""A study as a job array on a Slurm of its own: one controller, one node, all on this machine.

Usage: slurm_test.py SCREE FOLDER. Needs root and Debian's slurmctld, slurmd, slurm-client and munge; status 77 (skipped) without them.
"""

import contextlib
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import time

SKIPPED = 77
NEEDED = ["munged", "mungekey", "slurmctld", "slurmd", "sbatch", "squeue", "sinfo"]

SCENE = """
materials: {ore: {density: 2500, conductivity: 3, specific_heat: 880, friction: 0.5}}
bodies:
  plate: {box: {size: [1, 1, 0.1], centre: [0, 0, -0.05]}, material: ore, mesh_size: 0.3, fixed: true}
  block: {box: {size: [0.2, 0.2, 0.2], centre: [0, 0, 0.11]}, material: ore, mesh_size: 0.2}
settle: {limit: 5 s}
heat:
  initial: 300
  boundaries: [{body: plate, temperature: 400}]
  until: 2 h
  tolerance: 1 K
output: {every: 1 h, probes: {top: {point: [0, 0, 0.15], reach: 2 cm}}}
"""

STUDY = """
scene: scene.yaml
vary: [{key: contact.stiffness_factor, values: [1, 10, 100]}]
report: [heat.probes.top.temperature]
"""

CONFIG = """
ClusterName=scree
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={controller}
SlurmdPort={node}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
CredType=cred/munge
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
MpiDefault=none
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs={processors} State=UNKNOWN
PartitionName=all Nodes={host} Default=YES State=UP MaxTime=INFINITE
"""


def skip(reason):
    print(f"skipped: {reason}")
    sys.exit(SKIPPED)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


def run(*command, **options):
    return subprocess.run(command, check=True, text=True, capture_output=True, **options).stdout


def wait_until(what, condition, seconds=60):
    end = time.monotonic() + seconds
    while not condition():
        if time.monotonic() > end:
            raise TimeoutError(what)
        time.sleep(0.2)


@contextlib.contextmanager
def daemon(name, command, folder, environment):
    """Runs a daemon in the foreground of a process group of its own, and ends it."""
    with open(folder / f"{name}.out", "w", encoding="utf-8") as log:
        process = subprocess.Popen(command, stdout=log, stderr=log, env=environment, start_new_session=True)
    try:
        yield process
    finally:
        process.send_signal(signal.SIGTERM)
        with contextlib.suppress(subprocess.TimeoutExpired):
            process.wait(10)
        process.kill()


@contextlib.contextmanager
def slurm(folder):
    """A cluster of this machine; gives the environment that finds it."""
    for name in ["state", "spool"]:
        (folder / name).mkdir()
    configuration = folder / "slurm.conf"
    configuration.write_text(CONFIG.format(host=socket.gethostname().split(".")[0], folder=folder, controller=free_port(),
                                           node=free_port(), processors=os.cpu_count()), encoding="utf-8")
    environment = dict(os.environ, SLURM_CONF=str(configuration))
    run("mungekey", "--create", "--keyfile", str(folder / "munge.key"))
    munged = ["munged", "--foreground", "--force", f"--key-file={folder}/munge.key", f"--socket={folder}/munge.socket",
              f"--pid-file={folder}/munge.pid", f"--log-file={folder}/munge.log", f"--seed-file={folder}/munge.seed"]
    with contextlib.ExitStack() as daemons:
        daemons.enter_context(daemon("munged", munged, folder, environment))
        wait_until("munge", (folder / "munge.socket").exists)
        daemons.enter_context(daemon("slurmctld", ["slurmctld", "-D", "-f", str(configuration)], folder, environment))
        daemons.enter_context(daemon("slurmd", ["slurmd", "-D", "-f", str(configuration)], folder, environment))

        def idle():
            answer = subprocess.run(["sinfo", "-h", "-o", "%T"], env=environment, text=True, capture_output=True, check=False)
            return answer.returncode == 0 and answer.stdout.strip() == "idle"

        wait_until("the node to be idle", idle)
        yield environment


def check_study(scree, folder, environment):
    """Submits the study as a user would, waits for its tasks and gathers them."""
    out, script = folder / "out", folder / "job.sh"
    study = [scree, "study", str(folder / "study.yaml"), "--out", str(out)]
    run(*study, "--slurm", str(script))
    job = run("sbatch", "--parsable", str(script), env=environment).strip()
    wait_until("the tasks", lambda: not run("squeue", "-h", "-j", job, env=environment).strip(), 120)
    run(*study, "--gather")
    rows = [line.split(",") for line in (out / "table.csv").read_text(encoding="utf-8").splitlines()]
    columns = {name: [row[i] for row in rows[1:]] for i, name in enumerate(rows[0])}
    assert columns["status"] == ["complete"] * 3, rows
    temperatures = [float(value) for value in columns["heat.probes.top.temperature"]]
    assert 300 < temperatures[0] < temperatures[1] < temperatures[2] < 400, temperatures
    packings = list((out / "packings").glob("*.h5"))
    assert len(packings) == 1, "the three tasks settle once"
    settled = [path for path in out.glob("runs/*/settle.pvd")]
    assert len(settled) == 1, settled


def main():
    scree, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    missing = [program for program in NEEDED if shutil.which(program) is None]
    if missing:
        skip(f"{', '.join(missing)} not there. As root: apt-get install slurmctld slurmd slurm-client munge")
    if os.geteuid() != 0:
        skip("a Slurm of its own needs root")
    shutil.rmtree(folder, ignore_errors=True)
    folder.mkdir(parents=True)
    (folder / "scene.yaml").write_text(SCENE, encoding="utf-8")
    (folder / "study.yaml").write_text(STUDY, encoding="utf-8")
    try:
        with slurm(folder) as environment:
            check_study(scree, folder, environment)
    except Exception:
        for log in [*folder.glob("*.out"), *folder.glob("out/slurm-*.log")]:
            print(f"--- {log}\n{log.read_text(encoding='utf-8', errors='replace')[-3000:]}")
        raise


main()
