#!/usr/bin/env bash
# usage: apply.sh WORKTREE [STAGE...]: moves, formats and commits, a commit a stage. The worktree must be clean.
set -euo pipefail
here=$(cd "$(dirname "$0")" && pwd)
cd "$1"; shift
[[ -z $(git status --porcelain -uno) ]] || { echo "not clean" >&2; exit 1; }
format=$(command -v clang-format-14 || command -v clang-format)
declare -A says=(
  [root]="Keep the root to what a stranger needs: container recipe in scripts, security in docs"
  [analysis]="Put what is worked out of shapes, measurements and contacts under one roof"
  [report]="Give reports a floor of their own, with pictures in it and pages beside their verbs"
  [interfaces]="Let the program and the interfaces share FMUs and result folders below both"
  [contact]="Put what imitates CONTACT into rooms of one name"
  [vehicle]="Sort the solvers of vehicles into rooms: track, contacts, stability"
  [model]="Sort the model into rooms; public headers keep their old names until 0.3"
  [limits]="Hold the number of entries at the root by the test of the architecture"
)
for stage in ${@:-root analysis report interfaces contact vehicle model limits}; do
  python3 "$here/move.py" . "$stage"
  git diff --cached --name-only --diff-filter=d -- '*.cpp' '*.hpp' | { grep -v third_party || true; } | xargs -r python3 "$here/sort_includes.py"
  git add -u
  python3 "$here/others.py" | xargs -r -n 60 -P 2 "$format" -i
  git add -u
  if git diff --cached --quiet; then echo "$stage: nothing to do"; else git commit -q -m "${says[$stage]}"; echo "$stage: $(git log -1 --format=%h --shortstat | tr '\n' ' ')"; fi
done
