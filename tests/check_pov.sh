#!/bin/sh
# Every example scene of POV-Ray read by us and by POV-Ray: the share that is read, and that agrees ray for ray (tests/check_pov.c).
# usage: check_pov.sh PROGRAM [FOLDER OF SCENES] [LEAST SHARE THAT AGREES, IN PERCENT] [LIST OF RESULTS]; exit status 1 below that share
# Needs povray, povray-examples and povray-includes. Scenes of mesh cameras bake images and are left out.
program=$1
scenes=${2:-/usr/share/doc/povray/examples}
least=${3:-85}
results=${4:-build/check_pov.txt}
command -v povray >/dev/null || { echo "check_pov: povray is not installed" >&2; exit 1; }
mkdir -p "$(dirname "$results")"
find "$scenes" -name '*.pov' | sort | while read -r scene; do
	ulimit -t 120
	"$program" "$scene" || echo "unread   -     $scene  no result"
done >"$results"
awk -v least="$least" '
	{ count[$1]++ }
	$1 == "unread" || $1 == "differ" { print substr($0, 1, 200) }
	END {
		all = count["agree"] + count["differ"] + count["unread"]
		if (!all) all = 1
		printf "%d scenes, %d refused by POV-Ray; of the other %d are read %d (%.1f %%), agree %d (%.1f %%)\n", NR, count["refused"], all,
			all - count["unread"], 100 * (all - count["unread"]) / all, count["agree"], 100 * count["agree"] / all
		exit 100 * count["agree"] < least * all
	}' "$results"
