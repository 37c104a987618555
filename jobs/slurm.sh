#!/bin/bash
#SBATCH --job-name=raycost
#SBATCH --array=0-15
#SBATCH --cpus-per-task=1
#SBATCH --output=slurm-%A_%a.log
# A job as an array of shards, one each; started again, every shard goes on where it was. From the folder of the Makefile:
#
#   id=$(sbatch --parsable jobs/slurm.sh jobs/sweep.yaml)
#   sbatch --dependency=afterany:$id --wrap 'build/plain/raycost merge out/sweep'
#
# --array=0-N on sbatch's command line takes another number of shards; further words are options of raycost run. The shards need only see
# the same files: the job, its scenes, and the output folder.
set -eu
job=$1
shift
if [ "$SLURM_ARRAY_TASK_MIN" != 0 ] || [ $((SLURM_ARRAY_TASK_MAX + 1)) != "$SLURM_ARRAY_TASK_COUNT" ]; then
	echo 'slurm.sh: the array must be 0-N, all of it: shards that are done end at once' >&2
	exit 2
fi
exec "${RAYCOST:-build/plain/raycost}" run "$job" --shard "$SLURM_ARRAY_TASK_ID/$SLURM_ARRAY_TASK_COUNT" --threads "${SLURM_CPUS_PER_TASK:-1}" "$@"
