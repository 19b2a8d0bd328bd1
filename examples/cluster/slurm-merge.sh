#!/bin/bash
#SBATCH --job-name=quasilux-merge
#SBATCH --cpus-per-task=8
#SBATCH --mem=4G
#SBATCH --time=00:10:00
# Puts the parts together, and takes the pictures of cameras. Exit code 3, which Slurm shows as a failed job, says that
# the results are written and complete, but that the samples of the plan were too few for the tolerance.
set -eu
quasilux merge parts/*.part --out out --threads "$SLURM_CPUS_PER_TASK"
