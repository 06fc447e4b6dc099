#!/usr/bin/env python3
"""Runs the job scripts of docs/slurm/ and compares their file with that of one run.

Usage: slurm_script_test.py PROGRAM SOURCES

First as Slurm would, task by task, with the variables that it sets, of which one part is made
again. Then by a Slurm of one machine, which is started for it where slurmctld, slurmd and munged are
installed and may be run (Debian: slurm-wlm, as root).
"""

import contextlib
import os
import pathlib
import secrets
import shutil
import socket
import subprocess
import sys
import tempfile
import time

PARTS = 3
OPTIONS = ["--patches", "300", "--tolerance", "0.01"]
LONGEST = 120  # s
CONFIGURATION = """ClusterName=test
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmdPort={ports[1]}
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket
SlurmUser=root
SlurmdUser=root
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
SelectType=select/cons_tres
SelectTypeParameters=CR_Core
ReturnToService=2
NodeName={host} NodeAddr=127.0.0.1 CPUs=1 RealMemory=1000 State=UNKNOWN
PartitionName=all Nodes={host} Default=YES MaxTime=INFINITE State=UP
"""


def run(words, folder, **more):
    subprocess.run(words, cwd=folder, check=True, timeout=LONGEST, stdout=subprocess.DEVNULL,
                   env={**os.environ, **more})


def compare(folder):
    if (folder / "F.h5").read_bytes() != (folder / "whole.h5").read_bytes():
        sys.exit("the merged file is not that of one run")


def by_hand(folder, scripts, scene, path):
    def task(k):
        run([scripts / "array.sbatch", str(PARTS), scene, "F.h5", *OPTIONS], folder, PATH=path,
            SLURM_ARRAY_TASK_ID=str(k), SLURM_CPUS_PER_TASK="1", SLURM_MEM_PER_NODE="2000")
    for k in (3, 1, 2, 2):
        task(k)
    first = (folder / f"F.1-of-{PARTS}.h5").read_bytes()
    (folder / f"F.1-of-{PARTS}.h5").unlink()
    task(1)
    if (folder / f"F.1-of-{PARTS}.h5").read_bytes() != first:
        sys.exit("a part that was made again is another one")
    run([scripts / "merge.sbatch", str(PARTS), "F.h5"], folder, PATH=path)
    compare(folder)


def free_ports(n):
    with contextlib.ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket()) for _ in range(n)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


@contextlib.contextmanager
def local_slurm():
    """The environment of a Slurm of this machine alone, whose folder is that of its files."""
    with tempfile.TemporaryDirectory() as name, contextlib.ExitStack() as stack:
        folder = pathlib.Path(name)
        folder.chmod(0o711)  # as munged wants it
        for sub in ("state", "spool"):
            (folder / sub).mkdir()
        (folder / "key").write_bytes(secrets.token_bytes(1024))
        (folder / "key").chmod(0o400)
        host = socket.gethostname().split(".")[0]
        (folder / "slurm.conf").write_text(
            CONFIGURATION.format(host=host, ports=free_ports(2), folder=folder))
        env = {**os.environ, "SLURM_CONF": str(folder / "slurm.conf")}
        for words in (["munged", "--foreground", "--force", f"--socket={folder}/munge.socket",
                       f"--key-file={folder}/key", f"--pid-file={folder}/munged.pid",
                       f"--seed-file={folder}/seed", f"--log-file={folder}/munged.log"],
                      ["slurmctld", "-D"], ["slurmd", "-D", "-N", host]):
            process = subprocess.Popen(words, env=env, stdout=subprocess.DEVNULL,
                                       stderr=subprocess.DEVNULL)
            stack.callback(process.wait)
            stack.callback(process.terminate)
            time.sleep(1)
        for _ in range(40):
            state = subprocess.run(["sinfo", "-h", "-o", "%T"], env=env, capture_output=True,
                                   text=True, check=False).stdout.strip()
            if state == "idle":
                break
            time.sleep(0.5)
        yield env if state == "idle" else None


def by_slurm(folder, scripts, scene, path):
    if os.geteuid() != 0 or not all(map(shutil.which, ("slurmctld", "slurmd", "munged", "sbatch"))):
        print("there is no Slurm here: its own run of the scripts is left out")
        return
    with local_slurm() as env:
        if env is None:
            print("Slurm does not start here: its own run of the scripts is left out")
            return
        small = ["--cpus-per-task=1", "--mem=600M", "--wait"]
        run(["sbatch", *small, f"--array=1-{PARTS}", scripts / "array.sbatch", str(PARTS), scene,
             "F.h5", *OPTIONS], folder, **{**env, "PATH": path})
        run(["sbatch", *small, scripts / "merge.sbatch", str(PARTS), "F.h5"], folder,
            **{**env, "PATH": path})
        compare(folder)
        print("Slurm has run the scripts")


def main(program, sources):
    program, sources = (pathlib.Path(path).resolve() for path in (program, sources))
    scene = str(sources / "scenes" / "cornell-box.json")
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "bin").mkdir()
        (folder / "bin" / "radiosity").symlink_to(program)
        path = f"{folder / 'bin'}:{os.environ['PATH']}"
        run([program, "form-factors", scene, *OPTIONS, "-o", "whole.h5", "--quiet"], folder)
        for way in (by_hand, by_slurm):
            way(folder, sources / "docs" / "slurm", scene, path)
            for part in folder.glob("F*.h5"):
                part.unlink()


if __name__ == "__main__":
    main(*sys.argv[1:])
