#!/usr/bin/env bash
# Renders the goldens anew and rewrites those that changed: tests/golden/goldens.json with its pictures, and
# tests/golden/corpus.json.in where the corpus of sample models is there. Says what changed.
#   scripts/update-goldens.sh [PROGRAM]      default: build/release/facet
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
facet=${1:-build/release/facet}
corpus=${FACET_CORPUS:-../shared/corpus}

"$facet" check tests/golden/goldens.json --root . --update

if [[ -d $corpus ]]; then
  corpus=$(realpath "$corpus")
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  sed "s|@CORPUS@|$corpus|" tests/golden/corpus.json.in > "$folder/corpus.json"
  status=0
  "$facet" check "$folder/corpus.json" --root / --update || status=$?
  sed "s|$corpus|@CORPUS@|" "$folder/corpus.json" > tests/golden/corpus.json.in
  (( status == 0 )) || exit "$status"
else
  echo "no corpus at $corpus: its goldens stay as they are"
fi
git --no-pager diff --stat -- tests/golden
