#!/bin/bash
#SBATCH --job-name=quasilux-shards
#SBATCH --array=0-15
#SBATCH --cpus-per-task=8
#SBATCH --mem=4G
#SBATCH --time=01:00:00
#SBATCH --output=parts/%a.log
# Each task computes one part. Before: mkdir parts, and
#     quasilux plan "$PROJECT" --samples N --out plan.json
# A task that failed is run again by itself: sbatch --array=7 needs SHARDS=16 then.
set -eu
project=${PROJECT:-cluster.toml}
shards=${SHARDS:-$SLURM_ARRAY_TASK_COUNT}

quasilux shard "$project" --plan plan.json \
    --shard "$SLURM_ARRAY_TASK_ID/$shards" \
    --threads "$SLURM_CPUS_PER_TASK" \
    --out "parts/$SLURM_ARRAY_TASK_ID.part" --quiet
