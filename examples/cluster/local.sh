#!/bin/sh
# sh local.sh PROJECT SAMPLES SHARDS: what a cluster does, with processes on one machine, and whether it
# gives the bits of the single run. QUASILUX names the program where it is not on the path.
set -eu
project=$1 samples=$2 shards=$3
quasilux=${QUASILUX:-quasilux}
out=${OUT:-out/cluster}

rm -rf "$out"
mkdir -p "$out/parts"
"$quasilux" plan "$project" --samples "$samples" --out "$out/plan.json"

processes=
k=0
while [ "$k" -lt "$shards" ]; do
    "$quasilux" shard "$project" --plan "$out/plan.json" --shard "$k/$shards" \
        --threads 1 --out "$out/parts/$k.part" &
    processes="$processes $!"
    k=$((k + 1))
done
for process in $processes; do
    wait "$process"
done

# Exit code 3 says that the tolerance was not reached with so many samples.
allow_3() { "$@" || [ $? -eq 3 ]; }
allow_3 "$quasilux" merge "$out"/parts/*.part --out "$out/merged"
allow_3 "$quasilux" run "$project" --plan "$out/plan.json" --out "$out/single" --quiet

for name in merged single; do
    grep -v -e '"seconds":' -e '"threads":' "$out/$name/result.json" > "$out/$name.txt"
done
cmp "$out/merged.txt" "$out/single.txt"
echo "the same bits in $shards parts and in one"
