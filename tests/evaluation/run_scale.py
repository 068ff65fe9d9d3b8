#!/usr/bin/env python3
# SPDX-License-Identifier: BSD-3-Clause
"""A street in one run and in parts: the figures of docs/scale.md.

  tests/evaluation/run_scale.py build/bin/colmap_curvix FOLDER [--views 60 120 240]

Writes scenes and results into FOLDER, where they stay for the next time. The
parts of the largest scene are reconstructed by Snakemake, too: on the cores of
this machine and, with --slurm, on a cluster of two nodes that
examples/cluster/local_slurm.sh makes of it; there a part is killed and a node
taken down. Needs NumPy and SciPy, snakemake, and for --slurm root and what the
head of that script names.
"""
import argparse
import json
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import numpy as np
from scipy.spatial import cKDTree

CLUSTER = Path(__file__).resolve().parents[2] / "examples/cluster"
MAX_VIEWS = 80
EDGES_PER_MEGAPIXEL = 50000  # the scene has more edges than most photographs
OPTIONS = ["--EdgeDetection.max_edges_per_megapixel", str(EDGES_PER_MEGAPIXEL)]
POSES_AS_GIVEN = ["--refiner", "none", "--refine_poses_with_curves", "0"]
RESULTS = ["curves.ply", "curves.json", "curves.txt", "edges.ply"]


def measure(command):
    """CPU seconds and peak megabytes of a command that must succeed."""
    process = subprocess.Popen([str(part) for part in command],
                               stdout=subprocess.DEVNULL,
                               stderr=subprocess.PIPE)
    message = process.stderr.read().decode()
    _, status, usage = os.wait4(process.pid, 0)
    if status != 0:
        sys.exit(f"{command}\nfailed:\n{message}")
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss / 1024


def evaluate(program, results, scene):
    text = subprocess.check_output(
        [program, "evaluate", "--json", "--curves_path", results / "curves.ply",
         "--truth_path", scene / "gt.txt"])
    return json.loads(text)


def owner(plan, place):
    node = "cut 0" if plan["cuts"] else "part 0"
    while node.startswith("cut"):
        cut = plan["cuts"][int(node[4:])]
        node = cut["below" if np.dot(cut["normal"], place) < cut["offset"]
                   else "above"]
    return node


def curves_of(path):
    curves = []
    for line in path.read_text().splitlines():
        if line.startswith("#"):
            continue
        fields = line.split()
        if len(fields) == 3:
            curves.append([])
        else:
            curves[-1].append([float(x) for x in fields[:3]])
    return [np.array(curve) for curve in curves if curve]


def whole_across_borders(plan, results, scene):
    """Of the true curves that lie in two cores or more: how many one drawn
    curve covers for nine tenths of what four views see, and how many there
    are."""
    truth = np.loadtxt(scene / "gt.txt")
    truth = truth[truth[:, 8] >= 4]
    drawn = curves_of(results / "curves.txt")
    tree = cKDTree(np.concatenate(drawn))
    curve_of = np.repeat(np.arange(len(drawn)), [len(c) for c in drawn])
    whole = crossing = 0
    for curve_id in np.unique(truth[:, 6]):
        samples = truth[truth[:, 6] == curve_id, :3]
        if len(samples) < 5:
            continue
        if len({owner(plan, x) for x in samples[::5]}) < 2:
            continue
        crossing += 1
        counts = {}
        for near in tree.query_ball_point(samples, 0.006):
            for curve in set(curve_of[near]):
                counts[curve] = counts.get(curve, 0) + 1
        whole += max(counts.values(), default=0) >= 0.9 * len(samples)
    return whole, crossing


def make_scene(program, folder, num_views):
    scene = folder / f"street_{num_views}"
    if not (scene / "gt.txt").exists():
        measure([program, "synthesize", "--workspace_path", scene,
                 "--solid", "facade", "--num_views", num_views,
                 "--width", 480, "--height", 360, "--noise", 1,
                 "--points_per_view", 20])
    return scene


def run_in_parts(program, scene, results):
    """Cost of each step: {"partition": (seconds, megabytes), ...}."""
    shutil.rmtree(results, ignore_errors=True)
    paths = ["--workspace_path", scene, "--output_path", results]
    costs = {"partition": measure([program, "partition", *paths,
                                   "--max_views_per_part", MAX_VIEWS])}
    plan = json.loads((results / "parts/plan.json").read_text())
    for part in plan["parts"]:
        costs[f"part {part['part']}"] = measure(
            [program, "reconstruct", *paths, "--part", part["part"],
             "--num_threads", 1, *OPTIONS])
    costs["merge"] = measure([program, "merge", *paths, *OPTIONS])
    return costs, plan


