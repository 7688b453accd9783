#!/usr/bin/env bash
# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: Treadmark contributors
# Runs the studies of a wheel flat in a vehicle (examples/figure*.toml) and writes their results and pictures into out/figures.
#   scripts/figures.sh [SLICES.slcw]
# A measured wheel takes the place of the generated flat; S1002_flat.slcw is looked for in ../shared/data/contact_examples. Without it the
# generated flat of the examples is used. Environment: PROGRAM (default build/release/app/treadmark, else build/app/treadmark),
# OUT (default out/figures), WORKERS (processor cores to use), PITCH_DEG (the angle at which the measured flat is down), SMOOTHING_MM3.
#
# Slices are given by angle and by their height over the nominal radius. A wheel of 490 mm radius that runs as one of 460 mm keeps its
# angles and depths; the flat becomes shorter by 460/490.
set -euo pipefail
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

program=${PROGRAM:-$root/build/release/app/treadmark}
[[ -x $program ]] || program=$root/build/app/treadmark
[[ -x $program ]] || { echo "no program at $program: build the target treadmark_cli, or name it in PROGRAM" >&2; exit 2; }
out=${OUT:-$root/out/figures}
workers=${WORKERS:-$(nproc)}
center=${PITCH_DEG:--37.2}

slices=${1:-}
known=$root/../shared/data/contact_examples/S1002_flat.slcw
[[ -n $slices || ! -f $known ]] || slices=$known
[[ -z $slices || -f $slices ]] || { echo "no file $slices" >&2; exit 2; }

degrees() { awk -v a="$1" -v b="$center" 'BEGIN { printf "%.4g", a + b }'; }

wheel=() angles=()
if [[ -n $slices ]]; then
  slices=$(realpath "$slices")
  echo "measured wheel: $slices" >&2
  wheel=(--set "wheel.shape.file=$slices" --set "wheel.shape.smoothing_lambda_mm3=${SMOOTHING_MM3:-5}" --set "wheel.flats=[]"
    --set "simulation.other_wheel.shape.standard=S1002" --set "simulation.wheels.0.pitch_deg=$(degrees 60)")
  list=""
  for angle in -10 -5 -3 -1 1 3 5 8; do list+="${list:+, }$(degrees "$angle")"; done
  angles=(--set "simulation.fields.pitch_deg=[$list]")
else
  echo "generated flat" >&2
fi

status=0
"$program" simulate "$root/examples/figure7.toml" -o "$out/figure7" --threads "$workers" "${wheel[@]}" "${angles[@]}" || status=$?
for study in figure5 figure6-track figure6; do
  "$program" sweep "$root/examples/$study.toml" -o "$out/$study" --threads "$workers" "${wheel[@]}" || status=$?
done
find "$out" -maxdepth 2 -name '*.svg' | sort
exit "$status"  # of a run that failed; the pictures show the others
