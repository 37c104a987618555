#!/bin/sh
# tests/layers.sh FLOOR... -- lowest first. A folder may include only its own floor and those below; predictors never see a ray
# and the tracer never sees a prediction; every header compiles alone.
set -u
bad=0
grep -rn '^#include "[a-z]*/' src spd --include='*.[ch]' | awk -v floors="$*" '
BEGIN { n = split(floors, f, " "); for (i = 1; i <= n; i++) rank[f[i]] = i }
{ split($1, place, ":"); k = split(place[1], dir, "/"); from = dir[k - 1]; split($2, inc, /["\/]/); to = inc[2]
  if (from == "src") next
  if (!rank[from] || !rank[to]) { print place[1] ": " from " or " to " is no floor"; bad = 1 }
  else if (rank[to] > rank[from]) { print place[1] ": " from " must not include " to; bad = 1 } }
END { exit bad }' || bad=1
if grep -rnE 'shoot_|>shoot' src/cost; then echo "src/cost: a predictor must not shoot"; bad=1; fi
if grep -rn '"cost/' src/trace; then echo "src/trace: the tracer must not see predictions"; bad=1; fi
for header in src/*/*.h spd/*.h; do
	name=${header#src/}
	printf '#include "%s"\n' "$name" | ${CC:-cc} -std=c11 -D_POSIX_C_SOURCE=200809L -Wall -Wextra -Wpedantic -Werror -Isrc -I. \
		-x c -fsyntax-only -Wno-psabi - || { echo "$header does not compile alone"; bad=1; }
done
exit $bad