def print_scene(program, folder, num_views):
    scene = make_scene(program, folder, num_views)
    one, parts = folder / f"one_{num_views}", folder / f"parts_{num_views}"
    shutil.rmtree(one, ignore_errors=True)
    one_cost = measure([program, "--workspace_path", scene, "--output_path",
                        one, "--clean", "--num_threads", 1, *POSES_AS_GIVEN,
                        *OPTIONS])
    costs, plan = run_in_parts(program, scene, parts)
    of_parts = [cost for name, cost in costs.items() if name.startswith("part ")]
    print(f"\n{num_views} views, {len(of_parts)} parts")
    print(f"  one run    {one_cost[0]:7.1f} CPU s {one_cost[1]:6.0f} MB")
    print(f"  partition  {costs['partition'][0]:7.1f} CPU s "
          f"{costs['partition'][1]:6.0f} MB")
    print(f"  parts      {sum(c[0] for c in of_parts):7.1f} CPU s "
          f"{max(c[1] for c in of_parts):6.0f} MB, the largest")
    print(f"  merge      {costs['merge'][0]:7.1f} CPU s "
          f"{costs['merge'][1]:6.0f} MB")
    for name, results in (("one run", one), ("in parts", parts)):
        scores = evaluate(program, results, scene)
        length = json.loads((results / "report.json").read_text())
        whole, crossing = whole_across_borders(plan, results, scene)
        print(f"  {name:9}  Fv5 {scores['Fv5']:.2f}  P5 {scores['P5']:.2f}  "
              f"dup {scores['dup']:.3f}  whole {scores['whole']:.1f}  "
              f"curves {scores['curves']}  "
              f"length {length['result']['total_length']:.2f}  "
              f"whole across borders {whole} of {crossing}")
    return scene, parts


def compare(name, results, expected):
    different = [file for file in RESULTS
                 if (results / file).read_bytes() !=
                 (expected / file).read_bytes()]
    print(f"  {name}: " + (f"DIFFERS in {different}" if different else
                           "the same bytes as step by step"))


def snakemake(program, scene, results, log, *more):
    shutil.rmtree(results, ignore_errors=True)
    work = results.parent / (results.name + "_work")
    shutil.rmtree(work, ignore_errors=True)
    with open(log, "wb") as out:
        return subprocess.Popen(
            ["snakemake", "--snakefile", str(CLUSTER / "Snakefile"),
             "--directory", str(work), *more, "--config",
             f"workspace={scene}", f"results={results}", f"program={program}",
             f"max_views_per_part={MAX_VIEWS}",
             f"edges_per_megapixel={EDGES_PER_MEGAPIXEL}",
             f"options={' '.join(OPTIONS)}"],
            stdout=out, stderr=subprocess.STDOUT)


def jobs(*more):
    text = subprocess.check_output(["squeue", "--noheader", *more], text=True)
    return text.splitlines()


def is_on(process, node):
    try:
        environment = Path(f"/proc/{process}/environ").read_bytes()
    except OSError:
        return False
    return f"SLURMD_NODENAME={node}".encode() in environment.split(b"\0")


def disturb(cluster):
    """Kills a part on one node, and takes the other node down."""
    while not any("node2" in line for line in jobs("--states=R")):
        time.sleep(0.2)
    time.sleep(2)
    names = subprocess.run(["pgrep", "-x", "colmap_curvix"],
                           stdout=subprocess.PIPE, text=True).stdout.split()
    parts = [int(name) for name in names if is_on(name, "node1")]
    if parts:
        os.kill(random.choice(parts), signal.SIGKILL)
    subprocess.check_call([CLUSTER / "local_slurm.sh", "kill-node", cluster,
                           "node2"])
    return len(parts)


def run_on_slurm(program, scene, expected, folder):
    cluster = folder / "slurm"
    os.environ["SLURM_CONF"] = str(cluster / "slurm.conf")
    for name in ("undisturbed", "disturbed"):
        subprocess.check_call([CLUSTER / "local_slurm.sh", "start", cluster],
                              stdout=subprocess.DEVNULL)
        try:
            results = folder / f"slurm_{name}"
            flow = snakemake(program, scene, results,
                             folder / f"slurm_{name}.log", "--profile",
                             str(CLUSTER / "slurm"), "--latency-wait", "5")
            if name == "disturbed":
                print(f"  killed: a part, of {disturb(cluster)} on node1, and "
                      "node2")
            if flow.wait() != 0:
                sys.exit(f"Snakemake failed; see {folder}/slurm_{name}.log")
            compare(f"on Slurm, {name}", results, expected)
        finally:
            subprocess.check_call([CLUSTER / "local_slurm.sh", "stop", cluster])


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("program", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--views", type=int, nargs="+", default=[60, 120, 240])
    parser.add_argument("--slurm", action="store_true")
    args = parser.parse_args()
    program, folder = args.program.resolve(), args.folder.resolve()
    folder.mkdir(parents=True, exist_ok=True)
    for num_views in args.views:
        scene, parts = print_scene(program, folder, num_views)
    flow = snakemake(program, scene, folder / "snakemake",
                     folder / "snakemake.log", "--cores", "2")
    if flow.wait() != 0:
        sys.exit(f"Snakemake failed; see {folder}/snakemake.log")
    compare("Snakemake on two cores", folder / "snakemake", parts)
    if args.slurm:
        run_on_slurm(program, scene, parts, folder)


if __name__ == "__main__":
    main()
