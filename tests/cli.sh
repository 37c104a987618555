#!/bin/sh
# The program from outside: exit status, messages, the same bytes whatever the threads and however often it is killed.
# RAYCOST names the program.
set -u
raycost=${RAYCOST:-build/plain/raycost}
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
passed=0 failed=0

# expect STATUS TEXT COMMAND...: the command must end with STATUS and say TEXT (a fixed string) on stdout or stderr.
expect() {
	status=$1 text=$2
	shift 2
	"$@" >"$work/stdout" 2>"$work/stderr"
	got=$?
	# The blank line lets an empty text match.
	if [ "$got" -ne "$status" ] || ! cat "$work/stdout" "$work/stderr" - <<-END | grep -qF -- "$text"; then

	END
		echo "FAILED ($got, wanted $status and '$text'): $*"
		cat "$work/stderr"
		failed=$((failed + 1))
	else
		passed=$((passed + 1))
	fi
}
same() { expect 0 '' cmp "$1" "$2"; }

# The words it understands.
expect 0 'raycost run' "$raycost" --help
expect 0 'raycost ' "$raycost" --version
for command in run plan merge compare history render report spd info view convert columns; do
	expect 0 "usage: raycost $command" "$raycost" $command --help
done
expect 2 'no command given' "$raycost"
expect 2 "no command 'fly'" "$raycost" fly
expect 2 'no job file given' "$raycost" run
expect 2 "--threads 0: not a value" "$raycost" run jobs/smoke.yaml --threads 0
expect 2 "'--frobnicate' is not understood" "$raycost" run jobs/smoke.yaml --frobnicate
expect 2 'needs a value' "$raycost" run jobs/smoke.yaml --set
expect 0 'z_exact' "$raycost" columns
expect 0 'tetra' "$raycost" spd
expect 2 "no family 'cow'" "$raycost" spd cow
expect 2 'size 0 is not in 1..13' "$raycost" spd tetra -s 0
expect 2 'not in 1..13' "$raycost" spd tetra -s 99
expect 2 'not a resolution' "$raycost" spd balls -t 0
expect 2 'shells has no -n' "$raycost" spd shells -n 3
expect 2 'No such file' "$raycost" run nowhere.yaml
expect 2 'No such file' "$raycost" info nowhere.nff
expect 2 'not a regular file' "$raycost" info tests

