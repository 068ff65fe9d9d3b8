#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# What became of a Slurm job, for Snakemake: success, running or failed. Asks
# the controller, and the accounting, if there is any, once that has forgotten.
# A job that nobody knows has failed: parts may always run again.
set -u
state="$(scontrol --oneliner show job "$1" 2>/dev/null |
  sed -nE 's/.* JobState=([A-Z_]+).*/\1/p')"
if [[ -z "$state" ]]; then
  state="$(sacct --noheader --parsable2 --allocations --format=State \
    --jobs="$1" 2>/dev/null | head -n 1)"
fi
case "$state" in
  COMPLETED) echo success ;;
  PENDING | CONFIGURING | RUNNING | COMPLETING | SUSPENDED | REQUEUED | \
    REQUEUE_HOLD | RESIZING | SIGNALING | STAGE_OUT | STOPPED)
    echo running ;;
  *) echo failed ;;
esac
