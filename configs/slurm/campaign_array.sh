#!/usr/bin/env bash
# A campaign as a job array: each task does one shard, with as many threads as it has cores.
#
#   sbatch --array=1-16 configs/slurm/campaign_array.sh configs/05_estimators_campaign.yaml FOLDER
#   gapscope campaign merge FOLDER/shard_* -o FOLDER/whole          (when all tasks are done)
#
# The array must begin at 1. A task that was killed or ran out of time goes on where it was: submit the same again.
#SBATCH --job-name=gapscope
#SBATCH --ntasks=1
#SBATCH --cpus-per-task=1
#SBATCH --array=1-4
set -euo pipefail
[ $# -eq 2 ] || { echo "usage: sbatch --array=1-N $0 CONFIG FOLDER" >&2; exit 2; }
shard="$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT"
exec "${GAPSCOPE:-gapscope}" campaign "$1" -o "$2/shard_$SLURM_ARRAY_TASK_ID" --shard "$shard" \
  -j "${SLURM_CPUS_PER_TASK:-1}" --quiet