# Scenes through files and back, plain and gzipped; equal content gives equal bytes.
expect 0 '' "$raycost" spd gears -s 1 -o "$work/gears.nff"
expect 0 '' "$raycost" spd gears -s 1 -o "$work/gears.nff.gz"
expect 0 '' "$raycost" spd gears -s 1 -o "$work/again.nff.gz"
same "$work/gears.nff.gz" "$work/again.nff.gz"
gzip -dc "$work/gears.nff.gz" >"$work/unpacked.nff"
same "$work/gears.nff" "$work/unpacked.nff"
expect 0 '574 triangles' "$raycost" info "$work/gears.nff.gz"
expect 1 'nowhere' "$raycost" spd tetra -o "$work/nowhere/x.nff"
for bad in tests/bad/*.nff tests/bad/*.nff.gz tests/bad/*.aff; do expect 2 "$(cat "$bad.expect")" "$raycost" info --strict "$bad"; done

# Other formats: what each holds comes back; POV-Ray's image lands beside its scene; what cannot be is said before anything is read.
expect 0 '' "$raycost" convert "$work/gears.nff.gz" "$work/back.nff" --digits 6
same "$work/gears.nff" "$work/back.nff"
expect 0 '' "$raycost" convert "$work/gears.nff" "$work/gears.pov.gz"
expect 0 '' "$raycost" convert "$work/gears.nff" "$work/gears.obj.gz"
expect 0 'newmtl m1' cat "$work/gears.mtl"
expect 0 '' "$raycost" spd sombrero -r pov -o "$work/sombrero.pov"
expect 0 'hf000.tga' grep tga "$work/sombrero.pov"
expect 0 '3090' wc -c "$work/hf000.tga"
expect 0 '// POV-Ray 1.0' "$raycost" spd tetra -s 1 -r 2
expect 2 '-r rib: no such format; known are nff, pov (pov3), pov1, pov2, pov3' "$raycost" spd tetra -r rib
expect 2 'no writer for mesh; known endings are: nff aff pov inc obj ply' "$raycost" convert nowhere.nff "$work/x.stl"
expect 2 'IN and OUT are needed' "$raycost" convert "$work/gears.nff"
expect 2 'no reader for this kind of file; known endings are: nff aff' "$raycost" info tests/bad/unknown.txt
expect 1 'nowhere' "$raycost" convert "$work/gears.nff" "$work/nowhere/x.ply"
expect 0 '' "$raycost" view "$work/gears.nff" -o "$work/gears.png" --width 40 --height 30
expect 0 'PNG' head -c 8 "$work/gears.png"
# The same triangles, whatever the surroundings; faults.sh has a locale with decimal commas.
for scene in machine terrain; do
	expect 0 '' "$raycost" convert --resolution 3 jobs/scenes/$scene.pov "$work/$scene.ply"
	expect 0 '' env LC_ALL=de_DE.UTF-8 TZ=Asia/Tokyo HOME=/nowhere "$raycost" convert --resolution 3 jobs/scenes/$scene.pov "$work/again.ply"
	same "$work/$scene.ply" "$work/again.ply"
done
# Scenes may ask for the size of their image.
echo '#error concat(str(image_width, 0, 0), " by ", str(image_height, 0, 0))' >"$work/asks.pov"
expect 2 'the scene says: 40 by 30' "$raycost" render "$work/asks.pov" --width 40 --height 30
expect 2 'the scene says: 512 by 512' "$raycost" render "$work/asks.pov"
expect 2 'the scene says: 40 by 512' "$raycost" view "$work/asks.pov" -o "$work/asks.png" --width 40
expect 2 'the scene says: 800 by 600' "$raycost" info "$work/asks.pov"
expect 2 '-o IMAGE.png is needed' "$raycost" view "$work/gears.nff"
printf 'f 1 1 1 1 0 1 0 1\ntt wood 0 0 0 0 0 1 0 0 1 0 0 1 0 0 1\ni part.aff\nd 1\n' >"$work/main.aff"
mkdir "$work/parts"
printf 's 0 0 0 1\ns 0 0 0 1\n' >"$work/parts/part.aff"
expect 2 'part.aff: no such file there' "$raycost" info "$work/main.aff"
expect 0 'primitives  3: 1 triangles, 2 spheres' "$raycost" info "$work/main.aff" -L "$work/parts"
expect 0 'skipped     1 records, the first in line 4' "$raycost" info "$work/main.aff" -L "$work/parts"
expect 0 'duplicates  1 equal' "$raycost" info "$work/main.aff" -L "$work/parts"
expect 2 "'d' is not part of a scene that stands still" "$raycost" info "$work/main.aff" --strict -L "$work/parts"
expect 2 '--planes fold: not a value' "$raycost" info "$work/main.aff" --planes fold
expect 2 '-L needs a value' "$raycost" info "$work/main.aff" -L
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' >"$work/one.obj"
if "$raycost" info "$work/one.obj" >/dev/null 2>&1; then
	expect 0 '574 triangles' "$raycost" info "$work/gears.obj.gz"
	expect 0 '' "$raycost" convert "$work/one.obj" "$work/one.ply"
	expect 0 '1 triangles' "$raycost" info "$work/one.ply"
	printf 'f 1 2 999\nv 0 0 0\n' >"$work/damaged.obj"
	expect 2 'damaged.obj: ' "$raycost" info "$work/damaged.obj"
else
	expect 2 'one.obj: this format needs Assimp: install libassimp-dev' "$raycost" info "$work/one.obj"
fi
cat >"$work/formats.yaml" <<'JOB'
name: formats
scenes: [{file: main.aff, include: parts, resolution: [1, 2], curves: tessellate}]
structures: [octree: {max_depth: 2}]
measure: [{rays: invariant, count: 1000}]
JOB
expect 0 '2 rows, 0 failed' "$raycost" run "$work/formats.yaml" -o "$work/formats"
sed 's/include: parts/include: ..\/parts/' "$work/formats.yaml" >"$work/outside.yaml"
expect 2 "lies outside the job file's folder" "$raycost" run "$work/outside.yaml" -o "$work/formats"

# Scenes in POV-Ray's language, whole: every deviation from an exact prediction is within four standard errors.
expect 0 '48 rows, 0 failed' "$raycost" run jobs/pov.yaml --set count=5000 --set max_depth=5 --set resolution=2 -o "$work/pov"

# Rays from inside: the comparison's plan, and the same of a scene of one's own, with its tables.
expect 0 '64 rows' "$raycost" run jobs/fabianowski2009.yaml --dry-run
"$raycost" spd room -s 2 -o "$work/room.nff"
expect 2 'outside' "$raycost" run jobs/meshes.yaml --set mesh="$work/room.nff" --dry-run
expect 0 '12 rows, 0 failed' "$raycost" run jobs/meshes.yaml --allow-outside --set mesh="$work/room.nff" --set pixels=16 --set rays=2000 \
	--set depth=10 -o "$work/meshes"
expect 0 'what eq. (3) assumes' cat "$work/meshes/report.html"
expect 0 'The trees' cat "$work/meshes/report.html"
expect 0 '48 rows, all within' awk -F, '
	NR == 1 { for (i = 1; i <= NF; i++) if ($i ~ /^z_/) column[i] }
	NR > 1 { for (i in column) { all += $i != ""; far += ($i + 0 > 4 || $i + 0 < -4) } }
	END { if (all >= 3 * (NR - 1) && !far) print NR - 1 " rows, all within" }' "$work/pov/counts.csv"
for scene in jobs/scenes/*.pov; do expect 0 'primitives' "$raycost" info --strict --resolution 2 "$scene"; done

# A job: the same bytes for 1, 2 and 7 threads; a second time nothing is done.
run() { "$raycost" run jobs/smoke.yaml "$@"; }
expect 0 '108 rows' run --dry-run
for threads in 1 2 7; do expect 0 '108 rows, 0 failed' run --threads $threads -o "$work/t$threads"; done
same "$work/t1/counts.csv" "$work/t2/counts.csv"
same "$work/t1/counts.csv" "$work/t7/counts.csv"
expect 0 '108 rows, 0 failed' run -o "$work/t1"
same "$work/t1/counts.csv" "$work/t2/counts.csv"
expect 0 '"rows_kept": 108' cat "$work/t1/manifest.json"

# Killed at any time, started again: the same file. A torn last line is dropped and done anew.
for delay in 0.02 0.05 0.1 0.2 0.3; do
	"$raycost" run jobs/smoke.yaml -o "$work/killed" >/dev/null 2>&1 &
	victim=$!
	sleep $delay
	kill -9 $victim 2>/dev/null
	wait $victim 2>/dev/null
done
expect 0 '108 rows, 0 failed' run -o "$work/killed"
same "$work/t1/counts.csv" "$work/killed/counts.csv"
head -c 9000 "$work/t1/counts.csv" >"$work/killed/counts.csv"
expect 0 '108 rows, 0 failed' run -o "$work/killed"
same "$work/t1/counts.csv" "$work/killed/counts.csv"

# After a power cut blocks may be empty: rows with a hole are no rows.
dd if=/dev/zero of="$work/killed/counts.csv" bs=1 seek=9000 count=700 conv=notrunc 2>/dev/null
expect 0 '108 rows, 0 failed' run -o "$work/killed"
same "$work/t1/counts.csv" "$work/killed/counts.csv"
expect 1 '' grep -q '"rows_added": 0' "$work/killed/manifest.json"
expect 1 '' test -e "$work/killed/counts.old.csv"

# What another version of the program wrote, of other columns, is set aside whole; the times too.
mkdir "$work/older"
printf 'key,scene\n0123456789abcdef,tetra-1\n' >"$work/older/counts.csv"
printf 'key,seconds\n0123456789abcdef,1\n' >"$work/older/times.csv"
expect 0 '108 rows, 0 failed' run -o "$work/older"
same "$work/t1/counts.csv" "$work/older/counts.csv"
expect 0 '0123456789abcdef,tetra-1' cat "$work/older/counts.old.csv"
expect 0 '0123456789abcdef,1' cat "$work/older/times.old.csv"
expect 0 '109 ' wc -l "$work/older/times.csv"
printf '0123456789abcdef,torn' >>"$work/older/times.csv"
expect 0 '108 rows, 0 failed' run -o "$work/older"
expect 0 '109 ' wc -l "$work/older/times.csv"

# Rows of another job are set aside, never mixed in.
expect 0 '108 rows, 0 failed' run --set size=1,3 -o "$work/killed"
expect 0 'tetra-2' cat "$work/killed/counts.old.csv"
expect 1 '' grep -q tetra-2 "$work/killed/counts.csv"

# Failed rows are tried again; --fresh does all of them again; a renamed job and a changed scene are other rows.
cp "$work/gears.nff" "$work/hall.nff"
cat >"$work/hall.yaml" <<'JOB'
name: hall
scenes: [{file: hall.nff, strict: true}]
structures: [list, octree: {max_depth: 3}]
measure: [{rays: invariant, count: 1000}]
output: {scenes: true}
JOB
hall() { "$raycost" run "$work/hall.yaml" -o "$work/hall" "$@"; }
echo mesh >>"$work/hall.nff"
expect 4 '2 rows, 2 failed' hall
cp "$work/gears.nff" "$work/hall.nff"
expect 0 '2 rows, 0 failed' hall
cp "$work/hall/counts.csv" "$work/hall.csv"
gzip -dc "$work/hall/scenes/hall.nff.gz" >"$work/kept.before"
expect 0 '"rows_added": 2' cat "$work/hall/manifest.json"
expect 0 '2 rows' hall
expect 0 '"rows_kept": 2' cat "$work/hall/manifest.json"
expect 0 '2 rows' hall --fresh
expect 0 '"rows_added": 2' cat "$work/hall/manifest.json"
same "$work/hall.csv" "$work/hall/counts.csv"
echo 's 0 0 0 9' >>"$work/hall.nff"
expect 0 '2 rows' hall
expect 0 '"rows_added": 2' cat "$work/hall/manifest.json"
gzip -dc "$work/hall/scenes/hall.nff.gz" >"$work/kept.after"
expect 1 '' cmp -s "$work/kept.before" "$work/kept.after"
expect 0 '' sh -c "[ \$(grep -c hall '$work/hall/counts.csv') = 2 ] && [ \$(grep -c ,ok, '$work/hall/counts.old.csv') = 2 ]"
cp "$work/gears.nff" "$work/hall.nff"
expect 0 '2 rows' hall
expect 0 '"rows_kept": 2' cat "$work/hall/manifest.json"
same "$work/hall.csv" "$work/hall/counts.csv"
sed -i 's/name: hall/name: hill/' "$work/hall.yaml"
expect 0 '2 rows' hall
expect 1 '' grep -q '^[0-9a-f]*,hall' "$work/hall/counts.csv"

# Memory does not grow with the rows.
cat >"$work/rows.yaml" <<JOB
name: rows
scenes: [{spd: soup, count: 200, seed: [$(seq -s, 1 125)]}]
structures: [octree: {max_objects: [2, 10], max_depth: 4}]
measure: [{rays: invariant, count: [2000, 2001]}]
JOB
expect 0 '500 rows, 0 failed' "$raycost" run "$work/rows.yaml" -o "$work/rows" --threads 1
expect 0 'steady' awk -F, 'NR == 51 { early = $NF } NR == 501 && $NF <= 1.05 * early { print "steady" }' "$work/rows/times.csv"

# Shards: what is missing, what is done, and that no other word will do.
for bad in 3/3 -1/3 1 1/0 /3 1/3x 0x1/3; do expect 2 'not a value' run --shard "$bad"; done
expect 0 '36 rows, 0 failed' run -o "$work/parts" --shard 1/3
expect 0 '36 rows' "$raycost" plan jobs/smoke.yaml --shard 1/3
expect 4 '72 rows missing' "$raycost" plan jobs/smoke.yaml --missing -o "$work/parts"
expect 4 'of 108 rows 0 failed and 72 are missing' "$raycost" merge "$work/parts"
expect 0 '108 rows, 0 failed' run -o "$work/parts"
same "$work/t1/counts.csv" "$work/parts/counts.csv"
expect 0 '0 rows missing' "$raycost" plan jobs/smoke.yaml --missing -o "$work/parts"
expect 0 '108 rows of 1 shards' "$raycost" merge "$work/parts"
same "$work/t1/counts.csv" "$work/parts/counts.csv"
expect 0 '' run -o "$work/parts" --shard 0/2 --set size=3
expect 2 'shards of different jobs' "$raycost" merge "$work/parts"
expect 2 'there are no shards' "$raycost" merge "$work/t1"

# Images, drawings and the page; killed in the middle they are made again, and a shard's move to where they belong.
cat >"$work/page.yaml" <<'JOB'
name: page
vars: {size: 2}
scenes: [{spd: tetra, size: "${size}"}, {spd: teapot, size: 1}, {spd: wall}]
structures: [octree: {max_objects: [2, 5], max_depth: 4}, octree: {criterion: random, runs: 2, max_depth: 3}]
measure: [{rays: invariant, count: [300, 3000]}, {render: {width: 16, height: 16}}]
output: {images: true, drawings: true, scenes: true, report: true}
JOB
page() { "$raycost" run "$work/page.yaml" "$@"; }
expect 0 'report.html' page -o "$work/page"
expect 0 'Every row' cat "$work/page/report.html"
expect 0 'scenes/tetra-2.nff.gz' sh -c "cd '$work/page' && ls scenes/tetra-2.nff.gz images/wall*.png drawings/tetra-2.dat"
expect 0 '18 rows, 0 failed' page -o "$work/pages" --shard 1/2
expect 0 '18 rows, 0 failed' page -o "$work/pages" --shard 0/2
expect 0 '36 rows of 2 shards' "$raycost" merge "$work/pages"
same "$work/page/counts.csv" "$work/pages/counts.csv"
for file in scenes/tetra-2.nff.gz drawings/tetra-2.dat images/tetra-2.png; do same "$work/page/$file" "$work/pages/$file"; done
# Going on after the first structure's rows must not draw the scene with the second.
mkdir "$work/half" && cp -r "$work/page/drawings" "$work/half/" && head -n 8 "$work/page/counts.csv" >"$work/half/counts.csv"
expect 0 '36 rows, 0 failed' page -o "$work/half"
same "$work/page/counts.csv" "$work/half/counts.csv"
same "$work/page/drawings/tetra-2.dat" "$work/half/drawings/tetra-2.dat"
expect 0 'report.html' "$raycost" report "$work/pages"
expect 2 'No such file' "$raycost" report "$work/nowhere"
expect 0 'primary' "$raycost" render "$work/gears.nff" --width 16 --height 16 -o "$work/gears.png" --max_depth 4
expect 0 'PNG' head -c 4 "$work/gears.png"
expect 2 'needs a value' "$raycost" render "$work/gears.nff" --width

# A row tells how many rays were shot, more than asked for where they were not enough to be sure.
cat >"$work/sure.yaml" <<'JOB'
name: sure
scenes: [{spd: balls, size: 1, tessellate: true}]
structures: [octree: {max_depth: 4}]
measure: [{rays: invariant, count: 3001, error: 0.02}]
JOB
expect 0 '1 rows, 0 failed' "$raycost" run "$work/sure.yaml" -o "$work/sure"
expect 0 'more' awk -F, 'NR == 1 { for (i = 1; i <= NF; i++) column[$i] = i } NR == 2 && $column["rays"] > 3001 { print "more" }' "$work/sure/counts.csv"

# A gate: equal records are good; the report is written before the verdict.
expect 0 '108 rows compared, 0 missing, 0 new: good' "$raycost" compare "$work/t1" "$work/t2"
expect 0 'good' "$raycost" compare "$work/t1" "$work/t2" --fail-if rays_per_second:99.9% --fail-if actual:0
expect 3 'is worse than' "$raycost" compare "$work/t1" "$work/hall" --format markdown -o "$work/gate.md"
expect 0 '| fail |' cat "$work/gate.md"
expect 0 'new: good' "$raycost" compare "$work/t1" "$work/hall" --lenient
expect 3 'fail,' "$raycost" compare "$work/t1" "$work/hall" --format csv
expect 2 "no column 'speed'" "$raycost" compare "$work/t1" "$work/t2" --fail-if speed:1%
expect 2 'not a value' "$raycost" compare "$work/t1" "$work/t2" --fail-if actual
expect 2 'two folders' "$raycost" compare "$work/t1"
expect 0 'that all 3 runs have' "$raycost" history "$work/t1/" "$work/t2/" "$work/t7/" "$work" -o "$work"
expect 0 'history-actual.dat' cat "$work/plots/history-actual.gp"
expect 2 'no folder' "$raycost" history "$work"

# An ended run says so and goes on later; two runs do not share a folder.
sed 's/count: 20000/count: 4000000/' jobs/smoke.yaml >"$work/long.yaml"
"$raycost" run "$work/long.yaml" -o "$work/long" 2>"$work/ended" >/dev/null &
long=$!
sleep 0.5
expect 75 'another run is at work' "$raycost" run "$work/long.yaml" -o "$work/long"
kill -TERM $long
wait $long
expect 143 'the same command goes on' sh -c "cat '$work/ended'; exit $?"

# Where nothing can be written; where nobody listens.
touch "$work/file"
expect 1 'Not a directory' run -o "$work/file/out"
expect 1 'stdout: ' sh -c "'$raycost' columns >/dev/full"
expect 1 'stdout: ' sh -c "'$raycost' columns >&-"

# A bad scene is a failed row; the others are there.
printf 's 0 0 0 1\nmesh\n' >"$work/bad.nff"
printf 's 0 0 0 1\ns 1 2 3 1\n' >"$work/good.nff"
cat >"$work/mixed.yaml" <<'JOB'
name: mixed
scenes: [{file: bad.nff, strict: true}, {file: good.nff}]
structures: [octree: {max_depth: 2}]
measure: [{rays: invariant, count: 1000}]
JOB
expect 4 '2 rows, 1 failed' "$raycost" run "$work/mixed.yaml" -o "$work/mixed"
expect 0 "unknown keyword 'mesh'" cat "$work/mixed/counts.csv"
expect 4 '2 rows, 1 failed' "$raycost" run "$work/mixed.yaml" -o "$work/mixed"

# What make passes on is data.
expect 2 'is not a whole number' make -s sweep BUILD="$(dirname "$raycost")" SIZE="1,2; touch $work/owned"
expect 2 'is not a whole number' make -s sweep BUILD="$(dirname "$raycost")" SIZE='$(shell touch '"$work"'/owned)'
expect 1 '' test -e "$work/owned"

echo "cli: $passed passed, $failed failed"
[ "$failed" -eq 0 ]
