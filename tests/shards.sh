#!/bin/sh
# Shards started by make, by GNU parallel and, with SLURM=yes, by sbatch: merged, the bytes of a run without shards. RAYCOST names the
# program, JOB the job.
set -eu
raycost=${RAYCOST:-build/plain/raycost} job=${JOB:-jobs/smoke.yaml}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
"$raycost" run "$job" -o "$work/whole" >/dev/null

check() { # WAY N
	"$raycost" merge "$work/$1-$2" >/dev/null
	cmp "$work/whole/counts.csv" "$work/$1-$2/counts.csv"
	[ "$(sort "$work/whole/times.csv" | cut -d, -f1 | cksum)" = "$(sort "$work/$1-$2/times.csv" | cut -d, -f1 | cksum)" ]
	echo "shards: $2 by $1, the same bytes"
}

cat >"$work/Makefile" <<'MAKE'
all: $(addprefix shard-,$(shell seq 0 $$(($(N) - 1))))
shard-%: ; @$(RAYCOST) run $(JOB) -o $(OUT) --shard $*/$(N) --threads 1 >/dev/null
MAKE
for n in 1 3 16; do
	make -s -j2 -f "$work/Makefile" N=$n RAYCOST="$raycost" JOB="$job" OUT="$work/make-$n"
	check make $n
	if command -v parallel >/dev/null; then
		seq 0 $((n - 1)) | parallel --will-cite -j2 "$raycost" run "$job" -o "$work/parallel-$n" --shard {}/$n --threads 1 >/dev/null
		check parallel $n
	else
		echo "skip: no GNU parallel"
	fi
	if [ "${SLURM:-}" = yes ]; then
		RAYCOST=$raycost sbatch --wait --array=0-$((n - 1)) --output="$work/slurm-%a.log" jobs/slurm.sh "$job" -o "$work/slurm-$n" >/dev/null ||
			{ cat "$work"/slurm-*.log; exit 1; }
		check slurm $n
	fi
done
