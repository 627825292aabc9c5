#!/bin/sh
# From a text to a robot that has learnt something: `make demo` runs this in a folder that may be thrown away.
set -eu

folder=$1
mind=$folder/collect.mind

show() {
  printf '\n\033[1m$ %s\033[0m\n' "$*"
  "$@"
}

rm -rf "$folder"
mkdir -p "$folder"
cp "$(dirname "$0")/collect/collect.mind" "$folder"

show mindc check "$mind"
show mindc show "$mind"
show mindc train "$mind" GoToObject --generations 50 --seed 1 --runs "$folder/runs"
show mindc bench "$mind" --task GoToObject --runs 100 --seed 1
show mindc run "$mind" --task GoToObject --seed 3 --picture "$folder/go-to-object.png"

printf '\nThe robot and the path it took: %s\n' "$folder/go-to-object.png"
