#!/bin/bash
# What the world does to a run: killed anywhere, signalled, started twice, without disk, memory, descriptors or threads, fed garbage. After
# every fault the same command gives the bytes of a run without faults. A case that needs a tool or a privilege that is not there says
# skip, and is counted.
#   RAYCOST names the program, SHIM the library of tests/shim.c; KILLS=N kills N times instead of 40, SEED=N chooses when.
set -u
raycost=$(realpath "${RAYCOST:-build/plain/raycost}") shim=${SHIM:+$(realpath "$SHIM")} kills=${KILLS:-40} RANDOM=${SEED:-1}
work=$(mktemp -d) passed=0 failed=0 skipped=0
trap 'umount -q "$work"/*/ 2>/dev/null; rm -rf "$work"' EXIT
sanitized=; case $raycost in */plain/*) ;; *) sanitized=yes ;; esac

fault() { echo "FAILED: $*"; [ -s "$work/stderr" ] && tail -5 "$work/stderr"; failed=$((failed + 1)); }
ok() { passed=$((passed + 1)); }
skip() { echo "skip: $*"; skipped=$((skipped + 1)); }
has() { command -v "$1" >/dev/null; }

# try STATUSES WORDS COMMAND...: ends with one of the statuses (a|b|c) and says WORDS; where it is not 0 it says something.
try() {
	local statuses=$1 words=$2 got
	shift 2
	"$@" >"$work/stdout" 2>"$work/stderr" </dev/null
	got=$?
	case "|$statuses|" in *"|$got|"*) ;; *) fault "status $got instead of $statuses: $*"; return ;; esac
	if [ -n "$words" ] && ! grep -qF -- "$words" "$work/stdout" "$work/stderr"; then fault "does not say '$words': $*"; return; fi
	if [ "$got" != 0 ] && [ -z "$words" ] && ! [ -s "$work/stderr" ] && ! [ -s "$work/stdout" ]; then fault "status $got and not a word: $*"; return; fi
	ok
}

# A job of 90 rows, and what becomes of it without faults.
cat >"$work/job.yaml" <<'JOB'
name: faults
seed: 3
vars: {n: 2000}
scenes: [{spd: tetra, size: [1, 2, 3]}, {spd: balls, size: 1}, {spd: gears, size: 1, soup: true}]
structures: [octree: {balanced: [false, true], max_objects: [2, 5], root: [cube, box], max_depth: 4}, list]
measure: [{rays: invariant, count: "${n}"}, {rays: lines, count: "${n}"}]
output: {scenes: true}
JOB
run() { "$raycost" run "$work/job.yaml" -o "$@"; }
try 0 '90 rows, 0 failed' run "$work/reference"
same() { # the same command once more gives the reference
	try 0 '90 rows, 0 failed' run "$1"
	cmp -s "$work/reference/counts.csv" "$1/counts.csv" && ! ls "$1"/*.tmp >/dev/null 2>&1 && [ ! -e "$1/counts.old.csv" ] && ok ||
		fault "$1/counts.csv is not that of a run without faults"
}

killed_at_random() {
	local done=0 pid rows=0 size
	for ((i = 0; i < kills; i++)); do
		"$raycost" run "$work/job.yaml" -o "$work/killed" >/dev/null 2>&1 &
		pid=$!
		sleep 0.0$((RANDOM % 10))$((RANDOM % 10))
		kill -9 $pid 2>/dev/null
		{ wait $pid; } 2>/dev/null
		[ -e "$work/killed/counts.csv" ] || continue
		# At every instant the rows are the first of the finished file, but for a torn last one.
		head -c "$(stat -c %s "$work/killed/counts.csv")" "$work/reference/counts.csv" | cmp -s - "$work/killed/counts.csv" ||
			fault "after $i kills the rows are not the first ones"
		# Done: tear it somewhere and go on.
		size=$(stat -c %s "$work/killed/counts.csv")
		if [ "$size" = "$(stat -c %s "$work/reference/counts.csv")" ]; then
			truncate -s $((size * (RANDOM % 100) / 100)) "$work/killed/counts.csv"
			rm -f "$work/killed/counts.old.csv"
			done=$((done + 1))
		fi
	done
	same "$work/killed"
	! ls "$work"/killed/scenes/*.tmp >/dev/null 2>&1 && ok || fault 'half-written files are left'
	echo "killed $kills times, finished and torn $done times"
}

killed_at_calls() {
	local -x ASAN_OPTIONS=detect_leaks=0 # which traces, as strace does
	has strace && strace -qq -o /dev/null true 2>/dev/null || { skip "no strace, or it may not trace: kills at system calls"; return; }
	for call in openat:3 openat:9 openat:25 openat:40 write:1 write:2 write:5 write:40 fsync:1 fsync:2 fsync:3 fsync:8 rename:1 rename:2 rename:4 rename:8 \
		close:9 close:30 unlink:1 ftruncate:1 flock:1 mkdir:1 mkdir:2; do
		{ strace -f -qq -o /dev/null -e inject="${call%:*}:signal=KILL:when=${call#*:}" "$raycost" run "$work/job.yaml" -o "$work/calls" & wait $!; } \
			>/dev/null 2>&1
	done
	same "$work/calls"
	for call in write:ENOSPC write:EIO fsync:EIO rename:EACCES openat:EMFILE mkdir:EROFS flock:ENOLCK ftruncate:EIO; do
		for when in 3 4 7 12; do
			try '0|1|2|4' '' strace -f -qq -o /dev/null -e inject="${call%:*}:error=${call#*:}:when=$when" \
				"$raycost" run "$work/job.yaml" -o "$work/errors"
		done
	done
	same "$work/errors"
	strace -qq -o /dev/null -e inject=flock:error=EAGAIN "$raycost" run "$work/job.yaml" -o "$work/errors" 2>/dev/null
	[ $? = 75 ] && ok || fault "a lock that is held"
	try 1 'No locks available' strace -qq -o /dev/null -e inject=flock:error=ENOLCK "$raycost" run "$work/job.yaml" -o "$work/errors"
}

signalled() {
	local pid start status
	for signal in INT:130 TERM:143 HUP:129; do
		env --default-signal "$raycost" run "$work/job.yaml" --set n=20000000 -o "$work/signalled" >/dev/null 2>"$work/stderr" &
		pid=$!
		sleep 0.5
		start=$(date +%s%N)
		kill -"${signal%:*}" $pid
		wait $pid
		status=$?
		[ $status = "${signal#*:}" ] && [ $((($(date +%s%N) - start) / 1000000)) -lt 2000 ] && grep -q 'same command goes on' "$work/stderr" && ok ||
			fault "SIG${signal%:*} ended with $status after $((($(date +%s%N) - start) / 1000000)) ms"
	done
	# In the middle of one block that takes minutes: still within two seconds. And a second signal does not wait at all.
	"$raycost" spd gears -s 4 --soup -o "$work/gears.nff"
	printf 'name: x\nscenes: [{file: gears.nff}]\nstructures: [list]\nmeasure: [{rays: invariant, count: 60000}]\n' >"$work/block.yaml"
	for second in 0 1; do
		env --default-signal "$raycost" run "$work/block.yaml" -o "$work/block" >/dev/null 2>"$work/stderr" &
		pid=$!
		sleep 1
		start=$(date +%s%N)
		kill -TERM $pid
		[ $second = 0 ] || { sleep 0.1; kill -TERM $pid; }
		{ wait $pid; } 2>/dev/null
		status=$?
		[ $status = 143 ] && [ $((($(date +%s%N) - start) / 1000000)) -lt $((second ? 500 : 2000)) ] && ok ||
			fault "SIGTERM in a long block ended with $status after $((($(date +%s%N) - start) / 1000000)) ms"
	done
	# A hang-up that is ignored, as under nohup, stays ignored.
	(trap '' HUP; exec "$raycost" run "$work/job.yaml" -o "$work/nohup" >/dev/null 2>"$work/stderr") &
	pid=$!
	sleep 0.05
	kill -HUP $pid 2>/dev/null
	wait $pid && ok || fault "an ignored SIGHUP"
	same "$work/nohup"
}

# on_tmpfs OPTIONS CASE: run the case where $work/disk is a small file system of its own.
on_tmpfs() {
	mkdir -p "$work/disk"
	mount -t tmpfs -o "$1" tmpfs "$work/disk" 2>/dev/null || { skip "no right to mount: $2"; return; }
	$2
	umount "$work/disk"
}
disk_full() {
	for size in 8k 20k 48k 64k 80k; do
		mount -o remount,size=$size "$work/disk"
		try 1 'No space left' run "$work/disk/out"
	done
	mount -o remount,size=16m "$work/disk"
	same "$work/disk/out"
}
read_only() {
	run "$work/disk/out" >/dev/null 2>&1
	mount -o remount,ro "$work/disk"
	try 1 'Read-only' run "$work/disk/out"
	try 1 'Read-only' run "$work/disk/other"
	mount -o remount,rw "$work/disk"
	same "$work/disk/out"
}

limited() {
	limit() { (ulimit "$1" "$2" && shift 2 && exec "$@"); }
	try 1 '' limit -f 8 "$raycost" run "$work/job.yaml" -o "$work/limited"
	for n in 3 4 5 6 7 8 9 10; do try '0|1|2|4|127' '' limit -n $n "$raycost" run "$work/job.yaml" -o "$work/limited"; done
	try 0 '90 rows' limit -s 256 "$raycost" run "$work/job.yaml" -o "$work/stack" --threads 4
	if [ -n "$sanitized" ]; then
		skip 'a sanitizer wants its memory: ulimit -v'
	else
		for kib in 4000 8000 16000 24000 32000 48000 64000 128000; do
			try '0|1|2|4|127' '' limit -v $kib "$raycost" run "$work/job.yaml" -o "$work/limited" --threads 1
		done
	fi
	same "$work/limited"
}

removed_while_running() {
	"$raycost" run "$work/job.yaml" --set n=2000000 -o "$work/removed" >/dev/null 2>"$work/stderr" &
	local pid=$! start
	sleep 0.4
	rm -rf "$work/removed"
	run "$work/removed" >/dev/null 2>&1
	wait $pid
	[ $? = 1 ] && grep -q 'removed or replaced' "$work/stderr" && ok || fault 'the output folder removed while running'
	same "$work/removed"
}

started_together() {
	for n in 2 8; do
		local pids=() won=0 busy=0
		for ((i = 0; i < n; i++)); do
			"$raycost" run "$work/job.yaml" --set n=100000 -o "$work/together$n" >/dev/null 2>"$work/stderr" &
			pids+=($!)
		done
		for pid in "${pids[@]}"; do
			wait "$pid"
			case $? in 0) won=$((won + 1)) ;; 75) busy=$((busy + 1)) ;; esac
		done
		[ $won -ge 1 ] && [ $((won + busy)) = "$n" ] && ok || fault "$n runs on one folder: $won done, $busy refused"
		run "$work/together$n" >/dev/null 2>&1
		cmp -s "$work/reference/counts.csv" "$work/together$n/counts.csv" && ok || fault "$n runs on one folder mixed their rows"
	done
}

standard_files() {
	for closed in '<&-' '>&-' '2>&-' '<&- >&-' '<&- >&- 2>&-'; do
		rm -rf "$work/standard"
		eval "run '$work/standard' $closed" >/dev/null 2>"$work/stderr"
		cmp -s "$work/reference/counts.csv" "$work/standard/counts.csv" && ok || fault "rows with $closed"
	done
	same "$work/standard"
	try 1 'stdout: ' bash -c "'$raycost' run '$work/job.yaml' -o '$work/standard' >&-"
	try 1 'No space left' bash -c "'$raycost' run '$work/job.yaml' -o '$work/standard' >/dev/full"
	try 1 'Broken pipe' bash -c "set -o pipefail; '$raycost' spd balls -s 4 | true"
	same "$work/standard"
}

surroundings() {
	local locale=
	localedef -i de_DE -f UTF-8 "$work/de_DE.UTF-8" >/dev/null 2>&1 && locale=yes
	if [ -n "$locale" ]; then
		env LOCPATH="$work" LC_ALL=de_DE.UTF-8 "$raycost" run "$work/job.yaml" -o "$work/locale" >/dev/null && same "$work/locale" || fault 'a locale with decimal commas'
		"$raycost" convert jobs/scenes/machine.pov "$work/here.ply" && env LOCPATH="$work" LC_ALL=de_DE.UTF-8 TZ=Asia/Tokyo "$raycost" convert jobs/scenes/machine.pov \
			"$work/there.ply" && cmp -s "$work/here.ply" "$work/there.ply" && ok || fault 'a scene read in a locale with decimal commas'
	else
		skip 'no localedef: a locale with decimal commas'
	fi
	TZ=:/nowhere/../../etc LANG=xx HOME=/nowhere env -u PATH "$raycost" run "$work/job.yaml" -o "$work/zone" >/dev/null && same "$work/zone" || fault 'TZ'
	[ -n "$shim" ] && [ -z "$sanitized" ] || { skip 'no shim, or sanitized: clock, threads, allocations'; return; }
	LD_PRELOAD=$shim CLOCK_JUMPS=1 run "$work/clock" >/dev/null && same "$work/clock" || fault 'a clock that jumps'
	LD_PRELOAD=$shim FAIL_THREADS=1 run "$work/threads" --threads 8 >/dev/null && same "$work/threads" || fault 'no threads'
	sed 's/size: \[1, 2, 3\]/size: 1/; s/n: 2000/n: 20/' "$work/job.yaml" >"$work/small.yaml"
	for n in $(seq 0 400); do
		try '0|1|2|4' '' env LD_PRELOAD="$shim" FAIL_ALLOCATION="$n" "$raycost" run "$work/small.yaml" -o "$work/memory" --fresh
	done
	for n in $(seq 0 23 400); do
		try '0|1|2|4' '' env LD_PRELOAD="$shim" FAIL_ALLOCATIONS_FROM="$n" "$raycost" run "$work/small.yaml" -o "$work/memory"
	done
	"$raycost" run "$work/small.yaml" -o "$work/plenty" >/dev/null
	"$raycost" run "$work/small.yaml" -o "$work/plenty" --shard 0/1 >/dev/null
	for n in $(seq 0 7 400); do
		try '0|1|2|4' '' env LD_PRELOAD="$shim" FAIL_ALLOCATION="$n" "$raycost" plan "$work/small.yaml" -o "$work/plenty" --missing
		try '0|1|2|4' '' env LD_PRELOAD="$shim" FAIL_ALLOCATION="$n" "$raycost" merge "$work/plenty"
		try '0|1|2|3' '' env LD_PRELOAD="$shim" FAIL_ALLOCATION="$n" "$raycost" compare "$work/plenty" "$work/memory"
		try '0|1|2' '' env LD_PRELOAD="$shim" FAIL_ALLOCATION="$n" "$raycost" report "$work/plenty"
	done
	"$raycost" merge "$work/plenty" >/dev/null
	"$raycost" run "$work/small.yaml" -o "$work/memory" >/dev/null
	cmp -s "$work/plenty/counts.csv" "$work/memory/counts.csv" && ok || fault 'rows after allocations have failed'
}

garbage() {
	"$raycost" spd tetra -s 2 -o "$work/t.nff.gz"
	local size bytes
	size=$(stat -c %s "$work/t.nff.gz")
	for ((i = 0; i < 40; i++)); do
		head -c $((size * i / 40)) "$work/t.nff.gz" >"$work/cut.nff.gz"
		try '0|2' '' "$raycost" info --strict "$work/cut.nff.gz" # cut off before the gzip head ends it is plain text
		cp "$work/t.nff.gz" "$work/flipped.nff.gz"
		bytes=$((RANDOM % size))
		printf "\\x$(printf %02x $((RANDOM % 256)))" | dd of="$work/flipped.nff.gz" bs=1 seek=$bytes conv=notrunc status=none
		try '0|2' '' "$raycost" info --strict "$work/flipped.nff.gz"
	done
	# Half a gigabyte of nothing in half a megabyte.
	head -c 500000000 /dev/zero | gzip -1 >"$work/bomb.nff.gz"
	if [ -n "$sanitized" ]; then
		try 2 'times its size' "$raycost" info "$work/bomb.nff.gz"
	else
		try 2 'times its size' bash -c "ulimit -v 1000000; exec '$raycost' info '$work/bomb.nff.gz'"
	fi
	printf 's 0 0 0 1\np 4000000000\n0 0 0\n' >"$work/huge.nff"
	try 2 'cannot fit' "$raycost" info "$work/huge.nff"
	head -c 1000000 /dev/zero | tr '\0' '[' >"$work/deep.yaml"
	try 2 '32 deep' timeout 5 "$raycost" run "$work/deep.yaml"
	mkfifo "$work/fifo"
	try 2 'not a regular file' timeout 5 "$raycost" run "$work/fifo"
	try 2 'not a regular file' timeout 5 "$raycost" info "$work/fifo"
	for file in counts.csv counts.old.csv times.csv .lock; do
		mkdir -p "$work/fifos"
		rm -rf "$work/fifos/$file"
		mkfifo "$work/fifos/$file"
		try '0|1' '' timeout 20 "$raycost" run "$work/job.yaml" -o "$work/fifos"
		rm -rf "$work/fifos"
		mkdir -p "$work/fifos/$file"
		try 1 '' timeout 20 "$raycost" run "$work/job.yaml" -o "$work/fifos"
		rm -rf "$work/fifos"
	done
	# A link out of the job's folder is as far out as a path; counts.csv that is a link is replaced, its target left alone.
	mkdir -p "$work/inside" "$work/linked"
	ln -s "$work/t.nff.gz" "$work/inside/link.nff.gz"
	printf 'name: x\nscenes: [{file: link.nff.gz}]\nstructures: [list]\nmeasure: [{rays: invariant, count: 10}]\n' >"$work/inside/job.yaml"
	try 2 'link out of' "$raycost" run "$work/inside/job.yaml" -o "$work/link"
	try 0 '1 rows' "$raycost" run "$work/inside/job.yaml" -o "$work/link" --allow-outside
	echo precious >"$work/precious"
	ln -s "$work/precious" "$work/linked/counts.csv"
	run "$work/linked" >/dev/null
	cmp -s "$work/reference/counts.csv" "$work/linked/counts.csv" && grep -qx precious "$work/precious" && ok || fault 'a link was written through'
	# 10^16 rows.
	{
		echo 'name: x'
		echo "scenes: [{spd: soup, count: 10, seed: [$(seq -s, 1 10000)]}]"
		echo "structures: [octree: {max_objects: [$(seq -s, 1 1000)], max_depth: [$(seq -s, 1 10)]}]"
		echo "measure: [{rays: invariant, count: [$(seq -s, 1 10000)], alpha: [$(seq -s, 1 1000)]}]"
	} >"$work/plan.yaml"
	try 2 'more than 100000' timeout 20 "$raycost" run --dry-run "$work/plan.yaml"
	try 2 'more than 10000000' timeout 60 "$raycost" run --dry-run --many "$work/plan.yaml"
}

cases="killed_at_random killed_at_calls signalled limited removed_while_running started_together standard_files surroundings garbage"
for case in $cases; do $case; done
on_tmpfs size=16m disk_full
on_tmpfs size=16m read_only
echo "faults: $passed passed, $failed failed, $skipped skipped"
[ "$failed" = 0 ]
